// A Frame is a read-only picture of the state at one moment: what renderers, exporters and windows see of a run.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/fields.h"
#include "sim/core/vec.h"
#include "sim/scene/scene.h"
#include "sim/surface/surface_mesh.h"

namespace curlew {

class SurfaceMaker;

// A scalar by which particles can be coloured.
struct ColourField {
  std::string_view name;      // "speed"
  std::string_view label;     // "speed"
  std::string_view unit;      // "m/s"
  std::string_view doc = {};  // one sentence
};

// All of them; a vector field is coloured by its length.
std::span<const ColourField> colour_fields();

// A body as it is drawn.
struct FrameBody {
  std::string name;
  TriangleMesh surface;  // in world coordinates, where the scene has the body
};

// What does not change while a run goes on.
struct FrameGeometry {
  int dimension = 3;
  double particle_radius = 0;
  Domain domain;
  std::vector<FrameBody> bodies;
};

struct Frame {
  double time = 0;  // s
  std::int64_t step = 0;
  std::vector<Vec3> position;  // m; of particles that have split, their sub-particles
  std::vector<float> size;     // radius over the particle radius, one a position; empty: 1
  std::vector<float> value;    // of the colour field, one a particle; empty for plain water colour
  ColourField colour;
  std::shared_ptr<const FrameGeometry> geometry;
  std::vector<Vec3d> body_offset;              // m, of the geometry's bodies at this moment; empty where none moves
  std::shared_ptr<const SurfaceMesh> surface;  // of the water, where it is shown as water
};

struct World;

// The fields that must be filled to colour by `name`; throws InputError for a name that is not in colour_fields().
FieldSet colour_demand(std::string_view name);

// The key of the parameter that switches on the model which fills the colour's field, where that is off; else empty.
// Frames then show 0.
std::string_view colour_switch(std::string_view name, const Parameters& parameters);

std::shared_ptr<const FrameGeometry> make_geometry(const Scene& scene);

// Copies what a frame shows out of the world.
Frame make_frame(const World& world, std::string_view colour_name, std::shared_ptr<const FrameGeometry> geometry);

// The surface of the water at this moment, without what the cut takes away. `maker` keeps its memory from frame to
// frame. Needs the fields of surface_demand().
FieldSet surface_demand();
std::shared_ptr<const SurfaceMesh> make_surface(const World& world, SurfaceMaker& maker,
                                                const std::optional<Cut>& cut = {});

// The frame without what the cut takes away; a surface is not cut, and goes.
Frame cut_open(const Frame& frame, const Cut& cut);

// What a look shows: particles with their colour, or clear water with its surface where the look is of one, without
// what its cut takes away. Needs the fields of shown_demand().
FieldSet shown_demand(const Look& look, int dimension);
Frame make_shown_frame(const World& world, const Look& look, std::shared_ptr<const FrameGeometry> geometry,
                       SurfaceMaker& maker);
// The field that colours it: "none" for clear water.
std::string shown_colour(const Look& look, int dimension);  // dimension: of the scene

}  // namespace curlew
