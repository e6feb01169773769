// `curlew compare GOLDEN NEW`: what changed between two runs, in a sentence: a parameter, the rendering, or the
// simulation, and then in which step and pass.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run_record.h"
#include "render/image.h"
#include "render/picture_difference.h"

namespace curlew {

// How far a number of the last row may be off: by a share of the larger of both, or by `absolute`.
struct StateTolerance {
  std::string column;
  double share = 0, absolute = 0;
};

// GOLDEN/compare.json, or what stands for it. Bits count where both runs come from one compiler and instruction set,
// the state's tolerances elsewhere; `tight` counts for pictures of the same state by the same renderer, `loose`
// elsewhere.
struct CompareTolerances {
  std::vector<StateTolerance> state;
  PictureTolerance tight, loose;
};
CompareTolerances default_tolerances();
// Throws InputError with the place of what is wrong.
CompareTolerances read_tolerances(const std::filesystem::path& file);

struct StateRow {
  std::string column, golden, now;
  double difference = 0;  // of both as a share of the larger
  bool allowed = true;
};

// A picture of GOLDEN and what stands against it: the frame of that name in NEW, or one that was drawn here.
struct PictureRow {
  std::string name;
  PictureDifference difference;
  bool allowed = true;
  std::string checkpoint = {};  // GOLDEN's, of which it was drawn here
  Image drawn = {};             // in that case
};

// GOLDEN's stored states, drawn again by this program and compared with the pictures that GOLDEN has of them. That
// needs no state of NEW, so it tells a change of the rendering from one of the simulation where both changed.
struct Redrawn {
  std::vector<PictureRow> rows;
  std::string warning;  // why states that GOLDEN has were not drawn: a sentence
  std::string hint;     // what GOLDEN lacks, for the page
};
// Throws InputError, naming the file, where a checkpoint or a picture cannot be read.
Redrawn redraw_stored_states(const RunRecord& golden, const PictureTolerance& tight);

struct Comparison {
  enum class Kind { identical, within_tolerance, parameter, rendering, simulation };
  Kind kind = Kind::identical;
  std::string verdict;                // one sentence
  std::vector<std::string> warnings;  // each one sentence
  std::vector<std::string> changed;   // "parameters.viscosity.nu is 0 in GOLDEN and 0.01 in NEW"
  std::vector<StateRow> state;        // of the last rows
  std::vector<PictureRow> pictures;
  Redrawn redrawn;
  CompareTolerances tolerances;
  PictureTolerance picture_tolerance;  // the one that was applied to `pictures`

  bool passed() const { return kind == Kind::identical || kind == Kind::within_tolerance; }
};

Comparison compare_runs(const RunRecord& golden, const RunRecord& now);

// A page that needs no other file: verdict, golden and new pictures with their difference, numbers, versions, and the
// command that accepts the new run.
std::string comparison_page(const Comparison& comparison, const RunRecord& golden, const RunRecord& now);

}  // namespace curlew
