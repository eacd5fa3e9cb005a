#include "optimizer/search/scalar_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/search/describe_minimum.h"
#include "optimizer/search/history.h"
#include "optimizer/search/knowledge_gradient.h"
#include "optimizer/search/local_step.h"
#include "optimizer/search/model_step.h"
#include "optimizer/search/restart.h"
#include "optimizer/search/step_choice.h"
#include "optimizer/search/trust_region.h"
#include "optimizer/words.h"

namespace talus::optimizer {
namespace {

// Posterior sd of the answer is inflated: point-estimated hyper-parameters make it overconfident.
// Calibrated by bench/optimizers/value_coverage.cc.
constexpr double kAnswerInflation = 1.5;

// Below this probability that an evaluation works, no step near the best point is taken.
constexpr double kSafe = 0.7;

// Without noise a process has a floor that keeps it solvable, and knows no point better than that.
// Gains of less than so many of its bounds are none that it could promise.
constexpr double kFloors = 5;
// Evaluations without a gain, times the parameters, after which such a search ends: every second of
// them looks for another basin, which a process that is smooth in the first does not foresee.
constexpr int kPatience = 20;

ModelView ViewOf(const ObjectiveModel& model, const SearchRecord& record, const Domain& domain,
                 std::uint64_t seed) {
  const Eigen::VectorXd mean = model.Means(record.history().points);
  return {.model = model,
          .feasibility = record.feasibility(),
          .domain = domain,
          .points = record.history().points,
          .failure_cost = mean.maxCoeff() - mean.minCoeff(),
          .searches = {},
          .seed = seed};
}

// Evaluations from before the first step: the design and the repeat.
int NumBefore(const SearchRecord& record) { return record.design_size() + 1; }

// Every second step of a search that has converged; the others go on polishing, lest a search that
// only seemed to converge should stay where it is.
std::optional<Elsewhere> Restart(const SearchRecord& record,
                                 std::span<const Eigen::VectorXd> asked) {
  const bool in_turn = (record.history().size() + static_cast<int>(asked.size())) % 2 == 0;
  if (!record.noise_free() || !in_turn || record.domain().IsList()) return std::nullopt;
  return RestartElsewhere(record.history(), record.domain(), NumBefore(record));
}

// A step near the best point, where the next one is to be one; not a failing or evaluated point.
std::optional<Eigen::VectorXd> NearBest(const SearchRecord& record,
                                        std::span<const Eigen::VectorXd> asked,
                                        const std::optional<Elsewhere>& elsewhere) {
  if (record.domain().IsList()) return std::nullopt;
  const History& history = elsewhere ? elsewhere->history : record.history();
  const Domain& domain = elsewhere ? elsewhere->domain : record.domain();
  const Eigen::VectorXd& values = record.history().values;
  std::optional<Eigen::VectorXd> step;
  switch (NextStep(values, NumBefore(record), static_cast<int>(asked.size()))) {
    case Step::kGlobal:
      break;
    case Step::kQuadratic:
      step = TrustRegionStep(history, domain);
      break;
    case Step::kLocal:
      step = LocalStep(history, domain, asked, record.StepSeed(asked));
      break;
  }
  if (step && !record.domain().IsContinuous()) step = record.domain().Snap(*step);
  if (!step || record.WasEvaluated(*step, asked) ||
      record.feasibility().Probability(*step) < kSafe) {
    return std::nullopt;
  }
  return step;
}

// Under noise every second step is by the knowledge gradient, once there are evaluations enough.
bool StepsByKnowledge(const SearchRecord& record, std::span<const Eigen::VectorXd> asked) {
  const int index = record.history().size() + static_cast<int>(asked.size());
  return !record.noise_free() && index >= kFewestForKnowledge && index % 2 == 0;
}

}  // namespace

const ScalarFit& ScalarSearch::Fit(const SearchRecord& record) {
  if (!fit_) fit_ = fitter_.Fit(record.history(), record.noise_free(), FitFor::kSearch);
  return *fit_;
}

Proposal ScalarSearch::Next(const SearchRecord& record, std::span<const Eigen::VectorXd> asked) {
  const std::optional<Elsewhere> elsewhere = Restart(record, asked);
  if (record.noise_free()) {
    if (const auto step = NearBest(record, asked, elsewhere)) return {*step, Origin::kModel};
  }
  const Eigen::MatrixXd& points = record.history().points;
  surrogate::GaussianProcess process = Fit(record).process;
  double incumbent = process.PredictAll(points).mean.minCoeff();
  for (const Eigen::VectorXd& point : asked) {
    incumbent =
        std::min(incumbent, process.AddFantasy({.x = point}));  // or the next would land beside it
  }
  const TransformedModel model(std::move(process));
  const double noise = record.noise_free() ? 0 : model.NoiseSd(points.row(0));
  const Domain open = elsewhere ? elsewhere->domain : record.OpenDomain(asked);
  const ModelView view = ViewOf(model, record, open, record.StepSeed(asked));
  if (StepsByKnowledge(record, asked)) {
    const Eigen::MatrixXd minimisers = PossibleMinimisers(view);
    const KnowledgeStep step =
        MostKnowledge(view, GainsOfValues(model.process(), minimisers), minimisers);
    if (step.gain > 0) return record.ReplicateOrPerturb(step.point, asked);
  }
  const Eigen::VectorXd point = MostExpectedImprovement(
      view, {.value = incumbent, .noise = noise, .is_own_value = record.wants_own_values()},
      BestEvaluated(view));
  return record.ReplicateOrPerturb(point, asked);
}

// Without noise the best evaluation is known exactly, and beats what a model promises.
Eigen::VectorXd ScalarSearch::Best(const SearchRecord& record) {
  const History& history = record.history();
  if (record.deterministic()) {
    Eigen::Index best = 0;
    history.values.minCoeff(&best);
    return history.points.row(best);
  }
  const TransformedModel model(Fit(record).process);
  return LowestMean(ViewOf(model, record, record.domain(), record.options().seed));
}

std::optional<StopReason> ScalarSearch::WhyStop(const SearchRecord& record) {
  const ScalarFit& fit = Fit(record);
  const TransformedModel model(fit.process);
  const ModelView view = ViewOf(model, record, record.domain(), record.options().seed);
  const double bound = LowestBound(view, BestEvaluated(view));
  const double noise = model.NoiseSd(record.history().points.row(0));
  if (record.noise_free()) {
    const double lowest = record.history().values.minCoeff();
    if (const auto reason = record.ReasonToStop(lowest - fit.transform.Backward(bound), 0)) {
      return reason;
    }
    const bool is_unseen = fit.transform.Forward(lowest) - bound < kFloors * kBoundSds * noise;
    const Eigen::Index patience = kPatience * record.domain().num_parameters;
    if (!is_unseen || !HasConverged(record.history(), NumBefore(record), patience)) {
      return std::nullopt;
    }
    return StopReason{.rule = StopRule::kConverged, .name = "the search"};
  }
  const Moments best = model.Predict(Best(record).transpose());
  return record.ReasonToStop(best.mean[0] + kBoundSds * best.sd[0] - fit.transform.Backward(bound),
                             noise);
}

Answer ScalarSearch::Recommend(const SearchRecord& record) {
  if (record.history().size() < 2) {
    return BestObserved(record.told(), record.domain(), "those so far, too few for one");
  }
  const ScalarFit& searched = Fit(record);
  const ScalarFit fit = fitter_.ServesBoth()
                            ? searched
                            : fitter_.Fit(record.history(), record.noise_free(), FitFor::kAnswer);
  Answer answer =
      DescribeMinimum(ScalarModel(fit, kAnswerInflation), record.domain(), Best(record),
                      {.seed = record.options().seed, .feasibility = &record.feasibility()});
  const surrogate::Predictions left_out = fit.process.LeaveOneOut();
  const Eigen::ArrayXd error = left_out.mean - fit.process.values();
  const double z = std::sqrt((error.square() / left_out.variance.array()).mean());
  const Eigen::ArrayXd told = fit.process.values();
  const double spread = std::sqrt((told - told.mean()).square().mean());
  if (spread > 0) answer.left_out_share = std::sqrt(error.square().mean()) / spread;
  answer.model = "Gaussian process of " + std::to_string(record.history().size()) +
                 " evaluations, " + (record.noise_free() ? "deterministic" : "noisy") +
                 "; left out, each is missed by " + Rounded(std::sqrt(error.square().mean())) +
                 (fit.transform.delta > 0 ? " in the logarithm, " : ", ") + Rounded(z) +
                 " x the predicted error";
  return answer;
}

}  // namespace talus::optimizer
