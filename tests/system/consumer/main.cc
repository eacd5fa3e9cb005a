// What a program that uses the installed libraries looks like: a ball dropped on a plate.
#include <iostream>

#include "engine/simulation.h"

int main() {
  talus::engine::Scene scene;
  scene.materials.emplace_back();
  scene.particles.push_back({.radius = 1e-3, .position = {0, 0, 2e-3}});
  scene.walls.push_back({.name = "floor", .shape = talus::engine::Plane{}, .motion = {}});
  talus::engine::Simulation simulation(scene);
  simulation.Advance(100);
  std::cout << simulation.Particles().front().position.z << '\n';
  return simulation.Particles().front().position.z < 2e-3 ? 0 : 1;
}
