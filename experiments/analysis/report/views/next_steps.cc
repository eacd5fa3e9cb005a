#include "experiments/analysis/report/views/next_steps.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/report/views/answer_words.h"
#include "experiments/analysis/report/views/width_views.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/rigs/observables/shown_number.h"
#include "optimizer/posterior/credible_ranges.h"

namespace talus::analysis {
namespace {

constexpr double kWorthAWord = 0.7;   // of the ranges' volume
constexpr double kBeforeAll = -1;     // what an alarm asks for comes first
constexpr double kNoNarrower = 0.95;  // of a range's width: less is not told from chance

// Three digits: none of these ranges is known better.
std::string Number(double value) { return base::ShortNumber(value, 3); }

// As the page shows them, "0.1 to 0.2".
std::string RangeText(const campaign::ResultParameter& v) {
  return Number(v.credible_low) + " to " + Number(v.credible_high);
}

// Never 0, which no other width could be compared with.
double WidthOf(const campaign::ResultParameter& v) { return std::max(v.Width(), 1e-3); }

// The draws near a value of one parameter, with the other parameters only.
Eigen::MatrixXd OthersNear(const Eigen::MatrixXd& draws, Eigen::Index column, double value) {
  std::vector<Eigen::Index> others;
  for (Eigen::Index j = 0; j < draws.cols(); ++j) {
    if (j != column) others.push_back(j);
  }
  return draws(DrawsNear(draws, column, value), others);
}

// Columns of the nuisances where that of parameter k is left out.
std::vector<Eigen::Index> NuisancesAmongOthers(const campaign::Answer& answer, std::size_t k) {
  std::vector<Eigen::Index> columns;
  for (std::size_t j = 0; j < answer.parameters.size(); ++j) {
    if (j == k || !answer.parameters[j].nuisance) continue;
    columns.push_back(static_cast<Eigen::Index>(j < k ? j : j - 1));
  }
  return columns;
}

// Another test tells this parameter: where do the others lie, given it? As the ranges that the page
// shows, those of what is asked for hold 90 % of the draws all together.
void AddMeasuring(const Evidence& evidence, std::size_t k, std::vector<NextStep>& steps) {
  const ParameterInfo& parameter = evidence.parameters[k];
  const campaign::ResultParameter& measured = evidence.answer->parameters[k];
  const double width = WidthOf(measured);
  if (!(width > kMeasured)) return;
  const Eigen::MatrixXd given = OthersNear(evidence.model->draws, static_cast<Eigen::Index>(k),
                                           parameter.range.ToUnit(measured.value));
  if (given.rows() < kFewestNear) return;
  NextStep step{.what = "Measure " + parameter.symbol + " on a tilted plate and set it in the spec",
                .cost = "one measurement to ± " + Number(50 * kMeasured) +
                        " % of its searched range; no simulation",
                .leaves = {},
                // Nobody asks for a nuisance, only for what the others are, given it.
                .remaining = measured.nuisance ? 1 : kMeasured / width};
  const std::vector<optimizer::Range> ranges =
      optimizer::AskedRanges(given, NuisancesAmongOthers(*evidence.answer, k));
  for (std::size_t j = 0, left = 0; j < evidence.parameters.size(); ++j) {
    if (j == k) continue;
    const ParameterInfo& other = evidence.parameters[j];
    const campaign::ResultParameter& now = evidence.answer->parameters[j];
    const optimizer::Range& range = ranges[left++];
    campaign::ResultParameter then = now;
    then.credible_low = other.range.ToNative(range.low);
    then.credible_high = other.range.ToNative(range.high);
    const double share = std::min(1.0, WidthOf(then) / WidthOf(now));
    if (!now.nuisance) step.remaining *= share;
    step.leaves += (step.leaves.empty() ? "" : ", ") + other.symbol;
    step.leaves += share < kNoNarrower ? " in " + RangeText(then) + " (now " + RangeText(now) + ")"
                                       : " as it is";
  }
  if (step.leaves.empty()) step.leaves = "nothing open";
  step.leaves += ", if " + parameter.symbol + " turns out to be " + Number(measured.value);
  if (step.remaining < kWorthAWord) steps.push_back(step);
}

// As many runs again, which only photographs count.
NextStep MoreRuns(const Evidence& evidence) {
  if (evidence.experiments.size() > 1) {
    return {.what = "Repeat every measurement",
            .cost = "as many runs again of each test; no simulation",
            .leaves = {}};
  }
  if (!evidence.reference.has_image()) {
    return {.what = "Repeat the measurement",
            .cost = "as many runs of the test again; no simulation",
            .leaves = {}};
  }
  const int runs = evidence.reference.num_heaps;
  return {.what = "Photograph " + base::Counted(runs, "more heap"),
          .cost = base::Counted(runs, "more run") + " of the test; no simulation",
          .leaves = {}};
}

// The experiment's own error falls with the root of its runs; no range can fall faster.
void AddRepeating(const Evidence& evidence, std::vector<NextStep>& steps) {
  const double factor = std::sqrt(0.5);
  const auto dimension = static_cast<double>(campaign::AskedParameters(*evidence.answer).size());
  NextStep step = MoreRuns(evidence);
  step.leaves = "ranges at best " + base::ShortNumber(factor, 2) +
                " times as wide as now, where the measurements' scatter sets them";
  step.remaining = std::pow(factor, dimension);
  steps.push_back(step);
}

void AddSecondTest(const Evidence& evidence, std::vector<NextStep>& steps) {
  if (evidence.parameters.size() < 2) return;
  // A point needs none; what the measurements leave open, no more of the same closes.
  if (evidence.answer->verdict && evidence.answer->verdict->kind == campaign::VerdictKind::kPoint)
    return;
  steps.push_back({.what = "Add a different kind of test",
                   .cost = "its measurement, and about as many simulations again",
                   .leaves = "what this command works out and this page then shows: talus next " +
                             base::ShellWord(evidence.folder.string()) + " --simulate",
                   .remaining = 0});
}

// Processor time of a simulation at the finest scale factor, of any experiment [s].
double TimeOfOne(const Evidence& evidence) {
  double sum = 0, count = 0;
  for (const TrialEvidence* trial : evidence.AllTrials()) {
    if (trial->scale_factor != evidence.scale_factor || !std::isfinite(trial->cpu_seconds))
      continue;
    sum += trial->cpu_seconds;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

// "18 % of rolling_friction, 12 % of sliding_friction"
std::string NarrowingText(const campaign::ResultUnsettled& unsettled) {
  std::string text;
  for (const campaign::ResultNarrowing& one : unsettled.narrowing) {
    text += (text.empty() ? "" : ", ") + base::InPercent(one.share) + " % of " + one.parameter;
  }
  return text;
}

// Whether the budget ended a search that may still move the region.
bool MayMoveTheRegion(const campaign::Answer& answer) {
  if (!answer.posterior || !answer.unsettled) return false;
  return answer.unsettled->narrowing.empty() ||
         campaign::IsProvisional(answer.posterior->surrogate_narrowing);
}

// First where an alarm asks for it, and while the region, which all other steps are worked out
// from, may still move.
void AddSimulating(const Evidence& evidence, std::vector<NextStep>& steps) {
  const campaign::Answer& answer = *evidence.answer;
  const bool asked = campaign::AsksForSimulations(answer);
  // The search's rule ended it, or the budget when half as many again would hardly tell more.
  const bool is_settled = answer.posterior && !answer.unsettled;
  if (!asked && (is_settled || answer.stop.kind == campaign::StopKind::kRule)) return;
  const int count = campaign::MoreSimulations(answer);
  const std::string more = std::to_string(count);
  NextStep step{.what = "Simulate more: talus resume " + base::ShellWord(evidence.folder.string()) +
                        " --add-simulations " + more,
                .cost = more + " simulations, about " +
                        base::DurationText(count * TimeOfOne(evidence)) + " of core time",
                .leaves = "not more than what the measurements themselves leave open",
                .remaining = 0.95};
  if (const double volume = VolumeThen(answer); std::isfinite(volume)) {
    step.leaves = "ranges narrower by " + NarrowingText(*answer.unsettled);
    step.remaining = volume;
  }
  if (MayMoveTheRegion(answer)) {
    const double share = answer.posterior->surrogate_narrowing;
    if (answer.unsettled->narrowing.empty() && share > 1 - kNoNarrower) {
      step.leaves = "ranges narrower by up to " + base::InPercent(share) + " %";
    }
    step.remaining = kBeforeAll;
  }
  if (asked) {
    step.leaves = "an answer that the warnings above do not hang on";
    step.remaining = kBeforeAll;
  }
  steps.push_back(step);
}

// "0.12", of a logarithmic range "a factor of 3".
std::string WithinText(const ParameterInfo& parameter, double width) {
  const auto two_digits = [](double x) {
    const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    return Number(std::round(x / unit) * unit);
  };
  const optimizer::Parameter& range = parameter.range;
  if (range.scale != optimizer::Scale::kLog) {
    return two_digits(std::max(width, 1e-6) * (range.high - range.low)) +
           (parameter.unit.empty() ? "" : " " + parameter.unit);
  }
  return "a factor of " + two_digits(std::pow(range.high / range.low, width));
}

// "angle of drum known within ± 0.78° (now ± 3.8°)"
std::string GoalWithinText(const NextGoalView& goal, double half_width) {
  const auto shown = [&](double x) { return "± " + rigs::ShownNumber(goal.metric, x, 2); };
  return rigs::SpokenName(goal.metric) + " of " + goal.process + " known within " +
         shown(half_width) + " (now " + shown(goal.half_width) + ")";
}

NextStep StepOf(const Evidence& evidence, const NextTableView& table,
                const CandidateView& candidate) {
  NextStep step{.what = candidate.name + ": " + candidate.what,
                .cost = candidate.num_simulations == 0
                            ? "no simulation"
                            : base::Counted(candidate.num_simulations, "simulation") + ", " +
                                  base::DurationText(candidate.core_time) + " of core time",
                .leaves = {},
                .remaining = candidate.remaining};
  step.what.front() =
      static_cast<char>(std::toupper(static_cast<unsigned char>(step.what.front())));
  if (table.goal) step.leaves = GoalWithinText(*table.goal, candidate.goal);
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const ParameterInfo& parameter = evidence.parameters[k];
    step.leaves += (step.leaves.empty() ? "" : ", ") + parameter.symbol + " known within " +
                   WithinText(parameter, candidate.width[k]) + " (now " +
                   WithinText(parameter, table.width[k]) + ")";
  }
  return step;
}

void AddCandidates(const Evidence& evidence, const NextTableView& table,
                   std::vector<NextStep>& steps) {
  constexpr int kMost = 3;
  constexpr double kWorth = 0.9;  // of what there is to narrow
  int taken = 0;
  for (const CandidateView& candidate : table.candidates) {
    if (std::isnan(candidate.bits) || taken == kMost) continue;
    const NextStep step = StepOf(evidence, table, candidate);
    if (taken > 0 && step.remaining > kWorth) continue;
    ++taken;
    steps.push_back(step);
  }
}

// Where no test has been simulated yet none is in the order, though one of them may narrow most.
bool HasUnjudgedTestsOnly(const NextTableView& table) {
  const auto is_test = [](const CandidateView& c) { return c.kind == "test"; };
  const auto is_judged = [&](const CandidateView& c) { return is_test(c) && !std::isnan(c.bits); };
  return std::ranges::any_of(table.candidates, is_test) &&
         std::ranges::none_of(table.candidates, is_judged);
}

}  // namespace

std::vector<NextStep> NextSteps(const Evidence& evidence,
                                const std::optional<NextTableView>& table) {
  std::vector<NextStep> steps;
  const bool has_draws = evidence.answer && evidence.model;
  // An outdated one may name the test that has just been made, beside ranges of before.
  const bool is_known = table && !table->is_outdated;
  if (is_known) {
    AddCandidates(evidence, *table, steps);
    if (has_draws && HasUnjudgedTestsOnly(*table)) AddSecondTest(evidence, steps);
  } else if (has_draws) {
    for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
      const std::string& name = evidence.parameters[k].range.name;
      if (campaign::CanBeMeasuredDirectly(name)) AddMeasuring(evidence, k, steps);
    }
    AddSecondTest(evidence, steps);
    AddRepeating(evidence, steps);
  }
  // The table has more simulations among its candidates.
  if (has_draws && (!is_known || campaign::AsksForSimulations(*evidence.answer))) {
    AddSimulating(evidence, steps);
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const NextStep& a, const NextStep& b) { return a.remaining < b.remaining; });
  return steps;
}

}  // namespace talus::analysis
