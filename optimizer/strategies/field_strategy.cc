#include "optimizer/strategies/field_strategy.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "base/random.h"
#include "optimizer/acquisition/model_search.h"
#include "optimizer/answer/answer.h"
#include "optimizer/designs/lattice.h"
#include "optimizer/space/places.h"

namespace talus::optimizer {
namespace {

constexpr int kNumCenters = 5;
constexpr double kStopSds = 1.96;
constexpr double kStopShare = 1e-6;  // of the spread of the values, when there is no scatter

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

Eigen::VectorXd MeansOf(const FieldModel& model, const Eigen::MatrixXd& points) {
  Eigen::VectorXd means(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) means[i] = model.Mean(points.row(i));
  return means;
}

// The evaluated points of the lowest predicted mean.
Eigen::MatrixXd Centers(const FieldModel& model, const Eigen::MatrixXd& points) {
  const Eigen::VectorXd mean = MeansOf(model, points);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(mean.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return mean[a] < mean[b]; });
  order.resize(std::min<std::size_t>(order.size(), kNumCenters));
  return points(order, Eigen::all);
}

}  // namespace

FieldStrategy::FieldStrategy(const Domain& domain, const FieldObjective& objective, bool always,
                             const ScalarOptions& options)
    : domain_(domain),
      options_(options),
      scalar_(domain, options),
      fields_(objective, always, options.seed),
      has_exact_target_(objective.num_target_heaps == 0) {}

void FieldStrategy::Tell(const Observation& observation) {
  scalar_.Tell(observation);
  if (!observation.failed) fields_.Add(observation);
  is_current_ = false;
}

const std::optional<FieldModel>& FieldStrategy::Model() {
  if (!is_current_) model_ = fields_.Model(scalar_.deterministic());
  is_current_ = true;
  return model_;
}

std::vector<Proposal> FieldStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    proposals.push_back(Next(asked));
    asked.push_back(proposals.back().point);
  }
  return proposals;
}

Proposal FieldStrategy::Next(const Points& asked) {
  if (const auto first = scalar_.BeforeModel(asked)) return *first;
  const std::optional<FieldModel>& model = Model();
  if (!model) return scalar_.Ask(1, asked).front();
  return scalar_.NotByAccident(NextByModel(*model, asked), asked);
}

// An exact target has one answer, so every third noisy evaluation goes to what the answer would be
// now. Of a target that is not exact the ranges are wanted too, so every other one explores.
Eigen::VectorXd FieldStrategy::NextByModel(const FieldModel& model, const Points& asked) const {
  const int turn = scalar_.history().size() + static_cast<int>(asked.size());
  if (!scalar_.deterministic()) {
    if (has_exact_target_ && turn % 3 == 0) return LowestMean(model);
    if (!has_exact_target_ && turn % 2 == 0) return ByDraw(model, asked);
  }
  return ByImprovement(model, asked);
}

// The minimiser of one draw of what is not known. Expected improvement crowds round one of several
// sets that tie; every other evaluation goes where another of them may be, which is what tells how
// well the parameters are known.
Eigen::VectorXd FieldStrategy::ByDraw(const FieldModel& model, const Points& asked) const {
  constexpr int kNumEven = 300;
  constexpr int kNumNear = 100;
  const auto index = static_cast<std::uint64_t>(fields_.size()) + asked.size();
  base::Random random(options_.seed, base::Stream("explored draw"), index);
  const Eigen::VectorXd lowest = LowestMean(model);
  Eigen::MatrixXd places = Stack(Lattice(kNumEven, domain_.num_parameters, options_.seed + index),
                                 lowest.transpose().replicate(kNumNear, 1));
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const double reach = i < kNumEven ? 0 : 0.2 * random.Uniform();
    for (double& x : places.row(i)) x = std::clamp(x + reach * random.Normal(), 0.0, 1.0);
  }
  places = Stack(lowest.transpose(), Inside(domain_, places));
  const History& history = scalar_.history();
  const double spread = history.values.maxCoeff() - history.values.minCoeff();
  const Eigen::VectorXd values = model.Draw(places, 1, random).row(0).transpose() -
                                 spread * scalar_.feasibility().Penalty(places);
  Eigen::Index best = 0;
  values.minCoeff(&best);
  return places.row(best);
}

// Under noise the incumbent is an evaluated point, as in the scalar strategy; without, the lowest
// prediction anywhere, since the images can be known far better than the evaluations are spaced.
Eigen::VectorXd FieldStrategy::ByImprovement(const FieldModel& model, const Points& asked) const {
  Eigen::MatrixXd centers = Centers(model, scalar_.history().points);
  double noise = 0;
  if (scalar_.deterministic()) {
    centers.conservativeResize(centers.rows() + 1, Eigen::NoChange);
    centers.bottomRows(1) = LowestMean(model).transpose();
    centers.row(0).swap(centers.row(centers.rows() - 1));
  } else {
    noise = model.NoiseSd(centers.row(0));
  }
  const double incumbent = model.Mean(centers.row(0));
  FieldModel believed = model;
  for (const Eigen::VectorXd& point : asked) believed.Believe(point);
  const auto values = [&](const Eigen::MatrixXd& points) -> Eigen::VectorXd {
    return -believed.LogImprovement(points, incumbent, noise) -
           scalar_.feasibility().Penalty(points);
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return values(x.transpose())[0];
  };
  return SearchCube({values, value}, domain_, centers,
                    {.num_candidates = 300,
                     .num_local = 3,
                     .tolerance = 1e-6,
                     .kinked = true,
                     .seed = options_.seed +
                             7919 * static_cast<std::uint64_t>(fields_.size() + asked.size())})
      .point;
}

// A failure costs as much as the spread of the values.
Eigen::VectorXd FieldStrategy::LowestMean(const FieldModel& model) const {
  const History& history = scalar_.history();
  const double spread = history.values.maxCoeff() - history.values.minCoeff();
  const auto values = [&](const Eigen::MatrixXd& points) -> Eigen::VectorXd {
    return MeansOf(model, points) - spread * scalar_.feasibility().Penalty(points);
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return values(x.transpose())[0];
  };
  return SearchCube({values, value}, domain_, Centers(model, history.points),
                    {.num_candidates = 200,
                     .num_local = 3,
                     .max_evaluations = 100,
                     .kinked = true,
                     .seed = options_.seed})
      .point;
}

std::optional<std::string> FieldStrategy::StopReason() {
  if (options_.stop_multiple == 0 || !scalar_.knows_scatter() ||
      fields_.size() < 2 * scalar_.size_of_design()) {
    return std::nullopt;
  }
  if (!Model()) return scalar_.StopReason();
  const FieldModel& model = *model_;
  const Eigen::VectorXd best = LowestMean(model);
  const Moments at = model.Predict(best.transpose());
  const auto lower = [&](const Eigen::MatrixXd& points) -> Eigen::VectorXd {
    const Moments moments = model.Predict(points);
    return moments.mean - kStopSds * moments.sd;
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return lower(x.transpose())[0];
  };
  const double bound =
      SearchCube({lower, value}, domain_, best.transpose(),
                 {.num_candidates = 300, .num_local = 1, .kinked = true, .seed = options_.seed})
          .value;
  const double gain = at.mean[0] + kStopSds * at.sd[0] - std::min(bound, at.mean[0]);
  const double noise = model.NoiseSd(best);
  const Eigen::VectorXd& seen = scalar_.history().values;
  const double enough = scalar_.deterministic() ? kStopShare * (seen.mean() - seen.minCoeff())
                                                : options_.stop_multiple * noise;
  if (!(gain < enough)) return std::nullopt;
  if (scalar_.deterministic()) {
    return "what is left to gain, at most " + Number(gain) +
           ", is below a millionth of the spread of the values";
  }
  return "what is left to gain, at most " + Number(gain) + ", is below " +
         Number(options_.stop_multiple) + " x the scatter of one evaluation, " + Number(noise);
}

// A process of the values does not know what an error of the target would change; the ties give an
// idea of it.
Answer FieldStrategy::RecommendByValues() {
  Answer answer = scalar_.Recommend();
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

Answer FieldStrategy::Recommend() {
  if (!Model()) return RecommendByValues();
  // Each place costs an image, so there are fewer than a scalar model is asked at; and fewer still
  // where a metric other than the sum of differences is measured on each.
  const bool slow = fields_.has_metric();
  Answer answer = DescribeMinimum(*model_, domain_, LowestMean(*model_),
                                  {.num_places = slow ? 300 : 800,
                                   .num_draw_places = slow ? 80 : 300,
                                   .num_draws = slow ? 100 : 200,
                                   .num_sobol = slow ? 32 : 128,
                                   .seed = options_.seed});
  answer.model = std::to_string(model_->num_modes()) + " modes of the images of " +
                 std::to_string(fields_.size()) + " evaluations, " +
                 (scalar_.deterministic() ? "deterministic" : "noisy") + "; " + fields_.verdict();
  return answer;
}

}  // namespace talus::optimizer
