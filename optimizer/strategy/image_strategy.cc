#include "optimizer/strategy/image_strategy.h"

#include <algorithm>
#include <span>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/search/describe_minimum.h"
#include "optimizer/search/image_knowledge.h"
#include "optimizer/search/knowledge_gradient.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

// Each point costs an image, so fewer are looked at than of a process of values. Sums of absolute
// differences have kinks.
constexpr StepSearches kImageSearches{
    .improvement = {.num_candidates = 300, .num_local = 3, .tolerance = 1e-6, .kinked = true},
    .mean = {.num_candidates = 200, .num_local = 3, .max_evaluations = 100, .kinked = true},
    .bound = {.num_candidates = 300, .num_local = 1, .kinked = true},
    .minimisers = {.num_draws = 32, .num_even = 100, .num_near = 100}};

ImageModel WithFantasies(ImageModel model, std::span<const Eigen::VectorXd> asked) {
  for (const Eigen::VectorXd& point : asked) model.AddFantasy(point);
  return model;
}

}  // namespace

ImageStrategy::ImageStrategy(const Domain& domain, const FieldObjective& objective,
                             const SurrogateOptions& options)
    : SurrogateStrategy(domain, options),
      fields_(objective, options.seed),
      by_values_(options.seed),
      has_exact_target_(objective.num_target_heaps == 0),
      num_pixels_(objective.num_pixels()) {}

void ImageStrategy::RequireUsable(const Observation& observation) const {
  if (observation.field.size() == num_pixels_) return;
  throw base::ConfigError("field: has " + std::to_string(observation.field.size()) +
                          " pixels, must have the " + std::to_string(num_pixels_) +
                          " of the objective; tell an evaluation that has no image as failed");
}

void ImageStrategy::Update(const Observation& observation) {
  by_values_.Update();
  if (!observation.failed) fields_.Add(observation);
  is_current_ = false;
}

const std::optional<ImageModel>& ImageStrategy::Model() {
  if (!is_current_) model_ = fields_.Model(record().noise_free());
  is_current_ = true;
  return model_;
}

ModelView ImageStrategy::ViewOf(const ImageModel& model, const Domain& domain,
                                std::uint64_t seed) const {
  const History& history = record().history();
  return {.model = model,
          .feasibility = record().feasibility(),
          .domain = domain,
          .points = history.points,
          .failure_cost = history.values.maxCoeff() - history.values.minCoeff(),
          .searches = kImageSearches,
          .seed = seed};
}

std::uint64_t ImageStrategy::ImageSeed(const Points& asked) const {
  return record().options().seed +
         7919 * (static_cast<std::uint64_t>(fields_.size()) + asked.size());
}

Proposal ImageStrategy::ByModel(const Points& asked) {
  const std::optional<ImageModel>& model = Model();
  if (!model) return by_values_.Next(record(), asked);
  return record().ReplicateOrPerturb(Step(*model, asked), asked);
}

// An exact target has one answer: every third noisy evaluation goes to what the answer would be
// now, and from kFewestForKnowledge on every other one to what would change it most. Of a target
// that is not exact the ranges are wanted too, so every other one explores. Rows that are evaluated
// once want none of these: the best of them is, next to others as good, a lucky one.
Eigen::VectorXd ImageStrategy::Step(const ImageModel& model, const Points& asked) const {
  const int turn = fields_.size() + static_cast<int>(asked.size());
  const bool is_even = turn % 2 == 0;
  if (record().noise_free() || record().wants_own_values()) return ByImprovement(model, asked);
  if (!has_exact_target_) return is_even ? ByDraw(model, asked) : ByImprovement(model, asked);
  if (turn >= kFewestForKnowledge) {
    return is_even ? ByKnowledge(model, asked) : ByImprovement(model, asked);
  }
  return turn % 3 == 0 ? Best(model, record().OpenDomain(asked)) : ByImprovement(model, asked);
}

Eigen::VectorXd ImageStrategy::ByKnowledge(const ImageModel& model, const Points& asked) const {
  const ImageModel with_fantasies = WithFantasies(model, asked);
  const Domain open = record().OpenDomain(asked);
  ModelView view = ViewOf(with_fantasies, open, ImageSeed(asked));
  // Predictions of many images take long, and the draws have the other valleys' minima anyway.
  constexpr int kMany = 300;
  if (fields_.size() > kMany) {
    view.searches.mean.num_local = 1;
    view.searches.minimisers = {.num_draws = 24, .num_even = 60, .num_near = 60};
  }
  const Eigen::MatrixXd minimisers = PossibleMinimisers(view);
  const ImageKnowledge knowledge(with_fantasies, minimisers);
  const KnowledgeStep step = MostKnowledge(
      view, [&](const Eigen::MatrixXd& points) { return knowledge.Gains(points); }, minimisers);
  return step.gain > 0 ? step.point : ByImprovement(model, asked);
}

// The minimiser of one posterior draw. Expected improvement crowds round one of several sets that
// tie; every other evaluation goes where another of them may be, which tells how well the
// parameters are known.
Eigen::VectorXd ImageStrategy::ByDraw(const ImageModel& model, const Points& asked) const {
  constexpr int kNumEven = 300;
  constexpr int kNumNear = 100;
  const auto index = static_cast<std::uint64_t>(fields_.size()) + asked.size();
  base::Random random(record().options().seed, base::Stream("explored draw"), index);
  const Domain open = record().OpenDomain(asked);
  const ModelView view = ViewOf(model, open, record().options().seed);
  const Eigen::VectorXd lowest = LowestMean(view);
  Eigen::MatrixXd candidates =
      Stack(RSequence(kNumEven, view.domain.num_parameters, view.seed + index),
            lowest.transpose().replicate(kNumNear, 1));
  for (Eigen::Index i = 0; i < candidates.rows(); ++i) {
    const double reach = i < kNumEven ? 0 : 0.2 * random.Uniform();
    for (double& x : candidates.row(i)) x = std::clamp(x + reach * random.Normal(), 0.0, 1.0);
  }
  candidates = Stack(lowest.transpose(), Inside(view.domain, candidates));
  const Eigen::VectorXd values = model.Draw(candidates, 1, random).row(0).transpose() -
                                 view.failure_cost * view.feasibility.Penalty(candidates);
  Eigen::Index best = 0;
  values.minCoeff(&best);
  return candidates.row(best);
}

// Under noise the incumbent is an evaluated point, as for numbers; without, the lowest prediction
// anywhere, since the images can be known far better than the evaluations are spaced.
Eigen::VectorXd ImageStrategy::ByImprovement(const ImageModel& model, const Points& asked) const {
  Eigen::MatrixXd centers = BestEvaluated(ViewOf(model, record().domain(), 0));
  Incumbent incumbent{.is_own_value = record().wants_own_values()};
  if (record().noise_free()) {
    centers = Stack(centers, Best(model, record().domain()).transpose());
    centers.row(0).swap(centers.row(centers.rows() - 1));
  } else {
    incumbent.noise = model.NoiseSd(centers.row(0));
  }
  incumbent.value = incumbent.is_own_value ? LowestOwnValue(model) : model.Mean(centers.row(0));
  const ImageModel with_fantasies = WithFantasies(model, asked);
  const Domain open = record().OpenDomain(asked);
  const ModelView view = ViewOf(with_fantasies, open, ImageSeed(asked));
  return MostExpectedImprovement(view, incumbent, centers);
}

// The lowest value told, as the model's mean would have it: the noise of a single image adds to its
// differences from the target, and the mean knows nothing of that.
double ImageStrategy::LowestOwnValue(const ImageModel& model) const {
  const History& history = record().history();
  const double added = (history.values - model.Means(history.points)).mean();
  return history.values.minCoeff() - added;
}

Eigen::VectorXd ImageStrategy::Best(const ImageModel& model, const Domain& domain) const {
  return LowestMean(ViewOf(model, domain, record().options().seed));
}

// Without noise the best evaluation is known. A model may promise less than it: it is believed
// where it is sure, and not where it promises a difference below zero, which no image has.
Eigen::VectorXd ImageStrategy::Recommended(const ImageModel& model) const {
  const Eigen::VectorXd lowest = Best(model, record().domain());
  if (!record().noise_free()) return lowest;
  Eigen::Index best = 0;
  const double evaluated = record().history().values.minCoeff(&best);
  const Moments at = model.Predict(lowest.transpose());
  const bool is_sure = at.mean[0] >= 0 && at.mean[0] + kBoundSds * at.sd[0] < evaluated;
  if (is_sure) return lowest;
  return record().history().points.row(best);
}

std::optional<StopReason> ImageStrategy::WhyStop() {
  if (!record().MayStop(fields_.size())) return std::nullopt;
  if (!Model()) return by_values_.WhyStop(record());
  const Eigen::VectorXd best = Best(*model_, record().domain());
  const Moments at = model_->Predict(best.transpose());
  const double bound =
      LowestBound(ViewOf(*model_, record().domain(), record().options().seed), best.transpose());
  return record().ReasonToStop(at.mean[0] + kBoundSds * at.sd[0] - std::min(bound, at.mean[0]),
                               model_->NoiseSd(best));
}

// A process of the values does not know what an error of the target would change; the ties give an
// idea of it.
Answer ImageStrategy::RecommendByValues() {
  Answer answer = by_values_.Recommend(record());
  if (!has_exact_target_) {
    for (std::size_t k = 0; k < answer.credible.size(); ++k) {
      Range& range = answer.credible[k];
      for (const Eigen::VectorXd& tied : answer.tied) {
        range.low = std::min(range.low, tied[static_cast<Eigen::Index>(k)]);
        range.high = std::max(range.high, tied[static_cast<Eigen::Index>(k)]);
      }
    }
  }
  return answer;
}

Answer ImageStrategy::Recommend() {
  if (!Model()) return RecommendByValues();
  // Each candidate costs an image, so there are fewer than of a process of values; and fewer still
  // where a metric other than the sum of differences is measured on each.
  const bool slow = fields_.has_metric();
  Answer answer = DescribeMinimum(*model_, record().domain(), Recommended(*model_),
                                  {.num_candidates = slow ? 300 : 800,
                                   .num_draw_candidates = slow ? 80 : 300,
                                   .num_draws = slow ? 100 : 200,
                                   .num_sobol = slow ? 32 : 128,
                                   .seed = record().options().seed,
                                   .feasibility = &record().feasibility()});
  answer.left_out_share = fields_.left_out_share();
  answer.model = std::to_string(model_->num_modes()) + " modes of the images of " +
                 std::to_string(fields_.size()) + " evaluations, " +
                 (record().noise_free() ? "deterministic" : "noisy") + "; " + fields_.verdict();
  return answer;
}

}  // namespace talus::optimizer
