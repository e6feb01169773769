#include "sim/scene/read_probes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/core/error.h"
#include "sim/core/params.h"
#include "sim/scene/names.h"

namespace curlew {
namespace {

constexpr double most_points = 10000;
constexpr double shortest_time = 1e-6, longest_time = 1e6;  // s

// Names become columns: nothing that a table or a column's own index and axis could be taken for.
std::string read_probe_name(const JsonPlace& place) {
  const std::string& name = place.text();
  const auto fits = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= '0' && byte <= '9') || ((byte | 32U) >= 'a' && (byte | 32U) <= 'z') || byte == ' ' || byte == '_' ||
           byte == '-' || byte >= 0x80;
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits)) {
    place.expected("a name of letters, digits, spaces, - and _");
  }
  if (name == "step" || name == "time") place.expected("another name, since probes.csv has a column of that name");
  return name;
}

// A point inside the domain or on its rim. Water heights are measured over a point without the vertical axis.
Vec3d read_point(const JsonPlace& place, Probe::Quantity quantity, const Scene& scene) {
  std::vector<int> axes;
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (quantity != Probe::Quantity::water_height || axis != scene.vertical_axis()) axes.push_back(axis);
  }
  const Vec3d numbers = place.vector(static_cast<int>(axes.size()));
  Vec3d point;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const int axis = axes[k];
    const double low = scene.domain.min[axis], high = scene.domain.max[axis];
    point[axis] = numbers[static_cast<int>(k)];
    if (point[axis] >= low && point[axis] <= high) continue;
    place.fail("lies outside the domain at " + std::string(1, "xyz"[axis]) + " = " + plain_number(point[axis]) +
               ", expected " + plain_number(low) + " to " + plain_number(high));
  }
  return point;
}

void read_points(const JsonPlace& place, const Scene& scene, Probe& probe) {
  place.allow({"at", "from", "to", "points"});
  if (const auto at = place.find("at")) {
    if (place.node().keys.size() > 1) place.fail("has \"at\" and keys of a line, expected a point or a line");
    probe.from = probe.to = read_point(*at, probe.quantity, scene);
    return;
  }
  if (place.node().keys.empty()) place.fail("has no place, expected \"at\", or \"from\", \"to\" and \"points\"");
  probe.from = read_point(place.at("from"), probe.quantity, scene);
  probe.to = read_point(place.at("to"), probe.quantity, scene);
  if (probe.from == probe.to) place.fail("has its ends at one place, expected two places");
  const JsonPlace points = place.at("points");
  const double number = points.node().number;
  if (points.node().type != JsonNode::Type::number || !(number >= 2 && number <= most_points) ||
      number != std::floor(number)) {
    points.expected("a whole number from 2 to " + plain_number(most_points));
  }
  probe.points = static_cast<int>(number);
}

Probe read_probe(const JsonPlace& place, const Scene& scene) {
  const auto quantities = probe_quantity_names();
  std::vector<std::string_view> keys{"name", "every"};
  keys.insert(keys.begin(), quantities.begin(), quantities.end());
  place.allow(keys);
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    if (place.find(quantities[k])) found.push_back(k);
  }
  if (found.size() != 1) {
    place.fail("has " + (found.empty() ? "no quantity" : std::to_string(found.size()) + " quantities") +
               ", expected one of " + joined_names(quantities, "or"));
  }
  Probe probe;
  probe.quantity = static_cast<Probe::Quantity>(found[0]);
  read_points(place.at(quantities[found[0]]), scene, probe);
  if (const auto name = place.find("name")) probe.name = read_probe_name(*name);
  if (const auto every = place.find("every")) probe.every = every->number(shortest_time, longest_time);
  return probe;
}

}  // namespace

std::vector<Probe> read_probes(const JsonPlace& place, const Scene& scene) {
  std::vector<Probe> probes;
  std::set<std::string> names;
  for (const JsonPlace& item : place.array("an array of probes")) {
    Probe probe = read_probe(item, scene);
    if (probe.name.empty()) probe.name = "probe " + std::to_string(probes.size() + 1);
    if (!names.insert(probe.name).second) {
      item.fail("has the name " + in_quotes(probe.name) + " of a probe before it, expected a name of its own");
    }
    probes.push_back(std::move(probe));
  }
  return probes;
}

}  // namespace curlew
