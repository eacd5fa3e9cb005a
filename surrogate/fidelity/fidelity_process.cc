#include "surrogate/fidelity/fidelity_process.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "surrogate/nlopt_minimize.h"
#include "surrogate/process/warp.h"
#include "surrogate/standard_deviation.h"

namespace talus::surrogate {
namespace {

struct Prior {
  Eigen::VectorXd median;
  Eigen::VectorXd sd;
};

Prior PriorOf(const FidelityLayout& layout, const FidelityFitOptions& options) {
  const Eigen::Index d = layout.dimension;
  const FidelityHyper median{.length = Eigen::VectorXd::Constant(d, 0.7),
                             .signal = 1,
                             .trend = 0.5,
                             .discrepancy = 0.3,
                             .noise = options.noise_median,
                             .warp = Eigen::VectorXd::Zero(d)};
  Prior prior{.median = layout.Pack(median), .sd = Eigen::VectorXd(layout.size())};
  prior.sd.head(d).setConstant(0.4);
  prior.sd[layout.signal()] = 0.7;
  prior.sd[layout.trend()] = 1.0;
  prior.sd[layout.discrepancy()] = 0.7;
  prior.sd.segment(layout.noise(), layout.num_levels) = options.noise_log_sd;
  prior.sd.segment(layout.warp(), d).setConstant(2.0);
  prior.sd[layout.decay()] = 1;
  prior.sd[layout.length_ratio()] = 0.7;
  return prior;
}

// Where evaluations at coarse scale factors tell nothing of the target. A search that starts from
// the prior's median ends in another maximum then: it takes them for a rough output without noise.
Eigen::VectorXd UselessLevels(const FidelityLayout& layout, const Prior& prior) {
  FidelityHyper hyper = layout.Unpack(prior.median);
  hyper.decay = 3;
  hyper.discrepancy = 0.5;
  hyper.length_ratio = 0.4;
  hyper.noise.head(layout.num_levels - 1).setConstant(0.7);
  return layout.Pack(hyper);
}

FidelityHyper Search(const FidelityData& data, const FidelityLayout& layout,
                     const FidelityFitOptions& options) {
  constexpr double kMostSds = 4;  // of the prior: the box of the search
  constexpr double kLargestWarp = 5;
  const Prior prior = PriorOf(layout, options);
  const SearchFunction cost = [&](const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) {
    const double log_posterior =
        FidelityLogPosterior(data, layout, prior.median, prior.sd, theta, gradient);
    if (gradient != nullptr && std::isfinite(log_posterior)) *gradient *= -1;
    return -log_posterior;
  };
  SearchTask task{.algorithm = SearchAlgorithm::kLbfgs,
                  .lower = prior.median - kMostSds * prior.sd,
                  .upper = prior.median + kMostSds * prior.sd,
                  .start = prior.median,
                  .max_evaluations = 50,
                  .relative_tolerance = 1e-6};
  task.lower.segment(layout.warp(), layout.dimension).setConstant(-kLargestWarp);
  task.upper.segment(layout.warp(), layout.dimension).setConstant(kLargestWarp);
  Minimum best = Minimize(cost, task);
  if (layout.num_levels > 1) {
    task.start = UselessLevels(layout, prior);
    const Minimum other = Minimize(cost, task);
    if (other.value < best.value) best = other;
  }
  return layout.Unpack(best.point);
}

}  // namespace

FidelityProcess::FidelityProcess(FidelityData data, FidelityState state)
    : data_(std::move(data)), state_(std::move(state)) {
  Factorise();
}

FidelityProcess FidelityProcess::Fit(FidelityData data, const FidelityFitOptions& options) {
  FidelityState state;
  if (options.frozen) {
    state = *options.frozen;
  } else {
    state.centre = data.values.mean();
    state.scale = StandardDeviation(data.values);
    if (!(state.scale > 0)) state.scale = 1;
  }
  data.values = (data.values.array() - state.centre) / state.scale;
  if (!options.frozen) {
    const FidelityLayout layout{.dimension = data.points.rows(),
                                .num_levels = options.noise_median.size()};
    state.hyper = Search(data, layout, options);
  }
  return FidelityProcess(std::move(data), std::move(state));
}

void FidelityProcess::Factorise() {
  warped_ = WarpAll(data_.points, state_.hyper.warp);
  const Eigen::Index size = data_.values.size();
  Eigen::MatrixXd k(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = j; i < size; ++i) {
      const FidelityPair pair =
          FidelityPair::Of(state_.hyper, warped_.col(i).data(), warped_.col(j).data());
      k(i, j) = FidelityCovarianceOf(state_.hyper, pair, data_.growth[i], data_.growth[j]);
    }
    const double noise = state_.hyper.noise[data_.level[j]];
    k(j, j) += noise * noise + 1e-10;  // rounding alone must not make K indefinite
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k.selfadjointView<Eigen::Lower>());
  lower_ = factor.matrixL();
  alpha_ = factor.solve(data_.values);
}

Eigen::MatrixXd FidelityProcess::Cross(const Eigen::MatrixXd& warped, double growth) const {
  Eigen::MatrixXd cross(data_.values.size(), warped.cols());
  for (Eigen::Index j = 0; j < warped.cols(); ++j) {
    for (Eigen::Index i = 0; i < cross.rows(); ++i) {
      const FidelityPair pair =
          FidelityPair::Of(state_.hyper, warped_.col(i).data(), warped.col(j).data());
      cross(i, j) = FidelityCovarianceOf(state_.hyper, pair, data_.growth[i], growth);
    }
  }
  return cross;
}

Predictions FidelityProcess::Predict(const Eigen::MatrixXd& points, double growth) const {
  const Eigen::MatrixXd warped = WarpAll(points.transpose(), state_.hyper.warp);
  const Eigen::MatrixXd cross = Cross(warped, growth);
  const Eigen::MatrixXd half = lower_.triangularView<Eigen::Lower>().solve(cross);
  Predictions result{.mean = cross.transpose() * alpha_, .variance = Eigen::VectorXd(cross.cols())};
  for (Eigen::Index j = 0; j < cross.cols(); ++j) {
    const double* x = warped.col(j).data();
    const double prior =
        FidelityCovarianceOf(state_.hyper, FidelityPair::Of(state_.hyper, x, x), growth, growth);
    result.variance[j] = std::max(0.0, prior - half.col(j).squaredNorm());
  }
  result.mean = state_.centre + state_.scale * result.mean.array();
  result.variance *= state_.scale * state_.scale;
  return result;
}

FidelityProcess::Watched FidelityProcess::Watch(const Eigen::MatrixXd& points) const {
  Watched watched;
  watched.warped = WarpAll(points.transpose(), state_.hyper.warp);
  watched.half = lower_.triangularView<Eigen::Lower>().solve(Cross(watched.warped, 0));
  watched.variance.resize(points.rows());
  for (Eigen::Index j = 0; j < points.rows(); ++j) {
    const double* x = watched.warped.col(j).data();
    const double prior =
        FidelityCovarianceOf(state_.hyper, FidelityPair::Of(state_.hyper, x, x), 0, 0);
    watched.variance[j] =
        state_.scale * state_.scale * std::max(0.0, prior - watched.half.col(j).squaredNorm());
  }
  return watched;
}

FidelityProcess::Teaching FidelityProcess::TeachingOf(const Watched& watched,
                                                      const FidelityPoint& site) const {
  const Eigen::MatrixXd warped = WarpAll(site.x, state_.hyper.warp);
  const double* x = warped.col(0).data();
  const Eigen::VectorXd half =
      lower_.triangularView<Eigen::Lower>().solve(Cross(warped, site.growth));
  const double unit = state_.scale * state_.scale;
  const double prior = FidelityCovarianceOf(state_.hyper, FidelityPair::Of(state_.hyper, x, x),
                                            site.growth, site.growth);
  Teaching teaching{.covariance = -unit * (watched.half.transpose() * half),
                    .site_variance = unit * std::max(0.0, prior - half.squaredNorm())};
  for (Eigen::Index j = 0; j < teaching.covariance.size(); ++j) {
    const FidelityPair pair = FidelityPair::Of(state_.hyper, watched.warped.col(j).data(), x);
    teaching.covariance[j] += unit * FidelityCovarianceOf(state_.hyper, pair, 0, site.growth);
  }
  return teaching;
}

// Residuals and variances from the inverse [dubrule1983].
Predictions FidelityProcess::LeaveOneOut() const {
  const Eigen::Index size = data_.values.size();
  const Eigen::MatrixXd root =
      lower_.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(size, size));
  const Eigen::VectorXd precision = root.colwise().squaredNorm().transpose();
  Predictions result{.mean = data_.values - alpha_.cwiseQuotient(precision),
                     .variance = precision.cwiseInverse()};
  result.mean = state_.centre + state_.scale * result.mean.array();
  result.variance *= state_.scale * state_.scale;
  return result;
}

void FidelityProcess::AddFantasy(const FidelityPoint& at, int level) {
  const double value =
      (Predict(at.x.transpose(), at.growth).mean[0] - state_.centre) / state_.scale;
  const Eigen::Index n = data_.values.size();
  data_.points.conservativeResize(Eigen::NoChange, n + 1);
  data_.points.col(n) = at.x;
  data_.growth.conservativeResize(n + 1);
  data_.growth[n] = at.growth;
  data_.level.conservativeResize(n + 1);
  data_.level[n] = level;
  data_.values.conservativeResize(n + 1);
  data_.values[n] = value;
  Factorise();
}

double FidelityProcess::noise_variance(int level) const {
  const double noise = state_.scale * state_.hyper.noise[level];
  return noise * noise;
}

}  // namespace talus::surrogate
