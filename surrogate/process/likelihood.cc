#include "surrogate/process/likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>

#include "surrogate/process/warp.h"

namespace talus::surrogate {
namespace {

const double kLog2Pi = std::log(2 * std::numbers::pi);

// dw/dc of every coordinate of every point.
Eigen::MatrixXd WarpSlopes(const Eigen::MatrixXd& points, const Eigen::VectorXd& strengths) {
  Eigen::MatrixXd slopes(points.rows(), points.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      slopes(k, j) = WarpAt(points(k, j), strengths[k]).warp_slope;
    }
  }
  return slopes;
}

// ½ Σᵢⱼ Wᵢⱼ ∂Kᵢⱼ/∂θ for symmetric W, over the pairs i < j twice and the diagonal once.
class TraceSum {
 public:
  // `data` with warped points; `warp_slopes` of the points before, empty without input warping.
  TraceSum(const PooledData& data, Eigen::MatrixXd warp_slopes, Kernel kernel,
           const Hyperparameters& hyper, const HyperLayout& layout)
      : data_(data),
        warp_slopes_(std::move(warp_slopes)),
        kernel_(kernel),
        hyper_(hyper),
        layout_(layout) {
    inverse_length_ = hyper.length.cwiseInverse();
    squared_.resize(hyper.length.size());
  }

  Eigen::VectorXd Of(const Eigen::MatrixXd& w) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(layout_.size());
    for (Eigen::Index j = 0; j < w.cols(); ++j) {
      for (Eigen::Index i = 0; i < j; ++i) AddPair(i, j, 2 * w(i, j), sum);
      AddPair(j, j, w(j, j), sum);
    }
    if (layout_.free_noise) {
      sum[layout_.noise_index()] =
          2 * hyper_.noise * hyper_.noise * w.diagonal().cwiseQuotient(data_.counts).sum();
    }
    return 0.5 * sum;
  }

 private:
  void AddPair(Eigen::Index i, Eigen::Index j, double weight, Eigen::VectorXd& sum) {
    const double* a = data_.points.col(i).data();
    const double* b = data_.points.col(j).data();
    double q = 0;
    double p = 0;
    for (Eigen::Index k = 0; k < layout_.dimension; ++k) {
      const double step = (a[k] - b[k]) * inverse_length_[k];
      squared_[k] = step * step;
      q += squared_[k];
      p += (2 * a[k] - 1) * (2 * b[k] - 1);
    }
    const Correlation rho = CorrelationAt(kernel_, q);
    const double signal2 = weight * hyper_.signal * hyper_.signal;
    for (Eigen::Index k = 0; k < layout_.dimension; ++k) {
      sum[k] -= 2 * signal2 * rho.slope * squared_[k];
    }
    sum[layout_.dimension] += 2 * signal2 * rho.value;
    if (layout_.free_trend) {
      sum[layout_.trend_index()] += 2 * weight * hyper_.trend * hyper_.trend * (p + p * p);
    }
    if (layout_.free_warp) {
      AddBends(i, j, {signal2 * rho.slope, weight * hyper_.trend * hyper_.trend * (1 + 2 * p)},
               sum);
    }
  }

  struct PairSlopes {
    double q = 0;  // dk/dq, weighted
    double p = 0;  // dk/dp, weighted
  };

  void AddBends(Eigen::Index i, Eigen::Index j, const PairSlopes& slope, Eigen::VectorXd& sum) {
    for (Eigen::Index k = 0; k < layout_.dimension; ++k) {
      const double a = data_.points(k, i);
      const double b = data_.points(k, j);
      const double da = warp_slopes_(k, i);
      const double db = warp_slopes_(k, j);
      const double dq = 2 * (a - b) * (da - db) * inverse_length_[k] * inverse_length_[k];
      const double dp = 2 * da * (2 * b - 1) + 2 * db * (2 * a - 1);
      sum[layout_.warp_index() + k] += slope.q * dq + slope.p * dp;
    }
  }

  const PooledData& data_;
  Eigen::MatrixXd warp_slopes_;
  Kernel kernel_;
  const Hyperparameters& hyper_;
  const HyperLayout& layout_;
  Eigen::VectorXd inverse_length_;
  Eigen::VectorXd squared_;
};

}  // namespace

Hyperparameters HyperLayout::Unpack(const Eigen::VectorXd& theta) const {
  Hyperparameters hyper;
  hyper.length = theta.head(dimension).array().exp();
  hyper.signal = std::exp(theta[dimension]);
  hyper.trend = free_trend ? std::exp(theta[trend_index()]) : 0;
  hyper.noise = free_noise ? std::exp(theta[noise_index()]) : fixed_noise;
  if (free_warp) hyper.warp = theta.tail(dimension);
  return hyper;
}

Eigen::VectorXd HyperLayout::Pack(const Hyperparameters& hyper) const {
  Eigen::VectorXd theta(size());
  theta.head(dimension) = hyper.length.array().log();
  theta[dimension] = std::log(hyper.signal);
  if (free_trend) theta[trend_index()] = std::log(hyper.trend);
  if (free_noise) theta[noise_index()] = std::log(hyper.noise);
  if (free_warp) theta.tail(dimension) = hyper.warp;
  return theta;
}

Eigen::MatrixXd NoisyCovariance(const Covariance& covariance, const PooledData& data) {
  const Eigen::Index size = data.values.size();
  const double noise2 = covariance.hyper().noise * covariance.hyper().noise;
  Eigen::MatrixXd k(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = j; i < size; ++i) {
      k(i, j) = covariance.At(data.points.col(i).data(), data.points.col(j).data());
    }
    k(j, j) += noise2 / data.counts[j];
  }
  return k.selfadjointView<Eigen::Lower>();
}

double PoolingTerm(const PooledData& data, double noise_variance) {
  const auto num_extra = static_cast<double>(data.num_values - data.values.size());
  if (num_extra == 0) return 0;
  return -0.5 * (num_extra * (kLog2Pi + std::log(noise_variance)) +
                 data.sum_of_squares / noise_variance + data.counts.array().log().sum());
}

double LogLikelihood(const PooledData& raw, Kernel kernel, const HyperLayout& layout,
                     const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) {
  const Covariance covariance(kernel, layout.Unpack(theta));
  const Eigen::VectorXd& strengths = covariance.hyper().warp;
  PooledData data = raw;
  data.points = WarpAll(raw.points, strengths);
  const Eigen::LLT<Eigen::MatrixXd> factor(NoisyCovariance(covariance, data));
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Eigen::VectorXd alpha = factor.solve(data.values);
  const double log_root = factor.matrixLLT().diagonal().array().log().sum();  // ½ ln|K|
  const double noise2 = covariance.hyper().noise * covariance.hyper().noise;
  const auto size = data.values.size();
  if (gradient != nullptr) {
    Eigen::MatrixXd w = -factor.solve(Eigen::MatrixXd::Identity(size, size));
    w.noalias() += alpha * alpha.transpose();
    const Eigen::MatrixXd slopes =
        layout.free_warp ? WarpSlopes(raw.points, strengths) : Eigen::MatrixXd();
    *gradient = TraceSum(data, slopes, kernel, covariance.hyper(), layout).Of(w);
    if (layout.free_noise) {
      const auto num_extra = static_cast<double>(data.num_values - size);
      (*gradient)[layout.noise_index()] += data.sum_of_squares / noise2 - num_extra;
    }
  }
  return -0.5 * data.values.dot(alpha) - log_root - 0.5 * static_cast<double>(size) * kLog2Pi +
         PoolingTerm(data, noise2);
}

Eigen::VectorXd PriorMedian(const HyperPriors& priors, const HyperLayout& layout) {
  return layout.Pack({.length = Eigen::VectorXd::Constant(layout.dimension, priors.length.median),
                      .signal = priors.signal.median,
                      .trend = priors.trend.median,
                      .noise = priors.noise.median,
                      .warp = Eigen::VectorXd::Zero(layout.dimension)});
}

Eigen::VectorXd PriorSd(const HyperPriors& priors, const HyperLayout& layout) {
  Eigen::VectorXd sd(layout.size());
  sd.head(layout.dimension).setConstant(priors.length.log_sd);
  sd[layout.dimension] = priors.signal.log_sd;
  if (layout.free_trend) sd[layout.trend_index()] = priors.trend.log_sd;
  if (layout.free_noise) sd[layout.noise_index()] = priors.noise.log_sd;
  if (layout.free_warp) sd.tail(layout.dimension).setConstant(priors.warp_sd);
  return sd;
}

double LogPrior(const HyperPriors& priors, const HyperLayout& layout, const Eigen::VectorXd& theta,
                Eigen::VectorXd* gradient) {
  const Eigen::VectorXd sd = PriorSd(priors, layout);
  const Eigen::VectorXd z = (theta - PriorMedian(priors, layout)).cwiseQuotient(sd);
  if (gradient != nullptr) *gradient -= z.cwiseQuotient(sd);
  return -0.5 * z.squaredNorm() - sd.array().log().sum() -
         0.5 * static_cast<double>(layout.size()) * kLog2Pi;
}

}  // namespace talus::surrogate
