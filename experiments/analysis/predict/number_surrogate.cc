#include "experiments/analysis/predict/number_surrogate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "optimizer/outputs/levels.h"
#include "surrogate/standard_deviation.h"

namespace talus::analysis {
namespace {

using optimizer::Levels;

// The runs that have the number.
struct DefinedRuns {
  std::vector<std::size_t> run;
  Levels levels;
};

// No number is told at a scale factor at which hardly a run has it, unless runs at two others show
// what the scale factor changes.
double ScaleFactorOf(const Prediction& prediction, const PredictedNumber& number) {
  std::map<double, int> num_runs;
  for (std::size_t r = 0; r < number.by_run.size(); ++r) {
    if (std::isfinite(number.by_run[r])) ++num_runs[prediction.runs[r].scale_factor];
  }
  std::erase_if(num_runs,
                [](const auto& level) { return level.second < NumberSurrogate::kFewestRuns; });
  if (num_runs.size() < 2) return prediction.scale_factor;
  return std::min(prediction.target, num_runs.begin()->first);
}

std::optional<DefinedRuns> DefinedRunsOf(const Prediction& prediction,
                                         const PredictedNumber& number, double scale_factor) {
  std::vector<std::size_t> runs;
  std::set<int> draws;
  std::set<double> scale_factors;
  for (std::size_t r = 0; r < number.by_run.size(); ++r) {
    if (!std::isfinite(number.by_run[r])) continue;
    if (prediction.runs[r].scale_factor < scale_factor) continue;
    runs.push_back(r);
    draws.insert(prediction.runs[r].draw);
    scale_factors.insert(prediction.runs[r].scale_factor);
  }
  if (draws.size() < NumberSurrogate::kFewest) return std::nullopt;
  return DefinedRuns{.run = std::move(runs),
                     .levels = Levels({scale_factors.begin(), scale_factors.end()}, scale_factor)};
}

surrogate::Evaluations EvaluationsOf(const Prediction& prediction, const PredictedNumber& number,
                                     const DefinedRuns& defined, const Eigen::MatrixXd& points) {
  const auto count = static_cast<Eigen::Index>(defined.run.size());
  surrogate::Evaluations evaluations{.points = Eigen::MatrixXd(count, points.cols()),
                                     .values = Eigen::VectorXd(count),
                                     .growth = Eigen::VectorXd(count),
                                     .level = Eigen::VectorXi(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t r = defined.run[static_cast<std::size_t>(i)];
    const PredictedRun& run = prediction.runs[r];
    evaluations.points.row(i) = points.row(run.draw);
    evaluations.values[i] = number.by_run[r];
    evaluations.level[i] = defined.levels.LevelOf(run.scale_factor);
    evaluations.growth[i] = defined.levels.growth(evaluations.level[i]);
  }
  return evaluations;
}

// Scatter of a single run over the spread of all, from runs of one draw where there are some, and
// with as many grains at the others (levels.h).
std::vector<surrogate::LogNormal> NoisePriors(const Prediction& prediction,
                                              const PredictedNumber& number, const Levels& levels,
                                              double spread) {
  constexpr double kLeast = 1e-3;
  constexpr double kRepeated = 0.7;  // log sd; the repeats themselves are told
  constexpr double kByGrains = 0.35;
  const surrogate::LogNormal usual = surrogate::HyperPriors{}.noise.front();
  const int base = levels.LevelOf(prediction.scale_factor);
  std::vector<surrogate::LogNormal> priors;
  for (int l = 0; l < levels.size(); ++l) {
    const double ratio = levels.NoiseAtTarget(base) / levels.NoiseAtTarget(l);
    surrogate::LogNormal prior{.median = usual.median * ratio, .log_sd = usual.log_sd};
    if (std::isfinite(number.repeats_sd)) {
      prior = {.median = std::clamp(number.repeats_sd / spread * ratio, kLeast, 1.0),
               .log_sd = l == base ? kRepeated : kByGrains};
    }
    priors.push_back(prior);
  }
  return priors;
}

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// The mean of a draw's runs at one scale factor, as a process pools them.
struct PooledMean {
  int draw = 0;
  double scale_factor = 1;
  double growth = 0;
  double value = 0;
};

std::vector<PooledMean> PooledMeansOf(const surrogate::GaussianProcess& process,
                                      const Prediction& prediction, const DefinedRuns& defined) {
  const Eigen::VectorXd values = process.values();
  std::vector<PooledMean> means;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const PredictedRun& run =
        prediction.runs[defined.run[static_cast<std::size_t>(process.first()[i])]];
    means.push_back({.draw = run.draw,
                     .scale_factor = run.scale_factor,
                     .growth = defined.levels.growth(defined.levels.LevelOf(run.scale_factor)),
                     .value = values[i]});
  }
  return means;
}

// By the weighted mean of the other draws at the prediction's own scale factor.
double MissedByDraws(const Prediction& prediction, const std::vector<PooledMean>& means,
                     const PooledMean& left) {
  double sum = 0;
  double total = 0;
  for (const PooledMean& other : means) {
    if (other.draw == left.draw || other.scale_factor != prediction.scale_factor) continue;
    const double weight = prediction.draws[static_cast<std::size_t>(other.draw)].weight;
    sum += weight * other.value;
    total += weight;
  }
  return sum / total - left.value;
}

// The runs of a number, as a process is told them.
struct ToldRuns {
  const Prediction& prediction;
  const DefinedRuns& defined;
  const surrogate::Evaluations& evaluations;
  rigs::Bounds bounds;
};

surrogate::Evaluations WithoutDraw(const ToldRuns& told, int draw) {
  std::vector<Eigen::Index> rest;
  for (Eigen::Index i = 0; i < told.evaluations.values.size(); ++i) {
    const std::size_t run = told.defined.run[static_cast<std::size_t>(i)];
    if (told.prediction.runs[run].draw != draw) rest.push_back(i);
  }
  return {.points = told.evaluations.points(rest, Eigen::all),
          .values = told.evaluations.values(rest),
          .growth = told.evaluations.growth(rest),
          .level = told.evaluations.level(rest)};
}

struct LeftOutErrors {
  double surrogate = 0;
  double draws = 0;
};

// With the process's hyper-parameters, and each draw left out with all its runs.
LeftOutErrors ErrorsOf(const surrogate::GaussianProcess& process,
                       surrogate::GaussianProcessOptions options, const ToldRuns& told,
                       const Eigen::MatrixXd& points) {
  options.frozen = process.state();
  const std::vector<PooledMean> means = PooledMeansOf(process, told.prediction, told.defined);
  std::vector<double> by_surrogate;
  std::vector<double> by_draws;
  for (const PooledMean& mean : means) {
    if (mean.scale_factor > told.prediction.scale_factor) continue;
    const auto without = surrogate::GaussianProcess::Fit(WithoutDraw(told, mean.draw), options);
    const double told_mean = without.PredictAll(points.row(mean.draw), mean.growth).mean[0];
    by_surrogate.push_back(told.bounds.Clamp(told_mean) - mean.value);
    by_draws.push_back(MissedByDraws(told.prediction, means, mean));
  }
  return {.surrogate = RootMeanSquare(by_surrogate), .draws = RootMeanSquare(by_draws)};
}

}  // namespace

Eigen::MatrixXd PointsOf(const Prediction& prediction, const optimizer::ParameterSpace& space) {
  const std::vector<int> free = space.Free();
  Eigen::MatrixXd points(static_cast<Eigen::Index>(prediction.draws.size()),
                         static_cast<Eigen::Index>(free.size()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const auto place = static_cast<std::size_t>(k);
      const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(free[place])];
      points(i, k) = p.ToUnit(prediction.draws[static_cast<std::size_t>(i)].values[place]);
    }
  }
  return points;
}

std::optional<NumberSurrogate> NumberSurrogate::Fit(const Prediction& prediction,
                                                    const PredictedNumber& number,
                                                    const optimizer::ParameterSpace& space) {
  const double scale_factor = ScaleFactorOf(prediction, number);
  const std::optional<DefinedRuns> defined = DefinedRunsOf(prediction, number, scale_factor);
  if (!defined) return std::nullopt;
  const Levels& levels = defined->levels;
  const Eigen::MatrixXd points = PointsOf(prediction, space);
  const surrogate::Evaluations evaluations = EvaluationsOf(prediction, number, *defined, points);
  NumberSurrogate fitted;
  fitted.scale_factor_ = scale_factor;
  fitted.constant_ = evaluations.values.mean();
  fitted.bounds_ = rigs::BoundsOf(number.name);
  const double spread = surrogate::StandardDeviation(evaluations.values);
  if (!(spread > 1e-12 * std::abs(fitted.constant_))) return fitted;
  const surrogate::GaussianProcessOptions options{
      .trend = surrogate::Trend::kQuadratic,  // over the draws, a small part of the range
      .priors = surrogate::PriorsOfOutputs(NoisePriors(prediction, number, levels, spread))};
  fitted.process_ = surrogate::GaussianProcess::Fit(evaluations, options);
  fitted.run_sd_ = levels.NoiseAtTarget(levels.finest()) *
                   std::sqrt(fitted.process_->noise_variance(levels.finest()));

  const LeftOutErrors errors = ErrorsOf(*fitted.process_, options,
                                        {.prediction = prediction,
                                         .defined = *defined,
                                         .evaluations = evaluations,
                                         .bounds = fitted.bounds_},
                                        points);
  fitted.left_out_error_ = errors.surrogate;
  fitted.draws_error_ = errors.draws;
  return fitted;
}

surrogate::Predictions NumberSurrogate::At(const Eigen::MatrixXd& points) const {
  if (process_) {
    surrogate::Predictions at = process_->PredictAll(points);
    at.mean = at.mean.cwiseMax(bounds_.low).cwiseMin(bounds_.high);
    return at;
  }
  return {.mean = Eigen::VectorXd::Constant(points.rows(), constant_),
          .variance = Eigen::VectorXd::Zero(points.rows())};
}

}  // namespace talus::analysis
