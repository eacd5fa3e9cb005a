// The goal of a running campaign: few simulations of the process at draws of the posterior, more of
// them at each look, and a surrogate over all of them.
//
// Everything is kept in DIR/goal/NNNN, NNNN the number of trials that had ended, and follows from
// the spec and these trials: a look that was ended is finished by the next process.
#pragma once

#include "base/json/json_file.h"
#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/campaign/campaign.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/plan/goal_judge.h"

namespace talus::analysis {

// Throws ConfigError where the goal of the spec, which `file` holds, contradicts it or its case
// does not measure the number; a spec without a goal is in order.
void CheckGoal(const campaign::CampaignSpec& spec, const base::JsonFile& file);

class CampaignGoal : public campaign::GoalJudge {
 public:
  // Throws as CheckGoal does; `parts` simulate. The spec must have a goal.
  CampaignGoal(const campaign::CampaignSpec& spec, const std::filesystem::path& campaign,
               campaign::CampaignParts parts);

  std::optional<campaign::GoalState> Look(std::int64_t num_ended,
                                          const base::InterruptGuard& interrupt) override;

 private:
  // Whether it is of this process, with the parameters that are searched now.
  bool IsOurs(const campaign::DesignRecord& design) const;
  campaign::DesignRecord DesignOf(const campaign::JointView& view, const Eigen::MatrixXd& draws,
                                  const campaign::DesignFolder& look, bool is_first) const;
  rigs::Case CaseAt(const std::filesystem::path& look, const campaign::DesignRecord& design,
                    std::size_t index) const;
  // What the first of a look's runs has left in its log, in words.
  std::string FailureOf(const std::filesystem::path& look) const;
  // The runs of all looks, each draw once; and the core time of all runs in DIR/goal [s], of those,
  // too, that say nothing of this goal.
  Prediction Collect(double& core_time) const;

  campaign::JointView plan_;  // before the first trial, so that the scale factor is always the same
  PredictedCase process_;
  campaign::CampaignParts parts_;
};

}  // namespace talus::analysis
