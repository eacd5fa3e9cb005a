#include "experiments/trials/engines/tube_numbers.h"

#include <algorithm>
#include <string>

#include "base/sphere.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/phased/repose.h"

namespace talus::trials {
namespace {

journal::MetricRecord RecordOf(const rigs::Reading& reading) {
  const std::string name = rigs::MetricName(reading.observable);
  return {.name = name,
          .value = reading.value,
          .unit = rigs::UnitOfObservable(name),
          .undefined = reading.undefined};
}

}  // namespace

std::vector<engine::Particle> ParticlesOf(const std::vector<base::Sphere>& spheres) {
  std::vector<engine::Particle> particles(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    particles[i].position = spheres[i].position;
    particles[i].radius = spheres[i].radius;
  }
  return particles;
}

std::vector<journal::MetricRecord> TubeNumbersOf(const rigs::Case& rig_case, double plate,
                                                 const std::vector<base::Sphere>& heap) {
  double volume = 0, height = 0;
  for (const base::Sphere& s : heap) {
    volume += base::SphereVolume(s.radius);
    height = std::max(height, s.position.z + s.radius);
  }
  const double on_plate = volume * rig_case.powder.material.density;
  const double fallen = std::max(0.0, rig_case.powder.mass - on_plate);
  std::vector<journal::MetricRecord> numbers{RecordOf({rigs::Observable::kMassOnPlate, on_plate}),
                                             RecordOf({rigs::Observable::kMassFallen, fallen}),
                                             RecordOf({rigs::Observable::kHeight, height})};
  const double mean = rigs::EstimatePowder(rig_case).mean_diameter;  // as our own rig takes it
  for (const rigs::Reading& reading :
       rigs::ReposeReadings(ParticlesOf(heap), {.diameter = plate, .grain_diameter = mean})) {
    numbers.push_back(RecordOf(reading));
  }
  return numbers;
}

}  // namespace talus::trials
