// libFuzzer's entry to the particle files of finished runs: the same bytes as VTK, PLY and bgeo are read, or refused in
// a sentence.
#include <vector>

#include "sim/io/particle_files.h"
#include "sim/io/particle_read.h"
#include "tests/fuzz/fuzz.h"

using namespace curlew;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::filesystem::path folder = test::corpus_folder(*argc, *argv);
  if (folder.empty() || !std::filesystem::is_empty(folder)) return 0;
  const std::vector<std::uint32_t> id = {1, 0};
  const std::vector<Vec3> place = {{1, 2, 3}, {4, 5, 6}};
  const std::vector<float> density = {999, 1000};
  const ParticleExport particles{0.5, 3, id, place, place, density, {{"swirl", std::span<const Vec3>(place)}}};
  write_vtk(folder / "a.vtk", particles);
  write_ply(folder / "a.ply", particles);
  write_bgeo(folder / "a.bgeo", particles);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  for (const char* name : {"a.vtk", "a.ply", "a.bgeo"}) {
    const std::string file = folder / name;
    test::put_file(file, std::string(reinterpret_cast<const char*>(data), size));
    try {
      const ParticleSet set = read_particles(file);
      test::require(set.position.size() == set.id.size() && set.velocity.size() == set.id.size() &&
                    set.density.size() == set.id.size() && set.id.size() <= size);
    } catch (const InputError& error) {
      test::check_sentence(error.what());
    }
  }
  return 0;
}
