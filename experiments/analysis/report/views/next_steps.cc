#include "experiments/analysis/report/views/next_steps.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "experiments/trials/simulate/run_log.h"

namespace talus::analysis {
namespace {

constexpr double kMeasured = 0.05;        // of a searched range: what a direct measurement leaves
constexpr Eigen::Index kFewestNear = 30;  // draws that a conditional range is made of
constexpr double kWorthAWord = 0.7;       // of the ranges' volume

// Three digits: none of these ranges is known better.
std::string Number(double value) { return base::ShortNumber(value, 3); }

// The middle 90 % of a column, unit cube.
std::pair<double, double> RangeOf(const Eigen::MatrixXd& draws, Eigen::Index column) {
  std::vector<double> sorted(draws.col(column).data(), draws.col(column).data() + draws.rows());
  std::sort(sorted.begin(), sorted.end());
  const auto last = static_cast<double>(sorted.size() - 1);
  return {sorted[static_cast<std::size_t>(0.05 * last)],
          sorted[static_cast<std::size_t>(0.95 * last)]};
}

// "0.1 to 0.2"; ends in the unit cube.
std::string RangeText(const ParameterInfo& parameter, const std::pair<double, double>& range) {
  return Number(parameter.range.ToNative(range.first)) + " to " +
         Number(parameter.range.ToNative(range.second));
}

double WidthOf(const Eigen::MatrixXd& draws, Eigen::Index column) {
  const auto [low, high] = RangeOf(draws, column);
  return std::max(high - low, 1e-3);
}

Eigen::MatrixXd Near(const Eigen::MatrixXd& draws, Eigen::Index column, double value) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (std::abs(draws(i, column) - value) <= kMeasured / 2) rows.push_back(i);
  }
  return draws(rows, Eigen::all);
}

// Another test tells this parameter: where do the others lie, given it?
void AddMeasuring(const Evidence& evidence, Eigen::Index k, std::vector<NextStep>& steps) {
  const Eigen::MatrixXd& draws = evidence.model->draws;
  const ParameterInfo& parameter = evidence.parameters[static_cast<std::size_t>(k)];
  const double width = WidthOf(draws, k);
  if (width <= kMeasured) return;
  const double recommended =
      parameter.range.ToUnit(evidence.conclusion->values[static_cast<std::size_t>(k)].value);
  const Eigen::MatrixXd given = Near(draws, k, recommended);
  if (given.rows() < kFewestNear) return;
  NextStep step{.what = "Measure " + parameter.symbol + " directly and set it in the spec",
                .cost = "one measurement to ± " + Number(50 * kMeasured) +
                        " % of its searched range; no simulation",
                .leaves = {},
                .remaining = kMeasured / width};
  for (Eigen::Index j = 0; j < draws.cols(); ++j) {
    if (j == k) continue;
    const ParameterInfo& other = evidence.parameters[static_cast<std::size_t>(j)];
    const auto [low, high] = RangeOf(given, j);
    const double share = std::min(1.0, std::max(high - low, 1e-3) / WidthOf(draws, j));
    step.remaining *= share;
    step.leaves += (step.leaves.empty() ? "" : ", ") + other.symbol + " in " +
                   RangeText(other, {low, high}) + ", " + Number(std::round(100 * (1 - share))) +
                   " % narrower";
  }
  if (step.leaves.empty()) step.leaves = "nothing open";
  step.leaves += ", if " + parameter.symbol + " turns out to be " +
                 Number(parameter.range.ToNative(recommended));
  if (step.remaining < kWorthAWord) steps.push_back(step);
}

// The experiment's own error falls with the root of its runs; no range can fall faster.
void AddPhotographing(const Evidence& evidence, std::vector<NextStep>& steps) {
  const int runs = evidence.reference.num_heaps;
  const double factor = std::sqrt(0.5);
  const auto dimension = static_cast<double>(evidence.parameters.size());
  const bool several = evidence.experiments.size() > 1;
  steps.push_back({.what = several ? "Repeat every measurement"
                                   : "Photograph " + base::Counted(runs, "more heap"),
                   .cost = several
                               ? "as many runs again of each test; no simulation"
                               : base::Counted(runs, "more run") + " of the test; no simulation",
                   .leaves = "ranges at best " + Number(std::round(100 * factor) / 100) +
                             " times as wide as now, where the measurements' scatter sets them",
                   .remaining = std::pow(factor, dimension)});
}

void AddSecondTest(const Evidence& evidence, std::vector<NextStep>& steps) {
  if (evidence.parameters.size() < 2) return;
  steps.push_back({.what = "Add a different kind of test",
                   .cost = "its measurement, and about as many simulations again",
                   .leaves = "what this command works out and this page then shows: talus next " +
                             evidence.folder.string() + " --simulate",
                   .remaining = 0.9});
}

// Processor time of a simulation at the finest scale factor [s].
double TimeOfOne(const Evidence& evidence) {
  double sum = 0, count = 0;
  for (const TrialEvidence& trial : evidence.trials) {
    if (trial.scale_factor != evidence.scale_factor || !std::isfinite(trial.cpu_seconds)) continue;
    sum += trial.cpu_seconds;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

// First where an alarm asks for it.
void AddSimulating(const Evidence& evidence, std::vector<NextStep>& steps) {
  constexpr int kMore = 20;
  const bool asked = evidence.conclusion->asks_for_simulations;
  // It stopped because more simulations would hardly tell more.
  if (!asked && evidence.stop_reason.find("surrogate's variance") != std::string::npos) return;
  const std::string more = std::to_string(kMore);
  steps.push_back({.what = "Simulate more: talus resume " + evidence.folder.string() +
                           " --add-simulations " + more,
                   .cost = more + " simulations, up to " +
                           trials::DurationText(kMore * TimeOfOne(evidence)) + " of core time",
                   .leaves = asked ? "an answer that the warnings above do not hang on"
                                   : "not more than what the measurements themselves leave open",
                   .remaining = asked ? 0 : 0.95});
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

NextStep StepOf(const Evidence& evidence, const NextTableView& table,
                const CandidateView& candidate) {
  NextStep step{.what = candidate.name + ": " + candidate.what,
                .cost = candidate.num_simulations == 0
                            ? "no simulation"
                            : base::Counted(candidate.num_simulations, "simulation") + ", " +
                                  trials::DurationText(candidate.core_time) + " of core time",
                .leaves = {}};
  step.what.front() =
      static_cast<char>(std::toupper(static_cast<unsigned char>(step.what.front())));
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const ParameterInfo& parameter = evidence.parameters[k];
    step.remaining *= std::min(1.0, candidate.width[k] / std::max(table.width[k], 1e-6));
    step.leaves += (k == 0 ? "" : ", ") + parameter.symbol + " known within " +
                   WithinText(parameter, candidate.width[k]) + " (now " +
                   WithinText(parameter, table.width[k]) + ")";
  }
  return step;
}

void AddCandidates(const Evidence& evidence, const NextTableView& table,
                   std::vector<NextStep>& steps) {
  constexpr int kMost = 3;
  constexpr double kWorth = 0.9;  // of the ranges' volume
  int taken = 0;
  for (const CandidateView& candidate : table.candidates) {
    if (std::isnan(candidate.bits) || taken == kMost) continue;
    const NextStep step = StepOf(evidence, table, candidate);
    if (taken > 0 && step.remaining > kWorth) continue;
    ++taken;
    steps.push_back(step);
  }
}

}  // namespace

std::vector<NextStep> NextSteps(const Evidence& evidence,
                                const std::optional<NextTableView>& table) {
  std::vector<NextStep> steps;
  const bool has_draws = evidence.conclusion && evidence.model && evidence.model->draws.rows() > 0;
  if (has_draws) {
    for (Eigen::Index k = 0; k < evidence.model->draws.cols(); ++k) {
      AddMeasuring(evidence, k, steps);
    }
  }
  if (table) {
    AddCandidates(evidence, *table, steps);
    if (has_draws && evidence.conclusion->asks_for_simulations) AddSimulating(evidence, steps);
  } else if (has_draws) {
    AddPhotographing(evidence, steps);
    AddSecondTest(evidence, steps);
    AddSimulating(evidence, steps);
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const NextStep& a, const NextStep& b) { return a.remaining < b.remaining; });
  return steps;
}

}  // namespace talus::analysis
