// A camera that a hand moves: around a target, towards it, and across. In 2D it looks straight on and only moves across
// and nearer.
#pragma once

#include <string_view>

#include "render/camera.h"
#include "sim/scene/scene.h"

namespace curlew {

class Orbit {
 public:
  Orbit() = default;
  // As the scene has its camera, or fitted to the domain.
  Orbit(const Camera& camera, const Domain& domain, int dimension, double aspect);

  // Pixels of a picture `height` pixels high.
  void turn(double dx, double dy, double height);
  void move(double dx, double dy, double height);
  // Notches of a mouse wheel; positive is nearer.
  void zoom(double notches);
  // All of the domain in sight, from where the eye is.
  void fit(const Domain& domain, double aspect);
  // "front", "back", "left", "right", "top", "corner": fitted.
  void look_from(std::string_view side, const Domain& domain, double aspect);

  Camera camera() const;
  double flat_zoom() const { return flat_zoom_; }  // of a 2D picture

 private:
  Vec3d forward() const;
  void aim(Vec3d position, Vec3d target);

  bool flat_ = false;
  Vec3d target_;
  double distance_ = 1, yaw_ = 0, pitch_ = 0;  // m, rad; yaw 0 looks along -z
  double field_of_view_ = 35, flat_zoom_ = 1, flat_height_ = 1;
};

}  // namespace curlew
