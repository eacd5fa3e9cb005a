#include "experiments/rigs/pace.h"

#include <algorithm>
#include <cmath>

#include "engine/run/run.h"

namespace talus::rigs {

std::int64_t CheckSteps(const HeapCase& heap_case, double time_step) {
  const double interval =
      0.5 * std::sqrt(EstimateHeap(heap_case).mean_diameter / heap_case.gravity);
  return std::max<std::int64_t>(1, std::llround(interval / time_step));
}

std::int64_t StepsOfSlice(const engine::Simulation& simulation, std::int64_t check_steps,
                          double until) {
  const double to_go = std::ceil((until - simulation.time()) / simulation.time_step());
  std::int64_t steps = check_steps - simulation.step() % check_steps;
  steps = std::min(steps, engine::SliceSteps(simulation.num_particles()));
  if (to_go < static_cast<double>(steps)) steps = std::max(1, static_cast<int>(to_go));
  return steps;
}

}  // namespace talus::rigs
