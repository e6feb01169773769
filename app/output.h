// What a run leaves behind each frame: pictures, video, particle files.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/options.h"
#include "render/colour_range.h"
#include "render/context.h"
#include "render/frame_writer.h"
#include "render/renderer.h"
#include "render/video.h"
#include "sim/core/frame.h"
#include "sim/core/world.h"
#include "sim/io/particle_files.h"
#include "sim/surface/surface.h"

namespace curlew {

class FrameOutput {
 public:
  // Makes what is asked for: the OpenGL context where there are pictures, ffmpeg where there is a video. `range` is
  // the colour scale so far, of a run that is resumed.
  FrameOutput(const RunOptions& options, const Scene& scene, const std::string& folder,
              std::optional<std::array<double, 2>> range);

  // Fields that the frames show.
  FieldSet demand() const;
  bool wants_frames() const { return renderer_ != nullptr || !format_.empty() || !mesh_format_.empty(); }
  const GraphicsInfo* graphics() const { return context_ ? &context_->info() : nullptr; }
  std::optional<std::array<double, 2>> colour_range() const { return range_; }

  void write(const World& world, std::int64_t frame);
  // Waits until the pictures so far are on disk.
  void settle();
  // The same, and ends the video.
  void finish();

 private:
  void write_particle_file(const ParticleExport& particles, std::int64_t frame) const;
  void write_particles(const World& world, std::int64_t frame) const;
  void write_mesh(const World& world, std::int64_t frame);

  std::string folder_, format_, mesh_format_;
  bool png_ = false, split_ = false;
  ViewSettings view_;
  std::optional<std::array<double, 2>> range_;
  std::shared_ptr<const FrameGeometry> geometry_;
  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Renderer> renderer_;
  SurfaceMaker surface_;  // empty while nobody asks for it
  std::unique_ptr<FrameWriter> frames_;
  std::unique_ptr<VideoWriter> video_;
};

}  // namespace curlew
