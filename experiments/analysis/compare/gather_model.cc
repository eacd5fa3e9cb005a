#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/knowledge.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {
namespace {

// A process of numbers may say less than nothing of a distance, which the heap cannot.
optimizer::Moments NotNegative(optimizer::Moments moments) {
  moments.mean = moments.mean.cwiseMax(0.0);
  return moments;
}

// The draws of the prior, evenly spaced where it says nothing: chance draws would show as waves.
Eigen::MatrixXd EvenWhereUniform(const optimizer::PosteriorSummary& posterior) {
  Eigen::MatrixXd draws = posterior.prior_draws;
  const auto count = static_cast<double>(draws.rows());
  for (Eigen::Index k = 0; k < draws.cols(); ++k) {
    if (!std::isnan(posterior.prior_offset[k])) continue;
    draws.col(k) = Eigen::VectorXd::LinSpaced(draws.rows(), 0.5 / count, 1 - 0.5 / count);
  }
  return draws;
}

// The one that answers, told again what the journal holds.
std::shared_ptr<optimizer::PosteriorStrategy> StrategyTold(const campaign::JointView& view) {
  std::shared_ptr<optimizer::PosteriorStrategy> strategy =
      campaign::MakePosteriorStrategy(view.spec, view.record, view.references);
  for (const optimizer::Observation& observation : view.observations) strategy->Tell(observation);
  return strategy;
}

ModelEvidence ModelOf(const std::shared_ptr<optimizer::PosteriorStrategy>& strategy,
                      const optimizer::Answer& answer, int experiment) {
  ModelEvidence model;
  model.point = answer.point;
  model.noise_sd = answer.noise_sd;
  model.draws = answer.posterior->draws;
  model.prior_draws = EvenWhereUniform(*answer.posterior);
  model.credible_levels = [strategy](const Eigen::MatrixXd& points) {
    return *strategy->CredibleLevels(points);
  };
  const auto expected = strategy->Predict(answer.point.transpose(), experiment);
  if (!expected) return model;
  model.expected = NotNegative(*expected).mean[0];
  model.expected_sd = expected->sd[0];
  model.predict = [strategy, experiment](const Eigen::MatrixXd& points) {
    return NotNegative(*strategy->Predict(points, experiment));
  };
  return model;
}

}  // namespace

void AddModel(const std::filesystem::path& campaign, Evidence& evidence,
              std::span<Evidence> others) {
  const auto tells = [](const TrialEvidence& trial) {
    return trial.state == journal::TrialStatus::kOk && trial.kind != journal::TrialKind::kConfirm;
  };
  if (std::ranges::none_of(evidence.trials, tells) &&
      std::ranges::none_of(evidence.of_others, tells)) {
    evidence.model_absent = "no trial has succeeded yet";
    return;
  }
  const campaign::JointView view = campaign::ReadJointView(campaign);
  evidence.feasible = view.space.MakeDomain().feasible;
  const std::shared_ptr<optimizer::PosteriorStrategy> strategy = StrategyTold(view);
  const optimizer::Answer answer = strategy->Recommend();
  if (!answer.posterior) {
    evidence.model_absent = answer.model;
    return;
  }
  const auto add = [&](Evidence& shown) {
    const int experiment = static_cast<int>(shown.experiment);
    shown.model = ModelOf(strategy, answer, experiment);
    if (shown.answer) shown.knowledge = KnowledgeOf(view, experiment, answer.point);
  };
  add(evidence);
  std::ranges::for_each(others, add);
}

}  // namespace talus::analysis
