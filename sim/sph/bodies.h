// Bodies as samples in two layers, half a spacing d and 3/2 d beneath their surface: each sample stands for the volume
// V_b = gamma / sum_b' W(x_b - x_b') (Akinci et al. 2012, "Versatile rigid-fluid coupling"), and gamma is such that a
// particle one spacing from even layers has the density that it has in a full lattice. One layer alone goes soft where
// an impact drives water within a spacing of it.
//
// The samples of a body that moves go along with it, in one grid with all others, which is sorted anew each step; their
// volumes stay, and are found without the samples of bodies that move otherwise.
#pragma once

#include <span>
#include <vector>

#include "sim/core/fields.h"
#include "sim/scene/scene.h"
#include "sim/sph/candidates.h"
#include "sim/sph/grid.h"
#include "sim/sph/kernel.h"
#include "sim/sph/walls.h"

namespace curlew {

// What moving samples do to a particle at one place, beside what they would do at rest: as in the field body_motion,
// and what is to be added to boundary_friction.
struct MotionSum {
  Vec3 motion, friction;
};

class BodySamples {
 public:
  BodySamples() = default;
  BodySamples(const Scene& scene, const CellShape& shape, const Kernel& kernel);

  std::size_t count() const { return position_.size(); }
  bool any_no_slip() const { return any_no_slip_; }
  const Array<Vec3>& position() const { return position_; }
  const Array<float>& volume() const { return volume_; }
  bool any_moving() const { return !moving_.empty(); }

  // Puts the samples where the bodies are, one place for each body of the scene; they have the velocity of the place.
  void place(const CellShape& shape, std::span<const BodyPlace> places);
  // Gives them other velocities and leaves them where they are.
  void set_velocities(std::span<const BodyPlace> places);

  // The samples around a cell; leaves `near` empty without a search where there are none.
  void collect(const CellShape& shape, std::array<int, 3> cell, Candidates& near, Grid::Hints& hints) const;

  // Adds to `total` what the samples in `near` do to a particle at `here`; rest density in kg/m^3.
  void add(WallSum& total, Vec3 here, const Candidates& near, const Kernel& kernel, float rest_density) const;

  // What those in `near` do by their motion.
  MotionSum motion(Vec3 here, const Candidates& near, const Kernel& kernel, float rest_density) const;

  // Whether the moving samples may be neighbours of what lies in a cell.
  bool moving_near(const CellShape& shape, std::array<int, 3> cell) const;

  std::size_t bytes() const;

 private:
  // Cells that hold samples, and the ring around them.
  struct Extent {
    std::array<int, 3> low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    void include(std::array<int, 3> cell);
    bool holds(const CellShape& shape, std::array<int, 3> cell) const;
  };
  // A sample as the scene has it, kept where bodies move.
  struct Origin {
    Vec3d at;            // m, in the coordinates of the shape
    std::uint32_t body;  // of the scene
    float volume, no_slip;
  };

  void sort(const CellShape& shape, std::span<const Vec3> unsorted);
  void find_volumes(const CellShape& shape, const Kernel& kernel, double spacing, std::span<const std::uint32_t> group);

  Array<Vec3> position_;
  Array<float> volume_;   // m^D
  Array<float> no_slip_;  // 1 where the surface is no-slip
  Grid grid_;
  std::vector<std::uint32_t> order_;  // the number that a sample had before the sort
  Extent extent_;
  bool any_no_slip_ = false;

  // Empty where no body moves.
  std::vector<Origin> origin_;
  std::vector<bool> moving_;  // for each body
  Array<Vec3> unsorted_;
  Array<Vec3> velocity_;  // m/s
  Extent moving_extent_;
};

}  // namespace curlew
