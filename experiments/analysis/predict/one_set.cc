#include "experiments/analysis/predict/one_set.h"

#include <optional>

#include "base/error.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/answer/standing_answer.h"

namespace talus::analysis {
namespace {

using campaign::JointView;

Eigen::VectorXd RecommendedPoint(const JointView& view) {
  const std::optional<campaign::Answer> answer = campaign::StandingAnswer(view.folder.root);
  if (!answer) {
    throw base::ConfigError(view.folder.root.string() +
                            ": has no result yet; without --recommended, draws of what its trials "
                            "say so far are taken");
  }
  Eigen::VectorXd point(static_cast<Eigen::Index>(answer->parameters.size()));
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    const campaign::ResultParameter& p = answer->parameters[static_cast<std::size_t>(i)];
    point[i] = p.Range().ToUnit(p.value);
  }
  return point;
}

}  // namespace

Eigen::VectorXd OneSet(const JointView& view, const PredictOptions& options) {
  if (options.recommended) return RecommendedPoint(view);
  return campaign::Filled(campaign::ReadSet(view.space, options.set),
                          *campaign::StrategyOf(view, view.Answered()));
}

}  // namespace talus::analysis
