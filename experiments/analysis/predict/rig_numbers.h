// Numbers of a predicted test: those that its rig measures, whoever simulates it.
#pragma once

#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::analysis {

// Takes away what the case's rig does not measure: templates of another test leave other numbers.
// Throws base::Error where nothing is left, neither a number nor an image.
void KeepRigNumbers(const rigs::Case& rig_case, trials::TrialOutput& output);

}  // namespace talus::analysis
