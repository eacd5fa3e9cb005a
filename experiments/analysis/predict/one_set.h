// The one set that is predicted by instead of draws.
#pragma once

#include <Eigen/Core>

#include "experiments/analysis/predict/predict_options.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// In the unit cube. Throws ConfigError where the set is no set of the campaign, or where the
// recommended one is asked for and there is none yet.
Eigen::VectorXd OneSet(const campaign::JointView& view, const PredictOptions& options);

}  // namespace talus::analysis
