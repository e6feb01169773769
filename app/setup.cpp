#include "app/setup.h"

#include "app/assets.h"
#include "sim/core/error.h"
#include "sim/core/frame.h"
#include "sim/scene/bundled.h"
#include "sim/scene/json.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {

void apply_settings(Parameters& parameters, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError("--set is " + in_quotes(setting) + ", expected key=value such as viscosity.nu=0.01");
    }
    try {
      set_parameter(parameters, parameter_row(setting.substr(0, equals)), setting.substr(equals + 1), "--set");
    } catch (const InputError& error) {
      const std::string message = error.what();
      throw InputError(message.starts_with("--set") ? message : "--set: " + message);
    }
  }
}

Scene scene_from(const RunOptions& options) {
  if (options.scene.empty()) throw InputError("no scene was given; `curlew scenes` lists the bundled ones");
  if (std::filesystem::path(options.scene).extension() == ".curlew") {
    throw InputError(options.scene + " is a checkpoint, expected a scene; go on from it with --resume " +
                     options.scene);
  }
  if (options.radius && options.particles)
    throw InputError("--radius and --particles both set the resolution; give one");
  Scene scene = read_scene(find_scene(options.scene, assets_folder()));
  apply_settings(scene.parameters, options.settings);
  if (options.look) scene.look.style = *options.look;
  if (options.radius) scene.particle_radius = *options.radius;
  if (options.particles) scene = with_particles(scene, *options.particles);
  return scene;
}

std::string colour_warning(const Scene& scene) {
  const std::string key(colour_switch(scene.look.colour_by, scene.parameters));
  if (key.empty()) return "";
  return "the water is coloured by " + scene.look.colour_by + ", which is 0 while its model is off; " + key +
         " switches it on";
}

}  // namespace curlew
