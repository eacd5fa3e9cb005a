#include "surrogate/process/covariance.h"

#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "surrogate/process/covariance_rows.h"

namespace talus::surrogate {
namespace {

constexpr double kPairWork = 20;  // multiplications, an exponential among them

}  // namespace

Covariance::Covariance(Kernel kernel, Hyperparameters hyper)
    : kernel_(kernel), hyper_(std::move(hyper)) {}

PairTerms Covariance::Terms(const double* a, const double* b, double growth_a,
                            double growth_b) const {
  PairTerms terms;
  for (Eigen::Index k = 0; k < hyper_.length.size(); ++k) {
    const double step = (a[k] - b[k]) / hyper_.length[k];
    terms.q += step * step;
    terms.p += (2 * a[k] - 1) * (2 * b[k] - 1);
  }
  terms.rho = CorrelationAt(kernel_, terms.q);
  if (!hyper_.scale || growth_a + growth_b == 0) return terms;
  const ScaleTerm& scale = *hyper_.scale;
  terms.target_share = std::exp(-scale.decay * (growth_a + growth_b));
  terms.shared_growth =
      growth_a * growth_b + (growth_a * growth_a - growth_a) * (growth_b * growth_b - growth_b);
  if (terms.shared_growth != 0) {
    terms.discrepancy_rho =
        CorrelationAt(kernel_, terms.q / (scale.length_ratio * scale.length_ratio));
  }
  return terms;
}

double Covariance::TargetValue(const PairTerms& terms) const {
  return hyper_.trend * hyper_.trend * (terms.p + terms.p * terms.p) +
         hyper_.signal * hyper_.signal * terms.rho.value;
}

double Covariance::Value(const PairTerms& terms) const {
  const double target = hyper_.constant * hyper_.constant + terms.target_share * TargetValue(terms);
  if (terms.shared_growth == 0) return target;
  const double u = hyper_.scale->discrepancy;
  return target + terms.shared_growth * u * u * (1 + terms.p / 2 + terms.discrepancy_rho.value);
}

Eigen::MatrixXd Covariance::Between(const Sites& a, const Sites& b) const {
  const CovarianceRows rows(a, hyper_);
  Eigen::MatrixXd result(rows.size(), b.columns.cols());
  base::ParallelFor(
      {.num_items = b.columns.cols(), .item_work = kPairWork * static_cast<double>(rows.size())},
      [&](Eigen::Index j) {
        result.col(j) = Column(rows, rows.size(), b.columns.col(j).data(), b.growth[j]);
      });
  return result;
}

Eigen::MatrixXd Covariance::Among(const Sites& sites) const {
  const CovarianceRows rows(sites, hyper_);
  const Eigen::Index size = rows.size();
  Eigen::MatrixXd result(size, size);
  base::ParallelFor({.num_items = size, .item_work = kPairWork / 2 * static_cast<double>(size)},
                    [&](Eigen::Index j) {
                      result.col(j).tail(size - j) =
                          Column(rows, size - j, sites.columns.col(j).data(), sites.growth[j]);
                    });
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

// The operations of `Value`, in its order.
Eigen::ArrayXd Covariance::Column(const CovarianceRows& rows, Eigen::Index count, const double* b,
                                  double growth) const {
  Eigen::ArrayXd q = Eigen::ArrayXd::Zero(count);
  Eigen::ArrayXd p = Eigen::ArrayXd::Zero(count);
  for (Eigen::Index k = 0; k < hyper_.length.size(); ++k) {
    q += ((rows.coordinate(k, count) - b[k]) / hyper_.length[k]).square();
    p += rows.centred(k, count) * (2 * b[k] - 1);
  }
  Eigen::ArrayXd value = hyper_.trend * hyper_.trend * (p + p * p) +
                         hyper_.signal * hyper_.signal * CorrelationsAt(kernel_, q);
  if (hyper_.scale) value *= rows.TargetShares(growth, count);
  value += hyper_.constant * hyper_.constant;
  if (!hyper_.scale || growth == 0 || !rows.any_growth()) return value;
  const ScaleTerm& scale = *hyper_.scale;
  const Eigen::ArrayXd rho = CorrelationsAt(kernel_, q / (scale.length_ratio * scale.length_ratio));
  return value + rows.SharedGrowth(growth, count) * scale.discrepancy * scale.discrepancy *
                     (1 + p / 2 + rho);
}

Eigen::VectorXd Covariance::Diagonal(const Sites& sites) const {
  Eigen::VectorXd result(sites.columns.cols());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    const double* x = sites.columns.col(j).data();
    result[j] = At(x, x, sites.growth[j], sites.growth[j]);
  }
  return result;
}

Eigen::MatrixXd Covariance::Gradient(const Eigen::VectorXd& x, const Sites& b) const {
  const double signal2 = hyper_.signal * hyper_.signal;
  const double trend2 = hyper_.trend * hyper_.trend;
  const Eigen::VectorXd z = 2 * x.array() - 1;
  Eigen::MatrixXd result(x.size(), b.columns.cols());
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    const Eigen::VectorXd step = (x - b.columns.col(j)).cwiseQuotient(hyper_.length);
    const Eigen::VectorXd other = 2 * b.columns.col(j).array() - 1;
    const PairTerms terms = Terms(x.data(), b.columns.col(j).data(), 0, b.growth[j]);
    result.col(j) =
        terms.target_share * (2 * signal2 * terms.rho.slope * step.cwiseQuotient(hyper_.length) +
                              2 * trend2 * (1 + 2 * z.dot(other)) * other);
  }
  return result;
}

Eigen::VectorXd Covariance::DiagonalGradient(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd z = 2 * x.array() - 1;  // k(x, x) varies by the trend alone
  return 4 * hyper_.trend * hyper_.trend * (1 + 2 * z.squaredNorm()) * z;
}

}  // namespace talus::surrogate
