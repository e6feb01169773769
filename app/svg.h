// What the pictures of the benches share: escaped text, its width, the frame of the file and the small print.
#pragma once

#include <string>
#include <vector>

namespace curlew::svg {

// Pixels. Readable where a page shows the picture at two thirds of its size.
inline constexpr double text_size = 16, small_size = 12, small_line = 16;
inline constexpr const char* ink = "#333333";

// As printf, at most 399 bytes: for numbers and fixed words, never for the user's text.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...);

std::string escaped(const std::string& text);

// `anchor` is start, middle or end; `more` holds further attributes, each after a blank.
std::string text_at(double x, double y, const std::string& text, const char* anchor, double size = text_size,
                    const char* more = "");

// About; letters of two and three bytes count once.
double text_width(const std::string& text, double size = text_size);

// The small print in lines that fit, broken at blanks.
std::vector<std::string> wrapped(const std::string& text, double width);

// The opening tag, on a white ground.
std::string begin_picture(double width, double height);

// The small print at the foot of the picture.
std::string small_print_text(const std::vector<std::string>& lines, double left, double height);

// What frames the body of a picture: a title above it, notes and the command that made it in small print below.
struct Page {
  std::string title;
  const std::vector<std::string>& notes;
  const std::string& command;
  double width = 0, margin = 0;
  double end_of_body = 0;  // its lower edge
};
std::string page_text(const Page& page, const std::string& body);

}  // namespace curlew::svg
