#include "optimizer/posterior/learn_model_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "optimizer/posterior/importance_sample.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

constexpr int kSampled = 1000;
constexpr int kSweeps = 2;  // over the experiments: the first one sees only the others' prior

// Model errors with the half-normal prior of each, for an integral by the trapezoidal rule. Evenly
// on a logarithmic axis from what no measurement would notice on: what the data tell of the error
// has a width of its own, whatever the scale of the prior.
class ErrorNodes {
 public:
  explicit ErrorNodes(double scale) {
    constexpr int kNumNodes = 32;
    constexpr double kUnnoticed = 0.02;  // run-to-run standard deviations
    constexpr double kFarthest = 14;     // scales of the prior
    const double least = std::min(kUnnoticed, 0.05 * scale);
    nodes_ = Eigen::ArrayXd::Zero(kNumNodes);
    nodes_.tail(kNumNodes - 1) =
        Eigen::ArrayXd::LinSpaced(kNumNodes - 1, std::log(least), std::log(kFarthest * scale))
            .exp();
    Eigen::ArrayXd width(kNumNodes);
    for (Eigen::Index i = 0; i < kNumNodes; ++i) {
      width[i] = 0.5 * (nodes_[std::min<Eigen::Index>(i + 1, kNumNodes - 1)] -
                        nodes_[std::max<Eigen::Index>(i - 1, 0)]);
    }
    log_prior_ = width.log() - 0.5 * (nodes_ / scale).square();
  }

  const Eigen::ArrayXd& nodes() const { return nodes_; }
  const Eigen::ArrayXd& log_prior() const { return log_prior_; }

  struct Moments {
    double mean_square = 0;
    double sd = 0;
  };
  Moments MomentsOf(const Eigen::ArrayXd& log_weight) const {
    const Eigen::ArrayXd weight = (log_weight - log_weight.maxCoeff()).exp();
    const double sum = weight.sum();
    const double mean = (weight * nodes_).sum() / sum;
    const double mean_square = (weight * nodes_.square()).sum() / sum;
    return {mean_square, std::sqrt(std::max(0.0, mean_square - mean * mean))};
  }

 private:
  Eigen::ArrayXd nodes_;
  Eigen::ArrayXd log_prior_;
};

// What does not depend on the model errors, at points of which more and more come.
class GrowingOutputs {
 public:
  explicit GrowingOutputs(const Posterior& posterior) : posterior_(posterior) {}

  // ln p(data | x) p(x) of all the points with the model errors as they are now.
  Eigen::VectorXd LogDensityAt(const Eigen::MatrixXd& points, const Prior& prior) {
    const Eigen::Index known = log_prior_.size();
    if (points.rows() > known) {
      const Eigen::MatrixXd more = points.bottomRows(points.rows() - known);
      Append(posterior_.Outputs(more));
      log_prior_.conservativeResize(points.rows());
      log_prior_.tail(more.rows()) = prior.LogDensity(more) + posterior_.LogSuccess(more);
    }
    return posterior_.LogDensity(outputs_) + log_prior_;
  }

 private:
  void Append(const std::vector<OutputMoments>& more) {
    if (outputs_.empty()) {
      outputs_ = more;
      return;
    }
    for (std::size_t e = 0; e < more.size(); ++e) {
      outputs_[e].mean = Stack(outputs_[e].mean, more[e].mean);
      outputs_[e].variance = Stack(outputs_[e].variance, more[e].variance);
    }
  }

  const Posterior& posterior_;
  std::vector<OutputMoments> outputs_;  // one element an experiment
  Eigen::VectorXd log_prior_;
};

// Model errors whose densities, from broad to narrow, the shared points are drawn for: those
// between are served by the mixture of both.
std::vector<double> CoveredErrors(double scale) {
  constexpr double kBroadest = 4;  // scales: nearly all nodes' densities are narrower
  constexpr double kStep = 4;
  constexpr double kNarrowest = 0.25;  // run-to-run standard deviations: less narrows little
  std::vector<double> errors{kBroadest * scale};
  while (errors.back() > kNarrowest) errors.push_back(errors.back() / kStep);
  return errors;
}

}  // namespace

void LearnModelErrors(const Domain& domain, double scale, std::uint64_t seed,
                      Posterior& posterior) {
  std::vector<ExperimentModel>& models = posterior.models();
  GrowingOutputs outputs(posterior);
  const auto density = [&](const Eigen::MatrixXd& points) {
    return outputs.LogDensityAt(points, domain.prior);
  };
  ImportanceSampler sampler({.domain = &domain, .prior = &domain.prior, .num_start = kSampled},
                            seed);
  for (const double error : CoveredErrors(scale)) {
    for (ExperimentModel& model : models) model.SetModelError({.value = error});
    sampler.Cover(density);
  }
  for (ExperimentModel& model : models) model.SetModelError({.value = scale});
  const Eigen::VectorXd log_volume = sampler.LogVolume();
  const ErrorNodes nodes(scale);
  const ErrorNodes::Moments before = nodes.MomentsOf(nodes.log_prior());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (ExperimentModel& model : models) {
      if (model.weight() == 0) continue;
      Eigen::ArrayXd log_weight = nodes.log_prior();
      for (Eigen::Index i = 0; i < log_weight.size(); ++i) {
        model.SetModelError({.value = nodes.nodes()[i]});
        log_weight[i] += LogSumExp(density(sampler.points()) + log_volume);
      }
      const ErrorNodes::Moments after = nodes.MomentsOf(log_weight);
      model.SetModelError({.value = scale * std::sqrt(after.mean_square / before.mean_square),
                           .told = std::clamp(1 - after.sd / before.sd, 0.0, 1.0)});
    }
  }
}

}  // namespace talus::optimizer
