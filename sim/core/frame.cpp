#include "sim/core/frame.h"

#include <cmath>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/core/parallel.h"
#include "sim/core/world.h"
#include "sim/scene/shapes.h"
#include "sim/surface/surface.h"
#include "sim/turbulence/micropolar_bender2018.h"
#include "sim/turbulence/sub_particles_fujisawa2011.h"

namespace curlew {
namespace {

using enum FieldId;

struct ColourSource {
  ColourField field;
  FieldSet reads;
  float (*value)(const World&, std::size_t);
  std::string_view key = {};  // of the model that fills the field, where one does
  bool (*on)(const Parameters&) = nullptr;
};

// In 2D a rotation has a sign.
float rotation(const World& w, const Array<Vec3>& field, std::size_t i) {
  return w.scene.dimension == 2 ? field[i].z : length(field[i]);
}

// The same of a field that does not exist while its model is off.
float rotation_if_any(const World& w, const Array<Vec3>& field, std::size_t i) {
  return field.empty() ? 0.0f : rotation(w, field, i);
}

constexpr ColourSource sources[] = {
    {{"none", "", "", "One colour for all water."}, {}, nullptr},
    {{"speed", "speed", "m/s", "Length of the velocity."},
     {velocity},
     [](const World& w, std::size_t i) { return length(w.fields.velocity[i]); }},
    {{"height", "height", "m", "Above the lowest point of the domain."},
     {position},
     [](const World& w, std::size_t i) { return w.fields.position[i].y - static_cast<float>(w.scene.domain.min.y); }},
    {{"pressure", "pressure", "Pa", "Sum of both pressure solves."},
     {pressure},
     [](const World& w, std::size_t i) { return w.fields.pressure[i]; }},
    {{"density", "density", "kg/m^3", "SPH sum over fluid and boundary."},
     {density},
     [](const World& w, std::size_t i) { return w.fields.density[i]; }},
    {{"vorticity", "vorticity", "1/s", "Curl of the velocity (Liu et al. 2020, Eq. 6)."},
     {vorticity},
     [](const World& w, std::size_t i) { return rotation(w, w.fields.vorticity, i); }},
    {{"microrotation", "microrotation", "1/s", "Spin of the particles (Bender et al. 2018)."},
     {microrotation},
     [](const World& w, std::size_t i) { return rotation_if_any(w, w.fields.microrotation, i); },
     "micropolar.nu_t",
     [](const Parameters& p) { return transfer_coefficient(p) != 0; }},
    {{"lost_vorticity", "dissipated vorticity", "1/s", "Vorticity that the last step lost (Liu et al. 2020, Eq. 12)."},
     {lost_vorticity},
     [](const World& w, std::size_t i) { return rotation_if_any(w, w.fields.lost_vorticity, i); },
     "vorticity_refinement.alpha",
     [](const Parameters& p) { return p.vorticity_refinement.alpha > 0; }},
    {{"wavelet_energy", "wavelet energy", "m^2/s^2",
      "Energy of the velocity at the scale of the particles (Fujisawa et al. 2011)."},
     {wavelet_energy},
     [](const World& w, std::size_t i) { return w.fields.wavelet_energy[i]; }},
    {{"sub_particle_level", "sub-particle level", "1", "Levels into which particles are split (Fujisawa et al. 2011)."},
     {sub_particles},
     [](const World& w, std::size_t i) { return w.fields.sub_particles.empty() ? 0.0f : w.fields.sub_particles[i].w; },
     "sub_particles.levels",
     [](const Parameters& p) { return p.sub_particles.levels > 0; }},
    {{"neighbours", "neighbours", "1", "Fluid neighbours, boundary samples and what the walls stand for."},
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

bool keeps(const Cut& cut, Vec3 position) { return (position[cut.axis] > static_cast<float>(cut.at)) == cut.keep_high; }

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

std::string_view colour_switch(std::string_view name, const Parameters& parameters) {
  const ColourSource& source = source_of(name);
  return source.on == nullptr || source.on(parameters) ? std::string_view{} : source.key;
}

std::shared_ptr<const FrameGeometry> make_geometry(const Scene& scene) {
  auto geometry = std::make_shared<FrameGeometry>();
  geometry->dimension = scene.dimension;
  geometry->particle_radius = scene.particle_radius;
  geometry->domain = scene.domain;
  for (const Body& body : scene.bodies) {
    geometry->bodies.push_back(
        {body.name, surface_mesh(body.shape, scene.dimension, domain_around(body, scene.domain))});
  }
  return geometry;
}

namespace {

// Sub-particles take the place of their particles, with their colours.
void show_sub_particles(Frame& frame, const World& world) {
  const Fields& f = world.fields;
  SplitParticles split = split_particles({f.position, f.id, f.sub_particles, world.time, world.scene.particle_radius});
  frame.position = std::move(split.position);
  frame.size = std::move(split.share);
  if (frame.value.empty()) return;
  std::vector<float> value;
  value.reserve(split.parent.size());
  for (const std::uint32_t i : split.parent) value.push_back(frame.value[i]);
  frame.value = std::move(value);
}

}  // namespace

Frame make_frame(const World& world, std::string_view colour_name, std::shared_ptr<const FrameGeometry> geometry) {
  const ColourSource& source = source_of(colour_name);
  Frame frame;
  frame.time = world.time;
  frame.step = world.step;
  frame.position.assign(world.fields.position.begin(), world.fields.position.end());
  frame.colour = source.field;
  frame.geometry = std::move(geometry);
  for (const BodyPlace& place : body_places(world.scene.bodies, world.time)) frame.body_offset.push_back(place.offset);
  if (source.value != nullptr) {
    frame.value.resize(world.count);
    parallel_for(world.count, [&](std::size_t i) { frame.value[i] = source.value(world, i); });
  }
  if (!world.fields.sub_particles.empty()) show_sub_particles(frame, world);
  return frame;
}

FieldSet surface_demand() { return {position, density}; }

std::shared_ptr<const SurfaceMesh> make_surface(const World& world, SurfaceMaker& maker,
                                                const std::optional<Cut>& cut) {
  const Fields& f = world.fields;
  const auto made = [&](const SurfaceParticles& particles, const Scene& scene) {
    return std::make_shared<const SurfaceMesh>(maker.make(particles, scene));
  };
  if (!cut) return made({f.position, f.density, {}, f.sub_particles, f.id, world.time}, world.scene);
  std::vector<std::uint32_t> left;
  for (std::uint32_t i = 0; i < world.count; ++i) {
    if (keeps(*cut, f.position[i])) left.push_back(i);
  }
  const auto of_left = [&](const auto& field) {
    std::vector<std::remove_cvref_t<decltype(field[0])>> values;
    if (!field.empty()) {
      for (const std::uint32_t i : left) values.push_back(field[i]);
    }
    return values;
  };
  // The cut is as flat as a wall.
  Scene scene = world.scene;
  (cut->keep_high ? scene.domain.min : scene.domain.max)[cut->axis] = cut->at;
  scene.domain.periodic[static_cast<std::size_t>(cut->axis)] = false;
  scene.domain.walls[static_cast<std::size_t>(2 * cut->axis + (cut->keep_high ? 0 : 1))].kind = WallKind::slip;
  const auto position = of_left(f.position), parts = of_left(f.sub_particles);
  const auto density = of_left(f.density);
  const auto id = of_left(f.id);
  return made({position, density, {}, parts, id, world.time}, scene);
}

Frame cut_open(const Frame& frame, const Cut& cut) {
  Frame rest{frame.time, frame.step, {}, {}, {}, frame.colour, frame.geometry, frame.body_offset, nullptr};
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    if (!keeps(cut, frame.position[i])) continue;
    rest.position.push_back(frame.position[i]);
    if (!frame.size.empty()) rest.size.push_back(frame.size[i]);
    if (!frame.value.empty()) rest.value.push_back(frame.value[i]);
  }
  return rest;
}

namespace {

bool shows_surface(const Look& look, int dimension) { return look.style == LookStyle::water && dimension == 3; }

}  // namespace

std::string shown_colour(const Look& look, int dimension) {
  return look.style == LookStyle::particles || dimension == 2 ? look.colour_by : "none";
}

FieldSet shown_demand(const Look& look, int dimension) {
  const FieldSet colour = colour_demand(shown_colour(look, dimension));
  return shows_surface(look, dimension) ? colour | surface_demand() : colour;
}

Frame make_shown_frame(const World& world, const Look& look, std::shared_ptr<const FrameGeometry> geometry,
                       SurfaceMaker& maker) {
  const int dimension = world.scene.dimension;
  Frame frame = make_frame(world, shown_colour(look, dimension), std::move(geometry));
  if (look.cut) frame = cut_open(frame, *look.cut);
  if (shows_surface(look, dimension)) frame.surface = make_surface(world, maker, look.cut);
  return frame;
}

}  // namespace curlew
