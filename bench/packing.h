// The settled packings that engines are compared on, and the scene around them.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "engine/scene.h"

namespace talus::bench {

// Lines "x,y,z,r" [m] below one head line.
inline std::vector<engine::Particle> ReadPacking(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw base::Error("cannot read " + path);
  std::vector<engine::Particle> particles;
  while (std::getline(file, line)) {
    std::istringstream text(line);
    engine::Particle p;
    char comma = 0;
    text >> p.position.x >> comma >> p.position.y >> comma >> p.position.z >> comma >> p.radius;
    if (!text) throw base::Error(path + ": \"" + line + "\" is not x,y,z,r");
    p.id = static_cast<std::int64_t>(particles.size());
    particles.push_back(p);
  }
  return particles;
}

// The tube of 10 mm on its base, and glass-like grains (bench/peers/README.md).
inline engine::Scene TubeScene(std::vector<engine::Particle> particles) {
  engine::Scene scene;
  scene.materials = {{.density = 4386,
                      .youngs_modulus = 26.25e6,
                      .poisson_ratio = 0.342,
                      .restitution = 0.9,
                      .sliding_friction = 0.25,
                      .rolling_friction = 0.1,
                      .rolling_damping = 0.3}};
  scene.particles = std::move(particles);
  scene.walls = {
      {.name = "tube",
       .shape =
           engine::OpenCylinder{.base = {}, .axis = {0, 0, 1}, .radius = 5e-3, .length = 0.03}},
      {.name = "base", .shape = engine::Disc{.center = {}, .normal = {0, 0, 1}, .radius = 5e-3}}};
  return scene;
}

}  // namespace talus::bench
