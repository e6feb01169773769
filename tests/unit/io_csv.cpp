// CSV tables that grow by whole lines.
#include <catch2/catch.hpp>

#include "sim/io/csv.h"
#include "tests/io/file_size_limit.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

const std::vector<std::string> columns = {"step", "time", "kinetic"};

void add_row(CsvWriter& csv, int step) { csv.row(std::vector<std::string>{std::to_string(step), "0.1", "2"}); }

}  // namespace

TEST_CASE("a table is on the disk after each row", "[io][csv]") {
  const TemporaryFolder folder;
  const std::string path = folder / "stats.csv";
  CsvWriter csv(path, columns);
  CHECK(file_text(path) == "step,time,kinetic\n");
  add_row(csv, 1);
  CHECK(file_text(path) == "step,time,kinetic\n1,0.1,2\n");
  CsvWriter moved(std::move(csv));
  add_row(moved, 2);
  moved.close();
  CHECK(file_text(path) == "step,time,kinetic\n1,0.1,2\n2,0.1,2\n");
  CHECK_THROWS_AS(moved.row(std::vector<std::string>{"1"}), std::logic_error);
}

TEST_CASE("the last row can be written again", "[io][csv]") {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "a.csv", columns);
  const auto row = [](const char* step, const char* kinetic) { return std::vector<std::string>{step, "0.1", kinetic}; };
  csv.replace_last_row(row("1", "2"));  // there is none yet
  csv.row(row("2", "3"));
  csv.replace_last_row(row("2", "3.25"));
  csv.replace_last_row(row("2", "4"));
  add_row(csv, 3);
  CHECK(file_text(csv.path()) == "step,time,kinetic\n1,0.1,2\n2,0.1,4\n3,0.1,2\n");
}

TEST_CASE("cells with commas and quotes are quoted, line breaks refused", "[io][csv]") {
  const TemporaryFolder folder;
  CsvWriter csv(folder / "a.csv", {"step", "a,b", "say \"hi\""});
  CHECK(file_text(csv.path()) == "step,\"a,b\",\"say \"\"hi\"\"\"\n");
  CHECK_THROWS_AS(csv.row(std::vector<std::string>{"1", "2", "3\n4"}), std::logic_error);
}

TEST_CASE("resuming keeps the rows up to a step", "[io][csv]") {
  const TemporaryFolder folder;
  const std::string path = folder / "stats.csv", header = "step,time,kinetic\n";
  const auto resumed = [&](const std::string& before, std::int64_t step) {
    put_file(path, before);
    CsvWriter csv(path, columns, step);
    const std::string cut = file_text(path);
    add_row(csv, 99);
    CHECK(file_text(path) == cut + "99,0.1,2\n");
    return cut;
  };
  CHECK(resumed(header + "1,a,b\n2,a,b\n3,a,b\n", 2) == header + "1,a,b\n2,a,b\n");
  CHECK(resumed(header + "1,a,b\n2,a,b\n2,c,d\n3,a,b\n", 2) == header + "1,a,b\n2,a,b\n2,c,d\n");
  CHECK(resumed(header + "1,a,b\n2,a,b\n", 7) == header + "1,a,b\n2,a,b\n");
  CHECK(resumed(header + "5,a,b\n", 2) == header);
  CHECK(resumed(header + "1,a,b\n2,a", 2) == header + "1,a,b\n");  // killed in the middle of a row
  CHECK(resumed(header, 2) == header);
  CHECK(resumed("step,ti", 2) == header);
  CHECK(resumed("", 2) == header);
  std::filesystem::remove(path);
  CHECK(CsvWriter(path, columns, 2).path() == path);
  CHECK(file_text(path) == header);
}

TEST_CASE("resuming a table of another kind is an error and changes nothing", "[io][csv]") {
  const TemporaryFolder folder;
  const std::string path = folder / "stats.csv";
  const auto message = [&](const std::string& before) {
    put_file(path, before);
    const std::string sentence = input_error([&] { CsvWriter(path, columns, 2); });
    CHECK(file_text(path) == before);
    return sentence;
  };
  const std::string begin = "cannot continue " + path + ": ", end = "; choose another --out";
  CHECK(message("step,time,potential\n1,2,3\n") ==
        begin + "column 3 of its header is \"potential\", this run writes \"kinetic\"" + end);
  CHECK(message("step,time\n1,2\n") == begin + "it has fewer columns than this run writes" + end);
  CHECK(message("step,time,kinetic,total\n") == begin + "it has more columns than this run writes" + end);
  CHECK(message("shopping list") ==
        begin + "column 1 of its header is \"shopping list\", this run writes \"step\"" + end);
  CHECK(message("step,time,kinetic\n1,2,3\n\n") ==
        begin + "line 3 begins with \"\" where a step number was expected" + end);
  CHECK(message("step,time,kinetic\n1.5,2,3\n") ==
        begin + "line 2 begins with \"1.5\" where a step number was expected" + end);
}

TEST_CASE("a full disk leaves whole lines", "[io][csv]") {
  const TemporaryFolder folder;
  const std::string path = folder / "stats.csv";
  CsvWriter csv(path, columns);
  add_row(csv, 1);
  const std::string before = file_text(path);
  CHECK(input_error([&] {
          const FileSizeLimit limit(before.size() + 3);
          add_row(csv, 2);
        }) == "cannot write " + path + ": File too large; choose another folder");
  CHECK(file_text(path) == before);
  add_row(csv, 2);  // space was made
  CHECK(file_text(path) == before + "2,0.1,2\n");

  CHECK(input_error([] { CsvWriter("/dev/full", columns); }) ==
        "cannot write /dev/full: No space left on device; free some space or choose another folder");
  CHECK(std::filesystem::exists("/dev/full"));
  CHECK(input_error([&] {
          const FileSizeLimit limit(5);
          CsvWriter(folder / "new.csv", columns);
        }) == "cannot write " + (folder / "new.csv") + ": File too large; choose another folder");
  CHECK_FALSE(std::filesystem::exists(folder / "new.csv"));
  CHECK(input_error([&] { CsvWriter(path + "/a.csv", columns); }) ==
        "cannot write " + path + "/a.csv: " + path + " is a file, not a folder; choose another folder");
}
