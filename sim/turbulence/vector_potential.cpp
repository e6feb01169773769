#include "sim/turbulence/vector_potential.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace curlew {
namespace {

constexpr double spacing_of_nodes = 1.5;  // in particle spacings
constexpr float sharpening = 0.31f;       // c of 1 - c delta^2
constexpr int cycles = 2;
constexpr double most_nodes = 5e7;  // 2.7 GB
constexpr int most_rounds = 8;      // of smoothing: more on coarser grids, where they cost little
constexpr int coarsest_rounds = 16;

f4& quad(Vec3& v) { return reinterpret_cast<f4&>(v); }
f4 quad(const Vec3& v) { return reinterpret_cast<const f4&>(v); }

// Behind a face across `axis` a node's value appears with these signs: the part along the face turned, as in a mirror.
f4 face_sign(int axis) {
  f4 sign{-1, -1, -1, -1};
  sign[axis] = 1;
  return sign;
}

// The least number of intervals, of the form 4, 5, 6 or 7 times a power of two, that is not less than `least`.
int intervals_for(double least) {
  for (int power = 1;; power *= 2) {
    for (int q = 4; q < 8; ++q) {
      if (q * power >= least) return q * power;
    }
  }
}

// f(y, z) for every row of nodes along x, on all cores where that pays.
template <class F>
void for_rows(const std::array<int, 3>& nodes, F&& f) {
  const int rows = nodes[1] * nodes[2];
#pragma omp parallel for schedule(static) if (rows * nodes[0] > 4096)
  for (int row = 0; row < rows; ++row) f(row % nodes[1], row / nodes[1]);
}

}  // namespace

void VectorPotential::Level::allocate() {
  std::ptrdiff_t size = 1;
  for (int axis = 0; axis < 3; ++axis) {
    stride[axis] = size;
    size *= nodes[axis] + 2 * ghosts[axis];
  }
  for (Nodes* values : {&psi, &source, &residual}) values->assign(static_cast<std::size_t>(size), Vec3{});
}

VectorPotential::VectorPotential(const Scene& scene) : dimension_(scene.dimension) {
  std::array<int, 3> intervals{};
  Vec3d length;
  for (int axis = 0; axis < dimension_; ++axis) {
    periodic_[axis] = scene.domain.periodic[axis];
    length[axis] = scene.domain.max[axis] - scene.domain.min[axis];
    intervals[axis] = intervals_for(length[axis] / (spacing_of_nodes * scene.spacing()));
    inverse_spacing_[axis] = static_cast<float>(intervals[axis] / length[axis]);
  }
  origin_ = to_float(scene.domain.min);
  const double number = (intervals[0] + 1.0) * (intervals[1] + 1.0) * (intervals[2] + 1.0);
  if (number > most_nodes) {
    throw InputError("the domain holds " + number_text(std::round(1e-6 * number)) +
                     " million nodes of the grid that vorticity_refinement.reconstruction = poisson needs, more than " +
                     number_text(1e-6 * most_nodes) +
                     " million; use a smaller domain, a larger particle radius, or sum");
  }
  for (bool coarsened = true; coarsened;) {
    coarsened = false;
    Level& level = levels_.emplace_back();
    for (int axis = 0; axis < dimension_; ++axis) {
      level.nodes[axis] = intervals[axis] + (periodic_[axis] ? 0 : 1);
      const double h = length[axis] / intervals[axis];
      level.weight[axis] = static_cast<float>(1 / (h * h));
      level.ghosts[axis] = 1;
      if (intervals[axis] % 2 != 0) continue;
      level.coarser[axis] = 2;
      intervals[axis] /= 2;
      coarsened = true;
    }
    level.allocate();
    prepare_lines(level);
  }
}

// In a thin domain the coarse levels' points are so near each other across it that point by point only the
// differences between them would settle, not what they have in common.
void VectorPotential::prepare_lines(Level& level) const {
  for (int axis = 0; axis < dimension_; ++axis) {
    const bool strongest = level.line_axis < 0 || level.weight[axis] > level.weight[level.line_axis];
    if (level.coarser[axis] == 1 && level.nodes[axis] <= longest_line && strongest) level.line_axis = axis;
  }
  if (level.line_axis < 0) return;
  const int axis = level.line_axis, n = level.nodes[axis];
  for (int across = 0; across < 2; ++across) {
    const double w = double{level.weight[axis]}, sign = across ? -1 : 1;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (int k = 0; k < n; ++k) {
      matrix(k, k) += 2 * double{level.weight.x + level.weight.y + level.weight.z};
      for (const int next : {k - 1, k + 1}) {
        const bool beyond = next < 0 || next >= n;
        const int seen = !beyond ? next : periodic_[axis] ? (next + n) % n : next < 0 ? 1 : n - 2;
        matrix(k, seen) -= beyond && !periodic_[axis] ? sign * w : w;
      }
    }
    const Eigen::MatrixXd inverse = matrix.inverse();
    for (int k = 0; k < n; ++k) {
      for (int l = 0; l < n; ++l) level.line_inverse[across][k][l] = static_cast<float>(inverse(k, l));
    }
  }
}

// Gauss-Seidel of whole lines, even and odd ones in turns.
void VectorPotential::smooth_lines(Level& level, int rounds) const {
  const int axis = level.line_axis, n = level.nodes[axis];
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const float wb = level.weight[b], wc = level.weight[c];
  const std::ptrdiff_t along = level.stride[axis], sb = level.stride[b], sc = c < dimension_ ? level.stride[c] : 0;
  const Vec3 mask{axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f};
  for (int half = 0; half < 2 * rounds; ++half) {
    for (int v = 0; v < level.nodes[c]; ++v) {
      for (int u = (v + half) & 1; u < level.nodes[b]; u += 2) {
        const std::ptrdiff_t first = level.at(0, 0, 0) + u * sb + v * level.stride[c];
        f4 right[longest_line];
        for (int k = 0; k < n; ++k) {
          const Vec3* psi = &level.psi[first + k * along];
          right[k] = quad(level.source[first + k * along]) + wb * (quad(psi[-sb]) + quad(psi[sb])) +
                     wc * (quad(psi[-sc]) + quad(psi[sc]));
        }
        for (int k = 0; k < n; ++k) {
          f4 own{}, other{};
          for (int l = 0; l < n; ++l) {
            own += level.line_inverse[0][k][l] * right[l];
            other += level.line_inverse[1][k][l] * right[l];
          }
          quad(level.psi[first + k * along]) = other + quad(mask) * (own - other);
        }
      }
    }
    fill_ghosts(level, level.psi);
  }
}

void VectorPotential::follow(Vec3 place) {
  for (int axis = 0; axis < dimension_; ++axis) {
    if (periodic_[axis]) origin_[axis] = place[axis];
  }
}

float VectorPotential::along(int axis, Vec3 position) const {
  const float at = (position[axis] - origin_[axis]) * inverse_spacing_[axis];
  if (!periodic_[axis]) return at;
  const auto intervals = static_cast<float>(levels_.front().nodes[axis]);
  return at - intervals * std::floor(at / intervals);
}

bool VectorPotential::place(Vec3 position, Place& found) const {
  const Level& level = levels_.front();
  int node[3] = {0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    float* w = found.weight[axis];
    float* s = found.slope[axis];
    if (axis >= dimension_) {
      w[0] = w[2] = s[0] = s[1] = s[2] = 0;
      w[1] = 1;
      continue;
    }
    const float at = along(axis, position);
    const float nearest_node = std::nearbyint(at), t = at - nearest_node;
    node[axis] = static_cast<int>(nearest_node);
    if (periodic_[axis] && node[axis] == level.nodes[axis]) node[axis] = 0;
    if (node[axis] < 0 || node[axis] >= level.nodes[axis]) return false;
    w[0] = 0.5f * (0.5f - t) * (0.5f - t);
    w[1] = 0.75f - t * t;
    w[2] = 0.5f * (0.5f + t) * (0.5f + t);
    s[0] = (t - 0.5f) * inverse_spacing_[axis];
    s[1] = -2 * t * inverse_spacing_[axis];
    s[2] = (t + 0.5f) * inverse_spacing_[axis];
  }
  found.node = level.at(node[0], node[1], node[2]);
  return true;
}

// Particles are taken plane by plane of nodes; every third plane at once, so that no two write to the same node.
void VectorPotential::spread(std::span<const Vec3> position, std::span<const Vec3> vorticity) {
  Level& level = levels_.front();
  const int across = dimension_ - 1, planes = level.nodes[across] + 1;
  const auto plane_of = [&](std::size_t i) {
    const float at = along(across, position[i]);
    return static_cast<std::uint32_t>(std::clamp(std::nearbyint(at), 0.0f, static_cast<float>(planes - 1)));
  };
  plane_begin_.assign(static_cast<std::size_t>(planes) + 1, 0);
  for (std::size_t i = 0; i < position.size(); ++i) ++plane_begin_[plane_of(i) + 1];
  for (int plane = 0; plane < planes; ++plane) plane_begin_[plane + 1] += plane_begin_[plane];
  order_.resize(position.size());
  std::vector<std::uint32_t> next(plane_begin_.begin(), plane_begin_.end() - 1);
  for (std::size_t i = 0; i < position.size(); ++i) order_[next[plane_of(i)]++] = static_cast<std::uint32_t>(i);

  std::fill(level.source.begin(), level.source.end(), Vec3{});
  float density = 1;
  for (int axis = 0; axis < dimension_; ++axis) density *= inverse_spacing_[axis];
  const int deep = dimension_ == 3 ? 1 : 0;
  // The last plane of a periodic axis is the first one again: a turn of its own.
  for (int turn = 0; turn < 4; ++turn) {
#pragma omp parallel for schedule(dynamic, 1)
    for (int plane = 0; plane < planes; ++plane) {
      if (turn != (plane == planes - 1 ? 3 : plane % 3)) continue;
      for (std::uint32_t k = plane_begin_[plane]; k < plane_begin_[plane + 1]; ++k) {
        const Vec3 value = vorticity[order_[k]];
        Place p;
        if (dot(value, value) == 0 || !place(position[order_[k]], p)) continue;
        const f4 strength = density * value.w * quad(value);
        for (int z = -deep; z <= deep; ++z) {
          for (int y = -1; y <= 1; ++y) {
            const f4 row = p.weight[2][z + 1] * p.weight[1][y + 1] * strength;
            Vec3* node = &level.source[p.node + y * level.stride[1] + z * level.stride[2]];
            for (int x = -1; x <= 1; ++x) quad(node[x]) += p.weight[0][x + 1] * row;
          }
        }
      }
    }
  }
}

namespace {

// f(index of a node of the plane `fixed` across `axis`), ghosts of the other axes included.
template <class LevelLike, class F>
void for_plane(const LevelLike& level, int axis, F&& f) {
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  for (int v = 0; v < level.nodes[b] + 2 * level.ghosts[b]; ++v) {
    for (int u = 0; u < level.nodes[a] + 2 * level.ghosts[a]; ++u) f(u * level.stride[a] + v * level.stride[b]);
  }
}

}  // namespace

// What was spread to ghosts belongs to the nodes that they stand for; and a node in a face is its own ghost.
void VectorPotential::fold_ghosts() {
  Level& level = levels_.front();
  for (int axis = 0; axis < dimension_; ++axis) {
    const std::ptrdiff_t step = level.stride[axis];
    const int last = level.nodes[axis];  // with the ghost before the first, the number of the last node
    const f4 sign = face_sign(axis);
    for_plane(level, axis, [&](std::ptrdiff_t plane) {
      const auto node = [&](int k) -> f4& { return quad(level.source[plane + k * step]); };
      if (periodic_[axis]) {
        node(last) += node(0);
        node(1) += node(last + 1);
      } else {
        node(2) += sign * node(0);
        node(last - 1) += sign * node(last + 1);
        node(1) *= 1.0f + sign;
        node(last) *= 1.0f + sign;
      }
    });
  }
}

void VectorPotential::fill_ghosts(const Level& level, Nodes& values) const {
  for (int axis = 0; axis < dimension_; ++axis) {
    const std::ptrdiff_t step = level.stride[axis];
    const int last = level.nodes[axis];
    const f4 sign = periodic_[axis] ? f4{1, 1, 1, 1} : face_sign(axis);
    const int low = periodic_[axis] ? last : 2, high = periodic_[axis] ? 1 : last - 1;
    for_plane(level, axis, [&](std::ptrdiff_t plane) {
      quad(values[plane]) = sign * quad(values[plane + low * step]);
      quad(values[plane + (last + 1) * step]) = sign * quad(values[plane + high * step]);
    });
  }
}

void VectorPotential::sharpen() {
  Level& level = levels_.front();
  fill_ghosts(level, level.source);
  for_rows(level.nodes, [&](int y, int z) {
    const std::ptrdiff_t row = level.at(0, y, z);
    for (std::ptrdiff_t n = row; n < row + level.nodes[0]; ++n) {
      const f4 here = quad(level.source[n]);
      f4 bend{};
      for (int axis = 0; axis < dimension_; ++axis) {
        bend += quad(level.source[n - level.stride[axis]]) + quad(level.source[n + level.stride[axis]]) - 2.0f * here;
      }
      quad(level.residual[n]) = here - sharpening * bend;
    }
  });
  level.source.swap(level.residual);
}

// A component that no face holds (periodic and even axes alone) has a potential only if its sum is zero.
void VectorPotential::remove_means() {
  Level& level = levels_.front();
  f4 loose{1, 1, 1, 0};
  for (int axis = 0; axis < dimension_; ++axis) {
    for (int part = 0; part < 3; ++part) {
      if (!periodic_[axis] && part != axis) loose[part] = 0;
    }
  }
  if (loose[0] + loose[1] + loose[2] == 0) return;
  // Nodes in a face stand for half as much.
  const auto share = [&](int axis, int k) {
    return !periodic_[axis] && axis < dimension_ && (k == 0 || k == level.nodes[axis] - 1) ? 0.5 : 1.0;
  };
  std::array<double, 3> sum{};
  double total = 0;
  for (int z = 0; z < level.nodes[2]; ++z) {
    for (int y = 0; y < level.nodes[1]; ++y) {
      for (int x = 0; x < level.nodes[0]; ++x) {
        const double weight = share(0, x) * share(1, y) * share(2, z);
        total += weight;
        for (int part = 0; part < 3; ++part) sum[part] += weight * double{level.source[level.at(x, y, z)][part]};
      }
    }
  }
  f4 mean{};
  for (int part = 0; part < 3; ++part) mean[part] = loose[part] * static_cast<float>(sum[part] / total);
  for (Vec3& value : level.source) quad(value) -= mean;
}

// Gauss-Seidel, even nodes and odd ones in turns.
void VectorPotential::smooth(Level& level, int rounds) const {
  if (level.line_axis >= 0) return smooth_lines(level, rounds);
  const Vec3 w = level.weight;
  const float inverse = 1 / (2 * (w.x + w.y + w.z));
  const std::ptrdiff_t sy = level.stride[1], sz = level.stride[2];
  const std::ptrdiff_t deep = dimension_ == 3 ? sz : 0;
  for (int half = 0; half < 2 * rounds; ++half) {
    for_rows(level.nodes, [&](int y, int z) {
      const std::ptrdiff_t row = level.at(0, y, z);
      for (std::ptrdiff_t n = row + ((y + z + half) & 1); n < row + level.nodes[0]; n += 2) {
        const Vec3* psi = &level.psi[n];
        const f4 around = w.x * (quad(psi[-1]) + quad(psi[1])) + w.y * (quad(psi[-sy]) + quad(psi[sy])) +
                          w.z * (quad(psi[-deep]) + quad(psi[deep]));
        quad(level.psi[n]) = inverse * (around + quad(level.source[n]));
      }
    });
    fill_ghosts(level, level.psi);
  }
}

void VectorPotential::find_residual(Level& level) const {
  const Vec3 w = level.weight;
  const std::ptrdiff_t sy = level.stride[1];
  const std::ptrdiff_t deep = dimension_ == 3 ? level.stride[2] : 0;
  for_rows(level.nodes, [&](int y, int z) {
    const std::ptrdiff_t row = level.at(0, y, z);
    for (std::ptrdiff_t n = row; n < row + level.nodes[0]; ++n) {
      const Vec3* psi = &level.psi[n];
      const f4 around = w.x * (quad(psi[-1]) + quad(psi[1])) + w.y * (quad(psi[-sy]) + quad(psi[sy])) +
                        w.z * (quad(psi[-deep]) + quad(psi[deep]));
      quad(level.residual[n]) = quad(level.source[n]) + around - 2 * (w.x + w.y + w.z) * quad(level.psi[n]);
    }
  });
  fill_ghosts(level, level.residual);
}

// One V-cycle from this level down: full weighting to the coarser one, linear interpolation back.
void VectorPotential::cycle(std::size_t depth) {
  Level& fine = levels_[depth];
  if (depth + 1 == levels_.size()) return smooth(fine, coarsest_rounds);
  const int rounds = std::min(1 << depth, most_rounds);
  smooth(fine, rounds);
  find_residual(fine);
  Level& coarse = levels_[depth + 1];
  const std::array<int, 3>& ratio = fine.coarser;
  const int reach[3] = {ratio[0] - 1, ratio[1] - 1, ratio[2] - 1};
  const auto weight = [&](int axis, int offset) { return reach[axis] == 0 ? 1.0f : offset == 0 ? 0.5f : 0.25f; };
  for_rows(coarse.nodes, [&](int y, int z) {
    for (int x = 0; x < coarse.nodes[0]; ++x) {
      const std::ptrdiff_t centre = fine.at(x * ratio[0], y * ratio[1], z * ratio[2]);
      f4 sum{};
      for (int c = -reach[2]; c <= reach[2]; ++c) {
        for (int b = -reach[1]; b <= reach[1]; ++b) {
          for (int a = -reach[0]; a <= reach[0]; ++a) {
            sum += weight(0, a) * weight(1, b) * weight(2, c) *
                   quad(fine.residual[centre + a + b * fine.stride[1] + c * fine.stride[2]]);
          }
        }
      }
      quad(coarse.source[coarse.at(x, y, z)]) = sum;
    }
  });
  std::fill(coarse.psi.begin(), coarse.psi.end(), Vec3{});
  cycle(depth + 1);
  // A fine node lies on a coarse one or half way between two.
  for_rows(fine.nodes, [&](int y, int z) {
    for (int x = 0; x < fine.nodes[0]; ++x) {
      const std::ptrdiff_t base = coarse.at(x / ratio[0], y / ratio[1], z / ratio[2]);
      const std::ptrdiff_t dx = x % ratio[0], dy = (y % ratio[1]) * coarse.stride[1],
                           dz = (z % ratio[2]) * coarse.stride[2];
      f4 sum{};
      for (const std::ptrdiff_t c : {std::ptrdiff_t{0}, dz}) {
        for (const std::ptrdiff_t b : {std::ptrdiff_t{0}, dy}) {
          sum += quad(coarse.psi[base + b + c]) + quad(coarse.psi[base + b + c + dx]);
        }
      }
      quad(fine.psi[fine.at(x, y, z)]) += 0.125f * sum;
    }
  });
  fill_ghosts(fine, fine.psi);
  smooth(fine, rounds);
}

void VectorPotential::solve(std::span<const Vec3> position, std::span<const Vec3> vorticity) {
  spread(position, vorticity);
  fold_ghosts();
  sharpen();
  remove_means();
  std::fill(levels_.front().psi.begin(), levels_.front().psi.end(), Vec3{});
  for (int k = 0; k < cycles; ++k) cycle(0);
}

Vec3 VectorPotential::curl(Vec3 position) const {
  Place p;
  if (!place(position, p)) return {};
  const Level& level = levels_.front();
  const int deep = dimension_ == 3 ? 1 : 0;
  f4 dx{}, dy{}, dz{};
  for (int z = -deep; z <= deep; ++z) {
    for (int y = -1; y <= 1; ++y) {
      const Vec3* node = &level.psi[p.node + y * level.stride[1] + z * level.stride[2]];
      f4 along{}, slope{};
      for (int x = -1; x <= 1; ++x) {
        along += p.weight[0][x + 1] * quad(node[x]);
        slope += p.slope[0][x + 1] * quad(node[x]);
      }
      dx += p.weight[1][y + 1] * p.weight[2][z + 1] * slope;
      dy += p.slope[1][y + 1] * p.weight[2][z + 1] * along;
      dz += p.weight[1][y + 1] * p.slope[2][z + 1] * along;
    }
  }
  return {dy[2] - dz[1], dz[0] - dx[2], dx[1] - dy[0]};
}

std::size_t VectorPotential::bytes() const {
  std::size_t bytes = (order_.capacity() + plane_begin_.capacity()) * sizeof(std::uint32_t);
  for (const Level& level : levels_) {
    bytes += (level.psi.capacity() + level.source.capacity() + level.residual.capacity()) * sizeof(Vec3);
  }
  return bytes;
}

}  // namespace curlew
