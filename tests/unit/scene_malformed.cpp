// Every file of tests/bad gives its sentence, word for word; cut and mutated scenes give some sentence and never crash.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "sim/core/error.h"
#include "sim/scene/mesh.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"

using namespace curlew;

namespace {

const std::filesystem::path bad_folder = CURLEW_SOURCE_DIR "/tests/bad";

struct Expectation {
  std::string file, message;
};

std::vector<Expectation> expectations() {
  std::vector<Expectation> all;
  std::ifstream lines(bad_folder / "messages.txt");
  for (std::string line; std::getline(lines, line);) {
    const std::size_t tab = line.find('\t');
    if (tab != std::string::npos) all.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  return all;
}

// Reads the file as the program would, with 16 GB for the machine's memory.
void use(const std::filesystem::path& file) {
  const auto kind = file.extension();
  if (kind == ".obj" || kind == ".ply" || kind == ".stl" || kind == ".glb") {
    require_closed(load_mesh(file), file.string());
    return;
  }
  const Scene scene = read_scene(file);
  check_resolution(scene, 16e9);
  sample_fluid(scene);
}

std::string message_of(const std::filesystem::path& file) {
  try {
    use(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string without_folder(std::string message) {
  const std::string folder = bad_folder.string() + "/";
  for (std::size_t at = message.find(folder); at != std::string::npos; at = message.find(folder))
    message.erase(at, folder.size());
  return message;
}

std::string file_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("every malformed file gives its sentence", "[scene][malformed]") {
  const auto all = expectations();
  REQUIRE(all.size() > 90);
  for (const auto& [file, message] : all) {
    INFO(file);
    CHECK(without_folder(message_of(bad_folder / file)) == message);
  }
}

TEST_CASE("every malformed file is listed", "[scene][malformed]") {
  std::set<std::string> listed;
  for (const auto& expectation : expectations()) listed.insert(expectation.file);
  for (const auto& entry : std::filesystem::directory_iterator(bad_folder)) {
    const auto kind = entry.path().extension();
    if (kind == ".txt" || kind == ".csv" || kind == ".md") continue;
    INFO(entry.path());
    CHECK(listed.count(entry.path().filename().string()) == 1);
  }
}

TEST_CASE("sentences do not leak the parser's own words", "[scene][malformed]") {
  for (const auto& [file, message] : expectations()) {
    INFO(message);
    CHECK(message.find("json.exception") == std::string::npos);
    CHECK(message.find("parse_error") == std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < 400);
  }
}

TEST_CASE("a scene cut anywhere gives one sentence", "[scene][malformed]") {
  const std::string whole = file_text(CURLEW_ASSETS_DIR "/scenes/pillars.json");
  REQUIRE(whole.size() > 1000);
  const std::size_t end = whole.rfind('}');
  for (std::size_t length = 0; length < end; ++length) {
    try {
      parse_scene(whole.substr(0, length), "cut.json");
      FAIL("accepted after " << length << " bytes");
    } catch (const InputError& error) {
      const std::string message = error.what();
      if (message.find("cut.json: line ") != 0) FAIL(message);
    }
  }
}

TEST_CASE("mutated scenes and meshes give a scene or a sentence", "[scene][malformed]") {
  const std::string scene = file_text(CURLEW_ASSETS_DIR "/scenes/sphere_drop.json");
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = scene;
    for (unsigned change = 0; change < 1 + static_cast<unsigned>(round) % 4; ++change) {
      text[random() % text.size()] =
          static_cast<char>(random() % 8 == 0 ? random() % 256 : "{}[]\",:0-9e.x"[random() % 13]);
    }
    try {
      parse_scene(text, "mutated.json");
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 1000);
}

TEST_CASE("long names and odd bytes are shortened in messages", "[scene][malformed]") {
  const std::string key(1000, 'k');
  CHECK_THROWS_WITH(
      parse_scene("{\"" + key + "\": 1}", "a.json"),
      Catch::StartsWith("a.json: the scene has the unknown key \"" + key.substr(0, 40) + "...\", expected"));
  CHECK_THROWS_WITH(parse_scene("{\"a\\u0000\\n\": 1}", "a.json"),
                    Catch::StartsWith("a.json: the scene has the unknown key \"a??\""));
}
