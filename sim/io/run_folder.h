// The folder of a run: where run.json, the CSVs, frames and checkpoints go.
#pragma once

#include <cstdint>
#include <string>

namespace curlew {

// Makes the folder, or checks that it may be used, and proves by a trial file that it can be written. Throws InputError
// where it holds a run already, unless `overwrite` is set: then what that run made is removed (run.json, the CSVs,
// video.mp4, the numbered files of frames/, particles/ and mesh/, and checkpoints), and nothing else.
void prepare_run_folder(const std::string& path, bool overwrite);

// Removes what a killed run was just writing (see AtomicFile), in the folder and in the folders of a run.
void remove_unfinished_files(const std::string& path);

// Removes the checkpoints of steps after `step`, for a run that goes on from there with its tables cut to that step:
// they belong to a course that is given up, and no table would lead up to them.
void remove_later_checkpoints(const std::string& path, std::int64_t step);

}  // namespace curlew
