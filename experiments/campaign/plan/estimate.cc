#include "experiments/campaign/plan/estimate.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <optional>

#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/number_text.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"
#include "optimizer/designs/posterior_design.h"

namespace talus::campaign {
namespace {

// Cost goes with the number of grain steps, nearly whatever the number of grains, so a smaller heap
// tells the speed, over most of its test: grains that fall cost more than grains that lie. In time
// of the processor, which other work does not lengthen.
double MeasureSpeed(rigs::Case rig_case, std::int64_t num_grains) {
  constexpr double kEnoughGrains = 3000;
  constexpr double kSeconds = 1.5;
  const double reduction = std::cbrt(static_cast<double>(num_grains) / kEnoughGrains);
  rig_case.coarse_graining.scale_factor *= std::max(1.0, reduction);
  rig_case.threads = 1;
  const std::unique_ptr<rigs::Rig> rig = rigs::MakeRig(rig_case);
  const auto now = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  const double start = now();
  double seconds = 0;
  bool more = true;
  const double before = rig->Progress().particle_steps;
  while (more && seconds < kSeconds) {
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

TrialEstimate EstimateTrial(const CampaignSpec& spec, int experiment, double scale_factor) {
  return {SizeOfRun(TypicalCase(spec, experiment, scale_factor)), experiment, scale_factor};
}

// One replicate of a candidate, at every experiment; none where nothing is confirmed.
std::vector<TrialEstimate> ConfirmingTrials(const CampaignSpec& spec, double speed) {
  std::vector<TrialEstimate> trials;
  if (MostConfirming(spec) == 0) return trials;
  for (int e = 0; e < static_cast<int>(ExperimentsOf(spec).size()); ++e) {
    trials.push_back(EstimateTrial(spec, e, spec.ConfirmScaleFactor()));
    trials.back().core_seconds = trials.back().grain_steps / speed;
  }
  return trials;
}

// How many trials the search makes, at most: without a number, trials that cost as much as one
// between the scale factors.
double NumSearchTrials(const BudgetOptions& budget, const std::vector<TrialEstimate>& trials) {
  double logs = 0;
  for (const TrialEstimate& trial : trials) logs += std::log(trial.core_seconds);
  const double typical = std::exp(logs / static_cast<double>(trials.size()));
  const double bought = budget.core_time ? *budget.core_time / typical : budget.simulations;
  return budget.simulations > 0 ? std::min<double>(bought, budget.simulations) : bought;
}

// [s] of a core. The n-th proposal takes some n times 3 ms: measured with images, at 116 trials of
// two experiments and five parameters (19 s in all), and beyond with `optimizer_proposal_time
// 1000`.
double ProposalTime(double num_trials) {
  constexpr double kSecondsPerTrialSquared = 0.003;
  return 0.5 * kSecondsPerTrialSquared * num_trials * num_trials;
}

// What the budget would buy, if it were all spent on such trials.
std::string BoughtText(const BudgetOptions& budget, const TrialEstimate& trial) {
  std::string text;
  if (budget.core_time) {
    text += "; " + base::DurationText(*budget.core_time) + " of core time buy " +
            std::to_string(static_cast<std::int64_t>(*budget.core_time / trial.core_seconds));
  }
  if (budget.simulations > 0) {
    text += "; " + std::to_string(budget.simulations) + " simulations take " +
            base::DurationText(budget.simulations * trial.core_seconds) + " of core time";
  }
  return text;
}

std::string TrialLines(const CampaignSpec& spec, const CampaignEstimate& e) {
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  std::string text;
  for (const TrialEstimate& trial : e.trials) {
    const std::string& name = experiments[static_cast<std::size_t>(trial.experiment)].name;
    text += "  scale factor " + base::ShortNumber(trial.scale_factor) +
            (experiments.size() > 1 ? " (" + name + ")" : "") + ": " +
            std::to_string(trial.num_grains) + " grains of " +
            base::ShortNumber(1e3 * trial.mean_diameter) + " mm, " +
            base::ShortNumber(std::round(trial.num_steps)) + " steps, " +
            base::ShortNumber(std::round(1e-6 * trial.memory)) + " MB, " +
            base::DurationText(trial.core_seconds) + " of a core" + BoughtText(spec.budget, trial) +
            "\n";
  }
  return text;
}

std::string TimeText(const CampaignEstimate& e) {
  const double trial_time = e.trials.front().core_seconds;
  const double confirm_time = e.confirming.empty() ? trial_time : e.confirming.front().core_seconds;
  return "  time              about " + base::DurationText(trial_time) + " a trial, " +
         (confirm_time == trial_time ? ""
                                     : base::DurationText(confirm_time) + " a confirming one, ") +
         base::DurationText(e.campaign_time) + " for " + std::to_string(e.num_trials) +
         " trials, " + std::to_string(e.num_workers) + " at a time\n";
}

// Trials that would be stopped by their time cap.
std::vector<std::string> TooLongTrials(const CampaignSpec& spec, const CampaignEstimate& e) {
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  std::vector<std::string> texts;
  const std::vector<double> levels = spec.coarse_graining.Levels();
  std::vector<TrialEstimate> all = e.trials;
  std::ranges::copy_if(e.confirming, std::back_inserter(all), [&](const TrialEstimate& trial) {
    return std::ranges::find(levels, trial.scale_factor) == levels.end();
  });
  for (const TrialEstimate& trial : all) {
    const double takes = trial.core_seconds / spec.threads;  // [s]
    if (takes <= spec.trial_time_cap) continue;
    texts.push_back(experiments[static_cast<std::size_t>(trial.experiment)].name +
                    " at scale factor " + base::ShortNumber(trial.scale_factor) +
                    ": a trial takes about " + base::DurationText(takes) +
                    ", and fails at the trial_time_cap of " +
                    base::DurationText(spec.trial_time_cap) +
                    ": raise it, or take coarser grains or more threads");
  }
  return texts;
}

// Where the core time buys few trials at the smallest scale factor.
std::optional<std::string> FewFineTrials(const CampaignSpec& spec, const CampaignEstimate& e) {
  // Ten heaps show their own scatter to a quarter: 1/√(2 · 9).
  constexpr double kEnoughFineTrials = 10;
  if (!spec.budget.core_time || spec.coarse_graining.Levels().size() < 2) return std::nullopt;
  const double finest = spec.coarse_graining.Finest();
  double each = 0;  // [s] of one trial of every experiment at the smallest scale factor
  for (const TrialEstimate& trial : e.trials) {
    if (trial.scale_factor == finest) each += trial.core_seconds;
  }
  const double num_fine = std::floor(*spec.budget.core_time / each);
  if (num_fine >= kEnoughFineTrials) return std::nullopt;
  return "even if all of it went there, the core time buys only " +
         base::Counted(static_cast<long long>(num_fine), "simulation") +
         " of each experiment at scale factor " + base::ShortNumber(finest) +
         ", and the answer rests on coarser grains: give it " +
         base::DurationText(2 * kEnoughFineTrials * each) + ", or leave that scale factor out";
}

// Trials of the search; 0 where no number ends it. A set that was begun gets all its replicates.
int MostSearched(const CampaignSpec& spec) {
  if (spec.budget.simulations == 0) return 0;
  const int sets =
      (spec.budget.simulations - spec.noise.replicates + spec.replicates - 1) / spec.replicates;
  return spec.noise.replicates + sets * spec.replicates;
}

// Where the simulations end with those at coarser scale factors.
std::optional<std::string> NoFineTrials(const CampaignSpec& spec) {
  const auto finer = static_cast<int>(spec.coarse_graining.Levels().size()) - 1;
  if (spec.budget.simulations == 0 || finer == 0 || spec.HasOwnProposer()) return std::nullopt;
  const int design =
      optimizer::PosteriorDesignSize(SpaceOf(spec).MakeDomain(), spec.strategy.num_initial);
  const int least =
      static_cast<int>(ExperimentsOf(spec).size()) * (design + optimizer::kFewestFinerSets * finer);
  if (MostSearched(spec) >= least * spec.replicates + spec.noise.replicates) return std::nullopt;
  return base::Counted(spec.budget.simulations, "simulation") + " end before " +
         base::Counted(optimizer::kFewestFinerSets, "set") +
         " of each experiment are simulated at scale factor " +
         base::ShortNumber(spec.coarse_graining.Finest()) +
         ", and the answer rests on coarser grains: give it " +
         std::to_string(least * spec.replicates + spec.noise.replicates) +
         " at least, or leave that scale factor out";
}

std::optional<std::string> FewInWallClock(const CampaignSpec& spec, const CampaignEstimate& e) {
  constexpr double kEnough = 10;
  if (!e.num_in_wall_clock || *e.num_in_wall_clock >= kEnough) return std::nullopt;
  if (spec.budget.simulations > 0 && *e.num_in_wall_clock >= spec.budget.simulations) {
    return std::nullopt;
  }
  return "budget.wall_clock ends the search after about " +
         base::Counted(static_cast<long long>(*e.num_in_wall_clock), "simulation") +
         ": give it more than " + base::DurationText(*spec.budget.wall_clock);
}

}  // namespace

RunEstimate EstimateRun(const rigs::Case& rig_case) {
  RunEstimate run = SizeOfRun(rig_case);
  run.core_seconds = run.grain_steps / MeasureSpeed(rig_case, run.num_grains);
  return run;
}

std::string RunText(const RunEstimate& run) {
  return std::to_string(run.num_grains) + " grains of " +
         base::ShortNumber(1e3 * run.mean_diameter) + " mm, " +
         base::ShortNumber(std::round(run.num_steps)) + " steps of " +
         base::ShortNumber(1e6 * run.time_step) + " us, " +
         base::ShortNumber(std::round(1e-6 * run.memory)) + " MB";
}

TrialEstimates EstimateTrials(const CampaignSpec& spec) {
  TrialEstimates e;
  for (int i = 0; i < static_cast<int>(ExperimentsOf(spec).size()); ++i) {
    for (const double factor : spec.coarse_graining.Levels()) {
      e.trials.push_back(EstimateTrial(spec, i, factor));
    }
  }
  const TrialEstimate& first = e.trials.front();
  e.grain_steps_per_s = MeasureSpeed(TypicalCase(spec, 0, first.scale_factor), first.num_grains);
  for (TrialEstimate& trial : e.trials) {
    trial.core_seconds = trial.grain_steps / e.grain_steps_per_s;
  }
  return e;
}

int MostConfirming(const CampaignSpec& spec) {
  return spec.confirm.MostTrials() * static_cast<int>(ExperimentsOf(spec).size());
}

CampaignEstimate EstimateCampaign(const CampaignSpec& spec) {
  CampaignEstimate e{EstimateTrials(spec)};
  const double dearest = std::ranges::max(e.trials, {}, &TrialEstimate::core_seconds).core_seconds;
  e.confirming = ConfirmingTrials(spec, e.grain_steps_per_s);
  double confirm_time = 0;  // [s], of one replicate by every experiment
  for (const TrialEstimate& trial : e.confirming) confirm_time += trial.core_seconds;
  const int num_confirming = MostConfirming(spec);
  const int num_search = MostSearched(spec);
  if (num_search > 0) e.num_trials = num_search + num_confirming;
  e.num_workers = MostAtATime(spec, NumCores());
  const double search = num_search > 0 ? dearest * num_search : spec.budget.core_time.value_or(0);
  e.proposal_time = ProposalTime(NumSearchTrials(spec.budget, e.trials));
  // More workers than this machine has cores wait for one another (CoresWarning).
  const bool is_here = spec.runner.kind == RunnerKind::kLocal;
  const int at_once =
      is_here ? std::clamp(NumCores() / CoresOfTrial(spec), 1, e.num_workers) : e.num_workers;
  // Proposals come one after another, and nothing is over before a trial and its confirmation.
  const double in_turn = (std::min(search, spec.budget.core_time.value_or(search)) +
                          confirm_time * spec.confirm.MostTrials()) /
                         (at_once * spec.threads);
  const double least = (dearest + confirm_time) / spec.threads;
  e.campaign_time = std::max(in_turn, least) + e.proposal_time;
  if (!spec.budget.wall_clock) return e;
  // What runs when it is over runs to its end, and is confirmed.
  const double after =
      dearest / spec.threads + confirm_time * spec.confirm.MostTrials() / (at_once * spec.threads);
  e.campaign_time = std::min(e.campaign_time, *spec.budget.wall_clock + after);
  e.num_in_wall_clock = std::floor(*spec.budget.wall_clock * at_once * spec.threads / dearest);
  return e;
}

std::vector<std::string> EstimateWarnings(const CampaignSpec& spec, const CampaignEstimate& e) {
  std::vector<std::string> warnings = TooLongTrials(spec, e);
  if (const auto few = FewFineTrials(spec, e)) warnings.push_back(*few);
  if (const auto none = NoFineTrials(spec)) warnings.push_back(*none);
  if (const auto short_of = FewInWallClock(spec, e)) warnings.push_back(*short_of);
  return warnings;
}

std::string EstimateText(const CampaignSpec& spec, const CampaignEstimate& e) {
  const bool one = e.trials.size() == 1 && !spec.budget.core_time;
  const std::string speed = "  this machine      " + base::ShortNumber(1e-6 * e.grain_steps_per_s) +
                            " million grain steps a second on a core\n";
  if (one) return "  a trial           " + RunText(e.trials.front()) + "\n" + speed + TimeText(e);
  return TrialLines(spec, e) + speed + "  time              at most " +
         base::DurationText(e.campaign_time) + " with the confirmation and " +
         base::DurationText(e.proposal_time) + " to choose trials, " +
         std::to_string(e.num_workers) + " at a time\n";
}

}  // namespace talus::campaign
