#include "experiments/campaign/plan/estimate.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "experiments/campaign/plan/budget_use.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/spec/first_design.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

constexpr double kMeasured = 1.5;  // [s] of the processor, of all experiments together

// Cost goes with the number of grain steps, nearly whatever the number of grains, so a smaller heap
// tells the speed, over most of its test: grains that fall cost more than grains that lie. In time
// of the processor, which other work does not lengthen.
double MeasureSpeed(rigs::Case rig_case, std::int64_t num_grains, double measured) {
  constexpr double kEnoughGrains = 3000;
  const double reduction = std::cbrt(static_cast<double>(num_grains) / kEnoughGrains);
  rig_case.coarse_graining.scale_factor *= std::max(1.0, reduction);
  rig_case.threads = 1;
  const std::unique_ptr<rigs::Rig> rig = rigs::MakeRig(rig_case);
  const auto now = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  const double start = now();
  double seconds = 0;
  bool more = true;
  const double before = rig->Progress().particle_steps;
  while (more && seconds < measured) {
    more = rig->Advance();
    seconds = now() - start;
  }
  return (rig->Progress().particle_steps - before) / seconds;
}

// All but its core time.
RunEstimate SizeOfRun(const rigs::Case& rig_case) {
  // Peak resident memory of runs with 6,000, 48,000 and 280,000 grains (20, 46 and 193 MB).
  constexpr double kProgram = 16e6;
  constexpr double kGrain = 650;
  const rigs::CaseSize size = rigs::EstimateCase(rig_case);
  return {.num_grains = size.num_grains,
          .mean_diameter = size.mean_diameter,
          .time_step = size.time_step,
          .num_steps = size.simulated_time / size.time_step,
          .grain_steps = size.grain_time / size.time_step,
          .memory = kProgram + kGrain * static_cast<double>(size.num_grains)};
}

double GrainStepsAt(const CampaignSpec& spec, const Eigen::VectorXd& point,
                    const TrialEstimate& trial) {
  return SizeOfRun(CaseAt(spec, point, trial.experiment, trial.scale_factor)).grain_steps;
}

// Whether the grain steps go with it: as √(Y/ρ)/d⁴, and as the mass. What else shortens a step does
// so in a corner of the ranges only.
bool SetsTheCost(const std::string& parameter) {
  return IsOfBulk(parameter) || parameter == "density" || parameter == "youngs_modulus";
}

// The most grain steps at the ends of the ranges, over those in the middle.
double AtEnds(const CampaignSpec& spec, const TrialEstimate& trial) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  const std::vector<int> free = space.Free();
  const Eigen::VectorXd middle =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(free.size()), 0.5);
  Eigen::VectorXd corner = middle;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!SetsTheCost(space.parameters[static_cast<std::size_t>(free[i])].name)) continue;
    const auto k = static_cast<Eigen::Index>(i);
    corner[k] = 0;
    const double low = GrainStepsAt(spec, corner, trial);
    corner[k] = 1;
    if (low > GrainStepsAt(spec, corner, trial)) corner[k] = 0;
  }
  if (corner == middle) return 1;
  return std::max(1.0, GrainStepsAt(spec, corner, trial) / trial.grain_steps);
}

TrialEstimate EstimateTrial(const CampaignSpec& spec, int experiment, double scale_factor) {
  TrialEstimate trial{SizeOfRun(TypicalCase(spec, experiment, scale_factor)), experiment,
                      scale_factor};
  trial.at_ends = AtEnds(spec, trial);
  return trial;
}

// One replicate of a candidate, at every experiment; none where nothing is confirmed.
std::vector<TrialEstimate> ConfirmingTrials(const CampaignSpec& spec,
                                            const std::vector<double>& speeds) {
  std::vector<TrialEstimate> trials;
  if (MostConfirming(spec) == 0) return trials;
  for (std::size_t e = 0; e < speeds.size(); ++e) {
    trials.push_back(EstimateTrial(spec, static_cast<int>(e), spec.ConfirmScaleFactor()));
    trials.back().core_seconds = trials.back().grain_steps / speeds[e];
  }
  return trials;
}

// Of one set by every experiment at the largest scale factor [s].
double CoarsestSet(const CampaignSpec& spec, const std::vector<TrialEstimate>& trials) {
  const double coarsest = spec.coarse_graining.Levels().front();
  double sum = 0;
  for (const TrialEstimate& trial : trials) {
    if (trial.scale_factor == coarsest) sum += trial.core_seconds;
  }
  return sum * spec.replicates;
}

// How many trials of the search so much core time buys: those of the design at the largest scale
// factor, then trials that cost as much as one between the scale factors.
double NumBought(const CampaignSpec& spec, const std::vector<TrialEstimate>& trials,
                 double core_time) {
  double logs = 0;
  for (const TrialEstimate& trial : trials) logs += std::log(trial.core_seconds);
  const double typical = std::exp(logs / static_cast<double>(trials.size()));
  const double set = CoarsestSet(spec, trials);
  const double num_sets = std::min<double>(DesignSets(spec), core_time / set);
  const auto of_a_set = static_cast<double>(ExperimentsOf(spec).size()) * spec.replicates;
  return num_sets * of_a_set + (core_time - num_sets * set) / typical;
}

// How many trials the search makes, at most.
double NumSearchTrials(const CampaignSpec& spec, const std::vector<TrialEstimate>& trials) {
  const BudgetOptions& budget = spec.budget;
  if (!budget.core_time) return budget.simulations;
  const double bought = NumBought(spec, trials, *budget.core_time);
  return budget.simulations > 0 ? std::min<double>(bought, budget.simulations) : bought;
}

// [s] of a core. The n-th proposal takes some n times 3 ms: measured with images, at 116 trials of
// two experiments and five parameters (19 s in all), and beyond with `optimizer_proposal_time
// 1000`.
double ProposalTime(double num_trials) {
  constexpr double kSecondsPerTrialSquared = 0.003;
  return 0.5 * kSecondsPerTrialSquared * num_trials * num_trials;
}

}  // namespace

RunEstimate EstimateRun(const rigs::Case& rig_case) {
  RunEstimate run = SizeOfRun(rig_case);
  run.core_seconds = run.grain_steps / MeasureSpeed(rig_case, run.num_grains, kMeasured);
  return run;
}

TrialEstimates EstimateTrials(const CampaignSpec& spec) {
  TrialEstimates e;
  const auto num_experiments = static_cast<int>(ExperimentsOf(spec).size());
  const std::vector<double> levels = spec.coarse_graining.Levels();
  for (int i = 0; i < num_experiments; ++i) {
    const std::size_t first = e.trials.size();
    for (const double factor : levels) e.trials.push_back(EstimateTrial(spec, i, factor));
    e.grain_steps_per_s.push_back(MeasureSpeed(TypicalCase(spec, i, levels.front()),
                                               e.trials[first].num_grains,
                                               kMeasured / num_experiments));
    for (std::size_t t = first; t < e.trials.size(); ++t) {
      e.trials[t].core_seconds = e.trials[t].grain_steps / e.grain_steps_per_s.back();
    }
  }
  return e;
}

int MostSearched(const CampaignSpec& spec) {
  if (spec.budget.simulations == 0) return 0;
  const int sets =
      (spec.budget.simulations - spec.noise.replicates + spec.replicates - 1) / spec.replicates;
  return spec.noise.replicates + sets * spec.replicates;
}

int MostConfirming(const CampaignSpec& spec) {
  return spec.confirm.MostTrials() * static_cast<int>(ExperimentsOf(spec).size());
}

CampaignEstimate EstimateCampaign(const CampaignSpec& spec) {
  CampaignEstimate e{EstimateTrials(spec)};
  const double dearest =
      std::ranges::max(e.trials, {}, &TrialEstimate::MostCoreSeconds).MostCoreSeconds();
  e.confirming = ConfirmingTrials(spec, e.grain_steps_per_s);
  double confirm_time = 0;  // [s], of one replicate by every experiment
  for (const TrialEstimate& trial : e.confirming) confirm_time += trial.MostCoreSeconds();
  const int num_search = MostSearched(spec);
  if (num_search > 0) e.num_trials = num_search + MostConfirming(spec);
  e.num_workers = MostAtATime(spec, NumCores());
  const double search = num_search > 0 ? dearest * num_search : spec.budget.core_time.value_or(0);
  e.proposal_time = ProposalTime(NumSearchTrials(spec, e.trials));
  // More workers than this machine has cores wait for one another (CoresWarning).
  const bool is_here = spec.runner.kind == RunnerKind::kLocal;
  const int at_once =
      is_here ? std::clamp(NumCores() / CoresOfTrial(spec), 1, e.num_workers) : e.num_workers;
  const int cores = at_once * spec.threads;
  const double confirm = confirm_time * spec.confirm.MostTrials();
  // Proposals come one after another, and nothing is over before a trial and its confirmation.
  const double core_time = std::min(search, spec.budget.core_time.value_or(search)) + confirm;
  const double least = (dearest + confirm_time) / spec.threads;
  e.campaign_time = std::max(core_time / cores, least) + e.proposal_time;
  if (spec.budget.wall_clock) {
    // What runs when it is over runs to its end, and is confirmed.
    const double after = dearest / spec.threads + confirm / cores;
    e.campaign_time = std::min(e.campaign_time, *spec.budget.wall_clock + after);
    e.num_in_wall_clock = std::floor(NumBought(spec, e.trials, *spec.budget.wall_clock * cores));
  }
  e.afterwards = AfterwardsLeft(spec, std::min(core_time, e.campaign_time * cores), at_once);
  return e;
}

}  // namespace talus::campaign
