#include "optimizer/search/knowledge_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/normal.h"
#include "base/parallel_for.h"
#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

constexpr double kDropWork = 1e4;  // multiplications of one expected drop of the minimum

// φ(z) - |z| Φ(-|z|): what a line that crosses another one at z adds to the expected maximum.
double Crossing(double z) {
  const double t = std::abs(z);
  return base::NormalDensity(t) - t * base::NormalProbability(-t);
}

struct Line {
  double height = 0;
  double slope = 0;
};

// The lines that are the highest one somewhere, by ascending slope [frazier2009, algorithm 1].
std::vector<Line> UpperEnvelope(std::vector<Line> lines) {
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return a.slope < b.slope || (a.slope == b.slope && a.height < b.height);
  });
  const auto crossing = [](const Line& a, const Line& b) {
    return (a.height - b.height) / (b.slope - a.slope);
  };
  std::vector<Line> upper;
  for (const Line& line : lines) {
    if (!upper.empty() && upper.back().slope == line.slope) upper.pop_back();
    while (upper.size() > 1 &&
           crossing(upper.back(), line) <= crossing(upper[upper.size() - 2], upper.back())) {
      upper.pop_back();
    }
    upper.push_back(line);
  }
  return upper;
}

}  // namespace

double ExpectedDropOfMinimum(const Eigen::VectorXd& mean, const Eigen::VectorXd& slope) {
  std::vector<Line> lines;
  for (Eigen::Index i = 0; i < mean.size(); ++i) lines.push_back({-mean[i], slope[i]});
  const std::vector<Line> upper = UpperEnvelope(std::move(lines));
  double sum = 0;
  for (std::size_t i = 0; i + 1 < upper.size(); ++i) {
    const double step = upper[i + 1].slope - upper[i].slope;
    sum += step * Crossing((upper[i].height - upper[i + 1].height) / step);
  }
  return sum;
}

Eigen::MatrixXd PossibleMinimisers(const ModelView& view) {
  const int dimension = view.domain.num_parameters;
  base::Random random(view.seed, base::Stream("possible minimisers"));
  const Eigen::MatrixXd evaluated = BestEvaluated(view);
  const Eigen::VectorXd best = LowestMean(view, evaluated);
  const Eigen::MatrixXd centers = Stack(best.transpose(), evaluated);
  Eigen::MatrixXd near(view.searches.minimisers.num_near, dimension);
  for (Eigen::Index i = 0; i < near.rows(); ++i) {
    const double radius = 0.3 * std::pow(10.0, -2 * random.Uniform());
    for (Eigen::Index k = 0; k < dimension; ++k) {
      near(i, k) = std::clamp(centers(i % centers.rows(), k) + radius * random.Normal(), 0.0, 1.0);
    }
  }
  const Eigen::MatrixXd even = RSequence(view.searches.minimisers.num_even, dimension, view.seed);
  const Eigen::MatrixXd candidates =
      Stack(best.transpose(), Inside(view.domain, Stack(even, near)));
  Eigen::MatrixXd draws = view.model.Draw(candidates, view.searches.minimisers.num_draws, random);
  draws.rowwise() -= (view.failure_cost * view.feasibility.Penalty(candidates)).transpose();
  std::vector<Eigen::Index> chosen{0};
  for (Eigen::Index d = 0; d < draws.rows(); ++d) {
    Eigen::Index lowest = 0;
    draws.row(d).minCoeff(&lowest);
    if (std::find(chosen.begin(), chosen.end(), lowest) == chosen.end()) chosen.push_back(lowest);
  }
  return candidates(chosen, Eigen::all);
}

KnowledgeGains GainsOfValues(const surrogate::GaussianProcess& process,
                             const Eigen::MatrixXd& minimisers) {
  return [&process, mean = process.PredictAll(minimisers).mean,
          anchors = process.Anchor(minimisers)](const Eigen::MatrixXd& points) {
    const surrogate::Covariances at = process.PosteriorCovariances(anchors, points);
    const double noise2 = process.noise_variance();
    Eigen::VectorXd result(points.rows());
    base::ParallelFor({.num_items = points.rows(), .item_work = kDropWork}, [&](Eigen::Index i) {
      const double sd = std::sqrt(at.variance[i] + noise2);
      result[i] = ExpectedDropOfMinimum(mean, at.between.col(i) / sd);
    });
    return result;
  };
}

KnowledgeStep MostKnowledge(const ModelView& view, const KnowledgeGains& gains,
                            const Eigen::MatrixXd& minimisers) {
  const auto values = [&](const Eigen::MatrixXd& points) -> Eigen::VectorXd {
    const Eigen::ArrayXd gain = gains(points).array().max(std::numeric_limits<double>::min());
    return -gain.log().matrix() - view.feasibility.Penalty(points);
  };
  const auto value = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return values(x.transpose())[0];
  };
  const double work = kDropWork + view.model.PredictionWork();
  const Found found = SearchCube({values, value, work}, view.domain, minimisers,
                                 {.num_candidates = 400,
                                  .num_local = 2,
                                  .max_evaluations = 60,
                                  .tolerance = 1e-4,
                                  .kinked = true,
                                  .seed = view.seed});
  return {.point = found.point, .gain = gains(found.point.transpose())[0]};
}

}  // namespace talus::optimizer
