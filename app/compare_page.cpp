// The page that `curlew compare` writes: one file, no script from elsewhere, pictures inside.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "app/compare.h"
#include "app/svg.h"
#include "render/png.h"
#include "sim/scene/json.h"

namespace curlew {
namespace {

using svg::escaped;

constexpr std::size_t most_pictures = 12;  // of the worst; each weighs three PNGs
constexpr int times = 16;                  // the differences are shown

// Light for everybody: the pictures are.
constexpr const char* style = R"(<style>
:root{color-scheme:light}
body{font:15px/1.5 system-ui,sans-serif;color:#222;background:#fff;max-width:1200px;margin:2em auto;padding:0 1em;
 overflow-wrap:anywhere}
h1{font-size:1.5em}h2{font-size:1.2em;margin-top:2.2em}h3{font-size:1em;margin:0 0 .3em}
.verdict{padding:.8em 1em;border-left:6px solid;background:#f4f6f8;font-size:1.1em}
.pass{border-color:#2e7d32}.pass b{color:#2e7d32}.fail{border-color:#b2182b}.fail b{color:#b2182b}
.warning{color:#8a5a00}.small{color:#555}
.scroll{overflow:auto}.long{max-height:40em}
.scroll table,.words td:first-child{white-space:nowrap}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}
td:first-child,th:first-child,.words td,.words th{text-align:left}
th{position:sticky;top:0;background:#fff}
tr.off td{background:#fdecea;color:#8f1020}tr.off td:first-child{font-weight:bold}
pre{background:#f0f2f4;padding:.6em .8em;white-space:pre-wrap;user-select:all}
figure{margin:1.5em 0 2.5em}
.pair{position:relative;width:fit-content;max-width:100%;--edge:50%;cursor:ew-resize;touch-action:none;line-height:0}
.pair img{max-width:100%}
.pair .over{position:absolute;inset:0;clip-path:inset(0 calc(100% - var(--edge)) 0 0)}
.pair .line{position:absolute;top:0;bottom:0;left:var(--edge);width:2px;margin-left:-1px;background:#fff;
 box-shadow:0 0 3px #000}
.pair span{position:absolute;top:.6em;background:#fffc;padding:0 .5em;line-height:1.5;border-radius:3px}
.pair .left{right:calc(100% - var(--edge) + .6em)}.pair .right{left:calc(var(--edge) + .6em)}
.pair .clip{position:absolute;inset:0;overflow:hidden;pointer-events:none}
input[type=range]{display:block;width:100%;margin:.3em 0 .8em}
.wide{width:fit-content;max-width:100%}
.three{display:grid;grid-template-columns:repeat(3,1fr);gap:8px}.three img{width:100%;display:block}
</style>
)";

// The pictures under the slider are those of the row below, so that the page holds each once. The edge between the
// golden picture, at its left, and the other follows the slider, and a pointer that is pressed on the picture.
constexpr const char* script = R"(<script>
for(const figure of document.querySelectorAll('figure')){
 const pair=figure.querySelector('.pair'),slider=figure.querySelector('input');
 if(!pair)continue;
 const pictures=figure.querySelectorAll('.three img'),places=pair.querySelectorAll('img');
 places[0].src=pictures[1].src;places[1].src=pictures[0].src;
 const show=()=>pair.style.setProperty('--edge',slider.value+'%');
 const follow=e=>{const box=pair.getBoundingClientRect();
  slider.value=100*(e.clientX-box.left)/box.width;show();};
 slider.addEventListener('input',show);
 pair.addEventListener('pointerdown',e=>{pair.setPointerCapture(e.pointerId);follow(e);e.preventDefault();});
 pair.addEventListener('pointermove',e=>{if(e.buttons)follow(e);});
 figure.querySelector('.wide').hidden=false;}
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

std::string number(double value, const char* format = "%.3g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// A number of a table in digits that a reader takes in, with all that there are at the pointer.
std::string short_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.size() <= 8 || *end != '\0') return escaped(text);
  return "<span title=\"" + escaped(text) + "\">" + number(value, "%.7g") + "</span>";
}

// In single quotes where a shell would take it for something else.
std::string shell_word(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string row(std::initializer_list<std::string> cells, bool off = false, const char* tag = "td") {
  std::string text = off ? "<tr class=\"off\">" : "<tr>";
  for (const std::string& cell : cells) text += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  return text + "</tr>\n";
}

std::string paragraph(const std::string& text, const char* kind = "small") {
  return std::string("<p class=\"") + kind + "\">" + text + "</p>\n";
}

std::string judgement(const PictureRow& picture) {
  if (!picture.difference.same_size) return "missing or of another size";
  if (picture.difference.largest == 0) return "same";
  return picture.allowed ? "within the tolerance" : "differs";
}

std::string picture_table(const std::vector<PictureRow>& pictures) {
  std::string text =
      "<div class=\"scroll long\"><table>\n" +
      row({"picture", "pixels that differ", "mean difference", "largest", "SSIM", "judgement"}, false, "th");
  for (const PictureRow& p : pictures) {
    const PictureDifference& d = p.difference;
    const std::string name = escaped(p.name) + (p.checkpoint.empty() ? "" : " of " + escaped(p.checkpoint));
    if (d.same_size)
      text += row({name, number(100 * d.share) + " %", number(d.mean), std::to_string(d.largest),
                   number(d.ssim, "%.5f"), judgement(p)},
                  !p.allowed);
    else
      text += row({name, "", "", "", "", judgement(p)}, true);
  }
  return text + "</table></div>\n";
}

// For the script to fill.
std::string slider(const std::string& label) {
  return "<div class=\"wide\" hidden><div class=\"pair\"><img alt=\"" + label +
         "\"><div class=\"over\"><img alt=\"golden\"></div><div class=\"line\"></div>"
         "<div class=\"clip\"><span class=\"left\">golden</span><span class=\"right\">" +
         label +
         "</span></div></div>\n<input type=\"range\" min=\"0\" max=\"100\" step=\"any\" value=\"50\" "
         "aria-label=\"golden or " +
         label + "\"></div>\n";
}

// Both pictures and their difference, and where there is one, a slider from the one to the other.
std::string figure(const PictureRow& picture, const Image& golden, const Image& other, const std::string& label) {
  return "<figure>\n<h3>" + escaped(picture.name) + "</h3>\n" + (picture.difference.largest > 0 ? slider(label) : "") +
         "<div class=\"three\"><div>golden" + inline_picture(golden) + "</div><div>" + label + inline_picture(other) +
         "</div><div>difference times " + std::to_string(times) + ", grey where equal" +
         inline_picture(difference_picture(golden, other, times)) + "</div></div>\n</figure>\n";
}

// Those that differ, the worst first. Of equal pictures one look is enough.
std::vector<PictureRow> worth_a_look(const std::vector<PictureRow>& all) {
  std::vector<PictureRow> rows;
  for (const PictureRow& p : all) {
    if (p.difference.same_size && p.difference.largest > 0) rows.push_back(p);
  }
  if (rows.empty() && all.back().difference.same_size) return {all.back()};
  std::stable_sort(rows.begin(), rows.end(),
                   [](const PictureRow& a, const PictureRow& b) { return a.difference.ssim < b.difference.ssim; });
  if (rows.size() > most_pictures) rows.resize(most_pictures);
  return rows;
}

std::string figures(const std::vector<PictureRow>& all, const RunRecord& golden, const RunRecord& now) {
  const std::vector<PictureRow> shown = worth_a_look(all);
  std::string text;
  if (shown.size() == most_pictures) text += paragraph("The " + std::to_string(most_pictures) + " that differ most:");
  for (const PictureRow& p : shown) {
    const Image before = read_png(golden.folder / "frames" / p.name);
    text += p.checkpoint.empty() ? figure(p, before, read_png(now.folder / "frames" / p.name), "new")
                                 : figure(p, before, p.drawn, "drawn again");
  }
  return text;
}

std::string allowed_text(const PictureTolerance& t) {
  return "Allowed: " + number(100 * t.share) + " % of the pixels off by more than " + std::to_string(t.channel) +
         " of 255, a mean difference of " + number(t.mean) + ", an SSIM of no less than " + number(t.ssim, "%.4g") +
         ".";
}

std::string pictures_section(const Comparison& c, const RunRecord& golden, const RunRecord& now) {
  if (c.pictures.empty()) return "";
  return "<h2>Pictures of both runs</h2>\n" + paragraph(allowed_text(c.picture_tolerance)) + picture_table(c.pictures) +
         figures(c.pictures, golden, now);
}

std::string redrawn_section(const Comparison& c, const RunRecord& golden, const RunRecord& now) {
  const Redrawn& r = c.redrawn;
  if (r.rows.empty() && r.hint.empty()) return "";
  const std::string title = "<h2>The golden run&rsquo;s stored states, drawn again</h2>\n";
  if (r.rows.empty()) return title + paragraph(escaped(r.hint));
  return title +
         paragraph(
             "Checkpoints of the golden run, drawn by the program that wrote this page and held to the pictures "
             "that the golden run has of the same steps. What differs here is the rendering, whatever the "
             "simulation does. " +
             allowed_text(c.tolerances.tight)) +
         picture_table(r.rows) + figures(r.rows, golden, now);
}

std::string versions_section(const RunRecord& golden, const RunRecord& now) {
  std::string text = "<h2>Versions</h2>\n<table class=\"words\">\n" + row({"", "golden", "new"}, false, "th");
  for (const auto& [key, name] : {std::pair{"version", "program"},
                                  {"compiler", "compiler"},
                                  {"instruction_set", "instruction set"},
                                  {"renderer", "renderer"},
                                  {"opengl", "OpenGL"}}) {
    const std::string a = golden.text({"program", key}), b = now.text({"program", key});
    if (!a.empty() || !b.empty()) text += row({name, escaped(a), escaped(b)}, a != b);
  }
  return text + row({"command", escaped(golden.text({"command"})), escaped(now.text({"command"}))}) + "</table>\n";
}

std::string allowed_text(const std::vector<StateTolerance>& all, const std::string& column) {
  for (const StateTolerance& t : all) {
    if (t.column != column) continue;
    if (t.share == 0 && t.absolute == 0) return "none";
    return number(100 * t.share) + " % or " + plain_number(t.absolute);
  }
  return "";
}

std::string state_section(const Comparison& c, const RunRecord& golden, const RunRecord& now) {
  const bool same = golden.state_hash() == now.state_hash();
  std::string text = "<h2>State at the end</h2>\n<div class=\"scroll\"><table>\n" +
                     row({"", "golden", "new", "difference", "allowed"}, false, "th") +
                     row({"hash of all bits", golden.state_hash(), now.state_hash(), same ? "same" : "differs", ""},
                         !same && !c.passed());
  for (const StateRow& r : c.state) {
    text += row({escaped(r.column), short_number(r.golden), short_number(r.now),
                 r.golden == r.now ? "same" : number(100 * r.difference, "%.2g") + " %",
                 allowed_text(c.tolerances.state, r.column)},
                !r.allowed);
  }
  return text + "</table></div>\n";
}

std::string changes_section(const Comparison& c) {
  if (c.changed.empty()) return "";
  std::string text = "<h2>What was asked for</h2>\n<ul>\n";
  for (const std::string& change : c.changed) text += "<li>" + escaped(change) + "</li>\n";
  return text + "</ul>\n";
}

}  // namespace

std::string comparison_page(const Comparison& c, const RunRecord& golden, const RunRecord& now) {
  const std::string old_folder = golden.folder.string(), new_folder = now.folder.string();
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Curlew: comparison</title>\n";
  text += style;
  text += "</head><body>\n<h1>" + escaped(new_folder) + " against " + escaped(old_folder) + "</h1>\n";
  text += paragraph((c.passed() ? "<b>Passed:</b> " : "<b>Failed:</b> ") + escaped(c.verdict),
                    c.passed() ? "verdict pass" : "verdict fail");
  for (const std::string& warning : c.warnings) text += paragraph("Warning: " + escaped(warning) + ".", "warning");
  text += changes_section(c) + redrawn_section(c, golden, now) + pictures_section(c, golden, now) +
          state_section(c, golden, now) + versions_section(golden, now);
  text += "<h2>To accept the new run</h2>\n<pre>curlew compare " + escaped(shell_word(old_folder)) + " " +
          escaped(shell_word(new_folder)) + " --accept</pre>\n";
  return text + script + "</body></html>\n";
}

}  // namespace curlew
