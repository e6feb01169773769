// What the fuzz targets share.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace curlew::test {

// libFuzzer keeps what made it abort.
inline void require(bool holds) {
  if (!holds) std::abort();
}

// The first folder on the command line, where new inputs go; empty without one.
inline std::filesystem::path corpus_folder(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    if (argv[k][0] != '-') return std::filesystem::is_directory(argv[k]) ? argv[k] : std::filesystem::path();
  }
  return {};
}

}  // namespace curlew::test
