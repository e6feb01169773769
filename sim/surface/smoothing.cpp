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

const f4& vector_at(const std::vector<Vec3>& vectors, std::size_t v) {
  return *reinterpret_cast<const f4*>(&vectors[v]);
}
f4& vector_at(std::vector<Vec3>& vectors, std::size_t v) { return *reinterpret_cast<f4*>(&vectors[v]); }

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

// A vertex on its way towards the mean of its neighbours, or away; all four numbers of a vector at once, the fourth is
// not used.
inline f4 Smoother::moved(std::size_t v, f4 here, f4 to_mean, float share) const {
  f4 there = here + share * freedom_[v] * to_mean;
  const f4 low{low_.x, low_.y, low_.z, -INFINITY}, high{high_.x, high_.y, high_.z, INFINITY};
  there = there < low ? low : there > high ? high : there;
  for (int axis = 0; held_[v] != 0 && axis < 3; ++axis) {
    if ((held_[v] >> axis & 1) != 0) there[axis] = here[axis];
  }
  return there;
}

// The first step also finds how much each vertex may move, and in which faces it is held.
void Smoother::first_step(const std::vector<Vec3>& from, std::vector<Vec3>& to) {
  freedom_.resize(from.size());
  held_.resize(from.size());
  parallel_for(from.size(), [&](std::size_t v) {
    const f4 here = vector_at(from, v);
    f4 sum{}, length2{};
    for (std::uint32_t k = first_[v]; k < first_[v + 1]; ++k) {
      const f4 way = vector_at(from, next_[k]) - here;
      sum += way;
      length2 += way * way;
    }
    const float number = static_cast<float>(first_[v + 1] - first_[v]);
    const f4 sum2 = sum * sum;
    const float bend =
        (sum2[0] + sum2[1] + sum2[2]) / (number * std::max(length2[0] + length2[1] + length2[2], 1e-30f));
    freedom_[v] = std::max(0.0f, 1 - sharpest * bend);
    unsigned held = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (here[axis] - low_[axis] < near_[axis] || high_[axis] - here[axis] < near_[axis]) held |= 1u << axis;
    }
    held_[v] = static_cast<std::uint8_t>(held);
    vector_at(to, v) = moved(v, here, (1 / number) * sum, inwards);
  });
}

void Smoother::step(const std::vector<Vec3>& from, std::vector<Vec3>& to, float share) const {
  parallel_for(from.size(), [&](std::size_t v) {
    f4 sum{};
    const std::uint32_t begin = first_[v], end = first_[v + 1];
    for (std::uint32_t k = begin; k < end; ++k) sum += vector_at(from, next_[k]);
    const f4 here = vector_at(from, v);
    vector_at(to, v) = moved(v, here, (1 / static_cast<float>(end - begin)) * sum - here, share);
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
  for (int axis = 0; axis < 3; ++axis) {
    const auto face = [&](int side, double open, double closed) {
      return static_cast<float>(is_cut_off(domain, axis, side) ? closed : open);
    };
    low_[axis] = face(0, -INFINITY, domain.min[axis]);
    high_[axis] = face(1, INFINITY, domain.max[axis]);
    near_[axis] = static_cast<float>(1e-5 * (domain.max[axis] - domain.min[axis]));
  }
  other_.resize(mesh.position.size());
  for (int pass = 0; pass < passes; ++pass) {
    if (pass == 0)
      first_step(mesh.position, other_);
    else
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
