#include "surrogate/fidelity/fidelity_covariance.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "surrogate/process/covariance.h"
#include "surrogate/process/warp.h"

namespace talus::surrogate {
namespace {

constexpr Kernel kKernel = Kernel::kMatern52;

// K = cov + n² on the diagonal, of points warped already.
Eigen::MatrixXd NoisyCovariance(const FidelityData& data, const FidelityHyper& hyper) {
  const Eigen::Index size = data.values.size();
  Eigen::MatrixXd k(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = j; i < size; ++i) {
      const FidelityPair pair =
          FidelityPair::Of(hyper, data.points.col(i).data(), data.points.col(j).data());
      k(i, j) = FidelityCovarianceOf(hyper, pair, data.growth[i], data.growth[j]);
    }
    const double noise = hyper.noise[data.level[j]];
    k(j, j) += noise * noise;
  }
  return k.selfadjointView<Eigen::Lower>();
}

// What the discrepancies of a pair have in common: g g' + (g² - g)(g'² - g').
double SharedGrowth(double g1, double g2) { return g1 * g2 + (g1 * g1 - g1) * (g2 * g2 - g2); }

// How much is left of the covariance at the target.
double TargetShare(const FidelityHyper& hyper, double g1, double g2) {
  return std::exp(-hyper.decay * (g1 + g2));
}

Correlation DiscrepancyCorrelation(const FidelityHyper& hyper, const FidelityPair& pair) {
  return CorrelationAt(kKernel, pair.q / (hyper.length_ratio * hyper.length_ratio));
}

// But for the constant.
double TargetCovariance(const FidelityHyper& hyper, const FidelityPair& pair) {
  return hyper.trend * hyper.trend * (pair.p + pair.p * pair.p) +
         hyper.signal * hyper.signal * pair.rho.value;
}

// ½ Σᵢⱼ Wᵢⱼ ∂Kᵢⱼ/∂θ for symmetric W.
class GradientSum {
 public:
  GradientSum(const FidelityData& warped, const Eigen::MatrixXd& warp_slopes,
              const FidelityHyper& hyper, const FidelityLayout& layout)
      : data_(warped), slopes_(warp_slopes), hyper_(hyper), layout_(layout) {}

  Eigen::VectorXd Of(const Eigen::MatrixXd& w) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(layout_.size());
    for (Eigen::Index j = 0; j < w.cols(); ++j) {
      for (Eigen::Index i = 0; i < j; ++i) AddPair(i, j, 2 * w(i, j), sum);
      AddPair(j, j, w(j, j), sum);
      const double noise = hyper_.noise[data_.level[j]];
      sum[layout_.noise() + data_.level[j]] += 2 * noise * noise * w(j, j);
    }
    return 0.5 * sum;
  }

 private:
  void AddPair(Eigen::Index i, Eigen::Index j, double weight, Eigen::VectorXd& sum) const {
    const double* a = data_.points.col(i).data();
    const double* b = data_.points.col(j).data();
    const FidelityPair pair = FidelityPair::Of(hyper_, a, b);
    const double g1 = data_.growth[i];
    const double g2 = data_.growth[j];
    const double share = weight * TargetShare(hyper_, g1, g2);
    const double signal2 = share * hyper_.signal * hyper_.signal;
    const double trend2 = share * hyper_.trend * hyper_.trend;
    const double shared = weight * hyper_.discrepancy * hyper_.discrepancy * SharedGrowth(g1, g2);
    const Correlation rho_d = DiscrepancyCorrelation(hyper_, pair);
    const double by_ratio = shared * rho_d.slope / (hyper_.length_ratio * hyper_.length_ratio);
    const double by_q = signal2 * pair.rho.slope + by_ratio;
    const double by_p = trend2 * (1 + 2 * pair.p) + shared / 2;
    for (Eigen::Index k = 0; k < layout_.dimension; ++k) {
      const double inverse = 1 / hyper_.length[k];
      const double step = (a[k] - b[k]) * inverse;
      sum[k] -= 2 * by_q * step * step;
      const double da = slopes_(k, i);
      const double db = slopes_(k, j);
      sum[layout_.warp() + k] += by_q * 2 * step * (da - db) * inverse +
                                 by_p * 2 * (da * (2 * b[k] - 1) + db * (2 * a[k] - 1));
    }
    sum[layout_.signal()] += 2 * signal2 * pair.rho.value;
    sum[layout_.trend()] += 2 * trend2 * (pair.p + pair.p * pair.p);
    sum[layout_.discrepancy()] += 2 * shared * (1 + pair.p / 2 + rho_d.value);
    sum[layout_.decay()] -= (g1 + g2) * share * TargetCovariance(hyper_, pair);
    sum[layout_.length_ratio()] -= 2 * by_ratio * pair.q;
  }

  const FidelityData& data_;
  const Eigen::MatrixXd& slopes_;
  const FidelityHyper& hyper_;
  const FidelityLayout& layout_;
};

}  // namespace

FidelityHyper FidelityLayout::Unpack(const Eigen::VectorXd& theta) const {
  return {.length = theta.head(dimension).array().exp(),
          .signal = std::exp(theta[signal()]),
          .trend = std::exp(theta[trend()]),
          .discrepancy = std::exp(theta[discrepancy()]),
          .noise = theta.segment(noise(), num_levels).array().exp(),
          .warp = theta.segment(warp(), dimension),
          .decay = theta[decay()],
          .length_ratio = std::exp(theta[length_ratio()])};
}

Eigen::VectorXd FidelityLayout::Pack(const FidelityHyper& hyper) const {
  Eigen::VectorXd theta(size());
  theta << hyper.length.array().log().matrix(), std::log(hyper.signal), std::log(hyper.trend),
      std::log(hyper.discrepancy), hyper.noise.array().log().matrix(), hyper.warp, hyper.decay,
      std::log(hyper.length_ratio);
  return theta;
}

FidelityPair FidelityPair::Of(const FidelityHyper& hyper, const double* a, const double* b) {
  FidelityPair pair;
  for (Eigen::Index k = 0; k < hyper.length.size(); ++k) {
    const double step = (a[k] - b[k]) / hyper.length[k];
    pair.q += step * step;
    pair.p += (2 * a[k] - 1) * (2 * b[k] - 1);
  }
  pair.rho = CorrelationAt(kKernel, pair.q);
  return pair;
}

double FidelityCovarianceOf(const FidelityHyper& hyper, const FidelityPair& pair, double g1,
                            double g2) {
  const double constant = kConstantSd * kConstantSd;
  if (g1 + g2 == 0) return constant + TargetCovariance(hyper, pair);
  const double of_target = TargetShare(hyper, g1, g2) * TargetCovariance(hyper, pair);
  const double shared = SharedGrowth(g1, g2);
  if (shared == 0) return constant + of_target;
  const double discrepancy2 = shared * hyper.discrepancy * hyper.discrepancy;
  const double rho_d = DiscrepancyCorrelation(hyper, pair).value;
  return constant + of_target + discrepancy2 * (1 + pair.p / 2 + rho_d);
}

double FidelityLogPosterior(const FidelityData& data, const FidelityLayout& layout,
                            const Eigen::VectorXd& median, const Eigen::VectorXd& sd,
                            const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) {
  const FidelityHyper hyper = layout.Unpack(theta);
  FidelityData warped = data;
  warped.points = WarpAll(data.points, hyper.warp);
  const Eigen::LLT<Eigen::MatrixXd> factor(NoisyCovariance(warped, hyper));
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Eigen::VectorXd alpha = factor.solve(data.values);
  const double log_root = factor.matrixLLT().diagonal().array().log().sum();
  const Eigen::VectorXd z = (theta - median).cwiseQuotient(sd);
  if (gradient != nullptr) {
    const Eigen::Index size = data.values.size();
    Eigen::MatrixXd w = -factor.solve(Eigen::MatrixXd::Identity(size, size));
    w.noalias() += alpha * alpha.transpose();
    Eigen::MatrixXd slopes(data.points.rows(), size);
    for (Eigen::Index j = 0; j < size; ++j) {
      for (Eigen::Index k = 0; k < slopes.rows(); ++k) {
        slopes(k, j) = WarpAt(data.points(k, j), hyper.warp[k]).warp_slope;
      }
    }
    *gradient = GradientSum(warped, slopes, hyper, layout).Of(w) - z.cwiseQuotient(sd);
  }
  return -0.5 * data.values.dot(alpha) - log_root - 0.5 * z.squaredNorm();
}

}  // namespace talus::surrogate
