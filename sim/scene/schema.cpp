#include "sim/scene/schema.h"

#include "sim/core/frame.h"
#include "sim/core/params.h"
#include "sim/scene/json.h"
#include "sim/scene/names.h"

namespace curlew {
namespace {

JsonNode text(const std::string& value) { return JsonNode::of(value); }
JsonNode number(double value) { return JsonNode::of(value); }

JsonNode with_doc(JsonNode node, const std::string& doc) { return std::move(node.add("description", text(doc))); }

JsonNode typed(const char* type, const std::string& doc = "") {
  JsonNode node = JsonNode::object();
  node.add("type", text(type));
  return doc.empty() ? node : with_doc(std::move(node), doc);
}

JsonNode number_node(const std::string& doc) { return typed("number", doc); }

JsonNode positive_node(const std::string& doc) {
  JsonNode node = typed("number");
  return with_doc(std::move(node.add("exclusiveMinimum", number(0))), doc);
}

JsonNode reference(const std::string& name, const std::string& doc = "") {
  JsonNode node = JsonNode::object();
  node.add("$ref", text("#/$defs/" + name));
  return doc.empty() ? node : with_doc(std::move(node), doc);
}

JsonNode one_of_names(std::span<const std::string_view> names, const std::string& doc = "") {
  JsonNode list = JsonNode::array();
  for (const std::string_view name : names) list.add(text(std::string(name)));
  JsonNode node = JsonNode::object();
  node.add("enum", std::move(list));
  return doc.empty() ? node : with_doc(std::move(node), doc);
}

JsonNode array_of(JsonNode items, double least, double most, const std::string& doc) {
  JsonNode node = typed("array");
  node.add("items", std::move(items)).add("minItems", number(least));
  if (most > 0) node.add("maxItems", number(most));
  return with_doc(std::move(node), doc);
}

struct Property {
  const char* name;
  JsonNode node;
  bool required = false;
};

JsonNode object_of(const std::string& doc, std::vector<Property> members) {
  JsonNode node = typed("object", doc), properties = JsonNode::object(), required = JsonNode::array();
  for (Property& member : members) {
    if (member.required) required.add(text(member.name));
    properties.add(member.name, std::move(member.node));
  }
  node.add("properties", std::move(properties));
  if (!required.items.empty()) node.add("required", std::move(required));
  return std::move(node.add("additionalProperties", JsonNode::of(false)));
}

JsonNode any_of(std::vector<JsonNode> choices, const char* keyword = "anyOf") {
  JsonNode list = JsonNode::array(), node = JsonNode::object();
  for (JsonNode& choice : choices) list.add(std::move(choice));
  return std::move(node.add(keyword, std::move(list)));
}

JsonNode vector3(const std::string& doc) { return array_of(typed("number"), 3, 3, doc); }

// An object with exactly one of some keys, and others.
JsonNode with_one_of(const std::string& doc, std::vector<Property> keys, std::vector<Property> others) {
  JsonNode list = JsonNode::array();
  for (Property& key : keys) {
    JsonNode required = JsonNode::array(), choice = JsonNode::object();
    required.add(text(key.name));
    list.add(std::move(choice.add("required", std::move(required))));
    others.push_back(std::move(key));
  }
  return std::move(object_of(doc, std::move(others)).add("oneOf", std::move(list)));
}

JsonNode with_shapes(const std::string& doc, std::vector<Property> others) {
  std::vector<Property> shapes;
  for (const char* shape : {"box", "sphere", "cylinder", "plane", "mesh", "heightfield"}) {
    shapes.push_back({shape, reference(shape)});
  }
  return with_one_of(doc, std::move(shapes), std::move(others));
}

JsonNode shape_definitions(JsonNode definitions) {
  definitions.add("box", object_of("A box, in 2D a rectangle.",
                                   {{"min", reference("vector"), true}, {"max", reference("vector"), true}}));
  definitions.add("sphere", object_of("A sphere, in 2D a disc.",
                                      {{"centre", reference("vector"), true}, {"radius", positive_node("m"), true}}));
  definitions.add("cylinder", object_of("A cylinder between the centres of its ends; in 2D a strip with round ends.",
                                        {{"from", reference("vector"), true},
                                         {"to", reference("vector"), true},
                                         {"radius", positive_node("m"), true}}));
  definitions.add("plane", object_of("All that lies behind a plane, opposite its normal.",
                                     {{"point", reference("vector"), true}, {"normal", reference("vector"), true}}));
  definitions.add("mesh", object_of("A closed triangle mesh; in 3D only.",
                                    {{"file", typed("string", ".obj, .ply or .stl, relative to the scene file."), true},
                                     {"scale", positive_node("Factor, before rotation and translation.")},
                                     {"translation", vector3("m")},
                                     {"rotation", vector3("Degrees about x, then y, then z.")}}));
  definitions.add("heightfield",
                  object_of("Fills its box from the bottom up to a height.",
                            {{"file", typed("string", "CSV of heights in metres: rows along z, columns along x.")},
                             {"formula", typed("string",
                                               "Height in metres from x and z: numbers, + - * / ^, pi, sin, cos, "
                                               "exp, sqrt, abs, min, max.")},
                             {"min", reference("vector"), true},
                             {"max", reference("vector"), true}}));
  return definitions;
}

JsonNode definitions_node() {
  JsonNode definitions = JsonNode::object();
  definitions.add("vector", array_of(typed("number"), 2, 3, "As many numbers as the scene has dimensions."));
  definitions.add("place", array_of(typed("number"), 1, 2, "One number fewer than the scene has dimensions."));
  definitions.add("wall",
                  any_of({one_of_names(wall_kind_names()),
                          object_of("A wall that may drag the fluid along.",
                                    {{"kind", one_of_names(wall_kind_names()), true},
                                     {"velocity", reference("vector", "Tangential, m/s; with no-slip only.")}})}));
  JsonNode rate = any_of({vector3("3D"), number_node("2D")});
  definitions.add(
      "velocity",
      any_of({reference("vector"),
              object_of("A named field with one period across the domain.",
                        {{"field", one_of_names(std::vector<std::string_view>{"taylor_green", "shear_wave"}), true},
                         {"speed", number_node("Amplitude, m/s; 1 where absent.")}}),
              object_of("Rigid rotation.", {{"field", one_of_names(std::vector<std::string_view>{"rotation"}), true},
                                            {"centre", reference("vector"), true},
                                            {"rate", with_doc(std::move(rate), "rad/s"), true}}),
              object_of("Vortex of Gresho & Chan (1990) around z: its speed rises evenly to a peak and falls evenly to "
                        "rest.",
                        {{"field", one_of_names(std::vector<std::string_view>{"gresho_chan"}), true},
                         {"centre", reference("vector"), true},
                         {"radius", positive_node("Of the peak, m; 0.2 where absent. Rest begins at twice that.")},
                         {"speed", number_node("At the peak, m/s; 1 where absent.")}}),
              object_of("Vortex of Lamb and Oseen around z: Gamma / (2 pi r) (1 - exp(-r^2 / a^2)).",
                        {{"field", one_of_names(std::vector<std::string_view>{"lamb_oseen"}), true},
                         {"centre", reference("vector"), true},
                         {"radius", positive_node("Of the core, a, m."), true},
                         {"circulation", number_node("Gamma, m^2/s."), true}})}));
  return shape_definitions(std::move(definitions));
}

JsonNode parameter_node(const ParameterRow& row) {
  using Type = ParameterRow::Type;
  JsonNode node;
  if (row.type == Type::choice) {
    node = one_of_names(std::vector<std::string_view>(row.names.begin(), row.names.end()));
    node.add("default", text(parameter_text(row, row.default_value)));
  } else if (row.type == Type::flag) {
    node = typed("boolean");
    node.add("default", JsonNode::of(row.default_value != 0));
  } else {
    node = typed(row.type == Type::count ? "integer" : "number");
    node.add("minimum", number(row.min)).add("maximum", number(row.max)).add("default", number(row.default_value));
  }
  return with_doc(std::move(node), row.doc + (row.unit == "1" ? "" : " Unit: " + row.unit + "."));
}

JsonNode parameters_node() {
  std::vector<Property> members;
  for (const ParameterRow& row : parameter_table()) members.push_back({row.key.c_str(), parameter_node(row)});
  return object_of("Parameters by key; those left out have their defaults.", std::move(members));
}

JsonNode domain_node() {
  std::vector<Property> walls;
  for (const std::string_view name : wall_names(3)) walls.push_back({name.data(), reference("wall")});
  return object_of("The box in which the scene happens.",
                   {{"min", reference("vector"), true},
                    {"max", reference("vector"), true},
                    {"periodic", array_of(typed("boolean"), 2, 3, "Axes along which the domain repeats.")},
                    {"walls", object_of("Faces; slip where absent.", std::move(walls))}});
}

JsonNode camera_node() {
  JsonNode angle = typed("number");
  angle.add("minimum", number(1)).add("maximum", number(150)).add("default", number(35));
  return object_of("Where the picture is taken from; fitted to the domain where absent. Always three numbers.",
                   {{"position", vector3("m")},
                    {"target", vector3("m")},
                    {"field_of_view", with_doc(std::move(angle), "Vertical, degrees.")}});
}

JsonNode cut_node() {
  JsonNode node = object_of("Cuts the water open: only what lies on one side of a plane is drawn.",
                            {{"axis", one_of_names(std::vector<std::string_view>{"x", "y", "z"}), true},
                             {"at", typed("number", "Where the plane lies along the axis, in metres."), true},
                             {"keep", one_of_names(std::vector<std::string_view>{"low", "high"})}});
  return node;
}

JsonNode look_node() {
  std::vector<std::string_view> fields;
  for (const ColourField& field : colour_fields()) fields.push_back(field.name);
  return object_of(
      "What the picture shows.",
      {{"style", one_of_names(look_style_names(),
                              "The particles as spheres, clear water by the mesh of its surface, or clear water by its "
                              "particles on the screen.")},
       {"colour_by", one_of_names(fields,
                                  "Field that colours the particles; microrotation, lost_vorticity and "
                                  "sub_particle_level are 0 while their models are off.")},
       {"colour_map", one_of_names(colour_map_names())},
       {"range", array_of(typed("number"), 2, 2, "Ends of the colour scale; from the run's data where absent.")},
       {"cut", cut_node()},
       {"background", one_of_names(std::vector<std::string_view>{"light", "dark"})},
       {"show_walls", typed("boolean")},
       {"show_legend", typed("boolean")},
       {"show_floor", typed("boolean")}});
}

JsonNode motion_node() {
  JsonNode time = typed("number", "s; later than that of the keyframe before.");
  return array_of(object_of("Where the body is at a time.",
                            {{"time", std::move(time), true},
                             {"at", reference("vector", "m, from where the shape stands in the scene."), true}}),
                  1, 0,
                  "Keyframes of a body that moves, without turning: its velocity is continuous, and zero at the first "
                  "and the last.");
}

JsonNode probe_place(const std::string& doc, const char* vector) {
  JsonNode points = typed("integer");
  points.add("minimum", number(2)).add("maximum", number(10000));
  JsonNode node = any_of({object_of("A point.", {{"at", reference(vector), true}}),
                          object_of("A line of points at even distances.", {{"from", reference(vector), true},
                                                                            {"to", reference(vector), true},
                                                                            {"points", std::move(points), true}})});
  return with_doc(std::move(node), doc);
}

JsonNode probe_node() {
  JsonNode every = typed("number");
  every.add("minimum", number(1e-6));
  return with_one_of(
      "A measurement; its cells are empty where no particle is within the kernel's support.",
      {{"pressure", probe_place("Pa; known from the first step on.", "vector")},
       {"velocity", probe_place("m/s.", "vector")},
       {"water_height", probe_place("Of the highest water over the place, in metres from the domain's lowest point; "
                                    "places are given without the vertical axis.",
                                    "place")}},
      {{"name",
        typed("string", "Of its columns: letters, digits, spaces, - and _; \"probe 1\" and so on where absent.")},
       {"every", with_doc(std::move(every), "Simulated time between rows, s; each step where absent.")}});
}

JsonNode constant(JsonNode value) {
  JsonNode node = JsonNode::object();
  return std::move(node.add("const", std::move(value)));
}

JsonNode dimension_node() {
  JsonNode node = JsonNode::object(), values = JsonNode::array();
  values.add(number(2)).add(number(3));
  node.add("enum", std::move(values)).add("default", number(3));
  return node;
}

}  // namespace

std::string scene_schema() {
  static constexpr std::string_view body_walls[] = {"slip", "no-slip"};
  JsonNode radius = positive_node("Half the particle spacing, m; 0.025 where absent.");
  JsonNode schema = JsonNode::object();
  schema.add("$schema", text("https://json-schema.org/draft/2020-12/schema")).add("title", text("Curlew scene"));
  JsonNode body = object_of(
      "A scene: SI units, y up. Comments are allowed in scene files. Written by `curlew params --schema`.",
      {{"curlew", with_doc(constant(number(1)), "Version of the format."), true},
       {"name", typed("string")},
       {"about", typed("string", "What there is to see, in a sentence or two.")},
       {"dimension", dimension_node()},
       {"particle_radius", std::move(radius)},
       {"gravity", reference("vector", "m/s^2; -9.81 along y where absent.")},
       {"domain", domain_node(), true},
       {"fluid",
        array_of(
            with_shapes("A body of fluid.",
                        {{"velocity", reference("velocity", "At the start, m/s.")},
                         {"jitter", number_node("Random start, at most so many spacings off the lattice, 0 to 0.3.")}}),
            1, 0, "What is fluid at the start."),
        true},
       {"bodies", array_of(with_shapes("A solid, at rest where it has no motion.", {{"name", typed("string")},
                                                                                    {"wall", one_of_names(body_walls)},
                                                                                    {"motion", motion_node()}}),
                           0, 0, "Solids in the way of the fluid.")},
       {"probes", array_of(probe_node(), 0, 0, "What is measured into probes.csv by `curlew run`.")},
       {"parameters", parameters_node()},
       {"camera", camera_node()},
       {"look", look_node()}});
  for (std::size_t i = 0; i < body.keys.size(); ++i) schema.add(body.keys[i], std::move(body.items[i]));
  return json_text(schema.add("$defs", definitions_node()));
}

}  // namespace curlew
