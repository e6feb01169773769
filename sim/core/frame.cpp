#include "sim/core/frame.h"

#include <cmath>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/core/parallel.h"
#include "sim/core/world.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

using enum FieldId;

struct ColourSource {
  ColourField field;
  FieldSet reads;
  float (*value)(const World&, std::size_t);
};

constexpr ColourSource sources[] = {
    {{"none", "", ""}, {}, nullptr},
    {{"speed", "speed", "m/s"}, {velocity}, [](const World& w, std::size_t i) { return length(w.fields.velocity[i]); }},
    {{"height", "height", "m"},
     {position},
     [](const World& w, std::size_t i) { return w.fields.position[i].y - static_cast<float>(w.scene.domain.min.y); }},
    {{"pressure", "pressure", "Pa"}, {pressure}, [](const World& w, std::size_t i) { return w.fields.pressure[i]; }},
    {{"density", "density", "kg/m^3"}, {density}, [](const World& w, std::size_t i) { return w.fields.density[i]; }},
    {{"vorticity", "vorticity", "1/s"},
     {vorticity},
     [](const World& w, std::size_t i) {
       // In 2D vorticity has a sign.
       return w.scene.dimension == 2 ? w.fields.vorticity[i].z : length(w.fields.vorticity[i]);
     }},
    {{"neighbours", "neighbours", "1"},
     {neighbour_number},
     [](const World& w, std::size_t i) { return w.fields.neighbour_number[i]; }},
};

const ColourSource& source_of(std::string_view name) {
  for (const ColourSource& source : sources) {
    if (source.field.name == name) return source;
  }
  std::vector<std::string_view> names;
  for (const ColourField& field : colour_fields()) names.push_back(field.name);
  const std::string near = nearest_name(std::string(name), names);
  throw InputError("there is no field \"" + std::string(name) + "\" to colour by" +
                   (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
}

}  // namespace

std::span<const ColourField> colour_fields() {
  static const std::vector<ColourField> fields = [] {
    std::vector<ColourField> all;
    for (const ColourSource& source : sources) all.push_back(source.field);
    return all;
  }();
  return fields;
}

FieldSet colour_demand(std::string_view name) { return source_of(name).reads; }

std::shared_ptr<const FrameGeometry> make_geometry(const Scene& scene) {
  auto geometry = std::make_shared<FrameGeometry>();
  geometry->dimension = scene.dimension;
  geometry->particle_radius = scene.particle_radius;
  geometry->domain = scene.domain;
  for (const Body& body : scene.bodies) {
    geometry->bodies.push_back({body.name, surface_mesh(body.shape, scene.dimension, scene.domain)});
  }
  return geometry;
}

Frame make_frame(const World& world, std::string_view colour_name, std::shared_ptr<const FrameGeometry> geometry) {
  const ColourSource& source = source_of(colour_name);
  Frame frame;
  frame.time = world.time;
  frame.step = world.step;
  frame.position.assign(world.fields.position.begin(), world.fields.position.end());
  frame.colour = source.field;
  frame.geometry = std::move(geometry);
  if (source.value == nullptr) return frame;
  frame.value.resize(world.count);
  parallel_for(world.count, [&](std::size_t i) { frame.value[i] = source.value(world, i); });
  return frame;
}

}  // namespace curlew
