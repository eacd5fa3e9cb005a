#include "optimizer/strategies/scalar_strategy.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/random.h"
#include "optimizer/acquisition/local_step.h"
#include "optimizer/acquisition/model_step.h"
#include "optimizer/acquisition/step_choice.h"
#include "optimizer/acquisition/trust_region.h"
#include "optimizer/answer/answer.h"
#include "optimizer/designs/design.h"
#include "optimizer/designs/lattice.h"
#include "optimizer/strategies/best_observed.h"

namespace talus::optimizer {
namespace {

// Posterior standard deviations between a bound and the mean, in the rule that ends a search.
constexpr double kStopSds = 1.96;
// Without noise the search ends when this share of the spread of the values is left to gain.
constexpr double kStopShare = 1e-6;
// Two evaluations this close to each other teach under noise what a repeat would.
constexpr double kReplicateDistance = 0.005;

bool Among(const Eigen::VectorXd& point, std::span<const Eigen::VectorXd> points) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Eigen::VectorXd& other) { return SamePoint(point, other); });
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// Where the feasibility is highest among points that are even over the domain: all there is to go
// by while hardly anything has worked.
Eigen::VectorXd MostFeasible(const Domain& domain, const Feasibility& feasibility,
                             std::uint64_t seed) {
  Eigen::VectorXd best = Eigen::VectorXd::Constant(domain.num_parameters, 0.5);
  double highest = -1;
  const Eigen::MatrixXd places = Lattice(1000, domain.num_parameters, seed);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const double probability = feasibility.Probability(places.row(i));
    if (probability <= highest || !domain.Contains(places.row(i))) continue;
    highest = probability;
    best = places.row(i);
  }
  return best;
}

}  // namespace

ScalarStrategy::ScalarStrategy(Domain domain, const ScalarOptions& options)
    : domain_(std::move(domain)), options_(options), fitter_(options.seed) {
  const int dimension = domain_.num_parameters;
  const int size = options.num_initial > 0 ? options.num_initial : 2 * dimension + 3;
  design_ = domain_.guesses;
  for (const Eigen::VectorXd& point : LatinHypercube(size, dimension, options.seed)) {
    if (domain_.Contains(point)) design_.push_back(point);
  }
  history_ = MakeHistory(told_, dimension);
}

std::vector<Proposal> ScalarStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    proposals.push_back(Next(asked));
    asked.push_back(proposals.back().point);
  }
  return proposals;
}

void ScalarStrategy::Tell(const Observation& observation) {
  told_.push_back(observation);
  told_.back().field.clear();  // images are not looked at, and many of them would fill the memory
  history_ = MakeHistory(told_, domain_.num_parameters);
  repeats_ = FindRepeats(history_);
  feasibility_ = Feasibility(history_);
  fit_.reset();
}

Proposal ScalarStrategy::Next(const Points& asked) {
  const auto first = BeforeModel(asked);
  return first ? *first : ByModel(asked);
}

std::optional<Proposal> ScalarStrategy::BeforeModel(const Points& asked) const {
  if (const auto point = NextOfDesign(asked)) return Proposal{*point, Origin::kDesign};
  if (const auto point = FirstRepeat(asked)) return Proposal{*point, Origin::kRepeat};
  return std::nullopt;
}

bool ScalarStrategy::WasEvaluated(const Eigen::VectorXd& point, const Points& asked) const {
  return Among(point, asked) ||
         std::any_of(told_.begin(), told_.end(),
                     [&](const Observation& seen) { return SamePoint(seen.point, point); });
}

// Enough points from elsewhere, such as the trials of another campaign, make the design needless.
std::optional<Eigen::VectorXd> ScalarStrategy::NextOfDesign(const Points& asked) const {
  if (told_.size() + asked.size() >= design_.size()) return std::nullopt;
  for (const Eigen::VectorXd& point : design_) {
    if (!WasEvaluated(point, asked)) return point;
  }
  return std::nullopt;
}

// The best point, since near it the scatter matters; not one that has failed meanwhile.
std::optional<Eigen::VectorXd> ScalarStrategy::FirstRepeat(const Points& asked) const {
  if (repeats_.num_repeats > 0 || history_.size() == 0) return std::nullopt;
  for (Eigen::Index i = 0; i < history_.points.rows(); ++i) {
    if (Among(history_.points.row(i), asked)) return std::nullopt;  // the repeat is under way
  }
  std::optional<Eigen::Index> best;
  for (Eigen::Index i = 0; i < history_.values.size(); ++i) {
    if (best && history_.values[i] >= history_.values[*best]) continue;
    if (!HasFailed(history_.points.row(i))) best = i;
  }
  if (!best) return std::nullopt;
  return history_.points.row(*best);
}

bool ScalarStrategy::HasFailed(const Eigen::VectorXd& point) const {
  return std::any_of(told_.begin(), told_.end(), [&](const Observation& seen) {
    return seen.failed && SamePoint(seen.point, point);
  });
}

Proposal ScalarStrategy::ByModel(const Points& asked) {
  const auto index = told_.size() + asked.size();
  const std::uint64_t seed = options_.seed + 7919 * index;
  if (history_.size() < 2) {
    return NotByAccident(MostFeasible(domain_, feasibility_, seed), asked);
  }
  if (repeats_.deterministic) {
    if (const auto step = NearBest(asked, seed)) return {*step, Origin::kModel};
  }
  surrogate::GaussianProcess believed = Fit().process;
  double incumbent = believed.PredictAll(history_.points).mean.minCoeff();
  for (const Eigen::VectorXd& point : asked) {
    incumbent = std::min(incumbent, believed.Believe(point));  // or the next would land beside it
  }
  const TransformedModel model(std::move(believed));
  const ModelView view{model, feasibility_, domain_, history_.points, seed};
  const double noise = repeats_.deterministic ? 0 : model.NoiseSd(history_.points.row(0));
  return NotByAccident(MostExpectedImprovement(view, incumbent, noise), asked);
}

std::optional<Eigen::VectorXd> ScalarStrategy::NearBest(const Points& asked,
                                                        std::uint64_t seed) const {
  std::optional<Eigen::VectorXd> step;
  switch (NextStep(history_.values, size_of_design() + 1, static_cast<int>(asked.size()))) {
    case Step::kGlobal:
      break;
    case Step::kQuadratic:
      step = TrustRegionStep(history_, domain_);
      break;
    case Step::kLocal:
      step = LocalStep(history_, domain_, asked, seed);
      break;
  }
  if (!step || WasEvaluated(*step, asked) || feasibility_.Probability(*step) < 0.7) {
    return std::nullopt;
  }
  return step;
}

// Under noise a point next to an evaluated one becomes a deliberate replicate of it, as long as
// replicates are left; otherwise it is moved away if it is the very same.
Proposal ScalarStrategy::NotByAccident(const Eigen::VectorXd& point, const Points& asked) const {
  if (!repeats_.deterministic && repeats_.num_repeats < 1 + options_.max_replicates) {
    for (Eigen::Index i = 0; i < history_.points.rows(); ++i) {
      const Eigen::VectorXd near = history_.points.row(i);
      if ((near - point).norm() < kReplicateDistance && !Among(near, asked) && !HasFailed(near)) {
        return {near, Origin::kRepeat};
      }
    }
  }
  base::Random random(options_.seed, base::Stream("not the same point"), told_.size());
  Eigen::VectorXd moved = point;
  for (double reach = 1e-3; WasEvaluated(moved, asked) || !domain_.Contains(moved); reach *= 1.2) {
    for (Eigen::Index k = 0; k < moved.size(); ++k) {
      moved[k] = std::clamp(point[k] + reach * random.Normal(), 0.0, 1.0);
    }
  }
  return {moved, Origin::kModel};
}

const ScalarFit& ScalarStrategy::Fit() {
  if (!fit_) {
    fit_ = fitter_.Fit(history_, repeats_.deterministic);
  }
  return *fit_;
}

// Without noise the best evaluation is known exactly, and beats what a model promises.
Eigen::VectorXd ScalarStrategy::Best() {
  if (repeats_.deterministic) {
    Eigen::Index best = 0;
    history_.values.minCoeff(&best);
    return history_.points.row(best);
  }
  const TransformedModel model(Fit().process);
  return LowestMean({model, feasibility_, domain_, history_.points, options_.seed});
}

std::optional<std::string> ScalarStrategy::StopReason() {
  if (options_.stop_multiple == 0 || repeats_.num_repeats == 0 ||
      told_.size() < 2 * design_.size()) {
    return std::nullopt;
  }
  const ScalarFit& fit = Fit();
  const TransformedModel model(fit.process);
  const ModelView view{model, feasibility_, domain_, history_.points, options_.seed};
  const double bound = fit.transform.Backward(LowestBound(view, kStopSds));
  if (repeats_.deterministic) {
    const double lowest = history_.values.minCoeff();
    const double spread = history_.values.mean() - lowest;
    if (lowest - bound > kStopShare * spread) return std::nullopt;
    return "what is left to gain, at most " + Number(std::max(0.0, lowest - bound)) +
           ", is below a millionth of the spread of the values, " + Number(spread);
  }
  const Moments best = model.Predict(Best().transpose());
  const double noise = model.NoiseSd(history_.points.row(0));
  const double gain = best.mean[0] + kStopSds * best.sd[0] - bound;
  if (!(gain < options_.stop_multiple * noise)) return std::nullopt;
  return "what is left to gain, at most " + Number(gain) + ", is below " +
         Number(options_.stop_multiple) + " x the scatter of one evaluation, " + Number(noise);
}

Answer ScalarStrategy::Recommend() {
  if (history_.size() < 2) return BestObserved(told_, domain_, "too few evaluations for a model");
  const ScalarModel model(Fit());
  Answer answer = DescribeMinimum(model, domain_, Best(), {.seed = options_.seed});
  const surrogate::Predictions left_out = Fit().process.LeaveOneOut();
  const Eigen::ArrayXd error = left_out.mean - Fit().process.values();
  const double z = std::sqrt((error.square() / left_out.variance.array()).mean());
  answer.model = "Gaussian process of " + std::to_string(history_.size()) + " evaluations, " +
                 (repeats_.deterministic ? "deterministic" : "noisy") +
                 "; left out, each is missed by " + Number(std::sqrt(error.square().mean())) +
                 (Fit().transform.delta > 0 ? " in the logarithm, " : ", ") + Number(z) +
                 " x the predicted error";
  return answer;
}

}  // namespace talus::optimizer
