// The page that `curlew compare` writes: one file, no script from elsewhere, pictures inside.
#include <algorithm>
#include <cstdio>

#include "app/compare.h"
#include "app/svg.h"
#include "render/png.h"

namespace curlew {
namespace {

using svg::escaped;

constexpr std::size_t most_pictures = 12;  // of the worst; each weighs three PNGs

constexpr const char* style = R"(<style>
body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1000px;margin:2em auto;padding:0 1em}
h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em}
.verdict{padding:.8em 1em;border-left:6px solid;background:#f4f6f8;font-size:1.1em}
.pass{border-color:#2e7d32}.fail{border-color:#b2182b}.warning{color:#8a5a00}
table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right}
td:first-child,th:first-child{text-align:left}tr.off td{color:#b2182b;font-weight:bold}
code{background:#f0f2f4;padding:.15em .4em}
.pair{position:relative;max-width:100%}.pair img{display:block;width:100%}
.pair .over{position:absolute;inset:0;overflow:hidden;border-right:2px solid #fff}
.pair .over img{width:auto;height:100%;max-width:none}
input[type=range]{width:100%}figure{margin:1.2em 0}figcaption{color:#555}
.three{display:grid;grid-template-columns:repeat(3,1fr);gap:8px}.three img{width:100%}
</style>
)";

// Moves the edge between the golden picture, at the left, and the new one.
constexpr const char* script = R"(<script>
for(const p of document.querySelectorAll('.pair')){
 const over=p.querySelector('.over'),r=p.nextElementSibling;
 r.addEventListener('input',()=>over.style.width=r.value+'%');over.style.width=r.value+'%';}
</script>
)";

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (at + k < bytes.size() ? bytes[at + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += at + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string inline_picture(const Image& image) {
  return "<img src=\"data:image/png;base64," + base64(encode_png(image)) + "\" alt=\"\">";
}

std::string number(double value, const char* format = "%.4g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string row(std::initializer_list<std::string> cells, bool off = false, const char* tag = "td") {
  std::string text = off ? "<tr class=\"off\">" : "<tr>";
  for (const std::string& cell : cells) text += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  return text + "</tr>\n";
}

std::string picture_section(const PictureRow& picture, const RunRecord& golden, const RunRecord& now) {
  const PictureDifference& d = picture.difference;
  std::string text = "<figure>\n<figcaption>" + escaped(picture.name) + ": " + number(100 * d.share) +
                     " % of the pixels beyond the channel's tolerance, mean difference " + number(d.mean) +
                     " of 255, largest " + std::to_string(d.largest) + ", SSIM " + number(d.ssim, "%.5f") +
                     (picture.allowed ? "" : " &mdash; <b>not allowed</b>") + "</figcaption>\n";
  if (!d.same_size) return text + "<p>Missing in NEW, or of another size.</p></figure>\n";
  const Image a = read_png(golden.folder / "frames" / picture.name), b = read_png(now.folder / "frames" / picture.name);
  const std::string first = inline_picture(a), second = inline_picture(b);
  text += "<div class=\"pair\">" + second + "<div class=\"over\">" + first +
          "</div></div><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"golden or new\">\n";
  return text + "<div class=\"three\"><div>golden" + first + "</div><div>new" + second +
         "</div><div>difference times 16" + inline_picture(difference_picture(a, b, 16)) + "</div></div>\n</figure>\n";
}

std::string versions_section(const RunRecord& golden, const RunRecord& now) {
  std::string text = "<h2>Versions</h2>\n<table>\n" + row({"", "golden", "new"}, false, "th");
  for (const char* key : {"version", "compiler", "instruction_set", "renderer", "opengl"}) {
    const std::string a = golden.text({"program", key}), b = now.text({"program", key});
    text += row({key, escaped(a), escaped(b)}, a != b);
  }
  return text + row({"command", escaped(golden.text({"command"})), escaped(now.text({"command"}))}) + "</table>\n";
}

std::string state_section(const Comparison& c, const RunRecord& golden, const RunRecord& now) {
  std::string text =
      "<h2>State at the end</h2>\n<table>\n" + row({"", "golden", "new", "difference", "allowed"}, false, "th");
  text += row(
      {"hash", golden.state_hash(), now.state_hash(), golden.state_hash() == now.state_hash() ? "none" : "other", ""},
      golden.state_hash() != now.state_hash());
  for (const StateRow& r : c.state) {
    std::string allowed;
    for (const StateTolerance& t : c.tolerances.state) {
      if (t.column == r.column) allowed = number(100 * t.share) + " % or " + number(t.absolute);
    }
    text += row({r.column, r.golden, r.now, number(100 * r.difference) + " %", allowed}, !r.allowed);
  }
  return text + "</table>\n";
}

}  // namespace

std::string comparison_page(const Comparison& c, const RunRecord& golden, const RunRecord& now) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Curlew: comparison</title>\n";
  text += style;
  text += "</head><body>\n<h1>" + escaped(golden.folder.string()) + " and " + escaped(now.folder.string()) + "</h1>\n";
  text += std::string("<p class=\"verdict ") + (c.passed() ? "pass" : "fail") + "\">" + escaped(c.verdict) + "</p>\n";
  for (const std::string& warning : c.warnings) text += "<p class=\"warning\">Warning: " + escaped(warning) + ".</p>\n";
  if (!c.changed.empty()) {
    text += "<h2>What was asked for</h2>\n<ul>\n";
    for (const std::string& change : c.changed) text += "<li>" + escaped(change) + "</li>\n";
    text += "</ul>\n";
  }
  if (!c.pictures.empty()) {
    text += "<h2>Pictures</h2>\n<p>Allowed: " + number(100 * c.picture_tolerance.share) + " % of the pixels beyond " +
            std::to_string(c.picture_tolerance.channel) + " of 255, mean difference " +
            number(c.picture_tolerance.mean) + ", SSIM at least " + number(c.picture_tolerance.ssim) +
            ". Golden at the left of the edge, new at the right.</p>\n";
    std::vector<PictureRow> rows = c.pictures;
    std::stable_sort(rows.begin(), rows.end(),
                     [](const PictureRow& a, const PictureRow& b) { return a.difference.ssim < b.difference.ssim; });
    if (rows.size() > most_pictures) {
      text += "<p>The " + std::to_string(most_pictures) + " that differ most, of " + std::to_string(rows.size()) +
              ".</p>\n";
      rows.resize(most_pictures);
    }
    for (const PictureRow& r : rows) text += picture_section(r, golden, now);
  }
  text += state_section(c, golden, now) + versions_section(golden, now);
  text += "<h2>To accept the new run</h2>\n<p><code>curlew compare " + escaped(golden.folder.string()) + " " +
          escaped(now.folder.string()) + " --accept</code></p>\n";
  return text + script + "</body></html>\n";
}

}  // namespace curlew
