#include "sim/io/run_folder.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string_view>
#include <system_error>
#include <vector>

#include "sim/core/error.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

constexpr const char* run_files[] = {"run.json", "stats.csv", "passes.csv", "probes.csv", "video.mp4"};
constexpr const char* run_subfolders[] = {"frames", "particles", "mesh", "checkpoints"};

bool is_unfinished(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.ends_with(".png.part") || name.ends_with(".mp4.part")) return true;
  const auto at = name.rfind(unfinished_suffix);
  return at != std::string::npos && at > 0 &&
         name.find_first_not_of("0123456789", at + unfinished_suffix.size()) == std::string::npos;
}

// frames/000012.png, checkpoints/000012.curlew, checkpoints/interrupted.curlew: a person's own file is not touched.
bool is_of_a_run(const fs::path& file) {
  const std::string stem = file.stem().string(), extension = file.extension().string();
  if (extension == ".curlew") return true;
  constexpr std::string_view extensions[] = {".png", ".vtk", ".ply", ".bgeo", ".obj"};
  return std::find(std::begin(extensions), std::end(extensions), extension) != std::end(extensions) &&
         stem.find_first_not_of("0123456789") == std::string::npos;
}

// The files of one folder that a test picks; none where the folder is missing.
std::vector<fs::path> files_in(const fs::path& folder, const std::function<bool(const fs::path&)>& wanted) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (!fs::is_directory(entry->symlink_status(ignored)) && wanted(entry->path())) files.push_back(entry->path());
  }
  return files;
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) {
    throw InputError("cannot remove " + file.string() + ": " + error.message() + "; choose another --out");
  }
}

std::vector<fs::path> files_of_a_run(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* name : run_files) {
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(folder / name, ignored);
    if (fs::exists(status) && !fs::is_directory(status)) files.push_back(folder / name);
  }
  for (const char* name : run_subfolders) {
    const auto more = files_in(folder / name, is_of_a_run);
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

void remove_run(const fs::path& folder) {
  for (const fs::path& file : files_of_a_run(folder)) remove_file(file);
  remove_unfinished_files(folder.string());
  for (const char* name : run_subfolders) {
    std::error_code ignored;
    const fs::path subfolder = folder / name;
    if (fs::is_directory(fs::symlink_status(subfolder, ignored)) && fs::is_empty(subfolder, ignored)) {
      remove_file(subfolder);
    }
  }
}

}  // namespace

void remove_unfinished_files(const std::string& path) {
  std::vector<fs::path> folders = {path};
  for (const char* name : run_subfolders) folders.push_back(fs::path(path) / name);
  for (const fs::path& folder : folders) {
    for (const fs::path& file : files_in(folder, is_unfinished)) remove_file(file);
  }
}

void remove_later_checkpoints(const std::string& path, std::int64_t step) {
  const auto is_later = [step](const fs::path& file) {
    const std::string stem = file.stem().string();
    std::int64_t number = 0;
    const auto [end, status] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    return file.extension() == ".curlew" && status == std::errc() && end == stem.data() + stem.size() && number > step;
  };
  for (const fs::path& file : files_in(fs::path(path) / "checkpoints", is_later)) remove_file(file);
}

void prepare_run_folder(const std::string& path, bool overwrite) {
  if (path.empty()) throw InputError("--out is empty; give the folder to write the run to");
  std::error_code ignored;
  if (const fs::file_status status = fs::status(path, ignored); fs::exists(status) && !fs::is_directory(status)) {
    throw InputError("cannot use " + path + " as the folder of a run: it is a file; choose another --out");
  }
  if (!overwrite) {
    if (fs::exists(fs::path(path) / "run.json", ignored)) {
      throw InputError(path + " holds a finished run; choose another --out or give --overwrite");
    }
    // Without run.json, what lies here would mix with the new run.
    if (const auto files = files_of_a_run(path); !files.empty()) {
      throw InputError(path + " holds files of an unfinished run (" + files.front().string() +
                       "); choose another --out or give --overwrite");
    }
  }
  // The trial comes before anything is removed.
  { AtomicFile trial((fs::path(path) / "run.json").string()); }
  if (overwrite) remove_run(path);
}

}  // namespace curlew
