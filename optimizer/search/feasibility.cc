#include "optimizer/search/feasibility.h"

#include <algorithm>
#include <cmath>

namespace talus::optimizer {
namespace {

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
  // Not fitted: a handful of failures says nothing of hyper-parameters. A length of a quarter of
  // the range gives each failure a surrounding; noise 0.3 lets neighbours outvote it. Centred on 1:
  // where nothing is known, evaluations work.
  const surrogate::GaussianProcessState state{
      .hyper = {.length = Eigen::VectorXd::Constant(points.cols(), 0.25),
                .noise = Eigen::VectorXd::Constant(1, 0.3),
                .constant = 0},
      .centre = 1,
      .scale = 0.5};
  process_ =
      surrogate::GaussianProcess::Fit({.points = points, .values = worked}, {.frozen = state});
}

double Feasibility::Probability(const Eigen::VectorXd& x) const {
  return process_ ? std::clamp(process_->Predict(x).mean, 0.0, 1.0) : 1;
}

Eigen::VectorXd Feasibility::Penalty(const Eigen::MatrixXd& points) const {
  if (!process_) return Eigen::VectorXd::Zero(points.rows());
  return process_->PredictAll(points).mean.unaryExpr(&PenaltyOf);
}

double Feasibility::Penalty(const Eigen::VectorXd& x, Eigen::VectorXd* slope) const {
  if (slope != nullptr) slope->setZero(x.size());
  if (!process_) return 0;
  const surrogate::PredictionGradient at = process_->PredictWithGradient(x);
  if (slope != nullptr) *slope = PenaltySlope(at.value.mean) * at.mean;
  return PenaltyOf(at.value.mean);
}

}  // namespace talus::optimizer
