// How a campaign's tests shear the powder, for a process that is predicted (regimes.h).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

struct TestsToRun {
  Eigen::VectorXd set;               // in the unit cube of what is searched
  double scale_factor = 1;           // of the process
  std::filesystem::path prediction;  // DIR/predict/NAME, locked by the caller
};

// Each test is simulated once, with the set and at the campaign's scale factor nearest to the
// process's, in `prediction`/tests. What another prediction of the campaign has simulated is read
// there. A test that shears nothing is left out; nothing where the user ended it.
std::optional<std::vector<FlowRegime>> TestRegimes(const campaign::JointView& view,
                                                   const TestsToRun& tests,
                                                   const campaign::CampaignParts& parts);

}  // namespace talus::analysis
