#include "experiments/campaign/estimate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "experiments/campaign/console.h"
#include "experiments/rigs/lifted_tube/heap_rig.h"
#include "experiments/trials/simulate/run_log.h"

namespace talus::experiments {
namespace {

// Cost goes with the number of grain steps, whatever the number of grains, so a small heap tells
// the speed; filling a large one would take longer than the measurement.
double MeasureSpeed(HeapCase heap_case, std::int64_t num_grains) {
  constexpr double kEnoughGrains = 2000;
  constexpr double kSeconds = 1;
  const double reduction = std::cbrt(static_cast<double>(num_grains) / kEnoughGrains);
  heap_case.coarse_graining.scale_factor *= std::max(1.0, reduction);
  heap_case.threads = 1;
  HeapRig rig(heap_case);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  double seconds = 0;
  bool more = true;
  const double before = rig.state().particle_steps;
  while (more && seconds < kSeconds) {
    more = rig.Advance();
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return (rig.state().particle_steps - before) / seconds;
}

double GrainSteps(const HeapSize& size) {
  return static_cast<double>(size.num_grains) * size.simulated_time / size.time_step;
}

HeapCase ConfirmingCase(const CampaignSpec& spec, HeapCase heap_case) {
  double& factor = heap_case.coarse_graining.scale_factor;
  factor = spec.confirm.scale_factor.value_or(factor);
  return heap_case;
}

}  // namespace

CampaignEstimate EstimateCampaign(const CampaignSpec& spec) {
  const HeapCase heap_case = TypicalCase(spec);
  const HeapSize size = EstimateHeap(heap_case);
  CampaignEstimate e;
  e.num_grains = size.num_grains;
  e.mean_diameter = size.mean_diameter;
  e.time_step = size.time_step;
  e.num_steps = size.simulated_time / size.time_step;
  e.grain_steps_per_s = MeasureSpeed(heap_case, size.num_grains);
  e.trial_time = GrainSteps(size) / e.grain_steps_per_s;
  e.confirm_time = GrainSteps(EstimateHeap(ConfirmingCase(spec, heap_case))) / e.grain_steps_per_s;
  const int num_confirming = spec.confirm.candidates * spec.confirm.replicates;
  e.num_trials = spec.budget.simulations + num_confirming;
  e.num_workers = spec.workers > 0
                      ? spec.workers
                      : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  e.campaign_time =
      (e.trial_time * spec.budget.simulations + e.confirm_time * num_confirming) / e.num_workers;
  return e;
}

std::string EstimateText(const CampaignEstimate& e) {
  return "  a trial           " + std::to_string(e.num_grains) + " grains of " +
         NumberText4(1e3 * e.mean_diameter) + " mm, " + NumberText4(std::round(e.num_steps)) +
         " steps of " + NumberText4(1e6 * e.time_step) + " us\n  this machine      " +
         NumberText4(1e-6 * e.grain_steps_per_s) +
         " million grain steps a second on a core\n  time              about " +
         DurationText(e.trial_time) + " a trial, " +
         (e.confirm_time == e.trial_time ? ""
                                         : DurationText(e.confirm_time) + " a confirming one, ") +
         DurationText(e.campaign_time) + " for " + std::to_string(e.num_trials) + " trials, " +
         std::to_string(e.num_workers) + " at a time\n";
}

}  // namespace talus::experiments
