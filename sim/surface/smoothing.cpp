#include "sim/surface/smoothing.h"

#include <omp.h>

#include <cmath>

#include "sim/core/parallel.h"
#include "sim/core/simd.h"

namespace curlew {
namespace {

// Taubin's lambda and mu: waves longer than some 17 sides of triangles, 6 particles, are kept.
constexpr float inwards = 0.9f, outwards = -0.93f;

// A vertex that stands out from the mean of its neighbours by half the length of its sides (squared: a quarter) is the
// tip of a small drop and stays.
constexpr float sharpest = 4;

}  // namespace

// In a closed mesh the corners that follow a vertex in its triangles are its neighbours, each once.
void Smoother::find_rings(const SurfaceMesh& mesh) {
  const std::size_t n = mesh.position.size();
  first_.assign(n + 1, 0);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++first_[v + 1];
  }
  for (std::size_t v = 0; v < n; ++v) first_[v + 1] += first_[v];
  next_.resize(3 * mesh.triangles.size());
  previous_.resize(next_.size());
  const int parts = omp_get_max_threads();
#pragma omp parallel for schedule(static, 1)
  for (int part = 0; part < parts; ++part) {
    // Each thread reads all triangles and writes for vertices of its own, so that rings come in the triangles' order.
    const auto bound = [&](int p) {
      return static_cast<std::uint32_t>(n * static_cast<std::size_t>(p) / static_cast<std::size_t>(parts));
    };
    const std::uint32_t begin = bound(part), end = bound(part + 1);
    std::vector<std::uint32_t> at(first_.begin() + begin, first_.begin() + end);
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] < begin || t[k] >= end) continue;
        const std::uint32_t place = at[t[k] - begin]++;
        next_[place] = t[(k + 1) % 3];
        previous_[place] = t[(k + 2) % 3];
      }
    }
  }
}

// How much each vertex may move.
void Smoother::find_freedom(const std::vector<Vec3>& position) {
  freedom_.resize(position.size());
  parallel_for(position.size(), [&](std::size_t v) {
    Vec3 sum;
    float length2 = 0;
    for (std::uint32_t k = first_[v]; k < first_[v + 1]; ++k) {
      const Vec3 side = position[next_[k]] - position[v];
      sum += side;
      length2 += dot(side, side);
    }
    const float number = static_cast<float>(first_[v + 1] - first_[v]);
    const float bend = dot(sum, sum) / (number * std::max(length2, 1e-30f));
    freedom_[v] = std::max(0.0f, 1 - sharpest * bend);
  });
}

// All four numbers of a vector at once; the fourth is not used.
void Smoother::step(const std::vector<Vec3>& from, std::vector<Vec3>& to, float share) const {
  const auto at = [&](std::size_t v) { return *reinterpret_cast<const f4*>(&from[v]); };
  const f4 low{low_.x, low_.y, low_.z, -INFINITY}, high{high_.x, high_.y, high_.z, INFINITY};
  parallel_for(from.size(), [&](std::size_t v) {
    f4 sum{};
    const std::uint32_t begin = first_[v], end = first_[v + 1];
    for (std::uint32_t k = begin; k < end; ++k) sum += at(next_[k]);
    const f4 here = at(v);
    f4 moved = here + share * freedom_[v] * ((1 / static_cast<float>(end - begin)) * sum - here);
    moved = moved < low ? low : moved > high ? high : moved;
    for (int axis = 0; held_[v] != 0 && axis < 3; ++axis) {
      if ((held_[v] >> axis & 1) != 0) moved[axis] = here[axis];
    }
    *reinterpret_cast<f4*>(&to[v]) = moved;
  });
}

void Smoother::find_normals(SurfaceMesh& mesh) const {
  parallel_for(mesh.position.size(), [&](std::size_t v) {
    Vec3 sum;
    for (std::uint32_t k = first_[v]; k < first_[v + 1]; ++k)
      sum += cross(mesh.position[next_[k]] - mesh.position[v], mesh.position[previous_[k]] - mesh.position[v]);
    const float l = length(sum);
    if (l > 0) mesh.normal[v] = (1 / l) * sum;
  });
}

void Smoother::run(SurfaceMesh& mesh, int passes, const Domain& domain) {
  if (passes == 0 || mesh.empty()) return;
  find_rings(mesh);
  held_.assign(mesh.position.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto face = [&](int side, double open, double closed) {
      return static_cast<float>(is_cut_off(domain, axis, side) ? closed : open);
    };
    low_[axis] = face(0, -INFINITY, domain.min[axis]);
    high_[axis] = face(1, INFINITY, domain.max[axis]);
    const auto near = static_cast<float>(1e-5 * (domain.max[axis] - domain.min[axis]));
    parallel_for(mesh.position.size(), [&](std::size_t v) {
      const float x = mesh.position[v][axis];
      if (x - low_[axis] < near || high_[axis] - x < near) held_[v] = static_cast<std::uint8_t>(held_[v] | 1u << axis);
    });
  }
  other_.resize(mesh.position.size());
  find_freedom(mesh.position);
  for (int pass = 0; pass < passes; ++pass) {
    step(mesh.position, other_, inwards);
    step(other_, mesh.position, outwards);
  }
  find_normals(mesh);
}

std::size_t Smoother::bytes() const {
  return first_.capacity() * sizeof(std::uint32_t) + 2 * next_.capacity() * sizeof(std::uint32_t) +
         freedom_.capacity() * sizeof(float) + other_.capacity() * sizeof(Vec3) + held_.capacity();
}

}  // namespace curlew
