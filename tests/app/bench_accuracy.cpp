// `curlew bench accuracy` from the outside: its tables, on standard output and as files.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "tests/app/program.h"
#include "tests/io/temporary_folder.h"

using namespace curlew::test;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the accuracy bench prints its tables and writes them") {
  const TemporaryFolder folder;
  const Outcome bench = curlew_program(
      words_of("bench accuracy gresho_chan spinning_drop --cases 400 --share 0.05 --out tables"), {folder.path()});
  CHECK(bench.code == 0);
  CHECK(bench.out.find("| DFSPH | ") != std::string::npos);
  CHECK(bench.out.find("MP 0.05 over DFSPH") != std::string::npos);
  CHECK(bench.out.find("VR 1 sum:") != std::string::npos);
  const auto vortex = lines_of(text_of(folder / "tables/accuracy_gresho_chan_20.csv"));
  REQUIRE(vortex.size() > 6);
  CHECK(vortex[0] == "method,peak retained,L1 velocity error,kinetic energy retained,steps,wall s");
  CHECK(vortex[1].starts_with("DFSPH,"));
  CHECK(lines_of(text_of(folder / "tables/accuracy_gresho_chan_20_profile.csv")).size() > 50);
  std::size_t tables = 0;
  for (const std::string& file : folder.contents()) {
    if (!file.starts_with("tables/accuracy_spinning_drop_")) continue;
    ++tables;
    CHECK(lines_of(text_of(folder / file)).size() > 6);
  }
  CHECK(tables == 1);
}
