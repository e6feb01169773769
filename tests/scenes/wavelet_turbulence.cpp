// Wavelet turbulence: where it is found, what it does, and that it costs nothing where it is off.
#include "sim/turbulence/wavelet_turbulence_fujisawa2011.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/measure/energy_budget.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr int per_metre = 40;
constexpr double spacing = 1.0 / per_metre, scale = spacing / 2;

// That of the window's preset.
constexpr double preset_amplitude = 0.02;  // s/m

using Flow = std::function<Vec3d(Vec3d)>;

// A block of disordered particles in a void, or a periodic box full of them, with a flow of our choice; its wavelet
// energy stands in the field.
Run flowing(const Flow& flow, bool periodic, double jitter = 0.15) {
  Scene scene = empty_box({1, 1, 1}, per_metre);
  scene.gravity = {};
  if (periodic) scene.domain.periodic = {true, true, true};
  const double rim = periodic ? 0 : 0.2;
  scene.fluid.push_back(moving(Box{{rim, rim, rim}, {1 - rim, 1 - rim, 1 - rim}}, {}));
  World world = jittered(make_world(scene), jitter);
  for (std::size_t i = 0; i < world.count; ++i)
    world.fields.velocity[i] = to_float(flow(to_double(world.fields.position[i])));
  return Run(std::move(world), {FieldId::wavelet_energy});
}

double largest_energy(const World& world) {
  return particle_max(world.count, [&](std::size_t i) { return double{world.fields.wavelet_energy[i]}; }).value;
}

// |u^| / |u| of a wave of wavenumber k (1/m): the Fourier transform of the wavelet, (2 pi)^(3/2) (k s)^2
// exp(-(k s)^2 / 2), over int |psi| = 24 sqrt(3) pi exp(-3/2).
double transfer(double k) {
  const double q = k * scale;
  return std::pow(2 * std::numbers::pi, 1.5) * q * q * std::exp(-q * q / 2) /
         (24 * std::sqrt(3.0) * std::numbers::pi * std::exp(-1.5));
}

}  // namespace

TEST_CASE("uniform flow has no wavelet energy at all, at a surface either, nor with three neighbours") {
  const Flow uniform = [](Vec3d) { return Vec3d{3, -2, 0.7}; };
  CHECK(largest_energy(flowing(uniform, false).world) == 0);
  CHECK(largest_energy(flowing(uniform, true).world) == 0);
  Scene scene = empty_box({1, 1, 1}, per_metre);
  const double d = spacing;
  scene.fluid.push_back(moving(Box{{0.5, 0.5, 0.5}, {0.5 + 2 * d, 0.5 + 2 * d, 0.5 + d}}, {1, 2, 3}));
  Run few(scene, {FieldId::wavelet_energy});
  REQUIRE(few.world.count == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(few.world.neighbours.count(i) == 3);
  CHECK(largest_energy(few.world) == 0);
}

TEST_CASE("rotating, sheared and strained flow has none either, at a surface as within") {
  const double rate = 10;  // 1/s
  const Flow flows[] = {
      [&](Vec3d x) {
        return rate * cross(Vec3d{0.6, 0, 0.8}, x - Vec3d{0.5, 0.5, 0.5});
      },
      [&](Vec3d x) {
        return rate * Vec3d{x.y, 0, 0};
      },
      [&](Vec3d x) {
        return rate * Vec3d{x.x, -x.y, 0};
      },
  };
  for (const Flow& flow : flows) {
    const double across = rate * spacing;  // what the flow changes by from a particle to the next, m/s
    const double most = largest_energy(flowing(flow, false).world) / (0.5 * across * across);
    CAPTURE(most);
    CHECK(most < 1e-7);
  }
}

TEST_CASE("in the midst of water the energy is that of the analytic field") {
  for (const double wavelengths : {2.0, 3.0, 5.0}) {  // 20, 13 and 8 spacings long
    const double k = 2 * std::numbers::pi * wavelengths;
    const Flow waves = [&](Vec3d x) {  // an ABC flow: all its waves have wavenumber k
      return Vec3d{std::sin(k * x.z) + 0.7 * std::cos(k * x.y), 0.8 * std::sin(k * x.x) + std::cos(k * x.z),
                   0.7 * std::sin(k * x.y) + 0.8 * std::cos(k * x.x)};
    };
    const Run run = flowing(waves, true, 0.1);
    double error = 0, exact = 0;
    for (std::size_t i = 0; i < run.world.count; ++i) {
      const Vec3d u = transfer(k) * waves(to_double(run.world.fields.position[i]));
      const double energy = 0.5 * dot(u, u);
      error += std::pow(double{run.world.fields.wavelet_energy[i]} - energy, 2);
      exact += energy * energy;
    }
    CAPTURE(wavelengths, std::sqrt(error / exact));
    CHECK(std::sqrt(error / exact) < 0.1);
  }
}

TEST_CASE("a shear layer has its energy on its flanks") {
  const double thickness = spacing;
  const Run run = flowing([&](Vec3d x) { return Vec3d{std::tanh((x.y - 0.5) / thickness), 0, 0}; }, false, 0.1);
  const World& world = run.world;
  // Means over thin layers, away from the block's faces.
  std::vector<double> energy(80), number(80);
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3 x = world.fields.position[i];
    if (std::max({std::abs(x.x - 0.5f), std::abs(x.y - 0.5f), std::abs(x.z - 0.5f)}) > 0.22f) continue;
    const auto layer = static_cast<std::size_t>((double{x.y} - 0.3) / (0.25 * spacing));
    if (layer >= energy.size()) continue;
    energy[layer] += double{world.fields.wavelet_energy[i]};
    number[layer] += 1;
  }
  const auto mean = [&](std::size_t layer) { return number[layer] > 0 ? energy[layer] / number[layer] : 0; };
  const double flank = 0.658 * thickness;  // where the curvature of tanh is largest
  double most = 0, at = 0, far = 0;
  for (std::size_t layer = 0; layer < energy.size(); ++layer) {
    const double y = std::abs(0.3 + 0.25 * spacing * (static_cast<double>(layer) + 0.5) - 0.5);
    if (mean(layer) > most) most = mean(layer), at = y;
    if (y > flank + 4 * scale) far = std::max(far, mean(layer));
  }
  CAPTURE(most, at / spacing, far / most);
  CHECK(std::abs(at - flank) < 2 * scale);
  CHECK(far < 0.1 * most);
}

TEST_CASE("turbulence accelerates by A e y over tau, and below the threshold not at all") {
  const Flow waves = [](Vec3d x) { return Vec3d{std::sin(30 * x.y), std::sin(30 * x.z), std::sin(30 * x.x)}; };
  World world = flowing(waves, true).world;
  WaveletParameters& p = world.scene.parameters.wavelet;
  p.amplitude = 0.6;
  p.threshold = largest_energy(world) / 3;
  world.wavelet.noise = make_wavelet_noise(p, 1);
  world.wavelet.moved = 1.7;
  const TurbulenceField field(*world.wavelet.noise, spacing, p.octaves, 1.7, 3);
  for (const bool per_step : {false, true}) {
    p.form = per_step ? WaveletParameters::form_t::step : WaveletParameters::form_t::rate;
    const double tau = per_step ? world.dt : p.reference_step;
    world.fields.acceleration.assign(world.count, Vec3{});
    add_wavelet_turbulence(world);
    int pushed = 0;
    for (std::size_t i = 0; i < world.count; ++i) {
      const double energy = std::max(0.0, double{world.fields.wavelet_energy[i]} - p.threshold);
      const Vec3d wanted = p.amplitude * energy / tau * to_double(field.at(world.fields.position[i]));
      CHECK(length(to_double(world.fields.acceleration[i]) - wanted) <= 1e-3 * length(wanted) + 1e-6);
      pushed += energy > 0 ? 1 : 0;
    }
    CHECK(pushed > 100);
    CHECK(pushed < static_cast<int>(world.count) / 2);
  }
  CHECK(world.wavelet.mean_energy > 0);
  const double before = world.wavelet.moved;
  drift_wavelet_noise(world);
  CHECK(world.wavelet.moved > before);
}

TEST_CASE("in a plane the turbulence stays in it and has no divergence") {
  WaveletParameters p;
  const auto noise = make_wavelet_noise(p, 3);
  const TurbulenceField field(*noise, 0.1, 3, 0.4, 2);
  const float step = 2e-3f;
  double divergence = 0, gradient = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 x{0.0317f * static_cast<float>(k), 1.7f - 0.0113f * static_cast<float>(k), 0};
    CHECK(field.at(x).z == 0);
    const Vec3 dx = field.at(x + Vec3{step, 0, 0}) - field.at(x - Vec3{step, 0, 0}),
               dy = field.at(x + Vec3{0, step, 0}) - field.at(x - Vec3{0, step, 0});
    divergence += std::pow(double{dx.x + dy.y}, 2);
    gradient += std::pow(double{dx.x}, 2) + std::pow(double{dy.x}, 2);
  }
  CHECK(std::sqrt(divergence / gradient) < 0.01);
}

TEST_CASE("a tile of another size is refused in a sentence") {
  WaveletParameters p;
  p.tile = 48;
  CHECK_THROWS_WITH(make_wavelet_noise(p, 0), "wavelet.tile is 48, expected 32, 64, 128 or 256");
}

TEST_CASE("off, wavelet turbulence and sub-particles have no passes and no memory") {
  Scene scene = at_particles_per_metre(bundled("dam_break"), 12);
  const Run run(scene);
  for (const Pass* pass : make_plan(run.world).step) {
    CHECK(pass->name.find("wavelet") == std::string_view::npos);
    CHECK(pass->name != "sub_particles");
  }
  CHECK(run.world.fields.wavelet_energy.capacity() == 0);
  CHECK(run.world.fields.sub_particles.capacity() == 0);
  CHECK(run.world.wavelet.noise == nullptr);
}

TEST_CASE("water that is left to rest calms down with wavelet turbulence as it does without it") {
  // After 6 s, a fall of water in a small tank: kinetic energy over the last half second, and the mean level.
  const auto settled = [](double amplitude, bool guard) {
    Scene scene = empty_box({0.5, 0.7, 0.5}, 30);
    scene.fluid.push_back(moving(Box{{0, 0, 0}, {0.25, 0.4, 0.5}}, {}));
    scene.parameters.wavelet.amplitude = amplitude;
    scene.parameters.sub_particles.levels = amplitude > 0 ? 3 : 0;
    scene.parameters.energy.guard = guard;
    Run run(scene);
    run.simulate(6);
    const World& world = run.world;
    const double level = amplitude == 0 ? 0 : particle_sum(world.count, [&](std::size_t i) {
      return double{world.fields.sub_particles[i].w} / static_cast<double>(world.count);
    });
    return std::pair{run.mean([](const Moment& moment) { return moment.sums.kinetic; }, 5.5), level};
  };
  const double calm = settled(0, false).first;
  for (const bool guard : {true, false}) {
    const auto [kinetic, level] = settled(preset_amplitude, guard);
    CAPTURE(guard, calm, kinetic, level);
    CHECK(kinetic < 1.2 * calm);
    CHECK(level < 0.01);
  }
}

TEST_CASE("the energy put in depends on the time, not on the number of steps, but for the paper's form") {
  using enum WaveletParameters::form_t;
  const Flow waves = [](Vec3d x) { return Vec3d{std::sin(30 * x.y), std::sin(30 * x.z), std::sin(30 * x.x)}; };
  const World start = flowing(waves, true).world;
  // The water stands still but for what the turbulence does to its velocity in 0.02 s.
  const auto given = [&](WaveletParameters::form_t form, int steps) {
    World world = start;
    world.scene.parameters.wavelet.amplitude = 0.05;
    world.scene.parameters.wavelet.form = form;
    world.wavelet.noise = make_wavelet_noise(world.parameters().wavelet, 1);
    world.dt = 0.02 / steps;
    for (int k = 0; k < steps; ++k) {
      find_wavelet_energy(world);
      world.fields.acceleration.assign(world.count, Vec3{});
      add_wavelet_turbulence(world);
      const auto dt = static_cast<float>(world.dt);
      parallel_for(world.count, [&](std::size_t i) { world.fields.velocity[i] += dt * world.fields.acceleration[i]; });
    }
    return kinetic_energy(world) - kinetic_energy(start);
  };
  const double coarse = given(rate, 10), fine = given(rate, 20);
  CAPTURE(coarse, fine);
  CHECK(fine > 0);
  CHECK(coarse == Approx(fine).epsilon(0.1));
  CHECK(given(step, 20) > 1.5 * given(step, 10));
}
