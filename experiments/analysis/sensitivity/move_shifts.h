// What a move shifts at a set, in every experiment that the campaign answers by.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/shift_field.h"

namespace talus::analysis {

struct MoveShifts {
  std::vector<Shift> shifts{};  // by experiment; zero where the move does not act
  int num_failed = 0;           // simulations with the move
  std::string why_not{};        // why there is none, for people; else empty
};

// Between simulations that were made of a set with its move and those without it, by experiment.
MoveShifts ShiftsBetween(const SensitivitySetting& setting,
                         const std::vector<MovedOutputs>& without, const MovedSet& with);

// A field for each, which knows one set.
std::vector<ShiftField> Everywhere(const Eigen::VectorXd& point, const std::vector<Shift>& shifts);

// Name of an experiment that the campaign answers by.
const std::string& NameOf(const campaign::JointView& view, std::size_t answered);

}  // namespace talus::analysis
