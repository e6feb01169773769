// libFuzzer's entry to the tables that a resumed run goes on with: whatever stats.csv holds, it is refused and stays as
// it is, or is cut to the step and grows by the next row.
#include <string>
#include <vector>

#include "sim/io/csv.h"
#include "tests/fuzz/fuzz.h"

using namespace curlew;

namespace {

const std::vector<std::string> columns = {"step", "time"};
const std::string header = "step,time\n";
constexpr std::int64_t last_step = 7;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::filesystem::path folder = test::corpus_folder(*argc, *argv);
  if (folder.empty() || !std::filesystem::is_empty(folder)) return 0;
  test::put_file(folder / "whole.csv", header + "0,0\n7,0.5\n8,0.75\n");
  test::put_file(folder / "torn.csv", header + "0,0\n6,0.");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  const std::string before(reinterpret_cast<const char*>(data), size), file = folder / "stats.csv";
  test::put_file(file, before);
  try {
    CsvWriter table(file, columns, last_step);
    const std::string kept = test::file_text(file);
    test::require(kept.starts_with(header) && kept.ends_with("\n"));
    test::require(before.starts_with(kept) || kept == header);
    table.row(std::vector<std::string>{"8", "1"});
    test::require(test::file_text(file) == kept + "8,1\n");
  } catch (const InputError& error) {
    test::check_sentence(error.what());
    test::require(test::file_text(file) == before);
  }
  return 0;
}
