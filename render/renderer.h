// Draws a Frame: particles as lit spheres or as clear water, bodies, walls and floor, with legend and time. Clear water
// (look.style) comes from frame.surface, and where there is none from the particles. Needs a current OpenGL 4.5 context
// (OffscreenContext or a window's) and leaves no state behind but the bound framebuffer.
#pragma once

#include <memory>
#include <optional>

#include "render/image.h"
#include "sim/core/frame.h"
#include "sim/scene/scene.h"

namespace curlew {

struct ViewSettings {
  Camera camera;
  Look look;  // without look.range, colours span what this one frame holds
  // Drawn radius over particle radius, the same for all. Otherwise a little more than 1 in the water, which closes the
  // gaps, and less for drops that fly alone (render/drop_size.h).
  std::optional<double> particle_scale;
  double flat_zoom = 1;  // of a 2D picture: 2 shows half as much
  bool show_bodies = true;
};

class Renderer {
 public:
  // supersample n draws n x n pixels for each one of the picture, at n^2 the cost: 2 for title pictures. 0 chooses 1,
  // or 2 for pictures so small (up to 640x360) that it costs no more than a usual one.
  Renderer(int width, int height, int supersample = 0);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // Throws InputError for a look or a camera that makes no sense, GraphicsError where OpenGL fails.
  Image draw(const Frame& frame, const ViewSettings& settings);

  // The same in two steps: a window shows texture() and need not read anything back. A draft has a quarter of the
  // pixels and leaves out what is deep in the water: four times as fast on a processor, for motion. Legend and lines
  // are sharp.
  enum class Detail { full, draft };
  void render(const Frame& frame, const ViewSettings& settings, Detail detail = Detail::full);
  Image read() const;
  unsigned texture() const;  // RGBA8, sRGB values, first row at the bottom

  void resize(int width, int height);
  int width() const;
  int height() const;

  // The point of the last picture's scene under a pixel (of the picture, top left is (0, 0)), or nothing where only
  // background is. For picking, and for tests.
  std::optional<Vec3d> point_at(int x, int y) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace curlew
