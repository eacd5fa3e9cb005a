#include "surrogate/process/gaussian_process.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/normal.h"
#include "base/parallel_for.h"
#include "surrogate/process/map_fit.h"
#include "surrogate/process/warp.h"
#include "surrogate/standard_deviation.h"

namespace talus::surrogate {
namespace {

// Mean and standard deviation of the values, with a standard deviation that is safe to divide by.
GaussianProcessState ScaleOf(const Eigen::VectorXd& values, double usual_sd) {
  const double centre = values.mean();
  const double sd = StandardDeviation(values);
  if (sd > 1e-12 * std::abs(centre)) return {.hyper = {}, .centre = centre, .scale = sd};
  if (usual_sd > 0) return {.hyper = {}, .centre = centre, .scale = usual_sd};
  // All the same: their own size is the only one there is, and zeros have none. A tiny scale would
  // make the process certain everywhere.
  return {.hyper = {}, .centre = centre, .scale = centre != 0 ? std::abs(centre) : 1};
}

// k(X, columns) → L⁻¹ k(X, columns), in blocks of columns that do not depend on the threads. One
// column is solved as a vector: the routine for many first copies L, which takes longer than that.
void SolveColumns(const Eigen::MatrixXd& lower, Eigen::MatrixXd& columns) {
  if (columns.cols() == 1) {
    auto column = columns.col(0);
    lower.triangularView<Eigen::Lower>().solveInPlace(column);
    return;
  }
  constexpr Eigen::Index kBlock = 64;
  const auto size = static_cast<double>(lower.rows());
  base::ParallelFor(
      {.num_items = (columns.cols() + kBlock - 1) / kBlock, .item_work = kBlock * size * size / 2},
      [&](std::int64_t i) {
        const Eigen::Index first = kBlock * i;
        const Eigen::Index count = std::min(kBlock, columns.cols() - first);
        lower.triangularView<Eigen::Lower>().solveInPlace(columns.middleCols(first, count));
      });
}

}  // namespace

GaussianProcess GaussianProcess::Fit(const Evaluations& evaluations,
                                     const GaussianProcessOptions& options) {
  const Eigen::VectorXd& values = evaluations.values;
  if (values.size() == 0 || evaluations.points.rows() != values.size() ||
      !evaluations.points.allFinite() || !values.allFinite()) {
    throw base::Error("a Gaussian process needs at least one point and finite values");
  }
  GaussianProcessState state = options.frozen ? *options.frozen : ScaleOf(values, options.usual_sd);
  const auto num_levels = static_cast<Eigen::Index>(options.priors.noise.size());
  Evaluations scaled = evaluations;
  scaled.values = (values.array() - state.centre) / state.scale;
  PooledData data = Pool(scaled, static_cast<int>(num_levels));
  const HyperLayout layout{.dimension = evaluations.points.cols(),
                           .num_levels = num_levels,
                           .free_trend = options.trend == Trend::kQuadratic,
                           .free_noise = !options.deterministic,
                           .fixed_noise = std::sqrt(options.noise_floor),
                           .free_warp = options.warp_inputs,
                           .has_scale = num_levels > 1 || (data.sites.growth.array() > 0).any()};
  double log_prior = 0;
  if (!options.frozen) {
    const MapFit fit = FitHyperparameters(data, layout, options);
    state.hyper = layout.Unpack(fit.theta);
    log_prior = fit.log_prior;
  }
  GaussianProcess process(std::move(data), std::move(state), options.kernel);
  process.log_prior_ = log_prior;
  return process;
}

GaussianProcess::GaussianProcess(PooledData data, GaussianProcessState state, Kernel kernel)
    : data_(std::move(data)), state_(std::move(state)), covariance_(kernel, state_.hyper) {
  Factorise();
}

Sites GaussianProcess::Warp(const Eigen::MatrixXd& points, double growth) const {
  return Sites::At(WarpAll(points.transpose(), state_.hyper.warp), growth);
}

void GaussianProcess::Factorise() {
  constexpr double kJitter = 1e-10;  // of values scaled to 1: far below any noise
  warped_ = {WarpAll(data_.sites.columns, state_.hyper.warp), data_.sites.growth};
  PooledData seen = data_;
  seen.sites = warped_;
  jitter_ = kJitter;
  Eigen::LLT<Eigen::MatrixXd> factor(NoisyCovariance(covariance_, seen, jitter_));
  while (factor.info() != Eigen::Success) {
    jitter_ *= 10;
    factor.compute(NoisyCovariance(covariance_, seen, jitter_));
  }
  lower_ = factor.matrixL();
  alpha_ = factor.solve(data_.values);
}

void GaussianProcess::Add(const Site& site, double value) {
  const Eigen::Index before = data_.size();
  const Eigen::Index place = AddTo(data_, site, (value - state_.centre) / state_.scale);
  if (place < before) {
    Factorise();  // a replicate changes the noise of a point in the middle of the factor
  } else {
    AppendRow(site);
  }
}

double GaussianProcess::AddFantasy(const Site& site) {
  const double mean = PredictAll(site.x.transpose(), site.growth).mean[0];
  Add(site, mean);
  return mean;
}

// Rank one: the new last row of L is (L⁻¹ k, √(k(x, x) + n² - |L⁻¹ k|²)).
void GaussianProcess::AppendRow(const Site& site) {
  const Eigen::Index size = lower_.rows();
  const Sites added = Warp(site.x.transpose(), site.growth);
  const Eigen::MatrixXd k = covariance_.Between(warped_, added);
  const Eigen::VectorXd row = lower_.triangularView<Eigen::Lower>().solve(k.col(0));
  const double noise = state_.hyper.noise[site.level];
  const double prior = covariance_.Diagonal(added)[0];
  const double pivot = prior + noise * noise + jitter_ - row.squaredNorm();
  if (!(pivot > 0)) {
    Factorise();
    return;
  }
  warped_.columns.conservativeResize(Eigen::NoChange, size + 1);
  warped_.columns.col(size) = added.columns.col(0);
  warped_.growth.conservativeResize(size + 1);
  warped_.growth[size] = site.growth;
  lower_.conservativeResize(size + 1, size + 1);
  lower_.col(size).setZero();
  lower_.row(size).head(size) = row;
  lower_(size, size) = std::sqrt(pivot);
  alpha_ = lower_.triangularView<Eigen::Lower>().solve(data_.values);
  lower_.transpose().triangularView<Eigen::Upper>().solveInPlace(alpha_);
}

Prediction GaussianProcess::Predict(const Eigen::VectorXd& x) const {
  const Sites at = Warp(x.transpose(), 0);
  const Eigen::VectorXd k = covariance_.Between(warped_, at).col(0);
  const Eigen::VectorXd v = lower_.triangularView<Eigen::Lower>().solve(k);
  const double variance = covariance_.Diagonal(at)[0] - v.squaredNorm();
  return {.mean = state_.centre + state_.scale * k.dot(alpha_),
          .variance = state_.scale * state_.scale * std::max(0.0, variance)};
}

Predictions GaussianProcess::PredictAll(const Eigen::MatrixXd& points, double growth) const {
  const Sites sites = Warp(points, growth);
  Eigen::MatrixXd k = covariance_.Between(warped_, sites);
  Predictions result;
  result.mean = state_.centre + state_.scale * (k.transpose() * alpha_).array();
  SolveColumns(lower_, k);
  const Eigen::VectorXd known = k.colwise().squaredNorm();
  result.variance =
      state_.scale * state_.scale * (covariance_.Diagonal(sites) - known).cwiseMax(0.0);
  return result;
}

AnchorPoints GaussianProcess::Anchor(const Eigen::MatrixXd& points) const {
  AnchorPoints anchors{.sites = Warp(points, 0), .whitened = {}, .variance = {}};
  anchors.whitened =
      lower_.triangularView<Eigen::Lower>().solve(covariance_.Between(warped_, anchors.sites));
  const Eigen::VectorXd known = anchors.whitened.colwise().squaredNorm();
  anchors.variance =
      state_.scale * state_.scale * (covariance_.Diagonal(anchors.sites) - known).cwiseMax(0.0);
  return anchors;
}

Covariances GaussianProcess::PosteriorCovariances(const AnchorPoints& anchors,
                                                  const Eigen::MatrixXd& points,
                                                  double growth) const {
  const Sites sites = Warp(points, growth);
  Eigen::MatrixXd v = covariance_.Between(warped_, sites);
  SolveColumns(lower_, v);
  const double scale2 = state_.scale * state_.scale;
  const Eigen::VectorXd known = v.colwise().squaredNorm();
  return {.between = scale2 *
                     (covariance_.Between(anchors.sites, sites) - anchors.whitened.transpose() * v),
          .variance = scale2 * (covariance_.Diagonal(sites) - known).cwiseMax(0.0)};
}

PredictionGradient GaussianProcess::PredictWithGradient(const Eigen::VectorXd& x) const {
  const Sites at = Warp(x.transpose(), 0);
  const Eigen::VectorXd warped = at.columns.col(0);
  const Eigen::VectorXd k = covariance_.Between(warped_, at).col(0);
  const Eigen::MatrixXd slope = covariance_.Gradient(warped, warped_);  // d × u
  Eigen::VectorXd v = lower_.triangularView<Eigen::Lower>().solve(k);
  const double variance = covariance_.Diagonal(at)[0] - v.squaredNorm();
  lower_.transpose().triangularView<Eigen::Upper>().solveInPlace(v);  // now K⁻¹ k
  PredictionGradient result;
  const double scale2 = state_.scale * state_.scale;
  result.value = {.mean = state_.centre + state_.scale * k.dot(alpha_),
                  .variance = scale2 * std::max(0.0, variance)};
  result.mean = state_.scale * (slope * alpha_);
  result.variance = scale2 * (covariance_.DiagonalGradient(warped) - 2 * (slope * v));
  for (Eigen::Index i = 0; i < state_.hyper.warp.size(); ++i) {  // from d/dw to d/dx
    const double factor = WarpAt(x[i], state_.hyper.warp[i]).slope;
    result.mean[i] *= factor;
    result.variance[i] *= factor;
  }
  return result;
}

Eigen::MatrixXd GaussianProcess::Draw(const Eigen::MatrixXd& points, int num_draws,
                                      base::Random random) const {
  const Sites sites = Warp(points, 0);
  Eigen::MatrixXd v = covariance_.Between(warped_, sites);
  const Eigen::VectorXd mean = v.transpose() * alpha_;
  SolveColumns(lower_, v);
  Eigen::MatrixXd posterior = covariance_.Among(sites) - v.transpose() * v;
  // Robust Cholesky: the posterior is singular at and between close points.
  const Eigen::LDLT<Eigen::MatrixXd> factor(posterior);
  const Eigen::VectorXd root = factor.vectorD().cwiseMax(0.0).cwiseSqrt();
  Eigen::MatrixXd normal(points.rows(), num_draws);
  for (Eigen::Index j = 0; j < num_draws; ++j) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) normal(i, j) = random.Normal();
  }
  Eigen::MatrixXd draws = factor.matrixL() * (root.asDiagonal() * normal);
  draws = factor.transpositionsP().transpose() * draws;
  draws.colwise() += mean;
  return (state_.centre + state_.scale * draws.array()).matrix().transpose();
}

// [dubrule1983]: the residual is αᵢ / (K⁻¹)ᵢᵢ and its variance 1 / (K⁻¹)ᵢᵢ.
Predictions GaussianProcess::LeaveOneOut() const {
  const Eigen::Index size = data_.values.size();
  const Eigen::MatrixXd inverse_lower =
      lower_.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(size, size));
  const Eigen::VectorXd inverse_diagonal = inverse_lower.colwise().squaredNorm();
  Predictions result;
  result.mean = state_.centre +
                state_.scale * (data_.values - alpha_.cwiseQuotient(inverse_diagonal)).array();
  result.variance = state_.scale * state_.scale * inverse_diagonal.cwiseInverse();
  return result;
}

double GaussianProcess::LogLikelihood() const {
  return -0.5 * data_.values.dot(alpha_) - lower_.diagonal().array().log().sum() +
         PoolingTerm(data_, state_.hyper.noise) -
         data_.num_values() * (base::kLogRootTwoPi + std::log(state_.scale));
}

double GaussianProcess::LogPosterior() const { return LogLikelihood() + log_prior_; }

double GaussianProcess::noise_variance(int level) const {
  const double noise = state_.scale * state_.hyper.noise[level];
  return noise * noise;
}

Eigen::VectorXd GaussianProcess::values() const {
  return state_.centre + state_.scale * data_.values.array();
}

}  // namespace talus::surrogate
