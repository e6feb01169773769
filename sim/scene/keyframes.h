// How a body moves: a smooth path through keyframes, without rotation.
//
// Between two keyframes each coordinate is a cubic Hermite polynomial. Its slope at a keyframe is zero at the first and
// the last and where the mean slopes before and after differ in sign, else their harmonic mean, weighted by the times
// between (Fritsch & Butland 1984, "A method for constructing local monotone piecewise cubic interpolants"; the
// weights are those of PCHIP, Fritsch & Carlson 1980). So the velocity is continuous, and no coordinate leaves the
// range between its two keyframes: a body that stops does not overshoot. Three keyframes in line at even speed give
// that very speed at the middle one, so between four the speed is constant.
//
// Place and velocity are functions of time alone: nothing accumulates, and a run that goes on has the same bits.
#pragma once

#include <vector>

#include "sim/core/vec.h"

namespace curlew {

struct Keyframe {
  double time = 0;  // s
  Vec3d at;         // m, from where the shape stands in the scene file
  bool operator==(const Keyframe&) const = default;
};

// Where a body is at one moment, and how fast.
struct BodyPlace {
  Vec3d offset;    // m, from where the shape stands in the scene file
  Vec3d velocity;  // m/s
};

class KeyframePath {
 public:
  // A body that stands where the scene file has it.
  KeyframePath() = default;
  // Times must rise.
  explicit KeyframePath(std::vector<Keyframe> keyframes);

  const std::vector<Keyframe>& keyframes() const { return keyframes_; }

  // Whether the body is ever anywhere else than where the scene file has it.
  bool moves() const { return moves_; }

  // Constant before the first keyframe and after the last.
  BodyPlace at(double time) const;

  // A bound of the speed (m/s) from one time to a later one: exact along each axis.
  double top_speed(double from, double to) const;
  // The same for all times.
  double top_speed() const;

  // The smallest and the largest offset ever, axis by axis.
  Vec3d least() const { return least_; }
  Vec3d most() const { return most_; }

  // Whether the body is on its way at some time from `from` to `to`.
  bool moves_between(double from, double to) const;

 private:
  // p0 + s (b + s (c + s e)) for s from 0 to 1 in `length` seconds.
  struct Piece {
    double length = 0;
    Vec3d start, b, c, e;
  };
  Piece piece(std::size_t k) const;
  std::size_t piece_of(double time) const;

  std::vector<Keyframe> keyframes_;
  std::vector<Vec3d> slope_;  // m/s, at the keyframes
  Vec3d least_, most_;
  bool moves_ = false;
};

}  // namespace curlew
