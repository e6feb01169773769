#include "sim/scene/reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "sim/core/error.h"
#include "sim/core/frame.h"
#include "sim/core/nearest_name.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json_place.h"
#include "sim/scene/names.h"
#include "sim/scene/read_probes.h"
#include "sim/scene/read_shapes.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

constexpr double largest = 1e6;

Wall read_wall(const JsonPlace& place, int axis, int dimension) {
  Wall wall;
  const bool bare = place.node().type == JsonNode::Type::text;
  if (!bare) place.allow({"kind", "velocity"});
  wall.kind = static_cast<WallKind>((bare ? place : place.at("kind")).one_of(wall_kind_names()));
  if (const auto velocity = place.find("velocity")) {
    if (wall.kind != WallKind::no_slip)
      velocity->fail("stands at a wall that does not drag, expected \"kind\": \"no-slip\"");
    wall.velocity = velocity->vector(dimension);
    if (wall.velocity[axis] != 0)
      velocity->fail("points through the wall, expected " + std::string(1, "xyz"[axis]) + " = 0");
  }
  return wall;
}

void read_walls(const JsonPlace& place, int dimension, Domain& domain) {
  const auto names = wall_names(dimension);
  place.allow(names);
  for (std::size_t face = 0; face < names.size(); ++face) {
    const auto wall = place.find(names[face]);
    if (!wall) continue;
    if (domain.periodic[face / 2]) wall->fail("is a face of a periodic axis, expected no wall there");
    domain.walls[face] = read_wall(*wall, static_cast<int>(face / 2), dimension);
  }
}

Domain read_domain(const JsonPlace& place, int dimension) {
  place.allow({"min", "max", "periodic", "walls"});
  Domain domain;
  const Box box = read_corners(place, dimension);
  domain.min = box.min;
  domain.max = box.max;
  if (const auto periodic = place.find("periodic")) {
    const std::string what = "an array of " + std::to_string(dimension) + " times true or false";
    const auto axes = periodic->array(what);
    if (axes.size() != static_cast<std::size_t>(dimension)) periodic->expected(what);
    for (std::size_t axis = 0; axis < axes.size(); ++axis) domain.periodic[axis] = axes[axis].flag();
  }
  if (const auto walls = place.find("walls")) read_walls(*walls, dimension, domain);
  return domain;
}

void read_rate(const JsonPlace& place, int dimension, Vec3d& rate) {
  if (dimension == 3) {
    rate = place.vector(3);
  } else {
    rate.z = place.number(-largest, largest);
  }
}

InitialVelocity read_velocity(const JsonPlace& place, int dimension) {
  InitialVelocity velocity;
  if (place.node().type == JsonNode::Type::array) {
    velocity.value = place.vector(dimension);
    return velocity;
  }
  if (place.node().type != JsonNode::Type::object) {
    place.expected("an array of " + std::to_string(dimension) + " numbers or an object with the key \"field\"");
  }
  using Field = InitialVelocity::Field;
  velocity.field = static_cast<Field>(place.at("field").one_of(velocity_field_names().subspan(1)) + 1);
  switch (velocity.field) {
    case Field::constant:
    case Field::taylor_green:
    case Field::shear_wave:
      place.allow({"field", "speed"});
      break;
    case Field::rotation:
      place.allow({"field", "centre", "rate"});
      read_rate(place.at("rate"), dimension, velocity.rate);
      break;
    case Field::gresho_chan:
      place.allow({"field", "centre", "radius", "speed"});
      velocity.radius = 0.2;  // of the paper
      break;
    case Field::lamb_oseen:
      place.allow({"field", "centre", "radius", "circulation"});
      velocity.radius = place.at("radius").positive(largest);
      velocity.circulation = place.at("circulation").number(-largest, largest);
      break;
  }
  if (const auto speed = place.find("speed")) velocity.speed = speed->number(-largest, largest);
  if (const auto radius = place.find("radius")) velocity.radius = radius->positive(largest);
  const bool across = velocity.field == Field::taylor_green || velocity.field == Field::shear_wave;
  if (!across) velocity.centre = place.at("centre").vector(dimension);
  return velocity;
}

std::vector<Fluid> read_fluid(const JsonPlace& place, int dimension) {
  std::vector<Fluid> fluids;
  const std::string what = "an array of at least one shape";
  for (const JsonPlace& item : place.array(what)) {
    Fluid fluid{read_shape(item, {"velocity", "jitter"}, dimension), {}};
    if (const auto velocity = item.find("velocity")) fluid.velocity = read_velocity(*velocity, dimension);
    if (const auto jitter = item.find("jitter")) fluid.jitter = jitter->number(0, 0.3);
    fluids.push_back(std::move(fluid));
  }
  if (fluids.empty()) place.expected(what);
  return fluids;
}

KeyframePath read_motion(const JsonPlace& place, int dimension) {
  const std::string what = "an array of at least one keyframe";
  std::vector<Keyframe> keyframes;
  for (const JsonPlace& item : place.array(what)) {
    item.allow({"time", "at"});
    const Keyframe keyframe{item.at("time").number(-largest, largest), item.at("at").vector(dimension)};
    if (!keyframes.empty() && !(keyframe.time > keyframes.back().time)) {
      item.at("time").expected("a time after the " + plain_number(keyframes.back().time) +
                               " s of the keyframe before it");
    }
    keyframes.push_back(keyframe);
  }
  if (keyframes.empty()) place.expected(what);
  return KeyframePath(std::move(keyframes));
}

// Bodies are not wrapped around periodic axes, so what moves along one has to stay between its faces.
void check_periodic_motion(const JsonPlace& place, const Body& body, const Scene& scene) {
  const Vec3d least = body.motion.least(), most = body.motion.most();
  constexpr double far = 1e9;
  const Domain everywhere{{-far, -far, -far}, {far, far, far}, {}, {}};
  const Box box = bounds(body.shape, scene.dimension, everywhere);
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (!scene.domain.periodic[static_cast<std::size_t>(axis)] || least[axis] == most[axis]) continue;
    if (box.min[axis] + least[axis] > scene.domain.min[axis] && box.max[axis] + most[axis] < scene.domain.max[axis])
      continue;
    place.fail("moves the body through a face of the periodic axis " + std::string(1, "xyz"[axis]) +
               ", expected a path that stays between them");
  }
}

std::vector<Body> read_bodies(const JsonPlace& place, const Scene& scene) {
  std::vector<Body> bodies;
  std::set<std::string> names;
  for (const JsonPlace& item : place.array("an array of bodies")) {
    Body body{
        "body " + std::to_string(bodies.size() + 1), read_shape(item, {"name", "wall", "motion"}, scene.dimension), {}};
    const auto name = item.find("name"), wall = item.find("wall");
    if (name) body.name = name->text();
    if (!names.insert(body.name).second) {
      item.fail("has the name " + in_quotes(body.name) + " of a body before it, expected a name of its own");
    }
    if (wall) body.kind = static_cast<WallKind>(wall->one_of(wall_kind_names().first(2)));
    if (const auto motion = item.find("motion")) {
      body.motion = read_motion(*motion, scene.dimension);
      check_periodic_motion(*motion, body, scene);
    }
    const Box box = bounds(body.shape, scene.dimension, domain_around(body, scene.domain));
    for (int axis = 0; axis < scene.dimension; ++axis) {
      if (box.max[axis] < box.min[axis]) item.fail("lies outside the domain, expected a body that reaches into it");
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

void read_parameter(const JsonPlace& place, const ParameterRow& row, Parameters& parameters) {
  using Type = ParameterRow::Type;
  const auto type = place.node().type;
  if (row.type == Type::flag) return row.set(parameters, place.flag() ? 1 : 0);
  if (row.type == Type::choice) {
    const std::vector<std::string_view> names(row.names.begin(), row.names.end());
    return row.set(parameters, static_cast<double>(place.one_of(names)));
  }
  const double value = place.node().number;
  const bool fits = type == JsonNode::Type::number && value >= row.min && value <= row.max;
  if (!fits || (row.type == Type::count && value != std::floor(value))) {
    place.expected(std::string(row.type == Type::count ? "a whole number" : "a number") + " from " +
                   plain_number(row.min) + " to " + plain_number(row.max) + (row.unit == "1" ? "" : " " + row.unit));
  }
  row.set(parameters, value);
}

Parameters read_parameters(const JsonPlace& place) {
  std::vector<std::string_view> keys;
  for (const ParameterRow& row : parameter_table()) keys.push_back(row.key);
  if (place.node().type != JsonNode::Type::object) place.expected("an object of parameters");
  for (std::size_t i = 0; i < place.node().keys.size(); ++i) {
    const std::string& key = place.node().keys[i];
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const std::string near = nearest_name(key, keys);
    place.fail(
        "has the unknown key " + in_quotes(key) +
        (near.empty() ? ", expected a parameter that `curlew params` lists" : "; did you mean \"" + near + "\"?"));
  }
  Parameters parameters;
  for (const ParameterRow& row : parameter_table()) {
    if (const auto value = place.find(row.key)) read_parameter(*value, row, parameters);
  }
  return parameters;
}

Camera read_camera(const JsonPlace& place) {
  place.allow({"position", "target", "field_of_view"});
  Camera camera;
  if (const auto position = place.find("position")) camera.position = position->vector(3);
  if (const auto target = place.find("target")) camera.target = target->vector(3);
  if (const auto angle = place.find("field_of_view")) camera.field_of_view = angle->number(1, 150);
  if (camera.position && camera.position == camera.target) {
    place.fail("has its position and its target at one place, expected two places");
  }
  return camera;
}

std::string read_name(const JsonPlace& place, std::span<const std::string_view> names) {
  return std::string(names[place.one_of(names)]);
}

Cut read_cut(const JsonPlace& place, int dimension) {
  place.allow({"axis", "at", "keep"});
  static constexpr std::string_view axes[] = {"x", "y", "z"}, sides[] = {"low", "high"};
  Cut cut;
  cut.axis = static_cast<int>(place.at("axis").one_of(std::span(axes).first(static_cast<std::size_t>(dimension))));
  cut.at = place.at("at").number(-1e6, 1e6);
  if (const auto keep = place.find("keep")) cut.keep_high = keep->one_of(sides) == 1;
  return cut;
}

Look read_look(const JsonPlace& place, int dimension) {
  place.allow(
      {"style", "colour_by", "colour_map", "range", "cut", "background", "show_walls", "show_legend", "show_floor"});
  Look look;
  std::vector<std::string_view> fields;
  for (const ColourField& field : colour_fields()) fields.push_back(field.name);
  static constexpr std::string_view backgrounds[] = {"light", "dark"};
  if (const auto style = place.find("style")) {
    const auto names = look_style_names();
    const std::string name = read_name(*style, names);
    look.style = static_cast<LookStyle>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  if (const auto field = place.find("colour_by")) look.colour_by = read_name(*field, fields);
  if (const auto map = place.find("colour_map")) look.colour_map = read_name(*map, colour_map_names());
  if (const auto background = place.find("background")) look.background = read_name(*background, backgrounds);
  if (const auto range = place.find("range")) {
    const Vec3d ends = range->vector(2);
    if (ends.x >= ends.y)
      range->fail("begins at " + plain_number(ends.x) + " and ends at " + plain_number(ends.y) +
                  ", expected an end above the beginning");
    look.range = {ends.x, ends.y};
  }
  if (const auto cut = place.find("cut")) look.cut = read_cut(*cut, dimension);
  for (const auto& [key, flag] :
       {std::pair{"show_walls", &Look::show_walls}, std::pair{"show_legend", &Look::show_legend},
        std::pair{"show_floor", &Look::show_floor}}) {
    if (const auto value = place.find(key)) look.*flag = value->flag();
  }
  return look;
}

// Keys of the format that no version reads yet get a sentence of their own: the scene is right, the program too young.
void check_keys(const JsonPlace& root) {
  constexpr std::string_view later[] = {"emitters", "sinks", "keyframes"};
  for (const std::string_view key : later) {
    if (const auto place = root.find(key)) place->fail("is not read by this version, expected a scene without it");
  }
  root.allow({"curlew", "name", "about", "dimension", "particle_radius", "gravity", "domain", "fluid", "bodies",
              "probes", "parameters", "camera", "look"});
  const JsonPlace version = root.at("curlew");
  if (version.node().type != JsonNode::Type::number || version.node().number != 1)
    version.expected("1, the format's version");
}

}  // namespace

Scene parse_scene(const std::string& text, const std::filesystem::path& file) {
  const JsonNode tree = parse_json(text, file);
  const JsonPlace root(tree, file);
  check_keys(root);
  Scene scene;
  scene.file = file;
  scene.name = file.stem().string();
  if (const auto name = root.find("name")) scene.name = name->text();
  if (const auto about = root.find("about")) scene.about = about->text();
  if (const auto dimension = root.find("dimension")) {
    const double value = dimension->node().number;
    if (dimension->node().type != JsonNode::Type::number || (value != 2 && value != 3)) dimension->expected("2 or 3");
    scene.dimension = static_cast<int>(value);
  }
  if (const auto radius = root.find("particle_radius")) {
    radius->positive(1000);
    scene.particle_radius = radius->number(1e-9, 1000);
  }
  if (const auto gravity = root.find("gravity")) scene.gravity = gravity->vector(scene.dimension);
  scene.domain = read_domain(root.at("domain"), scene.dimension);
  scene.fluid = read_fluid(root.at("fluid"), scene.dimension);
  if (const auto bodies = root.find("bodies")) scene.bodies = read_bodies(*bodies, scene);
  if (const auto probes = root.find("probes")) scene.probes = read_probes(*probes, scene);
  if (const auto parameters = root.find("parameters")) scene.parameters = read_parameters(*parameters);
  if (const auto camera = root.find("camera")) scene.camera = read_camera(*camera);
  if (const auto look = root.find("look")) scene.look = read_look(*look, scene.dimension);
  return scene;
}

Scene read_scene(const std::filesystem::path& file) {
  constexpr std::uintmax_t largest_file = 4U << 20U;
  return parse_scene(read_file(file, largest_file, "a scene file"), file);
}

}  // namespace curlew
