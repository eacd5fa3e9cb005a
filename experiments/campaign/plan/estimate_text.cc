// What a campaign will cost, and what is wrong with its budget, in words.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/number_text.h"
#include "experiments/campaign/plan/estimate.h"
#include "experiments/campaign/spec/first_design.h"
#include "optimizer/designs/posterior_design.h"

namespace talus::campaign {
namespace {

// Times as much at the ends of the ranges that is worth saying.
constexpr double kMuchMore = 1.3;

// " in the middle of the ranges, up to 9.1 times as much at their ends", where that is much more.
std::string RangeEndsText(const TrialEstimate& trial) {
  if (trial.at_ends <= kMuchMore) return "";
  return " in the middle of the ranges, up to " + base::ShortNumber(trial.at_ends, 2) +
         " times as much at their ends";
}

// "1 simulation takes", "60 simulations take".
std::string SimulationsThat(const std::string& verb, int count) {
  return base::Counted(count, "simulation") + " " + verb + (count == 1 ? "s" : "");
}

// What the budget would buy, if it were all spent on such trials.
std::string BoughtText(const BudgetOptions& budget, const TrialEstimate& trial) {
  std::string text;
  if (budget.core_time) {
    text += "; " + base::DurationText(*budget.core_time) + " of core time buy " +
            std::to_string(static_cast<std::int64_t>(*budget.core_time / trial.core_seconds));
  }
  if (budget.simulations > 0) {
    text += "; " + SimulationsThat("take", budget.simulations) + " " +
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
            base::DurationText(trial.core_seconds) + " of a core" + RangeEndsText(trial) +
            BoughtText(spec.budget, trial) + "\n";
  }
  return text;
}

// " and 12 min for what follows the answer", and that the runs for a goal are not counted.
std::string AfterwardsText(const CampaignSpec& spec, const CampaignEstimate& e) {
  const bool adds_goal = spec.goal && !spec.budget.core_time;
  return (e.afterwards > 0 ? ", " + base::DurationText(e.afterwards) +
                                 " of it for further tests and sensitivity after the answer"
                           : "") +
         (adds_goal ? "; the runs for the goal come on top" : "");
}

std::string TimeText(const CampaignSpec& spec, const CampaignEstimate& e) {
  const TrialEstimate& trial = e.trials.front();
  const double confirm_time =
      e.confirming.empty() ? trial.core_seconds : e.confirming.front().core_seconds;
  return "  time              about " + base::DurationText(trial.core_seconds) + " a trial" +
         RangeEndsText(trial) + ", " +
         (confirm_time == trial.core_seconds
              ? ""
              : base::DurationText(confirm_time) + " a confirming one, ") +
         (trial.at_ends > kMuchMore ? "at most " : "") +
         base::DurationText(e.campaign_time + e.afterwards) + " for " +
         base::Counted(e.num_trials, "trial") + ", " + std::to_string(e.num_workers) +
         " at a time" + AfterwardsText(spec, e) + "\n";
}

// "12.3 million", or from the slowest experiment's to the fastest's.
std::string SpeedText(const std::vector<double>& speeds) {
  const auto [slowest, fastest] = std::ranges::minmax(speeds);
  const std::string least = base::ShortNumber(1e-6 * slowest);
  const std::string most = base::ShortNumber(1e-6 * fastest);
  return "  this machine      " + (least == most ? least : least + " to " + most) +
         " million grain steps a second on a core\n";
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
    const double usual = trial.core_seconds / spec.threads;         // [s]
    const double longest = trial.MostCoreSeconds() / spec.threads;  // [s]
    if (longest <= spec.trial_time_cap) continue;
    const bool at_ends = usual <= spec.trial_time_cap;
    const double takes = at_ends ? longest : usual;
    // Two that are rounded to the same minutes are shown in seconds.
    const bool look_alike = base::DurationText(takes) == base::DurationText(spec.trial_time_cap);
    const auto text = [&](double seconds) {
      return look_alike ? base::ShortNumber(seconds, 6) + " s" : base::DurationText(seconds);
    };
    texts.push_back(
        experiments[static_cast<std::size_t>(trial.experiment)].name + " at scale factor " +
        base::ShortNumber(trial.scale_factor) + ": a trial takes about " + text(takes) +
        (at_ends ? " at the ends of the ranges" : "") + ", and fails at the trial_time_cap of " +
        text(spec.trial_time_cap) + ": raise it, " + (at_ends ? "narrow the ranges, " : "") +
        "or take coarser grains or more threads");
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

// Where the simulations end within the first design, or with those at coarser scale factors.
std::optional<std::string> FewSimulations(const CampaignSpec& spec) {
  if (spec.budget.simulations == 0 || spec.HasOwnProposer()) return std::nullopt;
  const int least = FirstSimulations(spec);
  if (MostSearched(spec) >= least) return std::nullopt;
  const std::string end = SimulationsThat("end", spec.budget.simulations);
  const std::string remedy = ": give it " + std::to_string(least) + " at least";
  if (spec.coarse_graining.Levels().size() == 1) {
    return end + " within the first design, " + base::Counted(DesignSets(spec), "set") +
           " of each experiment, and none is chosen by what the others have told" + remedy +
           ", better twice as many";
  }
  return end + " before " + base::Counted(optimizer::kFewestFinerSets, "set") +
         " of each experiment are simulated at scale factor " +
         base::ShortNumber(spec.coarse_graining.Finest()) +
         ", and the answer rests on coarser grains" + remedy + ", or leave that scale factor out";
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

std::string RunText(const RunEstimate& run) {
  return std::to_string(run.num_grains) + " grains of " +
         base::ShortNumber(1e3 * run.mean_diameter) + " mm, " +
         base::ShortNumber(std::round(run.num_steps)) + " steps of " +
         base::ShortNumber(1e6 * run.time_step) + " us, " +
         base::ShortNumber(std::round(1e-6 * run.memory)) + " MB";
}

std::vector<std::string> EstimateWarnings(const CampaignSpec& spec, const CampaignEstimate& e) {
  std::vector<std::string> warnings = TooLongTrials(spec, e);
  if (const auto few = FewFineTrials(spec, e)) warnings.push_back(*few);
  if (const auto few = FewSimulations(spec)) warnings.push_back(*few);
  if (const auto short_of = FewInWallClock(spec, e)) warnings.push_back(*short_of);
  return warnings;
}

std::string EstimateText(const CampaignSpec& spec, const CampaignEstimate& e) {
  constexpr double kWorthSaying = 1;  // [s]
  const std::string speed = SpeedText(e.grain_steps_per_s);
  const bool one = e.trials.size() == 1 && !spec.budget.core_time;
  if (one) {
    return "  a trial           " + RunText(e.trials.front()) + "\n" + speed + TimeText(spec, e);
  }
  return TrialLines(spec, e) + speed + "  time              at most " +
         base::DurationText(e.campaign_time + e.afterwards) + " with the confirmation" +
         (e.proposal_time >= kWorthSaying
              ? " and " + base::DurationText(e.proposal_time) + " to choose trials"
              : "") +
         ", " + std::to_string(e.num_workers) + " at a time" + AfterwardsText(spec, e) + "\n";
}

}  // namespace talus::campaign
