// How widely each parameter is known, in every sense in which a report says so: the same word
// "range" is a wider or a narrower one by what is asked of the other parameters and of the
// experiments.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/report/views/model_views.h"

namespace talus::analysis {

struct WidthView {
  std::string title;         // "stated range"
  std::string means;         // what it says, and what it is for
  std::vector<double> low;   // of each parameter, SI; undefined where this sense has none
  std::vector<double> high;  // …
};

// The stated ranges first; none of one parameter, or where no model answers. `pairs`: the figures
// of the region, whose shadow reaches as far as they show.
std::vector<WidthView> WidthViews(const Evidence& evidence, const std::vector<PairMap>& pairs);

// Draws (rows) whose parameter `column` is the value but for a measurement's error; unit cube.
std::vector<Eigen::Index> DrawsNear(const Eigen::MatrixXd& draws, Eigen::Index column,
                                    double value);

inline constexpr double kMeasured = 0.05;        // of a searched range: what measuring leaves
inline constexpr Eigen::Index kFewestNear = 30;  // draws that a range of them is made of

}  // namespace talus::analysis
