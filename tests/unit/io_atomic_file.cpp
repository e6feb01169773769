// Files that appear whole or not at all, and folders of runs.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>

#include "sim/io/atomic_file.h"
#include "sim/io/run_folder.h"
#include "tests/io/file_size_limit.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;
using Names = std::vector<std::string>;

TEST_CASE("an atomic file appears when it is complete", "[io]") {
  const TemporaryFolder folder;
  const std::string path = folder / "frames/000000.png", large(3 << 20, 'x');
  put_file(path, "old");
  {
    AtomicFile file(path);
    file.write("small ");
    file.write(large);
    file.write(" end");
    CHECK(file_text(path) == "old");
    file.commit();
  }
  CHECK(file_text(path) == "small " + large + " end");
  CHECK(folder.contents() == Names{"frames", "frames/000000.png"});
}

TEST_CASE("an atomic file that is given up leaves nothing", "[io]") {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a.vtk");
    file.write(std::string(1 << 20, 'x'));
    CHECK(folder.contents() == Names{"a.vtk.unfinished0"});
    // Another writer of the same file keeps out of its way.
    AtomicFile other(folder / "a.vtk");
    CHECK(folder.contents().size() == 2);
  }
  CHECK(folder.contents().empty());
}

TEST_CASE("atomic files have the permissions of other files", "[io]") {
  const TemporaryFolder folder;
  put_file(folder / "usual", "");
  AtomicFile file(folder / "atomic");
  file.commit();
  struct stat usual = {}, atomic = {};
  REQUIRE(::stat((folder / "usual").c_str(), &usual) == 0);
  REQUIRE(::stat((folder / "atomic").c_str(), &atomic) == 0);
  CHECK(usual.st_mode == atomic.st_mode);
}

TEST_CASE("a full disk is an error and leaves nothing", "[io]") {
  const TemporaryFolder folder;
  const std::string path = folder / "x.vtk";
  const std::string message = input_error([&] {
    const FileSizeLimit limit(100000);
    AtomicFile file(path);
    for (int i = 0; i < 100; ++i) file.write(std::string(5000, 'x'));
    file.commit();
  });
  CHECK(message == "cannot write " + path + ": File too large; choose another folder");
  CHECK(folder.contents().empty());

  SECTION("found only when the last of it is flushed") {
    CHECK(input_error([&] {
            const FileSizeLimit limit(100);
            AtomicFile file(path);
            file.write(std::string(5000, 'x'));
            file.commit(AtomicFile::Durability::power_cut);
          }) == message);
    CHECK(folder.contents().empty());
  }
  SECTION("No space left on device") {
    const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
    REQUIRE(full >= 0);
    CHECK(write_all(full, std::as_bytes(std::span(path))) == ENOSPC);
    ::close(full);
    CHECK(write_error("out/x.vtk", ENOSPC) ==
          "cannot write out/x.vtk: No space left on device; free some space or choose another folder");
  }
}

TEST_CASE("files that cannot be written say why", "[io]") {
  const TemporaryFolder folder;
  put_file(folder / "file", "kept");
  std::filesystem::create_directory(folder / "folder");
  const auto message = [](const std::string& path) { return input_error([&] { AtomicFile file(path); }); };

  CHECK(message(folder / "file/x.vtk") == "cannot write " + (folder / "file/x.vtk") + ": " + (folder / "file") +
                                              " is a file, not a folder; choose another folder");
  CHECK(message(folder / "folder") ==
        "cannot write " + (folder / "folder") + ": it is a folder; choose another folder");
  CHECK(message("/dev/null") == "cannot write /dev/null: it is not a regular file; choose another folder");
  CHECK(message("/proc/x.vtk") == "cannot write /proc/x.vtk: No such file or directory; choose another folder");
  CHECK(folder.contents() == Names{"file", "folder"});
  CHECK(file_text(folder / "file") == "kept");
}

TEST_CASE("a run folder is made where none is", "[io]") {
  const TemporaryFolder folder;
  prepare_run_folder(folder / "out/a/b", false);
  prepare_run_folder(folder / "out/a/b", false);
  prepare_run_folder(folder / "out/a/b/", true);
  CHECK(folder.contents() == Names{"out", "out/a", "out/a/b"});
}

TEST_CASE("a run folder that cannot serve is an error", "[io]") {
  const TemporaryFolder folder;
  put_file(folder / "file", "");
  const auto message = [](const std::string& path) { return input_error([&] { prepare_run_folder(path, false); }); };
  CHECK(message("") == "--out is empty; give the folder to write the run to");
  CHECK(message(folder / "file") ==
        "cannot use " + (folder / "file") + " as the folder of a run: it is a file; choose another --out");
  CHECK(message(folder / "file/out") == "cannot write " + (folder / "file/out/run.json") + ": " + (folder / "file") +
                                            " is a file, not a folder; choose another folder");
  CHECK(message("/proc/out") == "cannot write /proc/out/run.json: No such file or directory; choose another folder");
}

TEST_CASE("a run is not overwritten unless asked for, and nothing else ever", "[io]") {
  const TemporaryFolder folder;
  const Names of_a_run = {"run.json",
                          "stats.csv",
                          "passes.csv",
                          "probes.csv",
                          "video.mp4",
                          "frames/000000.png",
                          "particles/000001.vtk",
                          "particles/000001.ply",
                          "particles/000001.bgeo",
                          "mesh/000002.obj",
                          "checkpoints/000003.curlew",
                          "checkpoints/interrupted.curlew",
                          "frames/000004.png.unfinished0",
                          "frames/000005.png.part",
                          "video.mp4.part",
                          "stats.csv.unfinished12"};
  const Names of_a_person = {"frames/best.png", "mesh/ship.obj", "notes.txt", "mine/000000.png", "a.unfinished.txt"};
  for (const auto& names : {of_a_run, of_a_person}) {
    for (const std::string& name : names) put_file(folder / name, name);
  }

  const Names before = folder.contents();
  CHECK(input_error([&] { prepare_run_folder(folder.path(), false); }) ==
        folder.path() + " holds a finished run; choose another --out or give --overwrite");
  CHECK(folder.contents() == before);

  std::filesystem::remove(folder / "run.json");
  CHECK(input_error([&] { prepare_run_folder(folder.path(), false); }) ==
        folder.path() + " holds files of an unfinished run (" + (folder / "stats.csv") +
            "); choose another --out or give --overwrite");

  prepare_run_folder(folder.path(), true);
  CHECK(folder.contents() == Names{"a.unfinished.txt", "frames", "frames/best.png", "mesh", "mesh/ship.obj", "mine",
                                   "mine/000000.png", "notes.txt"});
  prepare_run_folder(folder.path(), false);
}
