// What the fuzz targets share.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "sim/core/error.h"
#include "tests/io/temporary_folder.h"

namespace curlew::test {

// libFuzzer keeps what made it abort.
inline void require(bool holds) {
  if (!holds) std::abort();
}

// What an error says is one sentence, fit to be shown.
inline void check_sentence(const std::string& sentence) {
  require(!sentence.empty() && sentence.size() < 2000 && sentence.find('\n') == std::string::npos);
}

// The first folder on the command line, where new inputs go; empty without one.
inline std::filesystem::path corpus_folder(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    if (argv[k][0] != '-') return std::filesystem::is_directory(argv[k]) ? argv[k] : std::filesystem::path();
  }
  return {};
}

}  // namespace curlew::test
