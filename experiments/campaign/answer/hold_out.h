// How the experiments of a campaign agree: what each answers alone, and whether what the others
// answer predicts one that is held out. From the trials there are; nothing is simulated.
#pragma once

#include <string>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/answer/result_held_out.h"

namespace talus::campaign {

struct HeldOut {
  PartialAnswer others;     // what they answer without it
  ResultHeldOut predicted;  // what that predicts of it
  std::string objective_unit{};
};

// Throws ConfigError when the campaign has no experiment of this name or no other one.
HeldOut HoldOut(const JointView& view, const std::string& name);

// "mass fallen: predicted 21 mg ± 2 mg, measured …", one for each of its numbers, and for its
// objective and implausibility.
std::vector<std::string> HeldOutFacts(const ResultHeldOut& held_out,
                                      const std::string& objective_unit);

// Each experiment by itself; those with too few trials are left out.
std::vector<PartialAnswer> AnswersAlone(const JointView& view);

std::string HeldOutText(const JointView& view, const HeldOut& held_out);
std::string HeldOutJson(const JointView& view, const HeldOut& held_out);
std::string AloneText(const JointView& view, const std::vector<PartialAnswer>& answers);
std::string AloneJson(const JointView& view, const std::vector<PartialAnswer>& answers);

}  // namespace talus::campaign
