// The surface of the water on the command line: with a run, and afterwards from its particle files.
#include <filesystem>

#include "sim/scene/mesh_formats.h"
#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* short_run = "run dam_break --particles 3k --time 0.05 --fps 40";

Outcome curlew_in(const TemporaryFolder& folder, const std::string& line) {
  return curlew_program(words_of(line), {.folder = folder.path()});
}

void check_refused(const TemporaryFolder& folder, const std::string& line, const std::string& sentence) {
  const Outcome outcome = curlew_in(folder, line);
  CAPTURE(line);
  CHECK(outcome.code == 2);
  CHECK(outcome.err == "curlew: " + sentence + "\n");
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
  return sum;
}

}  // namespace

TEST_CASE("a run writes the surface of each frame, and `mesh` makes the same from its particles") {
  const TemporaryFolder folder;
  for (const std::string kind : {"vtk", "ply", "bgeo"}) {
    const std::string run = "run_" + kind;
    run_in(folder.path(), std::string(short_run) + " --mesh-out ply --particles-out " + kind, run);
    std::vector<std::string> before;
    for (const char* name : {"000000", "000001", "000002"}) {
      before.push_back(file_text(folder / (run + "/mesh/" + name + ".ply")));
      const TriangleMesh mesh = read_ply(before.back(), "mesh.ply");
      CHECK(volume(mesh) == Approx(1).epsilon(0.03));
    }
    if (kind == "bgeo") continue;  // it does not say the time, which the mesh's comment has
    REQUIRE(curlew_in(folder, "mesh " + run + " --overwrite --quiet").code == 0);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(file_text(folder / (run + "/mesh/00000" + std::to_string(k) + ".ply")) == before[k]);
  }
  REQUIRE(curlew_in(folder, "mesh run_bgeo --mesh-out obj --set surface.cell=2 --overwrite --quiet").code == 0);
  const std::string file = folder / "run_bgeo/mesh/000001.obj";
  CHECK(volume(read_obj(file_text(file), file)) == Approx(1).epsilon(0.05));
}

TEST_CASE("the surface is the same on any number of threads, drawn or not") {
  const TemporaryFolder folder;
  run_in(folder.path(), std::string(short_run) + " --mesh-out ply --threads 1", "one");
  run_in(folder.path(), std::string(short_run) + " --mesh-out ply --threads 3 --frames --look water --size 160x90",
         "three");
  CHECK(file_text(folder / "one/mesh/000002.ply") == file_text(folder / "three/mesh/000002.ply"));
}

TEST_CASE("`render` draws the frames of a run again, as it did or in another look") {
  const TemporaryFolder folder;
  for (const std::string look : {"water", "fast-water", "particles"}) {
    const std::string run = "run_" + look;
    run_in(folder.path(),
           std::string(short_run) + " --particles-out vtk --frames --size 320x180 --look " + look +
               (look == "particles" ? " --set viscosity.nu=0.01" : ""),
           run);
    const std::string frame = folder / (run + "/frames/000000.png");
    const std::string before = file_text(frame);
    REQUIRE(curlew_in(folder, "render " + run + " --size 320x180 --overwrite --quiet --look " + look).code == 0);
    // The colour scale of a run grows with its frames, and so does that of the second drawing.
    CHECK(file_text(frame) == before);
    REQUIRE(
        curlew_in(folder, "render " + run + " --size 320x180 --overwrite --quiet --view pillars --look " + look).code ==
        0);
    CHECK(file_text(frame) != before);
  }
}

TEST_CASE("a run that goes on heeds --look, and its state does not") {
  const TemporaryFolder folder;
  run_in(folder.path(), "run dam_break --particles 3k --time 0.02 --checkpoint-every 0.02", "first");
  const std::string on =
      "run --resume " + last_checkpoint(folder / "first") + " --time 0.05 --fps 40 --frames --size 160x90 --look ";
  const Table water = run_in(folder.path(), on + "water", "water"),
              particles = run_in(folder.path(), on + "particles", "particles");
  CHECK(water.last_hash() == particles.last_hash());
  CHECK(file_text(folder / "water/frames/000002.png") != file_text(folder / "particles/frames/000002.png"));
}

TEST_CASE("a scene whose body is a mesh is drawn again from anywhere") {
  const TemporaryFolder folder;
  run_in(folder.path(), "run rock --particles 3k --steps 2 --particles-out vtk --frames --size 160x90", "rock");
  const std::string before = file_text(folder / "rock/frames/000000.png");
  const Outcome outcome = curlew_in(folder, "render rock --size 160x90 --overwrite --quiet");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(file_text(folder / "rock/frames/000000.png") == before);
}

TEST_CASE("mesh and render say what they lack") {
  const TemporaryFolder folder;
  check_refused(folder, "mesh nowhere", "nowhere: there is no such folder, expected one of a run");
  fs::create_directory(folder / "empty");
  check_refused(folder, "mesh empty", "empty/run.json: there is no such file, expected a run's run.json");
  run_in(folder.path(), "run dam_break --particles 3k --steps 2", "bare");
  check_refused(folder, "render bare",
                "bare has no particle files; run the scene with --particles-out, for example vtk");
  run_in(folder.path(), "run dam_break --particles 3k --steps 2 --particles-out ply --mesh-out obj", "full");
  check_refused(folder, "mesh full", "full/mesh holds meshes already; give --overwrite to replace them");
  check_refused(folder, "mesh full --mesh-out stl", "--mesh-out is \"stl\", expected ply or obj");
  check_refused(folder, "render full --look glass", "--look is \"glass\", expected particles, water or fast-water");
  const std::string particles = folder / "full/particles/000000.ply";
  put_file(particles, file_text(particles).substr(0, 50000));
  const Outcome cut = curlew_in(folder, "mesh full --overwrite");
  CHECK(cut.code == 2);
  CHECK(cut.err.find("full/particles/000000.ply: cut short in its particles\n") != std::string::npos);
  check_refused(folder, "run dam_break_2d --mesh-out ply --steps 1 --out flat",
                "--mesh-out makes surfaces of three-dimensional water, and " + std::string(CURLEW_ASSETS_DIR) +
                    "/scenes/dam_break_2d.json has two dimensions");
}

TEST_CASE("render refuses a colour that particle files do not have") {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", R"({"curlew": 1, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
    "particle_radius": 0.05, "fluid": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 1]}}],
    "look": {"colour_by": "vorticity"}})");
  run_in(folder.path(), "run scene.json --steps 1 --particles-out vtk", "run");
  check_refused(folder, "render run",
                "particle files do not have vorticity, expected look.colour_by none, speed, height or density; give "
                "another with --view");
}
