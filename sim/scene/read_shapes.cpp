#include "sim/scene/read_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.h"
#include "sim/core/params.h"
#include "sim/scene/heightfield.h"
#include "sim/scene/mesh.h"

namespace curlew {
namespace {

constexpr std::array<std::string_view, 6> shape_keys{"box", "sphere", "cylinder", "plane", "mesh", "heightfield"};
constexpr double largest_length = 1e6;  // m

Sphere read_sphere(const JsonPlace& place, int dimension) {
  place.allow({"centre", "radius"});
  return {place.at("centre").vector(dimension), place.at("radius").positive(largest_length)};
}

Cylinder read_cylinder(const JsonPlace& place, int dimension) {
  place.allow({"from", "to", "radius"});
  const Cylinder cylinder{place.at("from").vector(dimension), place.at("to").vector(dimension),
                          place.at("radius").positive(largest_length)};
  if (!(length(cylinder.to - cylinder.from) > 0)) place.fail("has its ends at one place, expected two places");
  return cylinder;
}

Plane read_plane(const JsonPlace& place, int dimension) {
  place.allow({"point", "normal"});
  const Plane plane{place.at("point").vector(dimension), place.at("normal").vector(dimension)};
  if (!(length(plane.normal) > 1e-9)) place.at("normal").fail("has no length, expected a direction");
  return plane;
}

std::filesystem::path read_path(const JsonPlace& place) {
  const std::string& text = place.text();
  if (text.empty() || text.find('\0') != std::string::npos) place.expected("the path of a file");
  return text;
}

// Errors in a file that the scene names say where the scene names it.
template <class Load>
void naming(const JsonPlace& place, Load&& load) {
  try {
    load();
  } catch (const InputError& error) {
    throw InputError(place.place() + ": " + error.what());
  }
}

// The bound of every number of a scene: sampling counts in spacings, which has to fit.
void require_near(const TriangleMesh& mesh, const std::string& place) {
  for (const Vec3d& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(vertex[axis]) <= largest_length) continue;
      throw InputError(place + ": has a vertex at " + std::string(1, "xyz"[axis]) + " = " + plain_number(vertex[axis]) +
                       " m in the scene, expected coordinates from -1000000 to 1000000");
    }
  }
}

Mesh read_mesh(const JsonPlace& place, int dimension) {
  if (dimension == 2) place.fail("is a mesh, which a scene of 2 dimensions cannot hold, expected another shape");
  place.allow({"file", "scale", "translation", "rotation"});
  Mesh mesh;
  mesh.file = read_path(place.at("file"));
  if (const auto scale = place.find("scale")) mesh.scale = scale->positive(largest_length);
  if (const auto translation = place.find("translation")) mesh.translation = translation->vector(3);
  if (const auto rotation = place.find("rotation")) mesh.rotation = rotation->vector(3);
  naming(place, [&] {
    const auto file = place.file().parent_path() / mesh.file;
    TriangleMesh loaded = load_mesh(file);
    require_closed(loaded, file.string());
    mesh.mesh = std::make_shared<const TriangleMesh>(
        transformed(std::move(loaded), mesh.scale, mesh.rotation, mesh.translation));
    require_near(*mesh.mesh, file.string());
  });
  return mesh;
}

Heightfield read_heightfield(const JsonPlace& place, int dimension) {
  place.allow({"file", "formula", "min", "max"});
  const auto file = place.find("file"), formula = place.find("formula");
  if (file.has_value() == formula.has_value()) {
    place.fail(std::string("has ") + (file ? "both \"file\" and" : "neither \"file\" nor") +
               " \"formula\", expected one of them");
  }
  Heightfield field;
  const Box box = read_corners(place, dimension);
  field.min = box.min;
  field.max = box.max;
  if (file) field.file = read_path(*file);
  if (formula) field.formula = formula->text();
  const std::filesystem::path folder = place.file().parent_path();
  if (formula) {
    load_heights(field, folder, dimension, formula->place());
  } else {
    naming(place, [&] { load_heights(field, folder, dimension, ""); });
  }
  return field;
}

}  // namespace

Box read_corners(const JsonPlace& place, int dimension) {
  const Box box{place.at("min").vector(dimension), place.at("max").vector(dimension)};
  for (int axis = 0; axis < dimension; ++axis) {
    if (box.min[axis] < box.max[axis]) continue;
    place.fail("has its min at " + std::string(1, "xyz"[axis]) + " = " + plain_number(box.min[axis]) +
               " and its max at " + plain_number(box.max[axis]) + ", expected min below max");
  }
  return box;
}

Box read_box(const JsonPlace& place, int dimension) {
  place.allow({"min", "max"});
  return read_corners(place, dimension);
}

Shape read_shape(const JsonPlace& place, std::initializer_list<std::string_view> others, int dimension) {
  std::vector<std::string_view> keys(shape_keys.begin(), shape_keys.end());
  keys.insert(keys.end(), others.begin(), others.end());
  place.allow(keys);
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < shape_keys.size(); ++k) {
    if (place.find(shape_keys[k])) found.push_back(k);
  }
  if (found.size() != 1) {
    place.fail("has " + (found.empty() ? "no shape" : std::to_string(found.size()) + " shapes") + ", expected one of " +
               joined_names(shape_keys, "or"));
  }
  const JsonPlace shape = place.at(shape_keys[found[0]]);
  switch (found[0]) {
    case 0:
      return read_box(shape, dimension);
    case 1:
      return read_sphere(shape, dimension);
    case 2:
      return read_cylinder(shape, dimension);
    case 3:
      return read_plane(shape, dimension);
    case 4:
      return read_mesh(shape, dimension);
    default:
      return read_heightfield(shape, dimension);
  }
}

}  // namespace curlew
