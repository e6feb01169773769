// Vortex sub-particles: the laws of their sizes, energies and turning, however long a run is.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "sim/sph/kernel.h"
#include "sim/turbulence/sub_particles_fujisawa2011.h"

using namespace curlew;

namespace {

constexpr double radius = 0.02;

double distance(Vec3 a, Vec3 b) { return static_cast<double>(length(a - b)); }

// How far an angle in turns is from another, either way round.
double apart(double a, double b) { return std::abs(a - b - std::round(a - b)); }

}  // namespace

TEST_CASE("sub-particles of a level have the volume of one of the level above between two") {
  for (int level = 0; level < most_sub_levels; ++level) {
    CHECK(sub_particle_share(level) == Approx(std::pow(2.0, -level / 3.0)).epsilon(1e-12));
    CHECK(2 * std::pow(sub_particle_share(level + 1), 3) == Approx(std::pow(sub_particle_share(level), 3)));
  }
}

TEST_CASE("the level is where the cascade has come down to the critical energy") {
  const float critical = 0.02f;
  CHECK(sub_particle_level(0, critical, 3) == 0);
  CHECK(sub_particle_level(critical, critical, 3) == 0);
  CHECK(sub_particle_level(NAN, critical, 3) == 0);
  for (const float level : {0.25f, 1.0f, 1.7f, 2.0f, 2.9f}) {
    const float energy = critical * std::exp2(5.0f / 9 * level);
    CHECK(sub_particle_level(energy, critical, 3) == Approx(level).epsilon(1e-5));
    CHECK(energy * std::pow(std::exp2(-5.0f / 9), level) == Approx(critical).epsilon(1e-5));
  }
  CHECK(sub_particle_level(1e6f, critical, 3) == 3);
  CHECK(sub_particle_level(1e6f, critical, 2) == 2);
}

TEST_CASE("pairs turn by speed over orbit, and a million steps lose nothing of it") {
  const float energy = 0.7f;
  const double dt = 1e-3;
  for (int level = 0; level < most_sub_levels; ++level) {
    const double speed = std::sqrt(2 * 0.7 * std::pow(2, -5.0 / 9 * level)),
                 orbit = radius * std::pow(2, -(level + 1) / 3.0);
    const float turn = sub_particle_turn(energy, level, radius, dt);
    CHECK(turn == Approx(speed * dt / orbit / (2 * std::numbers::pi)).epsilon(1e-6));
    float at = 0;
    for (int step = 0; step < 1'000'000; ++step) at = next_turn(at, turn);
    CHECK(at >= 0);
    CHECK(at < 1);
    CHECK(apart(at, 1e6 * static_cast<double>(turn)) < 0.05);  // of some 9000 turns
  }
}

TEST_CASE("arms are unit vectors across their axes, at any time") {
  for (const double time : {0.0, 0.37, 1e3, 1e6}) {
    for (std::uint32_t particle = 0; particle < 500; ++particle) {
      const int level = static_cast<int>(particle % 3);
      const SubPair pair =
          sub_pair(particle, level, particle % (1u << level), 0.001f * static_cast<float>(particle), time);
      CHECK(length(pair.arm) == Approx(1).margin(1e-5));
      CHECK(length(pair.axis) == Approx(1).margin(1e-5));
      CHECK(std::abs(dot(pair.arm, pair.axis)) < 1e-5f);
    }
  }
}

TEST_CASE("an arm turns about its axis by the angle given") {
  const double angle = 0.01;
  const auto turn = static_cast<float>(angle / (2 * std::numbers::pi));
  for (std::uint32_t particle = 0; particle < 100; ++particle) {
    const SubPair before = sub_pair(particle, 0, 0, 0.3f, 0.5), after = sub_pair(particle, 0, 0, 0.3f + turn, 0.5);
    CHECK(length(before.axis - after.axis) == 0);
    const Vec3d moved = to_double(after.arm - before.arm), along = to_double(cross(before.axis, before.arm));
    CHECK(length(moved - angle * along) < 0.6 * angle * angle);
  }
}

TEST_CASE("axes point everywhere, differ between pairs and turn with time, reproducibly") {
  Vec3 mean;
  Vec3d square;
  const int number = 4000;
  for (std::uint32_t particle = 0; particle < number; ++particle) {
    const Vec3 a = sub_pair(particle, 0, 0, 0, 0).axis;
    mean += (1.0f / number) * a;
    square += 1.0 / number * Vec3d{double{a.x} * a.x, double{a.y} * a.y, double{a.z} * a.z};
    CHECK(length(a - sub_pair(particle, 0, 0, 0, 0).axis) == 0);
  }
  CHECK(length(mean) < 0.05f);
  for (int axis = 0; axis < 3; ++axis) CHECK(square[axis] == Approx(1.0 / 3).margin(0.03));
  CHECK(length(sub_pair(7, 1, 0, 0, 0).axis - sub_pair(7, 1, 1, 0, 0).axis) > 0.01f);
  CHECK(length(sub_pair(7, 1, 0, 0, 0).axis - sub_pair(7, 2, 0, 0, 0).axis) > 0.01f);
  CHECK(length(sub_pair(7, 1, 0, 0, 0).axis - sub_pair(7, 1, 0, 0, 0.5).axis) > 0.01f);
}

TEST_CASE("sub-particles stand around the middle of their particle, each at its arm's length from its parent") {
  std::array<Vec3, most_sub_particles> places, parents;
  for (std::uint32_t particle = 0; particle < 50; ++particle) {
    const Vec3 turns{0.1f, 0.4f, 0.9f};
    for (int level = 1; level <= most_sub_levels; ++level) {
      const auto children = place_sub_particles(particle, level, turns, 0.2, radius, places);
      const auto above = place_sub_particles(particle, level - 1, turns, 0.2, radius, parents);
      REQUIRE(children.size() == 2 * above.size());
      Vec3 sum;
      for (std::size_t k = 0; k < children.size(); ++k) {
        sum += children[k];
        CHECK(distance(children[k], above[k / 2]) == Approx(sub_particle_share(level) * radius).epsilon(1e-4));
      }
      CHECK(length(sum) < 1e-6f);
    }
  }
}

TEST_CASE("the kernels of all levels have the same integral") {
  // W(|x| / r_L) with one peak for all: volume goes with r_L^3, and there are 2^L of them.
  for (int level = 0; level <= most_sub_levels; ++level) {
    CHECK(std::exp2(level) * std::pow(sub_particle_share(level), 3) == Approx(1).epsilon(1e-12));
  }
}
