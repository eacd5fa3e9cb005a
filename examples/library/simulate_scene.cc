// Simulates a scene: 200 grains fall from a loose packing onto a floor inside a tube.
#include <talus/base/error.h>
#include <talus/engine/scene/filling.h>
#include <talus/engine/simulation.h>

#include <cstdint>
#include <iostream>
#include <vector>

namespace engine = talus::engine;

namespace {

constexpr double kTubeRadius = 4e-3;  // [m]

engine::Scene GrainsInTube() {
  engine::Scene scene;
  scene.materials.push_back(
      {.density = 2500, .youngs_modulus = 1e7, .restitution = 0.6, .sliding_friction = 0.4});
  scene.walls.push_back({.name = "floor", .shape = engine::Plane{}});
  scene.walls.push_back(
      {.name = "tube", .shape = engine::OpenCylinder{.radius = kTubeRadius, .length = 0.1}});

  const std::vector<double> radii(200, 5e-4);  // [m]
  engine::FillRequest request;
  request.region = {.base = {0, 0, 1e-3}, .diameter = 2 * kTubeRadius};
  request.solid_fraction = 0.3;
  const engine::Filling filling = engine::Fill(radii, request);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    scene.particles.push_back(
        {.id = static_cast<std::int64_t>(i), .radius = radii[i], .position = filling.positions[i]});
  }
  return scene;
}

}  // namespace

int main() {
  try {
    engine::Simulation simulation(GrainsInTube());
    const double start = simulation.Energies().potential;  // [J]
    simulation.Advance(static_cast<std::int64_t>(0.1 / simulation.time_step()));
    const double load = -simulation.WallLoads().front().force.z;  // [N]
    std::cout << simulation.num_particles() << " grains, " << simulation.Contacts().size()
              << " contacts after " << simulation.time() << " s\n"
              << "load on the floor: " << load << " N\n"
              << "potential energy released: " << start - simulation.Energies().potential << " J\n";
  } catch (const talus::base::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
