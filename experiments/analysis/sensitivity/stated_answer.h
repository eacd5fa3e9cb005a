// The campaign's answer as it stands, against which those foretold are set.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/analysis/sensitivity/foreteller.h"
#include "experiments/analysis/sensitivity/sensitivity_table.h"
#include "optimizer/space/parameter_space.h"

namespace talus::analysis {

struct StatedAnswer {
  const optimizer::ParameterSpace& space;
  Eigen::VectorXd point;        // recommended, unit cube
  Eigen::VectorXd half_ranges;  // of the stated ranges, unit cube

  // Writes down where the move leads, of each parameter that is searched, and how it fits there.
  void Compare(const Foretold& foretold, FixedMove& move) const;
  // Where those shifts lead, unit cube.
  Eigen::VectorXd Shifted(const std::vector<AnswerShift>& shifts) const;
};

// `space` outlives it.
StatedAnswer StatedAnswerOf(const optimizer::ParameterSpace& space,
                            const optimizer::Answer& answer);

}  // namespace talus::analysis
