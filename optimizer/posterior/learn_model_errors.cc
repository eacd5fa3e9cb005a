#include "optimizer/posterior/learn_model_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace talus::optimizer {
namespace {

// Model errors in units of the prior's scale, denser where the prior is.
constexpr std::array kErrorNodes{0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 9.0, 14.0};
constexpr double kBroad = 4;  // of the sample that all nodes share: each is narrower or nearly so
constexpr int kSampled = 1000;
constexpr int kSweeps = 2;  // over the experiments: the first one sees only the others' prior

using Nodes = Eigen::Array<double, static_cast<int>(kErrorNodes.size()), 1>;

// Half-normal prior times the width of each node's part of the axis (trapezoidal rule), log.
Nodes LogPrior() {
  Nodes log_prior;
  for (std::size_t i = 0; i < kErrorNodes.size(); ++i) {
    const double low = i == 0 ? kErrorNodes[0] : kErrorNodes[i - 1];
    const double high = i + 1 == kErrorNodes.size() ? kErrorNodes[i] : kErrorNodes[i + 1];
    log_prior[static_cast<Eigen::Index>(i)] =
        std::log(0.5 * (high - low)) - 0.5 * kErrorNodes[i] * kErrorNodes[i];
  }
  return log_prior;
}

struct NodeMoments {
  double mean_square = 0;
  double sd = 0;
};

NodeMoments MomentsOf(const Nodes& log_weight) {
  const Nodes weight = (log_weight - log_weight.maxCoeff()).exp();
  const Nodes nodes = Eigen::Map<const Nodes>(kErrorNodes.data());
  const double sum = weight.sum();
  const double mean = (weight * nodes).sum() / sum;
  const double mean_square = (weight * nodes.square()).sum() / sum;
  return {mean_square, std::sqrt(std::max(0.0, mean_square - mean * mean))};
}

// ln ∫ p(data | x) p(x) dx over the sample; `prior`: p(x) dx of its points.
double LogEvidence(const Posterior& posterior, const std::vector<OutputMoments>& outputs,
                   const Eigen::ArrayXd& prior) {
  const Eigen::ArrayXd density = posterior.LogDensity(outputs).array();
  const double most = density.maxCoeff();
  return most + std::log((prior * (density - most).exp()).sum());
}

}  // namespace

void LearnModelErrors(const Domain& domain, double scale, std::uint64_t seed,
                      Posterior& posterior) {
  std::vector<ExperimentModel>& models = posterior.models();
  for (ExperimentModel& model : models) model.SetModelError({.value = kBroad * scale});
  const PosteriorSample sample = posterior.Sample(domain, kSampled, 1, seed);
  const std::vector<OutputMoments> outputs = posterior.Outputs(sample.points);
  const Eigen::ArrayXd prior =
      sample.volume.array() *
      (domain.prior.LogDensity(sample.points) + posterior.LogSuccess(sample.points)).array().exp();
  for (ExperimentModel& model : models) model.SetModelError({.value = scale});
  const Nodes log_prior = LogPrior();
  const NodeMoments before = MomentsOf(log_prior);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (ExperimentModel& model : models) {
      if (model.weight() == 0) continue;
      Nodes log_weight = log_prior;
      for (Eigen::Index i = 0; i < log_weight.size(); ++i) {
        model.SetModelError({.value = kErrorNodes[static_cast<std::size_t>(i)] * scale});
        log_weight[i] += LogEvidence(posterior, outputs, prior);
      }
      const NodeMoments after = MomentsOf(log_weight);
      model.SetModelError({.value = scale * std::sqrt(after.mean_square / before.mean_square),
                           .told = std::clamp(1 - after.sd / before.sd, 0.0, 1.0)});
    }
  }
}

}  // namespace talus::optimizer
