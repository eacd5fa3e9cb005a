#include <algorithm>
#include <memory>

#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {
namespace {

// A process of numbers may say less than nothing of a distance, which the heap cannot.
optimizer::Moments NotNegative(optimizer::Moments moments) {
  moments.mean = moments.mean.cwiseMax(0.0);
  return moments;
}

// The one that answers, told again what the journal holds.
std::shared_ptr<optimizer::PosteriorStrategy> StrategyTold(const std::filesystem::path& campaign) {
  const campaign::JointView view = campaign::ReadJointView(campaign);
  std::shared_ptr<optimizer::PosteriorStrategy> strategy =
      campaign::MakePosteriorStrategy(view.spec, view.record, view.references);
  for (const optimizer::Observation& observation : view.observations) strategy->Tell(observation);
  return strategy;
}

}  // namespace

void AddModel(const std::filesystem::path& campaign, Evidence& evidence) {
  const bool any = std::ranges::any_of(evidence.trials, [](const TrialEvidence& trial) {
    return trial.state == journal::TrialStatus::kOk && trial.purpose != "confirm";
  });
  if (!any) {
    evidence.model_absent = "no trial has succeeded yet";
    return;
  }
  const std::shared_ptr<optimizer::PosteriorStrategy> strategy = StrategyTold(campaign);
  const optimizer::Answer answer = strategy->Recommend();
  if (!answer.posterior) {
    evidence.model_absent = answer.model;
    return;
  }
  const int experiment = static_cast<int>(evidence.experiment);
  const auto expected = strategy->Predict(answer.point.transpose(), experiment);
  ModelEvidence model;
  model.point = answer.point;
  model.noise_sd = answer.noise_sd;
  model.draws = answer.posterior->draws;
  model.prior_draws = answer.posterior->prior_draws;
  model.credible_levels = [strategy](const Eigen::MatrixXd& points) {
    return *strategy->CredibleLevels(points);
  };
  if (expected) {
    model.expected = NotNegative(*expected).mean[0];
    model.expected_sd = expected->sd[0];
    model.predict = [strategy, experiment](const Eigen::MatrixXd& points) {
      return NotNegative(*strategy->Predict(points, experiment));
    };
  }
  evidence.model = std::move(model);
}

}  // namespace talus::analysis
