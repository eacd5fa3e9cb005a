#include "optimizer/search/describe_minimum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/posterior/credible_ranges.h"
#include "optimizer/posterior/sobol_indices.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

// Candidates round `point` at distances from 3e-5 to 0.3, since the minimum may be known that well.
Eigen::MatrixXd Around(const Eigen::VectorXd& point, int count, std::uint64_t seed) {
  base::Random random(seed, base::Stream("around the answer"));
  Eigen::MatrixXd candidates(count, point.size());
  for (int i = 0; i < count; ++i) {
    const double radius = 0.3 * std::pow(10.0, -4 * random.Uniform());
    for (Eigen::Index k = 0; k < point.size(); ++k) {
      candidates(i, k) = std::clamp(point[k] + radius * random.Normal(), 0.0, 1.0);
    }
  }
  return candidates;
}

struct Box {
  Eigen::VectorXd low;
  Eigen::VectorXd high;
};

// The box of some points, a fifth wider on each side, within the cube.
Box Wrap(const Eigen::MatrixXd& points) {
  const Eigen::VectorXd low = points.colwise().minCoeff();
  const Eigen::VectorXd high = points.colwise().maxCoeff();
  const Eigen::VectorXd margin = (0.2 * (high - low)).cwiseMax(1e-7);
  return {(low - margin).cwiseMax(0.0), (high + margin).cwiseMin(1.0)};
}

Eigen::MatrixXd RSequenceIn(const Box& box, const AnswerOptions& options) {
  const Eigen::MatrixXd unit =
      RSequence(options.num_candidates, static_cast<int>(box.low.size()), options.seed + 1);
  return (unit * (box.high - box.low).asDiagonal()).rowwise() + box.low.transpose();
}

// At most `count` rows, the first and then evenly through all of them.
Eigen::MatrixXd FewOf(const Eigen::MatrixXd& points, Eigen::Index count) {
  if (points.rows() <= count) return points;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < count; ++i) kept.push_back(i * points.rows() / count);
  return points(kept, Eigen::all);
}

// Rows of `candidates` where the minimum may be: within three posterior standard deviations of its
// value.
Eigen::MatrixXd Plausible(const ObjectiveModel& model, const Eigen::MatrixXd& candidates,
                          double lowest) {
  const Moments moments = model.Predict(candidates);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < candidates.rows(); ++i) {
    if (moments.mean[i] - 3 * moments.sd[i] <= lowest) kept.push_back(i);
  }
  return candidates(kept, Eigen::all);
}

// Where draws are minimised: the answer, half the candidates even over the box of all plausible
// ones, and half as they come, which are dense near the answer. Not the most plausible ones: those
// all lie close to the answer, and every credible range would be narrow.
Eigen::MatrixXd DrawCandidates(const ObjectiveModel& model, const Domain& domain,
                               const Eigen::MatrixXd& candidates, const Answer& answer,
                               const AnswerOptions& options) {
  const Eigen::MatrixXd plausible =
      Stack(answer.point.transpose(), Plausible(model, candidates, answer.predicted_value));
  const Eigen::MatrixXd even = Plausible(
      model, Inside(domain, RSequenceIn(Wrap(plausible), options)), answer.predicted_value);
  const Eigen::Index half = options.num_draw_candidates / 2;
  return Stack(FewOf(plausible, half), FewOf(even, half));
}

// One minimiser of each posterior draw, a row each.
Eigen::MatrixXd MinimisersAmong(const ObjectiveModel& model, const Eigen::MatrixXd& candidates,
                                const AnswerOptions& options) {
  const Eigen::MatrixXd draws = model.Draw(
      candidates, options.num_draws, base::Random(options.seed, base::Stream("answer draws")));
  Eigen::MatrixXd minimisers(draws.rows(), candidates.cols());
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    Eigen::Index lowest = 0;
    draws.row(i).minCoeff(&lowest);
    minimisers.row(i) = candidates.row(lowest);
  }
  return minimisers;
}

// New candidates where minimisers have been found: each is one of these, moved by half the
// difference of two others, so that the candidates follow the shape of the cloud, however thin or
// curved it is.
Eigen::MatrixXd Among(const Eigen::MatrixXd& minimisers, int count, base::Random random) {
  const auto any = [&] {
    return static_cast<Eigen::Index>(random.Below(static_cast<std::uint64_t>(minimisers.rows())));
  };
  Eigen::MatrixXd candidates(count, minimisers.cols());
  for (int i = 0; i < count; ++i) {
    const Eigen::RowVectorXd from = minimisers.row(any());
    const Eigen::RowVectorXd step = minimisers.row(any()) - minimisers.row(any());
    const double reach = 0.5 * random.Normal();
    for (Eigen::Index k = 0; k < candidates.cols(); ++k) {
      const double jitter = 1e-3 * random.Normal();  // where the cloud is a point or a line
      candidates(i, k) = std::clamp(from[k] + reach * step[k] + jitter, 0.0, 1.0);
    }
  }
  return candidates;
}

// The first candidates are everywhere the minimum may be, too far from each other to tell where in
// there the minimisers lie. So most of them are moved to where minimisers were found, twice.
Eigen::MatrixXd DrawMinimisers(const ObjectiveModel& model, const Domain& domain,
                               const Eigen::MatrixXd& first, const AnswerOptions& options) {
  constexpr int kRounds = 3;
  Eigen::MatrixXd minimisers = MinimisersAmong(model, first, options);
  for (int round = 1; round < kRounds; ++round) {
    const base::Random random(options.seed, base::Stream("answer places"),
                              static_cast<std::uint64_t>(round));
    const Eigen::MatrixXd moved = Inside(
        domain, Among(minimisers, static_cast<int>(first.rows() - first.rows() / 4), random));
    const Eigen::Index num_first = std::max<Eigen::Index>(1, first.rows() / 4);
    minimisers = MinimisersAmong(model, Stack(FewOf(first, num_first), moved), options);
  }
  return minimisers;
}

// A skewed posterior may leave the minimiser of the mean out; the ranges are meant to hold it.
void Include(const Eigen::VectorXd& point, std::vector<Range>& ranges) {
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const double x = point[static_cast<Eigen::Index>(k)];
    ranges[k] = {.low = std::min(ranges[k].low, x), .high = std::max(ranges[k].high, x)};
  }
}

Eigen::MatrixXd Correlation(const Eigen::MatrixXd& sample) {
  const Eigen::MatrixXd centred = sample.rowwise() - sample.colwise().mean();
  const Eigen::MatrixXd covariance = centred.transpose() * centred;
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  Eigen::MatrixXd result = Eigen::MatrixXd::Identity(sample.cols(), sample.cols());
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      if (i != j && sd[i] > 0 && sd[j] > 0) result(i, j) = covariance(i, j) / (sd[i] * sd[j]);
    }
  }
  return result;
}

// Rows of `candidates` whose mean is at most `level`.
Eigen::MatrixXd Below(const ObjectiveModel& model, const Eigen::MatrixXd& candidates,
                      double level) {
  const Eigen::VectorXd mean = model.Predict(candidates).mean;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    if (mean[i] <= level) kept.push_back(i);
  }
  return candidates(kept, Eigen::all);
}

// A few of the points, each the farthest from those before; the first is farthest from `point`.
std::vector<Eigen::VectorXd> FarthestApart(const Eigen::MatrixXd& points,
                                           const Eigen::VectorXd& point, int count) {
  std::vector<Eigen::VectorXd> chosen;
  Eigen::VectorXd nearest = (points.rowwise() - point.transpose()).rowwise().squaredNorm();
  while (static_cast<int>(chosen.size()) < std::min<Eigen::Index>(count, points.rows())) {
    Eigen::Index far = 0;
    nearest.maxCoeff(&far);
    chosen.emplace_back(points.row(far));
    nearest = nearest.cwiseMin((points.rowwise() - points.row(far)).rowwise().squaredNorm());
  }
  return chosen;
}

// One at least: what was told may lie beside the levels, and a narrow box round it has none.
std::vector<double> LevelsIn(const Domain& domain, const Box& box, Eigen::Index k) {
  const double low = domain.Snap(box.low)[k];
  const double high = domain.Snap(box.high)[k];
  std::vector<double> inside;
  for (const double level : domain.levels[static_cast<std::size_t>(k)]) {
    if (level >= low && level <= high) inside.push_back(level);
  }
  return inside;
}

// Points of a box with levelled coordinates evenly on the levels in it.
Eigen::MatrixXd OnLevels(const Domain& domain, const Box& box, Eigen::MatrixXd points) {
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    if (!domain.HasLevels(k)) continue;
    const std::vector<double> inside = LevelsIn(domain, box, k);
    const auto size = static_cast<double>(inside.size());
    points.col(k) = points.col(k).unaryExpr([&](double x) {
      const double share = (x - box.low[k]) / (box.high[k] - box.low[k]);
      return inside[static_cast<std::size_t>(std::clamp(share * size, 0.0, size - 1))];
    });
  }
  return points;
}

// The share of all there is that a box has: of a levelled coordinate its levels count.
double ShareOf(const Domain& domain, const Box& box) {
  double share = 1;
  for (Eigen::Index k = 0; k < box.low.size(); ++k) {
    share *= domain.HasLevels(k)
                 ? static_cast<double>(LevelsIn(domain, box, k).size()) /
                       static_cast<double>(domain.levels[static_cast<std::size_t>(k)].size())
                 : box.high[k] - box.low[k];
  }
  return share;
}

// The tied set is found in the cube and near the answer, then measured by an even sample of the box
// it lies in, so that its volume is known however small it is.
void DescribeTies(const ObjectiveModel& model, const Domain& domain,
                  const Eigen::MatrixXd& candidates, const AnswerOptions& options, Answer& answer) {
  constexpr int kNumTied = 12;
  const double tolerance = answer.noise_sd > 0 ? answer.noise_sd : answer.predicted_sd;
  const double level = answer.predicted_value + tolerance;
  if (domain.IsList()) {
    const Eigen::MatrixXd inside = Below(model, domain.candidates, level);
    answer.tied_volume =
        static_cast<double>(inside.rows()) / static_cast<double>(domain.candidates.rows());
    answer.tied = FarthestApart(inside, answer.point, kNumTied);
    return;
  }
  const Eigen::MatrixXd tied = Stack(Below(model, candidates, level), answer.point.transpose());
  const Box box = Wrap(tied);
  const Eigen::MatrixXd even = OnLevels(domain, box, RSequenceIn(box, options));
  const Eigen::MatrixXd inside = Below(model, Inside(domain, even), level);
  answer.tied_volume =
      ShareOf(domain, box) * static_cast<double>(inside.rows()) / options.num_candidates;
  answer.tied = FarthestApart(inside, answer.point, kNumTied);
}

}  // namespace

std::vector<BoundWarning> BoundWarnings(const Eigen::VectorXd& point) {
  constexpr double kNear = 0.005;
  std::vector<BoundWarning> warnings;
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    if (point[i] > kNear && point[i] < 1 - kNear) continue;
    warnings.push_back({.parameter = static_cast<int>(i), .is_upper = point[i] > 0.5});
  }
  return warnings;
}

std::string BoundText(const std::string& parameter, bool is_upper, bool has_levels) {
  if (has_levels) {
    return parameter + " is the " + (is_upper ? "highest" : "lowest") +
           " of its levels: the minimum may lie beyond";
  }
  return parameter + " lies on its " + (is_upper ? "upper" : "lower") + " bound: widen its range";
}

Answer DescribeMinimum(const ObjectiveModel& model, const Domain& whole,
                       const Eigen::VectorXd& point, const AnswerOptions& options) {
  const Domain domain =
      options.feasibility == nullptr ? whole : options.feasibility->LikelyToWork(whole);
  Answer answer;
  answer.point = point;
  const Moments at = model.Predict(point.transpose());
  answer.predicted_value = at.mean[0];
  answer.predicted_sd = at.sd[0];
  answer.noise_sd = model.NoiseSd(point);
  const Eigen::MatrixXd candidates =
      Inside(domain, Stack(RSequence(options.num_candidates, domain.num_parameters, options.seed),
                           Around(point, options.num_candidates / 2, options.seed)));
  const Eigen::MatrixXd minimisers = DrawMinimisers(
      model, domain, DrawCandidates(model, domain, candidates, answer, options), options);
  answer.credible = CredibleRanges(minimisers);
  Include(point, answer.credible);
  answer.correlation = Correlation(minimisers);
  DescribeTies(model, domain, candidates, options, answer);
  if (domain.IsList()) {
    answer.tied_volume *= static_cast<double>(domain.candidates.rows()) /
                          static_cast<double>(whole.candidates.rows());
  }
  SobolIndices indices = EstimateSobolIndices(
      [&](const Eigen::MatrixXd& points) { return model.Predict(points).mean; },
      {.dimension = domain.num_parameters, .num_base = options.num_sobol, .seed = options.seed});
  answer.sobol_first = std::move(indices.first);
  answer.sobol_total = std::move(indices.total);
  answer.warnings = BoundWarnings(point);
  return answer;
}

}  // namespace talus::optimizer
