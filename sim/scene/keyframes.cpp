#include "sim/scene/keyframes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/scene/scene.h"

namespace curlew {
namespace {

// The weighted harmonic mean of the slopes over times h and k, 0 where they differ in sign.
double monotone_slope(double h, double before, double k, double after) {
  if (!(before * after > 0)) return 0;
  const double first = h + 2 * k, second = 2 * h + k;
  return (first + second) / (first / before + second / after);
}

}  // namespace

KeyframePath::KeyframePath(std::vector<Keyframe> keyframes) : keyframes_(std::move(keyframes)) {
  const std::size_t n = keyframes_.size();
  if (n == 0) return;
  slope_.resize(n);
  least_ = most_ = keyframes_[0].at;
  for (std::size_t k = 0; k < n; ++k) {
    const Keyframe& here = keyframes_[k];
    moves_ = moves_ || here.at != Vec3d{};
    for (int axis = 0; axis < 3; ++axis) {
      least_[axis] = std::min(least_[axis], here.at[axis]);
      most_[axis] = std::max(most_[axis], here.at[axis]);
      if (k == 0 || k + 1 == n) continue;
      const Keyframe &last = keyframes_[k - 1], &next = keyframes_[k + 1];
      const double before = here.time - last.time, after = next.time - here.time;
      slope_[k][axis] = monotone_slope(before, (here.at[axis] - last.at[axis]) / before, after,
                                       (next.at[axis] - here.at[axis]) / after);
    }
  }
}

KeyframePath::Piece KeyframePath::piece(std::size_t k) const {
  const double h = keyframes_[k + 1].time - keyframes_[k].time;
  const Vec3d way = keyframes_[k + 1].at - keyframes_[k].at, begin = h * slope_[k], end = h * slope_[k + 1];
  return {h, keyframes_[k].at, begin, 3.0 * way - 2.0 * begin - end, begin + end - 2.0 * way};
}

// The piece that holds a time from the first keyframe on and before the last.
std::size_t KeyframePath::piece_of(double time) const {
  const auto next = std::upper_bound(keyframes_.begin(), keyframes_.end(), time,
                                     [](double t, const Keyframe& keyframe) { return t < keyframe.time; });
  return static_cast<std::size_t>(next - keyframes_.begin()) - 1;
}

BodyPlace KeyframePath::at(double time) const {
  if (keyframes_.empty()) return {};
  if (time < keyframes_.front().time) return {keyframes_.front().at, {}};
  if (time >= keyframes_.back().time) return {keyframes_.back().at, {}};
  const std::size_t k = piece_of(time);
  const Piece p = piece(k);
  const double s = (time - keyframes_[k].time) / p.length;
  return {p.start + s * (p.b + s * (p.c + s * p.e)), (1 / p.length) * (p.b + s * (2.0 * p.c + (3 * s) * p.e))};
}

double KeyframePath::top_speed(double from, double to) const {
  if (!moves_between(from, to)) return 0;
  double top = 0;
  for (std::size_t k = from > keyframes_.front().time ? piece_of(from) : 0;
       k + 1 < keyframes_.size() && keyframes_[k].time <= to; ++k) {
    const Piece p = piece(k);
    const double first = std::clamp((from - keyframes_[k].time) / p.length, 0.0, 1.0),
                 last = std::clamp((to - keyframes_[k].time) / p.length, 0.0, 1.0);
    Vec3d most;
    for (int axis = 0; axis < 3; ++axis) {
      const auto speed = [&](double s) {
        return std::abs(p.b[axis] + s * (2 * p.c[axis] + 3 * s * p.e[axis])) / p.length;
      };
      most[axis] = std::max(speed(first), speed(last));
      const double vertex = -p.c[axis] / (3 * p.e[axis]);  // where the speed along the axis has its extremum
      if (vertex > first && vertex < last) most[axis] = std::max(most[axis], speed(vertex));
    }
    top = std::max(top, length(most));
  }
  return top;
}

double KeyframePath::top_speed() const {
  constexpr double ever = std::numeric_limits<double>::max();
  return top_speed(-ever, ever);
}

std::vector<BodyPlace> body_places(const std::vector<Body>& bodies, double time) {
  std::vector<BodyPlace> places;
  if (std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.motion.moves(); })) {
    for (const Body& body : bodies) places.push_back(body.motion.at(time));
  }
  return places;
}

bool KeyframePath::moves_between(double from, double to) const {
  return moves_ && keyframes_.size() > 1 && to > keyframes_.front().time && from < keyframes_.back().time;
}

}  // namespace curlew
