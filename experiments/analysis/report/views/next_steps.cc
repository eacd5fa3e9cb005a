#include "experiments/analysis/report/views/next_steps.h"

#include <algorithm>
#include <cmath>

#include "experiments/campaign/folder/console.h"

namespace talus::analysis {
namespace {

constexpr double kMeasured = 0.05;        // of a searched range: what a direct measurement leaves
constexpr Eigen::Index kFewestNear = 30;  // draws that a conditional range is made of
constexpr double kWorthAWord = 0.7;       // of the ranges' volume

std::string Number(double value) { return campaign::NumberText4(value); }

// The middle 90 % of a column, unit cube.
std::pair<double, double> RangeOf(const Eigen::MatrixXd& draws, Eigen::Index column) {
  std::vector<double> sorted(draws.col(column).data(), draws.col(column).data() + draws.rows());
  std::sort(sorted.begin(), sorted.end());
  const auto last = static_cast<double>(sorted.size() - 1);
  return {sorted[static_cast<std::size_t>(0.05 * last)],
          sorted[static_cast<std::size_t>(0.95 * last)]};
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
  NextStep step{.what = "Measure " + parameter.symbol + " in another test and fix it",
                .cost = "one direct measurement, to about " + Number(100 * kMeasured) +
                        " % of its range; no simulation",
                .leaves = {},
                .remaining = kMeasured / width};
  for (Eigen::Index j = 0; j < draws.cols(); ++j) {
    if (j == k) continue;
    const ParameterInfo& other = evidence.parameters[static_cast<std::size_t>(j)];
    const auto [low, high] = RangeOf(given, j);
    step.remaining *= std::min(1.0, std::max(high - low, 1e-3) / WidthOf(draws, j));
    step.leaves += (step.leaves.empty() ? "" : ", ") + other.symbol + " in " +
                   Number(other.range.ToNative(low)) + " to " + Number(other.range.ToNative(high));
  }
  if (step.leaves.empty()) step.leaves = "nothing open";
  step.leaves += ", if it is " + Number(parameter.range.ToNative(recommended));
  if (step.remaining < kWorthAWord) steps.push_back(step);
}

// The experiment's own error falls with the root of its runs; no range can fall faster.
void AddPhotographing(const Evidence& evidence, std::vector<NextStep>& steps) {
  const int runs = evidence.reference.num_heaps;
  const double factor = std::sqrt(0.5);
  const auto dimension = static_cast<double>(evidence.parameters.size());
  steps.push_back(
      {.what = "Photograph " + std::to_string(runs) + " more " + (runs == 1 ? "heap" : "heaps"),
       .cost = std::to_string(runs) + " more runs of the test; no simulation",
       .leaves = "ranges at best " + Number(std::round(100 * factor) / 100) +
                 " times as wide, where the experiment's scatter sets them",
       .remaining = std::pow(factor, dimension)});
}

void AddSecondTest(const Evidence& evidence, std::vector<NextStep>& steps) {
  if (evidence.parameters.size() < 2) return;
  steps.push_back({.what = "Add a test that moves the grains otherwise",
                   .cost = "its photographs, and as many simulations again",
                   .leaves = "what `talus next DIR --simulate` says of it",
                   .remaining = 0.9});
}

void AddSimulating(const Evidence& evidence, std::vector<NextStep>& steps) {
  if (evidence.stop_reason.find("surrogate's variance") != std::string::npos) return;
  steps.push_back({.what = "Simulate more: talus resume DIR --add-simulations 20",
                   .cost = "20 simulations",
                   .leaves = "not more than what the measurements themselves leave open",
                   .remaining = 0.95});
}

}  // namespace

std::vector<NextStep> NextSteps(const Evidence& evidence) {
  std::vector<NextStep> steps;
  if (!evidence.conclusion || !evidence.model || evidence.model->draws.rows() == 0) return steps;
  for (Eigen::Index k = 0; k < evidence.model->draws.cols(); ++k) AddMeasuring(evidence, k, steps);
  AddPhotographing(evidence, steps);
  AddSecondTest(evidence, steps);
  AddSimulating(evidence, steps);
  std::stable_sort(steps.begin(), steps.end(),
                   [](const NextStep& a, const NextStep& b) { return a.remaining < b.remaining; });
  return steps;
}

}  // namespace talus::analysis
