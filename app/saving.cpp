#include "app/saving.h"

#include "app/commands.h"
#include "sim/io/checkpoint.h"
#include "sim/scene/reader.h"

namespace curlew {

void save_checkpoint(const std::string& file, const World& world, std::vector<std::pair<std::string, double>> numbers) {
  if (world.wavelet.moved != 0) numbers.emplace_back("wavelet_moved", world.wavelet.moved);
  if (world.energy.reserve != 0) numbers.emplace_back("energy_reserve", world.energy.reserve);
  if (world.start.known) {
    numbers.emplace_back("start_speed", world.start.speed);
    numbers.emplace_back("start_energy", world.start.energy);
  }
  CheckpointInfo info{scene_json(world.scene),
                      world.scene.file.string(),
                      version_text(),
                      CURLEW_ISA_NAME,
                      world.seed,
                      world.step,
                      world.time,
                      world.dt,
                      std::move(numbers)};
  write_checkpoint(file, info, world.fields);
}

}  // namespace curlew
