#include "experiments/analysis/design/rank_designs.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "experiments/analysis/next/ground.h"
#include "experiments/analysis/next/judge_test.h"
#include "experiments/analysis/next/test_design.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/point_rows.h"

namespace talus::analysis {
namespace {

constexpr std::size_t kMostTests = 3;

// So many that a few hundred remain in what two tests leave.
constexpr int kPriorDraws = 8000;

// A campaign's posterior has the surrogate's own error, too, in its variance and in its mean: as
// much as if this were its share of an output's variance (virtual powders; bench/RECORD.md).
constexpr double kSurrogateShare = 0.62;

// Equally likely before anything is measured.
Eigen::MatrixXd PriorDraws(const campaign::JointView& view) {
  const optimizer::Domain domain = view.space.MakeDomain();
  return optimizer::Inside(
      domain, domain.prior.IsUniform()
                  ? optimizer::RSequence(kPriorDraws, domain.num_parameters, view.spec.seed)
                  : domain.prior.Draw(kPriorDraws, domain.num_parameters, view.spec.seed));
}

// Sets with the values that are given, and with draws' values in place of those that are not (NaN):
// at most 64 of those that the constraints allow.
Eigen::MatrixXd SetsWith(const Eigen::VectorXd& given, const Eigen::MatrixXd& draws,
                         const optimizer::Domain& domain) {
  constexpr Eigen::Index kSets = 64;
  if (given.size() == 0) return {};
  Eigen::MatrixXd sets = draws;
  std::vector<Eigen::Index> allowed;
  for (Eigen::Index s = 0; s < sets.rows(); ++s) {
    sets.row(s) = given.array().isNaN().select(draws.row(s).transpose(), given).transpose();
    if (domain.Contains(sets.row(s))) allowed.push_back(s);
  }
  if (allowed.empty()) {
    throw base::ConfigError(
        "the supposed powder: no set with these values satisfies the constraints");
  }
  const auto count = static_cast<Eigen::Index>(allowed.size());
  std::vector<Eigen::Index> some;
  for (Eigen::Index s = 0; s < std::min(kSets, count); ++s) {
    some.push_back(allowed[static_cast<std::size_t>(s * count / std::min(kSets, count))]);
  }
  return sets(some, Eigen::all);
}

NextCandidate TestOf(const Ground& ground, const TestCandidate& test,
                     const campaign::CampaignParts& parts) {
  auto [candidate, can_simulate] = ListTest(ground.view, test);
  if (!can_simulate) return candidate;
  const TestDesign design =
      SimulateDesign(ground.view, test, {.draws = ground.draws, .size = kDesignSimulations}, parts);
  candidate.num_made = design.num_simulations;
  candidate.num_failed = design.NumFailed();
  candidate.core_time_made = design.core_time;
  JudgeTest(ground, {.test = test, .design = design, .unknown = {}}, candidate);
  return candidate;
}

optimizer::ExpectedLearning Together(const Ground& ground,
                                     const std::vector<NextCandidate>& candidates,
                                     const std::vector<std::size_t>& tests) {
  Eigen::Index num_outputs = 0;
  for (const std::size_t t : tests) num_outputs += candidates[t].predicted.mean.cols();
  optimizer::PredictedMeasurement all{
      .mean = Eigen::MatrixXd(ground.draws.rows(), num_outputs),
      .variance = Eigen::VectorXd(num_outputs),
      .supposed = Eigen::MatrixXd(ground.supposed.rows(), num_outputs)};
  Eigen::Index left = 0;
  for (const std::size_t t : tests) {
    const optimizer::PredictedMeasurement& one = candidates[t].predicted;
    all.mean.middleCols(left, one.mean.cols()) = one.mean;
    all.variance.segment(left, one.mean.cols()) = one.variance;
    if (one.supposed.rows() > 0) all.supposed.middleCols(left, one.mean.cols()) = one.supposed;
    left += one.mean.cols();
  }
  return ground.Learn(all);
}

// All sets of so many of the tests that could be judged.
void AddChoices(const std::vector<std::size_t>& judged, std::size_t size, std::size_t from,
                std::vector<std::size_t>& begun, std::vector<DesignChoice>& choices) {
  if (begun.size() == size) {
    choices.push_back({.tests = begun, .learning = {}});
    return;
  }
  for (std::size_t i = from; i < judged.size(); ++i) {
    begun.push_back(judged[i]);
    AddChoices(judged, size, i + 1, begun, choices);
    begun.pop_back();
  }
}

}  // namespace

DesignTable RankDesigns(const campaign::JointView& view, const std::vector<TestCandidate>& tests,
                        const campaign::CampaignParts& parts, const campaign::GivenSet& supposed) {
  Ground ground{.view = view,
                .draws = PriorDraws(view),
                .model_error = view.spec.posterior.model_error,
                .surrogate_share = kSurrogateShare};
  ground.supposed = SetsWith(supposed.point, ground.draws, view.space.MakeDomain());
  DesignTable table{
      .tests = {.parameters = view.record.parameters, .nuisances = view.space.Nuisances()},
      .supposed = supposed.values,
      .scale_factor = view.spec.coarse_graining.Levels().front()};
  for (const int i : view.space.Free()) {
    table.tests.scales.push_back(view.space.parameters[static_cast<std::size_t>(i)].scale);
  }
  table.tests.width =
      ground.Learn({.mean = Eigen::MatrixXd(ground.draws.rows(), 0), .variance = {}}).width;
  std::vector<std::size_t> judged;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    table.tests.candidates.push_back(TestOf(ground, tests[t], parts));
    if (table.tests.candidates.back().learning) judged.push_back(t);
  }
  SetRemaining(table.tests);
  for (std::size_t size = 1; size <= std::min(kMostTests, judged.size()); ++size) {
    std::vector<DesignChoice>& choices = table.choices.emplace_back();
    std::vector<std::size_t> begun;
    AddChoices(judged, size, 0, begun, choices);
    for (DesignChoice& choice : choices) {
      choice.learning = Together(ground, table.tests.candidates, choice.tests);
      choice.remaining = RemainingOf(table.tests, choice.learning);
    }
    std::ranges::stable_sort(choices, {}, [](const DesignChoice& c) {
      return std::tuple(c.remaining, -c.learning.bits);
    });
  }
  return table;
}

}  // namespace talus::analysis
