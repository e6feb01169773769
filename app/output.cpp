#include "app/output.h"

#include <cstdio>
#include <filesystem>

#include "app/setup.h"
#include "sim/core/error.h"
#include "sim/io/mesh_files.h"
#include "sim/io/particle_files.h"
#include "sim/turbulence/sub_particles_fujisawa2011.h"

namespace curlew {
namespace {

std::string numbered(const std::string& folder, const char* kind, std::int64_t frame, const std::string& extension) {
  char name[32];
  std::snprintf(name, sizeof name, "%06lld.", static_cast<long long>(frame));
  return folder + "/" + kind + "/" + name + extension;
}

}  // namespace

FrameOutput::FrameOutput(const RunOptions& options, const Scene& scene, const std::string& folder,
                         std::optional<std::array<double, 2>> range)
    : folder_(folder),
      format_(options.particles_out),
      mesh_format_(options.mesh_out),
      png_(options.frames),
      split_(options.sub_particles),
      range_(range) {
  if (!mesh_format_.empty() && scene.dimension != 3) {
    throw InputError("--mesh-out makes surfaces of three-dimensional water, and " + scene.file.string() +
                     " has two dimensions");
  }
  if (split_ && format_.empty()) {
    throw InputError("--sub-particles is about particle files; give --particles-out too, for example vtk");
  }
  view_.camera = scene.camera;
  view_.look = scene.look;
  if (scene.look.range) range_ = scene.look.range;
  if (!options.frames && options.video.empty()) return;
  const bool coloured = shown_colour(scene.look, scene.dimension) != "none";
  if (const std::string warning = coloured ? colour_warning(scene) : ""; !warning.empty() && !options.quiet) {
    std::fprintf(stderr, "curlew: warning: %s\n", warning.c_str());
  }
  geometry_ = make_geometry(scene);
  if (!options.video.empty()) {
    if (std::filesystem::is_directory(options.video)) {
      throw InputError("cannot write the video " + options.video + ": it is a folder, expected a file such as " +
                       options.video + "/video.mp4");
    }
    video_ = std::make_unique<VideoWriter>(options.video, options.width, options.height, options.fps);
  }
  context_ = std::make_unique<OffscreenContext>();
  renderer_ = std::make_unique<Renderer>(options.width, options.height);
  if (!png_) return;
  std::filesystem::create_directories(folder_ + "/frames");
  frames_ = std::make_unique<FrameWriter>();
}

FieldSet FrameOutput::demand() const {
  FieldSet fields;
  if (!mesh_format_.empty()) fields = fields | surface_demand();
  if (renderer_) fields = fields | shown_demand(view_.look, geometry_->dimension);
  return fields;
}

void FrameOutput::write(const World& world, std::int64_t frame) {
  if (!format_.empty()) write_particles(world, frame);
  if (!mesh_format_.empty()) write_mesh(world, frame);
  if (!renderer_) return;
  const Frame picture = make_shown_frame(world, view_.look, geometry_, surface_);
  if (!view_.look.range && !picture.value.empty()) {
    const auto own = curlew::colour_range(picture);
    range_ = range_ ? united(*range_, own) : own;
  }
  ViewSettings view = view_;
  view.look.range = range_;
  Image image = renderer_->draw(picture, view);
  if (video_) video_->write(image);
  if (frames_) frames_->write(numbered(folder_, "frames", frame, "png"), std::move(image));
}

void FrameOutput::write_particles(const World& world, std::int64_t frame) const {
  const Fields& f = world.fields;
  if (!split_) {
    write_particle_file({world.time, world.step, f.id, f.position, f.velocity, f.density, {}}, frame);
    return;
  }
  const std::vector<Vec3> whole(f.sub_particles.empty() ? world.count : 0);
  const SplitParticles parts =
      split_particles({f.position, f.id, f.sub_particles.empty() ? std::span<const Vec3>(whole) : f.sub_particles,
                       world.time, world.scene.particle_radius});
  const auto of_parent = [&](const auto& field) {
    std::vector<std::remove_cvref_t<decltype(field[0])>> values;
    values.reserve(parts.parent.size());
    for (const std::uint32_t i : parts.parent) values.push_back(field[i]);
    return values;
  };
  const auto id = of_parent(f.id);
  const auto velocity = of_parent(f.velocity);
  const auto density = of_parent(f.density);
  std::vector<float> radius;
  for (const float share : parts.share) radius.push_back(share * static_cast<float>(world.scene.particle_radius));
  write_particle_file({world.time, world.step, id, parts.position, velocity, density, {{"radius", radius}}}, frame);
}

void FrameOutput::write_particle_file(const ParticleExport& particles, std::int64_t frame) const {
  const std::string file = numbered(folder_, "particles", frame, format_);
  if (format_ == "vtk") write_vtk(file, particles);
  if (format_ == "ply") write_ply(file, particles);
  if (format_ == "bgeo") write_bgeo(file, particles);
}

void FrameOutput::write_mesh(const World& world, std::int64_t frame) {
  const Fields& f = world.fields;
  const SurfaceMesh& mesh =
      surface_.make({f.position, f.density, f.velocity, f.sub_particles, f.id, world.time}, world.scene);
  const std::string file = numbered(folder_, "mesh", frame, mesh_format_);
  if (mesh_format_ == "ply") write_mesh_ply(file, mesh, world.time, world.step);
  if (mesh_format_ == "obj") write_mesh_obj(file, mesh, world.time, world.step);
}

void FrameOutput::settle() {
  if (frames_) frames_->finish();
}

void FrameOutput::finish() {
  settle();
  if (video_) video_->finish();
}

}  // namespace curlew
