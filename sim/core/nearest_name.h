// "Did you mean": the nearest of a list of names by edit distance (Levenshtein 1966).
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace curlew {

inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row[b.size()];
}

// Empty where nothing is near: more than a third of the letters wrong is no suggestion.
template <class Names>
std::string nearest_name(const std::string& word, const Names& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  if (word.size() > 100) return best;
  for (const auto& candidate : candidates) {
    const std::string_view name{candidate};
    // A bare name matches the last part of a dotted key: "nu" suggests "viscosity.nu".
    const auto dot = name.rfind('.');
    const bool is_tail = dot != std::string_view::npos && name.substr(dot + 1) == word;
    const std::size_t distance = is_tail ? 1 : edit_distance(word, name);
    if (distance < best_distance) {
      best_distance = distance;
      best = std::string(name);
    }
  }
  return best;
}

}  // namespace curlew
