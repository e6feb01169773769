// The solver in a program of your own: ten lines and find_package(curlew).
#include <iostream>

#include "sim/core/passes.h"

int main() {
  curlew::Scene scene;
  scene.domain.max = {1, 1, 1};
  scene.fluid.push_back({curlew::Box{{0, 0, 0}, {0.5, 0.5, 0.5}}, {}});
  curlew::World world = curlew::make_world(scene);
  const curlew::Plan plan = curlew::make_plan(world);
  curlew::prepare(world, plan);
  while (world.time < 0.1) curlew::step(world, plan);
  std::cout << world.count << " particles after " << world.step << " steps: " << world.report.max_speed << " m/s\n";
  return world.report.max_speed > 0.5 && world.report.max_speed < 5 ? 0 : 1;
}
