// Bodies as samples in two layers, half a spacing d and 3/2 d beneath their surface: each sample stands for the volume
// V_b = gamma / sum_b' W(x_b - x_b') (Akinci et al. 2012, "Versatile rigid-fluid coupling"), and gamma is such that a
// particle one spacing from even layers has the density that it has in a full lattice. One layer alone goes soft where
// an impact drives water within a spacing of it.
#pragma once

#include <vector>

#include "sim/core/fields.h"
#include "sim/scene/scene.h"
#include "sim/sph/candidates.h"
#include "sim/sph/grid.h"
#include "sim/sph/kernel.h"
#include "sim/sph/walls.h"

namespace curlew {

class BodySamples {
 public:
  BodySamples() = default;
  BodySamples(const Scene& scene, const CellShape& shape, const Kernel& kernel);

  std::size_t count() const { return position_.size(); }
  bool any_no_slip() const { return any_no_slip_; }
  const Array<Vec3>& position() const { return position_; }
  const Array<float>& volume() const { return volume_; }

  // The samples around a cell; leaves `near` empty without a search where there are none.
  void collect(const CellShape& shape, std::array<int, 3> cell, Candidates& near, Grid::Hints& hints) const;

  // Adds to `total` what the samples in `near` do to a particle at `here`; rest density in kg/m^3.
  void add(WallSum& total, Vec3 here, const Candidates& near, const Kernel& kernel, float rest_density) const;

  std::size_t bytes() const;

 private:
  Array<Vec3> position_;
  Array<float> volume_;   // m^D
  Array<float> no_slip_;  // 1 where the surface is no-slip
  Grid grid_;
  std::array<int, 3> low_{}, high_{};  // cells that hold samples, and the ring around them
  bool any_no_slip_ = false;
};

}  // namespace curlew
