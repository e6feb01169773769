// What the tests of pictures ask of an SVG file's text.
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace curlew::test {

// Every element that is opened is closed, in order, and no & or < stands bare in a text.
inline bool well_formed(const std::string& svg) {
  std::vector<std::string> open;
  std::size_t at = 0;
  while ((at = svg.find_first_of("<&", at)) != std::string::npos) {
    if (svg[at] == '&') {
      if (!std::regex_search(svg.begin() + static_cast<std::ptrdiff_t>(at), svg.end(),
                             std::regex("^&(amp|lt|gt|quot);")))
        return false;
      ++at;
      continue;
    }
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return false;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
    at = end;
  }
  return open.empty();
}

inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace curlew::test
