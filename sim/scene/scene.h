// A scene as read from its file: everything in SI units, nothing yet laid out as particles.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/core/params.h"
#include "sim/core/vec.h"
#include "sim/scene/keyframes.h"

namespace curlew {

// A triangle mesh, for bodies, for mesh-shaped fluid and for drawing. Triangles index vertices, three each.
struct TriangleMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Shapes. In 2D a box is a rectangle, a sphere a disc, a cylinder a rounded-off strip of width 2 radius between its
// ends, a plane a half-plane. Angles in degrees.
struct Box {
  Vec3d min, max;
};
struct Sphere {
  Vec3d centre;
  double radius = 0;
};
struct Cylinder {
  Vec3d from, to;  // centres of the end faces
  double radius = 0;
};
struct Plane {
  Vec3d point, normal;  // solid (or fluid) lies opposite the normal
};
struct Mesh {
  std::filesystem::path file;  // .obj, .ply or .stl; as written in the scene, relative to the scene file
  double scale = 1;
  Vec3d translation;
  Vec3d rotation;                            // degrees about x, then y, then z
  std::shared_ptr<const TriangleMesh> mesh;  // loaded, scaled, rotated, moved
};
struct Heightfield {
  std::filesystem::path file;   // CSV grid of heights (rows along z, columns along x), or empty
  std::string formula;          // or a formula of x and z, such as "0.2 + 0.05*cos(2*pi*x)"
  Vec3d min, max;               // solid (or fluid) fills min.y up to the height, inside the box
  std::vector<double> heights;  // sampled, row by row along z
  int columns = 0, rows = 0;
};
using Shape = std::variant<Box, Sphere, Cylinder, Plane, Mesh, Heightfield>;

// What fluid does at a boundary.
enum class WallKind { slip, no_slip, open };

struct Wall {
  WallKind kind = WallKind::slip;
  Vec3d velocity;  // tangential, m/s; pulls the fluid where the wall is no-slip
};

// The box in which the scene happens. Faces in the order x-, x+, y-, y+, z-, z+; in 2D the last two do not exist.
struct Domain {
  Vec3d min, max;
  std::array<bool, 3> periodic{};
  std::array<Wall, 6> walls;
};

// An initial velocity: constant, or a named field.
struct InitialVelocity {
  enum class Field { constant, taylor_green, rotation, shear_wave, gresho_chan, lamb_oseen };
  Field field = Field::constant;
  Vec3d value;        // constant: the velocity
  double speed = 1;   // m/s; taylor_green, shear_wave: amplitude, with one period across the domain; gresho_chan: peak
  Vec3d centre;       // rotation, gresho_chan, lamb_oseen: about this point, the vortices around z
  Vec3d rate;         // rotation: angular velocity, rad/s (in 2D only z)
  double radius = 0;  // m; gresho_chan: of the peak, fluid farther than twice that is at rest; lamb_oseen: core, a
  double circulation = 0;  // lamb_oseen: m^2/s
};

struct Fluid {
  Shape shape;
  InitialVelocity velocity;
  // How far particles start from their lattice points at most, along each axis, in spacings: flows without a surface
  // must not start from a crystal, which breaks in one go when it is strained.
  double jitter = 0;
};

struct Body {
  std::string name;
  Shape shape;
  WallKind kind = WallKind::slip;  // slip or no_slip
  KeyframePath motion{};           // where the shape stands over time; at rest where it is empty
};

// Where all bodies are at a time, in the scene's order; nothing where none ever moves.
std::vector<BodyPlace> body_places(const std::vector<Body>& bodies, double time);

// What is measured at a point or along a line, into probes.csv.
struct Probe {
  enum class Quantity { pressure, velocity, water_height };
  std::string name;
  Quantity quantity = Quantity::pressure;
  Vec3d from, to;    // ends of the line, both the same for a point; water_height takes all along the vertical axis
  int points = 1;    // at even distances from end to end
  double every = 0;  // s of simulated time between rows; 0: each step

  Vec3d at(int point) const { return points > 1 ? from + (point / (points - 1.0)) * (to - from) : from; }
};

struct Camera {
  std::optional<Vec3d> position, target;  // fitted to the domain where absent
  double field_of_view = 35;              // vertical, degrees
};

// The water cut open: what lies beyond a plane across an axis is not drawn.
struct Cut {
  int axis = 2;
  double at = 0;           // m
  bool keep_high = false;  // else the low side stays
};

// How water is shown: its particles as spheres, as clear water by the mesh of its surface, or as clear water by its
// particles on the screen, without a mesh.
enum class LookStyle { particles, water, fast_water };

struct Look {
  LookStyle style = LookStyle::particles;
  std::string colour_by = "speed";             // a name of colour_fields(), see sim/core/frame.h
  std::string colour_map = "water";            // a name of the renderer's colour maps
  std::optional<std::array<double, 2>> range;  // of the colour scale; from the run's own data where absent
  std::optional<Cut> cut;
  std::string background = "light";  // light or dark
  bool show_walls = true, show_legend = true, show_floor = true;
};

struct Scene {
  std::string name, about;
  std::filesystem::path file;
  int dimension = 3;
  double particle_radius = 0.025;
  Vec3d gravity{0, -9.81, 0};
  Domain domain;
  std::vector<Fluid> fluid;
  std::vector<Body> bodies;
  std::vector<Probe> probes;
  Parameters parameters;
  Camera camera;
  Look look;

  double spacing() const { return 2 * particle_radius; }
  // The axis along which gravity pulls most; y where it pulls nowhere.
  int vertical_axis() const {
    int axis = 1;
    for (const int other : {0, 2}) {
      if (gravity[other] * gravity[other] > gravity[axis] * gravity[axis]) axis = other;
    }
    return axis;
  }
};

}  // namespace curlew
