#include "optimizer/search/feasibility.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::optimizer {
namespace {

constexpr double kLikely = 0.5;
constexpr double kTurn = 0.7;   // the penalty is ln p above and a line below
constexpr double kSteep = 1e6;  // slope of that line: more than any acquisition can gain

double PenaltyOf(double p) {
  if (p >= 1) return 0;
  return p > kTurn ? std::log(p) : std::log(kTurn) - kSteep * (kTurn - p);
}
double PenaltySlope(double p) {
  if (p >= 1) return 0;
  return p > kTurn ? 1 / p : kSteep;
}

}  // namespace

Feasibility::Feasibility(const History& history) {
  const Eigen::Index num_failed = history.failed.rows();
  if (num_failed == 0) return;
  const Eigen::Index num_good = history.points.rows();
  Eigen::MatrixXd points(num_failed + num_good, history.failed.cols());
  points << history.failed, history.points;
  Eigen::VectorXd worked(points.rows());
  worked << Eigen::VectorXd::Zero(num_failed), Eigen::VectorXd::Ones(num_good);
  worked_ = SuccessModel(points, worked);
}

double Feasibility::Probability(const Eigen::VectorXd& x) const {
  return worked_.always() ? 1 : std::clamp(worked_.process().Predict(x).mean, 0.0, 1.0);
}

Domain Feasibility::LikelyToWork(const Domain& domain) const {
  if (always()) return domain;
  Domain likely = domain;
  likely.feasible = [this, feasible = domain.feasible](const Eigen::VectorXd& x) {
    return (!feasible || feasible(x)) && Probability(x) >= kLikely;
  };
  if (!domain.IsList()) return likely;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < domain.candidates.rows(); ++i) {
    if (likely.feasible(domain.candidates.row(i))) kept.push_back(i);
  }
  if (kept.empty()) return domain;  // no candidates at all would be the whole cube
  likely.candidates = domain.candidates(kept, Eigen::all);
  return likely;
}

Eigen::VectorXd Feasibility::Penalty(const Eigen::MatrixXd& points) const {
  if (always()) return Eigen::VectorXd::Zero(points.rows());
  return worked_.process().PredictAll(points).mean.unaryExpr(&PenaltyOf);
}

double Feasibility::Penalty(const Eigen::VectorXd& x, Eigen::VectorXd* slope) const {
  if (slope != nullptr) slope->setZero(x.size());
  if (always()) return 0;
  const surrogate::PredictionGradient at = worked_.process().PredictWithGradient(x);
  if (slope != nullptr) *slope = PenaltySlope(at.value.mean) * at.mean;
  return PenaltyOf(at.value.mean);
}

}  // namespace talus::optimizer
