// What a move shifts at a set, in every experiment that the campaign answers by.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/shift_field.h"
#include "optimizer/posterior/posterior.h"

namespace talus::analysis {

struct MoveShifts {
  std::vector<Shift> shifts{};  // by experiment; zero where the move does not act
  std::string why_not{};        // why there is none, for people; else empty
};

// Between simulations of a set without the move and with it, in outputs of the posterior.
MoveShifts ShiftsBetween(const SensitivitySetting& setting, const optimizer::Posterior& posterior,
                         const SimulatedSet& without, const SimulatedSet& with);

// A field for each, which knows one set.
std::vector<ShiftField> Everywhere(const Eigen::VectorXd& point, const std::vector<Shift>& shifts);

// Name of an experiment that the campaign answers by.
const std::string& NameOf(const campaign::JointView& view, std::size_t answered);

}  // namespace talus::analysis
