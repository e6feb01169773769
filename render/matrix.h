// Four by four matrices as OpenGL takes them: columns one after the other, in single precision.
#pragma once

#include <array>

#include "sim/core/vec.h"

namespace curlew {

struct Matrix4 {
  std::array<float, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

  double operator()(int row, int column) const { return static_cast<double>(m[index(row, column)]); }
  void set(int row, int column, double value) { m[index(row, column)] = static_cast<float>(value); }

 private:
  static std::size_t index(int row, int column) { return static_cast<std::size_t>(4 * column + row); }
};

// A row of a matrix that maps points: (n.x, n.y, n.z, offset).
inline void set_row(Matrix4& matrix, int row, Vec3d n, double offset) {
  for (int axis = 0; axis < 3; ++axis) matrix.set(row, axis, n[axis]);
  matrix.set(row, 3, offset);
}

}  // namespace curlew
