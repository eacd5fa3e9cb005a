#include "surrogate/process/likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <utility>

#include "base/normal.h"
#include "surrogate/process/warp.h"

namespace talus::surrogate {
namespace {

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
  // `data` with warped points; `warp_slopes` at the points before, empty without input warping.
  TraceSum(const PooledData& data, Eigen::MatrixXd warp_slopes, const Covariance& covariance,
           const HyperLayout& layout)
      : data_(data),
        warp_slopes_(std::move(warp_slopes)),
        covariance_(covariance),
        hyper_(covariance.hyper()),
        layout_(layout) {}

  Eigen::VectorXd Over(const Eigen::MatrixXd& w) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(layout_.size());
    for (Eigen::Index j = 0; j < w.cols(); ++j) {
      for (Eigen::Index i = 0; i < j; ++i) AddPair(i, j, 2 * w(i, j), sum);
      AddPair(j, j, w(j, j), sum);
      if (!layout_.free_noise) continue;
      const double noise = hyper_.noise[data_.level[j]];
      sum[layout_.noise() + data_.level[j]] += 2 * noise * noise * w(j, j) / data_.counts[j];
    }
    return 0.5 * sum;
  }

 private:
  struct PairSlopes {
    double q = 0;  // dk/dq, weighted
    double p = 0;  // dk/dp, weighted
  };

  void AddPair(Eigen::Index i, Eigen::Index j, double weight, Eigen::VectorXd& sum) const {
    const double g1 = data_.sites.growth[i];
    const double g2 = data_.sites.growth[j];
    const double* a = data_.sites.columns.col(i).data();
    const double* b = data_.sites.columns.col(j).data();
    const PairTerms terms = covariance_.Terms(a, b, g1, g2);
    const double share = weight * terms.target_share;
    const double signal2 = share * hyper_.signal * hyper_.signal;
    const double trend2 = share * hyper_.trend * hyper_.trend;
    PairSlopes slopes{.q = signal2 * terms.rho.slope, .p = trend2 * (1 + 2 * terms.p)};
    sum[layout_.signal()] += 2 * signal2 * terms.rho.value;
    if (layout_.free_trend) {
      sum[layout_.trend()] += 2 * trend2 * (terms.p + terms.p * terms.p);
    }
    if (layout_.has_scale) AddScale(terms, weight, g1 + g2, slopes, sum);
    AddCoordinates(i, j, slopes, sum);
  }

  void AddScale(const PairTerms& terms, double weight, double growth, PairSlopes& slopes,
                Eigen::VectorXd& sum) const {
    const ScaleTerm& scale = *hyper_.scale;
    const double shared = weight * scale.discrepancy * scale.discrepancy * terms.shared_growth;
    const double by_ratio =
        shared * terms.discrepancy_rho.slope / (scale.length_ratio * scale.length_ratio);
    slopes.q += by_ratio;
    slopes.p += shared / 2;
    sum[layout_.discrepancy()] += 2 * shared * (1 + terms.p / 2 + terms.discrepancy_rho.value);
    sum[layout_.decay()] -= growth * (weight * terms.target_share) * covariance_.TargetValue(terms);
    sum[layout_.length_ratio()] -= 2 * by_ratio * terms.q;
  }

  void AddCoordinates(Eigen::Index i, Eigen::Index j, const PairSlopes& slopes,
                      Eigen::VectorXd& sum) const {
    for (Eigen::Index k = 0; k < layout_.dimension; ++k) {
      const double a = data_.sites.columns(k, i);
      const double b = data_.sites.columns(k, j);
      const double inverse = 1 / hyper_.length[k];
      const double step = (a - b) * inverse;
      sum[k] -= 2 * slopes.q * step * step;
      if (!layout_.free_warp) continue;
      const double da = warp_slopes_(k, i);
      const double db = warp_slopes_(k, j);
      sum[layout_.warp() + k] += slopes.q * 2 * step * (da - db) * inverse +
                                 slopes.p * 2 * (da * (2 * b - 1) + db * (2 * a - 1));
    }
  }

  const PooledData& data_;
  Eigen::MatrixXd warp_slopes_;
  const Covariance& covariance_;
  const Hyperparameters& hyper_;
  const HyperLayout& layout_;
};

}  // namespace

Hyperparameters HyperLayout::Unpack(const Eigen::VectorXd& theta) const {
  Hyperparameters hyper;
  hyper.length = theta.head(dimension).array().exp();
  hyper.signal = std::exp(theta[signal()]);
  hyper.trend = free_trend ? std::exp(theta[trend()]) : 0;
  hyper.noise = Eigen::VectorXd::Constant(num_levels, fixed_noise);
  if (free_noise) hyper.noise = theta.segment(noise(), num_levels).array().exp();
  if (free_warp) hyper.warp = theta.segment(warp(), dimension);
  if (has_scale) {
    hyper.scale = ScaleTerm{.discrepancy = std::exp(theta[discrepancy()]),
                            .decay = theta[decay()],
                            .length_ratio = std::exp(theta[length_ratio()])};
  }
  return hyper;
}

Eigen::VectorXd HyperLayout::Pack(const Hyperparameters& hyper) const {
  Eigen::VectorXd theta(size());
  theta.head(dimension) = hyper.length.array().log();
  theta[signal()] = std::log(hyper.signal);
  if (free_trend) theta[trend()] = std::log(hyper.trend);
  if (free_noise) theta.segment(noise(), num_levels) = hyper.noise.array().log();
  if (free_warp) theta.segment(warp(), dimension) = hyper.warp;
  if (has_scale) {
    theta[discrepancy()] = std::log(hyper.scale->discrepancy);
    theta[decay()] = hyper.scale->decay;
    theta[length_ratio()] = std::log(hyper.scale->length_ratio);
  }
  return theta;
}

Eigen::MatrixXd NoisyCovariance(const Covariance& covariance, const PooledData& data,
                                double nugget) {
  Eigen::MatrixXd k = covariance.Among(data.sites);
  for (Eigen::Index j = 0; j < k.cols(); ++j) {
    const double noise = covariance.hyper().noise[data.level[j]];
    k(j, j) += noise * noise / data.counts[j] + nugget;
  }
  return k;
}

double PoolingTerm(const PooledData& data, const Eigen::VectorXd& noise) {
  if (data.num_extra.sum() == 0) return 0;
  const Eigen::ArrayXd noise2 = noise.array().square();
  return -0.5 *
         ((data.num_extra.array() * noise2.log() + data.sum_of_squares.array() / noise2).sum() +
          data.counts.array().log().sum());
}

double LogLikelihood(const PooledData& raw, Kernel kernel, const HyperLayout& layout,
                     const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) {
  const Covariance covariance(kernel, layout.Unpack(theta));
  const Hyperparameters& hyper = covariance.hyper();
  PooledData data = raw;
  data.sites.columns = WarpAll(raw.sites.columns, hyper.warp);
  const Eigen::LLT<Eigen::MatrixXd> factor(NoisyCovariance(covariance, data));
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Eigen::VectorXd alpha = factor.solve(data.values);
  const double log_root = factor.matrixLLT().diagonal().array().log().sum();  // ½ ln|K|
  const auto size = data.size();
  if (gradient != nullptr) {
    Eigen::MatrixXd w = -factor.solve(Eigen::MatrixXd::Identity(size, size));
    w.noalias() += alpha * alpha.transpose();
    const Eigen::MatrixXd slopes =
        layout.free_warp ? WarpSlopes(raw.sites.columns, hyper.warp) : Eigen::MatrixXd();
    *gradient = TraceSum(data, slopes, covariance, layout).Over(w);
    if (layout.free_noise) {
      gradient->segment(layout.noise(), layout.num_levels) +=
          data.sum_of_squares.cwiseQuotient(hyper.noise.cwiseAbs2()) - data.num_extra;
    }
  }
  return -0.5 * data.values.dot(alpha) - log_root + PoolingTerm(data, hyper.noise);
}

ThetaPrior::ThetaPrior(const HyperPriors& priors, const HyperLayout& layout) : sd(layout.size()) {
  Hyperparameters hyper{.length = Eigen::VectorXd::Constant(layout.dimension, priors.length.median),
                        .signal = priors.signal.median,
                        .trend = priors.trend.median,
                        .noise = Eigen::VectorXd(layout.num_levels),
                        .warp = Eigen::VectorXd::Zero(layout.dimension),
                        .scale = ScaleTerm{.discrepancy = priors.discrepancy.median,
                                           .decay = 0,
                                           .length_ratio = priors.length_ratio.median}};
  for (Eigen::Index l = 0; l < layout.num_levels; ++l) {
    const LogNormal& noise = priors.noise.at(static_cast<std::size_t>(l));
    hyper.noise[l] = noise.median;
    if (layout.free_noise) sd[layout.noise() + l] = noise.log_sd;
  }
  median = layout.Pack(hyper);
  sd.head(layout.dimension).setConstant(priors.length.log_sd);
  sd[layout.signal()] = priors.signal.log_sd;
  if (layout.free_trend) sd[layout.trend()] = priors.trend.log_sd;
  if (layout.free_warp) sd.segment(layout.warp(), layout.dimension).setConstant(priors.warp_sd);
  if (layout.has_scale) {
    sd[layout.discrepancy()] = priors.discrepancy.log_sd;
    sd[layout.decay()] = priors.decay_sd;
    sd[layout.length_ratio()] = priors.length_ratio.log_sd;
  }
}

double ThetaPrior::LogDensity(const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) const {
  const Eigen::VectorXd z = (theta - median).cwiseQuotient(sd);
  if (gradient != nullptr) *gradient -= z.cwiseQuotient(sd);
  return -0.5 * z.squaredNorm();
}

double ThetaPrior::LogConstant() const {
  return -sd.array().log().sum() - base::kLogRootTwoPi * static_cast<double>(sd.size());
}

}  // namespace talus::surrogate
