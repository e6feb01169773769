#include "sim/scene/heightfield.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/core/error.h"
#include "sim/scene/expression.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json.h"

namespace curlew {
namespace {

void sample_formula(Heightfield& field, int dimension, const std::string& place) {
  const Expression formula(field.formula, dimension, place);
  field.columns = dimension == 2 ? 2049 : 257;  // fine enough that a wave across the box is off by 1e-4 of its height
  field.rows = dimension == 2 ? 1 : 257;
  for (int row = 0; row < field.rows; ++row) {
    const double z = field.rows == 1 ? 0 : field.min.z + (field.max.z - field.min.z) * row / (field.rows - 1);
    for (int column = 0; column < field.columns; ++column) {
      const double x = field.min.x + (field.max.x - field.min.x) * column / (field.columns - 1);
      const double height = formula(x, z);
      if (!std::isfinite(height)) {
        throw InputError(place + " has no finite value at x = " + plain_number(x) +
                         (dimension == 3 ? ", z = " + plain_number(z) : "") + ", expected a height in metres");
      }
      field.heights.push_back(height);
    }
  }
}

// Numbers between commas; returns how many, and throws where one is none.
int read_row(std::string_view line, const std::string& place, std::vector<double>& heights) {
  int count = 0;
  while (true) {
    const std::size_t comma = line.find(',');
    std::string_view word = line.substr(0, comma);
    while (!word.empty() && (word.front() == ' ' || word.front() == '\t')) word.remove_prefix(1);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t' || word.back() == '\r')) word.remove_suffix(1);
    double value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw InputError(place + ", column " + std::to_string(count + 1) + ": found " + in_quotes(word) +
                       ", expected a height in metres");
    }
    heights.push_back(value);
    ++count;
    if (comma == std::string_view::npos) return count;
    line.remove_prefix(comma + 1);
  }
}

void read_csv(Heightfield& field, const std::filesystem::path& file, int dimension) {
  constexpr std::uintmax_t largest = std::uintmax_t{256} << 20U;
  const std::string text = read_file(file, largest, "a CSV file of heights");
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view row = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (row.empty() || row == "\r" || row[0] == '#') continue;
    const std::string place = file.string() + ": line " + std::to_string(line);
    const int count = read_row(row, place, field.heights);
    if (field.rows++ > 0 && count != field.columns) {
      throw InputError(place + ": found " + std::to_string(count) + " heights, expected " +
                       std::to_string(field.columns) + " as in the rows before");
    }
    field.columns = count;
  }
  const bool enough = field.columns >= 2 && (dimension == 2 ? field.rows == 1 : field.rows >= 2);
  if (!enough) {
    throw InputError(file.string() + ": found " + std::to_string(field.rows) + " rows of " +
                     std::to_string(field.columns) + " heights, expected " +
                     (dimension == 2 ? "one row" : "two rows or more") + " of two heights or more");
  }
}

// Where a coordinate falls between the grid's lines: the line before, and the share of the way to the next.
std::pair<std::size_t, double> grid_place(double value, double min, double max, int lines) {
  if (lines == 1) return {0, 0};
  const double at = std::clamp((value - min) / (max - min) * (lines - 1), 0.0, lines - 1.0);
  const double line = std::min(std::floor(at), lines - 2.0);
  return {static_cast<std::size_t>(line), at - line};
}

}  // namespace

void load_heights(Heightfield& field, const std::filesystem::path& folder, int dimension, const std::string& place) {
  field.heights.clear();
  field.columns = field.rows = 0;
  if (field.file.empty()) {
    sample_formula(field, dimension, place);
  } else {
    read_csv(field, folder / field.file, dimension);
  }
}

double height_at(const Heightfield& field, double x, double z) {
  const auto [column, s] = grid_place(x, field.min.x, field.max.x, field.columns);
  const auto [row, t] = grid_place(z, field.min.z, field.max.z, field.rows);
  const auto height = [&](std::size_t c, std::size_t r) {
    return field.heights[r * static_cast<std::size_t>(field.columns) + c];
  };
  const double near = (1 - s) * height(column, row) + s * height(column + 1, row);
  if (field.rows == 1) return near;
  return (1 - t) * near + t * ((1 - s) * height(column, row + 1) + s * height(column + 1, row + 1));
}

double distance_to_heightfield(const Heightfield& field, Vec3d p, int dimension) {
  const double dx = (field.max.x - field.min.x) / (field.columns - 1);
  const double dz = field.rows > 1 ? (field.max.z - field.min.z) / (field.rows - 1) : 1;
  const double top = std::min(height_at(field, p.x, p.z), field.max.y);
  const double slope_x = (height_at(field, p.x + dx, p.z) - height_at(field, p.x - dx, p.z)) / (2 * dx);
  const double slope_z =
      dimension == 3 ? (height_at(field, p.x, p.z + dz) - height_at(field, p.x, p.z - dz)) / (2 * dz) : 0;
  const double above = (p.y - top) / std::sqrt(1 + slope_x * slope_x + slope_z * slope_z);
  double outside = 0, deepest = above;  // beyond the sides and the floor: like a box
  const auto side = [&](double beyond) {
    deepest = std::max(deepest, beyond);
    outside += beyond > 0 ? beyond * beyond : 0;
  };
  side(std::max(field.min.x - p.x, p.x - field.max.x));
  side(field.min.y - p.y);
  if (dimension == 3) side(std::max(field.min.z - p.z, p.z - field.max.z));
  if (deepest <= 0) return deepest;
  return std::sqrt(outside + (above > 0 ? above * above : 0));
}

TriangleMesh heightfield_mesh(const Heightfield& field) {
  TriangleMesh mesh;
  const int columns = field.columns, rows = std::max(field.rows, 2);
  const auto index = [&](int column, int row, bool top) {
    return static_cast<std::uint32_t>((row * columns + column) * 2 + (top ? 1 : 0));
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = field.min.x + (field.max.x - field.min.x) * column / (columns - 1);
      const double z = field.min.z + (field.max.z - field.min.z) * row / (rows - 1);
      mesh.vertices.push_back({x, field.min.y, z});
      mesh.vertices.push_back({x, std::clamp(height_at(field, x, z), field.min.y, field.max.y), z});
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      quad(index(c, r, true), index(c, r + 1, true), index(c + 1, r + 1, true), index(c + 1, r, true));
      quad(index(c, r, false), index(c + 1, r, false), index(c + 1, r + 1, false), index(c, r + 1, false));
    }
    quad(index(0, r, false), index(0, r + 1, false), index(0, r + 1, true), index(0, r, true));
    const int e = columns - 1;
    quad(index(e, r, false), index(e, r, true), index(e, r + 1, true), index(e, r + 1, false));
  }
  for (int c = 0; c + 1 < columns; ++c) {
    quad(index(c, 0, false), index(c, 0, true), index(c + 1, 0, true), index(c + 1, 0, false));
    const int e = rows - 1;
    quad(index(c, e, false), index(c + 1, e, false), index(c + 1, e, true), index(c, e, true));
  }
  return mesh;
}

}  // namespace curlew
