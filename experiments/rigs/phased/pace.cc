#include "experiments/rigs/phased/pace.h"

#include <algorithm>
#include <cmath>

#include "engine/run/run.h"

namespace talus::rigs {

std::int64_t CheckSteps(const Case& rig_case, double time_step) {
  const double interval =
      0.5 * std::sqrt(EstimatePowder(rig_case).mean_diameter / rig_case.gravity);
  return std::max<std::int64_t>(1, std::llround(interval / time_step));
}

Slice AdvanceSlice(engine::Simulation& simulation, const SliceEnd& end) {
  double until = end.until;
  if (end.pour != nullptr) {
    end.pour->Advance(simulation, *end.pour_state);
    until = std::min(until, end.pour->NextTime(*end.pour_state));
  }
  const double to_go = std::ceil((until - simulation.time()) / simulation.time_step());
  const std::int64_t num_particles = simulation.num_particles();
  std::int64_t steps = end.check_steps - simulation.step() % end.check_steps;
  steps = std::min(steps, engine::SliceSteps(num_particles));
  if (to_go < static_cast<double>(steps)) steps = std::max(1, static_cast<int>(to_go));
  simulation.Advance(steps);
  return {.steps = steps,
          .particle_steps = static_cast<double>(steps) * static_cast<double>(num_particles)};
}

// As seen in runs of grains of 0.4 and 0.8 mm, cohesive or not.
double SettlingTime(const Case& c) { return c.filling.kind == FillingKind::kPour ? 0.07 : 0.05; }

double SimulatedTime(const Case& c, double test_time) {
  const double taps = c.filling.taps ? c.filling.taps->count * c.filling.taps->interval : 0;
  return SettlingTime(c) + test_time + taps;
}

}  // namespace talus::rigs
