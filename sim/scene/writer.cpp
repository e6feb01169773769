// The resolved scene as JSON.
#include "sim/scene/json.h"
#include "sim/scene/names.h"
#include "sim/scene/reader.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

JsonNode vector_node(Vec3d value, int count) {
  JsonNode node = JsonNode::array();
  for (int axis = 0; axis < count; ++axis) node.add(JsonNode::of(value[axis]));
  return node;
}

JsonNode name_node(std::span<const std::string_view> names, std::size_t index) {
  return JsonNode::of(std::string(names[index]));
}

// Absolute, so that a checkpoint resumes from any folder.
JsonNode path_node(const std::filesystem::path& file, const Scene& scene) {
  return JsonNode::of(std::filesystem::absolute(scene.file.parent_path() / file).lexically_normal().string());
}

struct ShapeWriter {
  const Scene& scene;
  JsonNode node = JsonNode::object();

  JsonNode vector(Vec3d value) const { return vector_node(value, scene.dimension); }

  void operator()(const Box& b) { node.add("min", vector(b.min)).add("max", vector(b.max)); }
  void operator()(const Sphere& s) { node.add("centre", vector(s.centre)).add("radius", JsonNode::of(s.radius)); }
  void operator()(const Cylinder& c) {
    node.add("from", vector(c.from)).add("to", vector(c.to)).add("radius", JsonNode::of(c.radius));
  }
  void operator()(const Plane& p) { node.add("point", vector(p.point)).add("normal", vector(p.normal)); }
  void operator()(const Mesh& m) {
    node.add("file", path_node(m.file, scene)).add("scale", JsonNode::of(m.scale));
    node.add("translation", vector(m.translation)).add("rotation", vector(m.rotation));
  }
  void operator()(const Heightfield& h) {
    if (h.file.empty()) {
      node.add("formula", JsonNode::of(h.formula));
    } else {
      node.add("file", path_node(h.file, scene));
    }
    node.add("min", vector(h.min)).add("max", vector(h.max));
  }
};

JsonNode shape_node(const Shape& shape, const Scene& scene) {
  ShapeWriter writer{scene};
  std::visit(writer, shape);
  return std::move(writer.node);
}

JsonNode walls_node(const Scene& scene) {
  JsonNode node = JsonNode::object();
  const auto names = wall_names(scene.dimension);
  for (std::size_t face = 0; face < names.size(); ++face) {
    if (scene.domain.periodic[face / 2]) continue;
    const Wall& wall = scene.domain.walls[face];
    JsonNode value = name_node(wall_kind_names(), static_cast<std::size_t>(wall.kind));
    if (wall.velocity != Vec3d{}) {
      JsonNode moving = JsonNode::object();
      moving.add("kind", std::move(value)).add("velocity", vector_node(wall.velocity, scene.dimension));
      value = std::move(moving);
    }
    node.add(std::string(names[face]), std::move(value));
  }
  return node;
}

JsonNode domain_node(const Scene& scene) {
  JsonNode node = JsonNode::object(), periodic = JsonNode::array();
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene.dimension); ++axis) {
    periodic.add(JsonNode::of(scene.domain.periodic[axis]));
  }
  node.add("min", vector_node(scene.domain.min, scene.dimension))
      .add("max", vector_node(scene.domain.max, scene.dimension));
  return node.add("periodic", std::move(periodic)).add("walls", walls_node(scene));
}

JsonNode velocity_node(const InitialVelocity& velocity, const Scene& scene) {
  using Field = InitialVelocity::Field;
  if (velocity.field == Field::constant) return vector_node(velocity.value, scene.dimension);
  JsonNode node = JsonNode::object();
  node.add("field", name_node(velocity_field_names(), static_cast<std::size_t>(velocity.field)));
  if (velocity.field == Field::taylor_green || velocity.field == Field::shear_wave) {
    return node.add("speed", JsonNode::of(velocity.speed));
  }
  node.add("centre", vector_node(velocity.centre, scene.dimension));
  if (velocity.field == Field::rotation) {
    return node.add("rate", scene.dimension == 3 ? vector_node(velocity.rate, 3) : JsonNode::of(velocity.rate.z));
  }
  node.add("radius", JsonNode::of(velocity.radius));
  return velocity.field == Field::gresho_chan ? node.add("speed", JsonNode::of(velocity.speed))
                                              : node.add("circulation", JsonNode::of(velocity.circulation));
}

JsonNode fluid_node(const Scene& scene) {
  JsonNode node = JsonNode::array();
  for (const Fluid& fluid : scene.fluid) {
    JsonNode item = JsonNode::object();
    item.add(std::string(shape_name(fluid.shape)), shape_node(fluid.shape, scene));
    item.add("velocity", velocity_node(fluid.velocity, scene));
    if (fluid.jitter > 0) item.add("jitter", JsonNode::of(fluid.jitter));
    node.add(std::move(item));
  }
  return node;
}

JsonNode motion_node(const KeyframePath& motion, const Scene& scene) {
  JsonNode node = JsonNode::array();
  for (const Keyframe& keyframe : motion.keyframes()) {
    JsonNode item = JsonNode::object();
    item.add("time", JsonNode::of(keyframe.time)).add("at", vector_node(keyframe.at, scene.dimension));
    node.add(std::move(item));
  }
  return node;
}

JsonNode bodies_node(const Scene& scene) {
  JsonNode node = JsonNode::array();
  for (const Body& body : scene.bodies) {
    JsonNode item = JsonNode::object();
    item.add("name", JsonNode::of(body.name)).add(std::string(shape_name(body.shape)), shape_node(body.shape, scene));
    item.add("wall", name_node(wall_kind_names(), static_cast<std::size_t>(body.kind)));
    if (!body.motion.keyframes().empty()) item.add("motion", motion_node(body.motion, scene));
    node.add(std::move(item));
  }
  return node;
}

// Water heights are written without the vertical axis, along which they are measured.
JsonNode point_node(const Probe& probe, Vec3d point, const Scene& scene) {
  const int left_out = probe.quantity == Probe::Quantity::water_height ? scene.vertical_axis() : -1;
  JsonNode node = JsonNode::array();
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (axis != left_out) node.add(JsonNode::of(point[axis]));
  }
  return node;
}

JsonNode probes_node(const Scene& scene) {
  JsonNode node = JsonNode::array();
  for (const Probe& probe : scene.probes) {
    JsonNode item = JsonNode::object(), place = JsonNode::object();
    if (probe.points > 1) {
      place.add("from", point_node(probe, probe.from, scene)).add("to", point_node(probe, probe.to, scene));
      place.add("points", JsonNode::of(static_cast<double>(probe.points)));
    } else {
      place.add("at", point_node(probe, probe.from, scene));
    }
    item.add("name", JsonNode::of(probe.name));
    item.add(std::string(probe_quantity_names()[static_cast<std::size_t>(probe.quantity)]), std::move(place));
    if (probe.every > 0) item.add("every", JsonNode::of(probe.every));
    node.add(std::move(item));
  }
  return node;
}

JsonNode parameters_node(const Parameters& parameters) {
  using Type = ParameterRow::Type;
  JsonNode node = JsonNode::object();
  for (const ParameterRow& row : parameter_table()) {
    const double value = row.get(parameters);
    node.add(row.key, row.type == Type::flag     ? JsonNode::of(value != 0)
                      : row.type == Type::choice ? JsonNode::of(parameter_text(row, value))
                                                 : JsonNode::of(value));
  }
  return node;
}

JsonNode camera_node(const Camera& camera) {
  JsonNode node = JsonNode::object();
  if (camera.position) node.add("position", vector_node(*camera.position, 3));
  if (camera.target) node.add("target", vector_node(*camera.target, 3));
  return node.add("field_of_view", JsonNode::of(camera.field_of_view));
}

JsonNode look_node(const Look& look) {
  JsonNode node = JsonNode::object();
  const auto style = look_style_names()[static_cast<std::size_t>(look.style)];
  node.add("style", JsonNode::of(std::string(style)));
  node.add("colour_by", JsonNode::of(look.colour_by)).add("colour_map", JsonNode::of(look.colour_map));
  if (look.range) node.add("range", vector_node({(*look.range)[0], (*look.range)[1], 0}, 2));
  if (look.cut) {
    JsonNode cut = JsonNode::object();
    cut.add("axis", JsonNode::of(std::string(1, "xyz"[look.cut->axis]))).add("at", JsonNode::of(look.cut->at));
    node.add("cut", std::move(cut.add("keep", JsonNode::of(std::string(look.cut->keep_high ? "high" : "low")))));
  }
  node.add("background", JsonNode::of(look.background)).add("show_walls", JsonNode::of(look.show_walls));
  return node.add("show_legend", JsonNode::of(look.show_legend)).add("show_floor", JsonNode::of(look.show_floor));
}

}  // namespace

std::string scene_json(const Scene& scene) {
  JsonNode node = JsonNode::object();
  node.add("curlew", JsonNode::of(1.0)).add("name", JsonNode::of(scene.name)).add("about", JsonNode::of(scene.about));
  node.add("dimension", JsonNode::of(static_cast<double>(scene.dimension)));
  node.add("particle_radius", JsonNode::of(scene.particle_radius));
  node.add("gravity", vector_node(scene.gravity, scene.dimension));
  node.add("domain", domain_node(scene)).add("fluid", fluid_node(scene)).add("bodies", bodies_node(scene));
  if (!scene.probes.empty()) node.add("probes", probes_node(scene));
  node.add("parameters", parameters_node(scene.parameters));
  return json_text(node.add("camera", camera_node(scene.camera)).add("look", look_node(scene.look)));
}

}  // namespace curlew
