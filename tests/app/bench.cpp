// `curlew bench energy`, `overhead` and `turbulence`, at sizes that take seconds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew::test;
namespace fs = std::filesystem;

namespace {

const std::string small = "bench energy --scenes dam_break --cases 500 --time 0.2 --nu 0 --out e ";

Outcome in(const TemporaryFolder& folder, const std::string& line) {
  return curlew_program(words_of(line), {folder.path()});
}

double interpolated(const Table& table, double time) {
  std::size_t k = 1;
  while (k + 1 < table.rows.size() && table.number(k, "time") < time) ++k;
  const double begin = table.number(k - 1, "time"), end = table.number(k, "time");
  const double from = table.number(k - 1, "mechanical"), to = table.number(k, "mechanical");
  return from + (to - from) * std::min(1.0, (time - begin) / (end - begin));
}

}  // namespace

TEST_CASE("the energy bench leaves a table a run, a summary and a plot") {
  const TemporaryFolder folder;
  const Outcome outcome = in(folder, small + "--methods vr1.0");
  REQUIRE(outcome.code == 0);
  CHECK(folder.contents() == std::vector<std::string>{"e", "e/dam_break", "e/dam_break/energy_nu0.svg",
                                                      "e/dam_break/nu0_dfsph.csv", "e/dam_break/nu0_vr1.csv",
                                                      "e/dam_break/settings.txt", "e/dam_break/summary.md"});
  const Table plain = read_table(folder / "e/dam_break/nu0_dfsph.csv");
  const Table refined = read_table(folder / "e/dam_break/nu0_vr1.csv");
  for (const Table& table : {plain, refined}) {
    CHECK(table.columns == std::vector<std::string>{"time", "kinetic", "rotational", "potential", "mechanical", "total",
                                                    "increase", "note"});
    const std::size_t last = table.rows.size() - 1;
    CHECK(last == 12);
    CHECK(table.number(0, "time") == 0);
    CHECK(table.number(last, "time") >= 0.2);
    CHECK(table.number(last, "kinetic") > 0);
    for (std::size_t row = 0; row <= last; ++row) {
      CHECK(table.number(row, "mechanical") ==
            Approx(table.number(row, "kinetic") + table.number(row, "potential")).epsilon(1e-12));
      const double increase = table.number(row, "mechanical") / interpolated(plain, table.number(row, "time")) - 1;
      CHECK(table.number(row, "increase") == Approx(increase).margin(1e-12));
      CHECK(table.cell(row, "note").empty());
    }
  }
  CHECK(refined.cell(12, "mechanical") != plain.cell(12, "mechanical"));
  const std::string summary = file_text(folder / "e/dam_break/summary.md");
  CHECK(outcome.out.starts_with(summary));
  CHECK(summary.starts_with("Dam break, 512 particles, 0.2 s (`curlew " + small + "--methods vr1.0`)."));
  CHECK(summary.find("\n| 0 | DFSPH | - | ") != std::string::npos);  // 0.2 s end before the window begins
  CHECK(summary.find("\n| 0 | VR 1.00 | - | ") != std::string::npos);
  CHECK(file_text(folder / "e/dam_break/energy_nu0.svg").find(">VR 1.00</text>") != std::string::npos);
}

TEST_CASE("the energy bench runs what is missing, and only that") {
  const TemporaryFolder folder;
  REQUIRE(in(folder, small + "--methods vr1.0").code == 0);
  const std::string csv = folder / "e/dam_break/nu0_vr1.csv", summary = folder / "e/dam_break/summary.md";
  const std::string before = file_text(summary);
  const auto written = fs::last_write_time(csv);
  fs::remove(summary);
  const Outcome again = in(folder, small + "--methods vr1.0");
  CHECK(again.code == 0);
  CHECK(again.err.empty());
  CHECK(fs::last_write_time(csv) == written);
  CHECK(file_text(summary) == before);

  const Outcome more = in(folder, small + "--methods vr1.0 mp0.05");
  CHECK(more.code == 0);
  CHECK(more.err.find("run 1 of 1: dam_break, nu 0, MP 0.05") != std::string::npos);
  CHECK(fs::last_write_time(csv) == written);
  CHECK(more.out.find("| 0 | MP 0.05 |") != std::string::npos);

  const Outcome other = in(folder, small + "--methods vr1.0 --set time.cfl=0.2");
  CHECK(other.code == 2);
  CHECK(other.err.find("curlew: e/dam_break/settings.txt says that the runs beside it are of dam_break, "
                       "particle_radius 0.0625, 0.2 s, energy.guard=false, expected dam_break, particle_radius "
                       "0.0625, 0.2 s, energy.guard=false, time.cfl=0.2; choose another --out\n") != std::string::npos);

  put_file(csv, "time,kinetic\n0,1\n");
  const Outcome damaged = in(folder, small + "--methods vr1.0");
  CHECK(damaged.code == 2);
  CHECK(damaged.err ==
        "curlew: e/dam_break/nu0_vr1.csv: line 1 is not the header of a run of this benchmark; remove "
        "the file to run it again\n");
}

TEST_CASE("a run that diverges is a row of the energy bench and not its end") {
  const TemporaryFolder folder;
  const Outcome outcome =
      in(folder, small + "--methods vr1.0 --set time.max_displacement=0.2 --set time.fixed_step=0.02");
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("| 0 | DFSPH | - | - | - | - | diverged at ") != std::string::npos);
  CHECK(outcome.out.find("| 0 | VR 1.00 | - | - | - | - | diverged at ") != std::string::npos);
  const Table table = read_table(folder / "e/dam_break/nu0_dfsph.csv");
  CHECK(table.cell(table.rows.size() - 1, "note").find(" s in pass ") != std::string::npos);
}

TEST_CASE("Ctrl-C ends the energy bench and leaves no half run") {
  const TemporaryFolder folder;
  const std::string begun = folder / "e/dam_break/nu0_dfsph.csv.unfinished";
  Process process(
      words_of(CURLEW_PROGRAM " bench energy --scenes dam_break --cases 20k --nu 0 --methods dfsph --out e"),
      {folder.path()});
  while (!fs::exists(begun) && process.running()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  CHECK(outcome.code == 130);
  CHECK(outcome.out == "interrupted; the same command goes on with the run that was in hand\n");
  CHECK(folder.contents() == std::vector<std::string>{"e", "e/dam_break", "e/dam_break/settings.txt"});
}

TEST_CASE("the overhead bench compares each method with plain DFSPH") {
  const Outcome outcome =
      curlew_program(words_of("bench overhead --cases 500 --time 0.02 --methods mp0.05 vr1.0+vc0.1"));
  CHECK(outcome.code == 0);
  CHECK(outcome.out.starts_with("dam_break, 512 particles, viscosity.nu = 0, from the state at 0.02"));
  CHECK(outcome.out.find("| 13.0 + 2.0 | 13.0 + 2.0 |\n") != std::string::npos);
  for (const char* words : {"\n| MP 0.05 | ", " | 2 | micropolar ", "\n| VR 1.00 + VC 0.10 | ",
                            " | 7 | vorticity_refinement ", ", vorticity_confinement ", ", vorticity "}) {
    INFO(words);
    CHECK(outcome.out.find(words) != std::string::npos);
  }
}

TEST_CASE("the turbulence bench leaves a spectrum a method and time, a table and a plot") {
  const TemporaryFolder folder;
  const Outcome outcome = in(folder, "bench turbulence --cases 16 --share 0.05 --methods dfsph wt0.02 --out t");
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.starts_with("Decaying turbulence, cube of 1 m, 16^3 particles, turnover time 0.29 s, "));
  std::vector<std::string> files{"t", "t/turbulence.csv", "t/turbulence.svg", "t/turbulence_noise.csv",
                                 "t/turbulence_start_0.000s.csv"};
  for (const char* method : {"dfsph", "wt0.02"}) {
    for (const char* time : {"0.007", "0.015", "0.029"})
      files.push_back("t/turbulence_" + std::string(method) + "_" + time + "s.csv");
  }
  std::sort(files.begin(), files.end());
  CHECK(folder.contents() == files);

  const Table table = read_table(folder / "t/turbulence.csv");
  REQUIRE(table.rows.size() == 8);
  CHECK(table.cell(0, "method") == "start");
  CHECK(table.cell(1, "method") == "DFSPH");
  CHECK(table.cell(4, "method") == "WT 0.02");
  CHECK(table.cell(7, "method") == "wavelet noise y");
  for (std::size_t row = 0; row < 7; ++row) {
    CHECK(table.number(row, "energy (J/kg)") == Approx(1.5).epsilon(0.01));
    CHECK(table.number(row, "slope") == Approx(-5.0 / 3).margin(0.5));
  }
  // Octaves with energies as 2^(-5/3) each spread over twice the wave numbers of the one before.
  CHECK(table.number(7, "slope") == Approx(-8.0 / 3).margin(0.1));

  // The start on the grid is the field's own spectrum, in a cube of 1 m.
  const Table start = read_table(folder / "t/turbulence_start_0.000s.csv");
  CHECK(start.number(0, "k (1/m)") == Approx(2 * 3.14159265).epsilon(1e-5));
  CHECK(start.number(1, "E k^(5/3) (m^(4/3)/s^2)") / start.number(0, "E k^(5/3) (m^(4/3)/s^2)") ==
        Approx(1).epsilon(0.02));
  const std::string plot = file_text(folder / "t/turbulence.svg");
  for (const char* words : {">DFSPH</text>", ">WT 0.02</text>", ">k^(-5/3)</text>", ">E (m³/s²)</text>"}) {
    CHECK(plot.find(words) != std::string::npos);
  }
}
