// Questions to shapes: where are they, is a point inside, how far is their surface, what do they look like?
// Lengths in metres. In 2D a sphere is a disc, a cylinder the strip of points nearer than its radius to the line
// between its ends, and z is not looked at; meshes exist in 3D only.
#pragma once

#include <optional>
#include <string_view>

#include "sim/scene/mesh_index.h"
#include "sim/scene/scene.h"

namespace curlew {

// "box", "sphere", ..., as in scene files.
std::string_view shape_name(const Shape&);

// For a mesh this builds an index every time: ask many points through a ShapeProbe.
bool inside(const Shape&, Vec3d p, int dimension);

// A shape made ready for many questions.
class ShapeProbe {
 public:
  // The shape must outlive the probe.
  ShapeProbe(const Shape& shape, int dimension);
  ShapeProbe(const Shape&& temporary, int dimension) = delete;

  bool inside(Vec3d p) const;

  // Signed distance to the surface, negative inside. Exact for box, sphere, cylinder and plane; for a mesh exact where
  // it is below `limit` in size; for a heightfield to first order in its slope.
  double distance(Vec3d p, double limit) const;

 private:
  const Shape* shape_;
  int dimension_;
  std::optional<MeshIndex> index_;
};

// The smallest box around the part of the shape that lies in the domain (for a plane: the domain). Its max may lie
// below its min: then nothing does.
Box bounds(const Shape&, int dimension, const Domain&);

// The domain as a body sees it: in the coordinates in which its shape is written, all places where the domain ever is.
// That is the domain itself for a body at rest.
Domain domain_around(const Body&, const Domain&);

// Volume (m^3, in 2D area in m^2) of the part inside the domain: exact for boxes, and for spheres, cylinders and meshes
// that lie wholly inside; else to about 1 % from a lattice of points.
double volume(const Shape&, int dimension, const Domain&);

// Area (m^2, in 2D length in m) of the whole surface; for a plane the most that can lie in the domain.
double surface_area(const Shape&, int dimension, const Domain&);

// A closed mesh with outward normals, for drawing: round shapes in 64 segments, planes cut to the domain. In 2D the
// outline, pulled out in z by 0.5 % of the domain's longer side to either side.
TriangleMesh surface_mesh(const Shape&, int dimension, const Domain&);

}  // namespace curlew
