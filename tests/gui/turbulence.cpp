// The sliders, presets and colours of the turbulence models in the window, and the plot of energies.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "app/gui/danger.h"
#include "app/gui/plot.h"
#include "app/gui/presets.h"
#include "tests/gui/desk.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

constexpr const char* small = CURLEW_ASSETS_DIR "/scenes/dam_break_2d.json";

const std::uint8_t* pixel_of(const Image& picture, std::array<float, 4> box, double share) {
  // Near the lower edge: above are the number and the grab.
  return picture.at(static_cast<int>(box[0] + static_cast<float>(share) * (box[2] - box[0])),
                    static_cast<int>(box[3]) - 4);
}

int difference(const std::uint8_t* a, const std::uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

void choose(Desk& desk, const std::string& menu, const std::string& entry) {
  desk.click(menu);
  desk.draw();
  desk.click(menu + " " + entry);
  desk.settle();
}

bool all_zero(const Frame& frame) {
  return frame.value.size() == frame.position.size() &&
         std::all_of(frame.value.begin(), frame.value.end(), [](float v) { return v == 0; });
}

Sample sample_of(double time, double rotational, std::vector<NamedValue> budget = {}) {
  Sample sample;
  sample.time = time;
  sample.kinetic = 2;
  sample.rotational = rotational;
  sample.potential = 3;
  sample.budget = std::move(budget);
  return sample;
}

}  // namespace

TEST_CASE("dangers are on sliders that exist, within their range, from low to high") {
  REQUIRE_FALSE(dangers().empty());
  const Danger* before = nullptr;
  for (const Danger& danger : dangers()) {
    INFO(danger.key << " " << danger.from);
    const ParameterRow& row = parameter_row(danger.key);
    CHECK(danger.from > row.slider_min);
    CHECK(danger.from < row.slider_max);
    CHECK(danger.from > row.default_value);
    CHECK(std::string(danger.why).find("et al.") != std::string::npos);
    const bool second = before != nullptr && before->key == danger.key;
    CHECK(danger.level == (second ? before->level + 1 : 1));
    if (second) CHECK(danger.from > before->from);
    before = &danger;
  }
}

TEST_CASE("the dangerous part of a slider's track has another colour, in both themes") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  for (const bool dark : {false, true}) {
    desk.restyle(dark, 1);
    desk.move_to(1, 1);
    const Image picture = desk.picture();
    const auto alpha = desk.interface().place("vorticity_refinement.alpha");
    const auto nu_t = desk.interface().place("micropolar.nu_t");
    const auto epsilon = desk.interface().place("vorticity_confinement.epsilon");
    const std::uint8_t* plain = pixel_of(picture, epsilon, 0.95);
    CHECK(difference(plain, pixel_of(picture, epsilon, 0.5)) == 0);
    CHECK(difference(plain, pixel_of(picture, alpha, 0.8)) == 0);
    CHECK(difference(plain, pixel_of(picture, alpha, 0.95)) > 20);
    CHECK(difference(plain, pixel_of(picture, nu_t, 0.3)) == 0);
    CHECK(difference(plain, pixel_of(picture, nu_t, 0.6)) > 20);
    CHECK(difference(pixel_of(picture, nu_t, 0.6), pixel_of(picture, nu_t, 0.95)) > 15);
  }
}

TEST_CASE("the sliders of vorticity refinement reach the solver") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  CHECK(desk.parameters.vorticity_refinement.alpha == 0);
  desk.drag("vorticity_refinement.alpha", 0.05f, 0.7f);
  choose(desk, "vorticity_refinement.reconstruction", "poisson");
  CHECK(desk.parameters.vorticity_refinement.alpha == Approx(1.05).epsilon(0.1));
  CHECK(desk.parameters.vorticity_refinement.reconstruction ==
        VorticityRefinementParameters::reconstruction_t::poisson);
  choose(desk, "vorticity_refinement.reconstruction", "sum");
  desk.session.colour_by("lost_vorticity");
  for (int k = 0; k < 5; ++k) desk.click("step");
  desk.settle();
  CHECK(desk.interface().status().step == 5);
  CHECK_FALSE(all_zero(*desk.interface().frame()));
  CHECK(desk.interface().command_line().find("--set vorticity_refinement.alpha=1") != std::string::npos);
}

TEST_CASE("a preset sets all models at once, and one undo takes it back") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  const auto stands_at = [&](double alpha, double nu_t, double epsilon) {
    const Parameters& p = desk.parameters;
    return p.vorticity_refinement.alpha == alpha && p.micropolar.nu_t == nu_t &&
           p.vorticity_confinement.epsilon == epsilon;
  };
  CHECK(stands_at(0, 0, 0));
  desk.click("step");
  choose(desk, "preset", "VC 0.1");
  CHECK(stands_at(0, 0, 0.1));
  choose(desk, "preset", "VR with MP");
  CHECK(stands_at(1, 0.05, 0));
  desk.click("step");
  desk.settle();
  CHECK(desk.interface().status().step == 2);  // the run goes on
  // Nothing is lost yet that the guard would let a model give back.
  CHECK(desk.interface().samples().back().rotational == 0);
  for (int k = 0; k < 8; ++k) {
    desk.click("step");
    desk.settle();
  }
  CHECK(desk.interface().samples().back().rotational > 0);
  desk.key('Z', true);
  desk.settle();
  CHECK(stands_at(0, 0, 0.1));
  desk.key('Z', true);
  desk.settle();
  CHECK(stands_at(0, 0, 0));
  desk.key('Y', true);
  desk.key('Y', true);
  desk.settle();
  CHECK(stands_at(1, 0.05, 0));
  choose(desk, "preset", "VR with MP");  // chosen already: nothing to take back
  desk.key('Z', true);
  desk.settle();
  CHECK(stands_at(0, 0, 0.1));
}

TEST_CASE("the preset in effect is known, and settings of one's own are none") {
  Parameters parameters;
  REQUIRE(preset_of(parameters) != nullptr);
  CHECK(std::string(preset_of(parameters)->name) == "off");
  for (const TurbulencePreset& preset : turbulence_presets()) {
    Parameters before;
    before.micropolar.model = MicropolarParameters::model_t::full;
    before.vorticity_confinement.epsilon = 0.3;
    before.viscosity.nu = 0.01;
    CHECK(preset_of(before) == nullptr);
    const Parameters after = with_preset(before, preset);
    CHECK(preset_of(after) == &preset);
    CHECK(after.viscosity.nu == 0.01);
    CHECK(std::string(preset.doc).size() > 20);
  }
  parameters.micropolar.nu_t = 0.06;
  CHECK(preset_of(parameters) == nullptr);
}

TEST_CASE("colours of models that are off show 0 and say so, and live when the model does") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  for (const auto& [field, preset] : {std::pair("microrotation", "MP 0.05"), std::pair("lost_vorticity", "VR 1.0")}) {
    INFO(field);
    choose(desk, "colour by", field);
    desk.click("step");
    desk.settle();
    CHECK(desk.interface().view().look.colour_by == field);
    CHECK(all_zero(*desk.interface().frame()));
    CHECK_NOTHROW(desk.interface().place("colour is off"));
    choose(desk, "preset", preset);
    for (int k = 0; k < 3; ++k) desk.click("step");
    desk.settle();
    CHECK_FALSE(all_zero(*desk.interface().frame()));
    CHECK_THROWS(desk.interface().place("colour is off"));
    choose(desk, "preset", "off");  // no step: the picture follows all the same
    CHECK(all_zero(*desk.interface().frame()));
    desk.click("step");
    desk.settle();
    CHECK(all_zero(*desk.interface().frame()));
  }
}

TEST_CASE("the preset of wavelets stirs and splits a splash, and their colours live") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(CURLEW_ASSETS_DIR "/../tests/golden/splash.json");
  const std::size_t particles = desk.interface().frame()->position.size();
  choose(desk, "colour by", "sub_particle_level");
  CHECK(all_zero(*desk.interface().frame()));
  CHECK_NOTHROW(desk.interface().place("colour is off"));
  choose(desk, "preset", "wavelets");
  CHECK(desk.parameters.wavelet.amplitude > 0);
  CHECK(desk.parameters.sub_particles.levels == 3);
  for (int k = 0; k < 60; ++k) desk.click("step");
  for (const char* field : {"sub_particle_level", "wavelet_energy"}) {
    choose(desk, "colour by", field);
    CHECK_FALSE(all_zero(*desk.interface().frame()));
    CHECK_THROWS(desk.interface().place("colour is off"));
    desk.keep(std::string("wavelets by ") + field);
  }
  CHECK(desk.interface().frame()->position.size() > particles);
  desk.drag("wavelet.amplitude", 0.3f, 0.7f);
  desk.settle();
  CHECK(desk.parameters.wavelet.amplitude > 0.02);
  desk.type("sub_particles.levels", "0");
  desk.click("step");
  desk.settle();
  CHECK(desk.parameters.sub_particles.levels == 0);
  CHECK(desk.interface().frame()->position.size() == particles);
}

TEST_CASE("energy of rotation has a curve once a model has spins") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  desk.click("step");
  desk.settle();
  desk.click("Energy.csv");
  CHECK(file_text(folder / "dam_break_2d/energy_000.csv").find("rotational") == std::string::npos);
  choose(desk, "preset", "MP 0.2");
  for (int k = 0; k < 3; ++k) desk.click("step");
  desk.settle();
  desk.click("Energy.csv");
  CHECK(file_text(folder / "dam_break_2d/energy_001.csv")
            .starts_with("step,time (s),total (J),kinetic (J),potential (J),rotational (J)\n1,"));
  const Sample& last = desk.interface().samples().back();
  CHECK(last.rotational > 0);
}

TEST_CASE("a budget becomes a plot with a curve for each name") {
  CHECK(budget_plot({}).series.empty());
  std::vector<Sample> samples{sample_of(0, 0), sample_of(1, 0, {{"pressure", 1.5}}),
                              sample_of(2, 0, {{"pressure", 2.5}, {"refinement", -4}})};
  const Plot plot = budget_plot(samples);
  REQUIRE(plot.series.size() == 2);
  CHECK(plot.unit == "J");
  CHECK(plot.series[0].name == "pressure");
  CHECK(plot.series[1].name == "refinement");
  CHECK(std::isnan(plot.series[0].value(samples[0])));
  CHECK(plot.series[0].value(samples[1]) == 1.5);
  CHECK(std::isnan(plot.series[1].value(samples[1])));
  CHECK(plot.series[1].value(samples[2]) == -4);
}
