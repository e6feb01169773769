#include "app/assets.h"

#include "sim/core/error.h"

namespace curlew {

std::filesystem::path assets_folder() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / "share" / "curlew";
  for (const fs::path& folder : {installed, fs::path(CURLEW_ASSETS_DIR)}) {
    if (fs::is_directory(folder / "scenes", ignored)) return folder;
  }
  throw InputError("the bundled scenes are neither in " + installed.string() + " nor in " + CURLEW_ASSETS_DIR +
                   "; install the program again or give the path of a scene file");
}

}  // namespace curlew
