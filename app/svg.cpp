#include "app/svg.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace curlew::svg {

std::string format(const char* pattern, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor, double size, const char* more) {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%g\"%s>", x, y, anchor, size, more) +
         escaped(text) + "</text>\n";
}

double text_width(const std::string& text, double size) {
  constexpr double letter = 0.56;
  return letter * size * static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
           return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
         }));
}

std::vector<std::string> wrapped(const std::string& text, double width) {
  const auto most = static_cast<std::size_t>(width / (0.61 * small_size));
  std::vector<std::string> lines;
  std::string rest = text;
  while (rest.size() > most && rest.find(' ') != std::string::npos) {
    std::size_t cut = rest.rfind(' ', most);
    if (cut == std::string::npos || cut == 0) cut = rest.find(' ', 1);
    if (cut == std::string::npos) break;
    lines.push_back(rest.substr(0, cut));
    rest = rest.substr(cut + 1);
  }
  lines.push_back(rest);
  return lines;
}

std::string begin_picture(double width, double height) {
  return format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" fill=\"%s\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
      width, height, width, height, ink);
}

std::string small_print_text(const std::vector<std::string>& lines, double left, double height) {
  std::string out;
  double y = height - 14 - small_line * static_cast<double>(lines.size() - 1);
  for (const std::string& line : lines) {
    out += text_at(left, y, line, "start", small_size, " fill=\"#777777\" font-family=\"monospace\"");
    y += small_line;
  }
  return out;
}

std::string page_text(const Page& page, const std::string& body) {
  constexpr double note_line = 22, note_size = 14;
  constexpr double width_share = 0.95;  // notes have wider letters than the small print that `wrapped` counts
  const double inner = page.width - 2 * page.margin;
  double height = page.end_of_body;
  std::string notes;
  for (const std::string& note : page.notes) {
    for (const std::string& line : wrapped(note, width_share * inner)) {
      height += note_line;
      notes += text_at(page.margin, height - 4, line, "start", note_size);
    }
  }
  const std::vector<std::string> small_print = wrapped(page.command, inner);
  height += 30 + small_line * static_cast<double>(small_print.size());
  return begin_picture(page.width, height) +
         text_at(page.margin, 36, page.title, "start", 20, " font-weight=\"bold\"") + body + notes +
         small_print_text(small_print, page.margin, height) + "</svg>\n";
}

}  // namespace curlew::svg
