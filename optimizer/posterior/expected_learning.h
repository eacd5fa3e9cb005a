// What one more measurement is expected to teach about the parameters, and about a number that
// follows from them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/not_known.h"

namespace talus::optimizer {

// A measurement that has not been made, as draws of the posterior predict it.
struct PredictedMeasurement {
  Eigen::MatrixXd mean;      // one draw a row, one output a column; no columns: nothing is measured
  Eigen::VectorXd variance;  // of each output once measured: its error and the model's, > 0
  // The same of sets that are supposed to be the truth, one a row; none: any draw may be it.
  Eigen::MatrixXd supposed{};
};

struct ExpectedLearning {
  double bits = 0;  // ½ log₂ det(I + C⁻¹ Cov), C the variance and Cov of the means
  // Each parameter's 90 % range (AskedRanges) afterwards, unit cube: the mean over the sets that
  // may be true, and its 10 and 90 % quantiles over them.
  Eigen::VectorXd width;
  Eigen::VectorXd narrow{};
  Eigen::VectorXd wide{};
  // What is left of the volume of the ranges of what is asked for, over what there is: the mean
  // over the same sets, in [0, 1]. A test that tells all of some sets and nothing of others leaves
  // more than the product of the mean ranges.
  double volume = 1;
  double goal_half_width = base::kNotKnown;  // of the goal's 90 %, expected
  // Two draws that it separates most, rows.
  Eigen::Index first = 0;
  Eigen::Index second = 0;
};

// What is to be learnt.
struct LearningAim {
  Eigen::VectorXd goal{};                 // a number at each draw; empty: there is none
  std::vector<Eigen::Index> nuisances{};  // columns of the draws that nobody asks for
};

// `draws`: equally likely, one a row, as many as the measurement's rows and two at least. Each of
// some of them, or of what is supposed, is taken for the truth in turn, its measurement drawn, and
// the others weighted by it, with the posterior's own heavy tails. `bits` is of all draws. What a
// measurement tells more finely than the draws lie apart hangs on the few that are near: widths
// below the distance of neighbouring draws mean no more than that they are below it.
ExpectedLearning Learn(const Eigen::MatrixXd& draws, const PredictedMeasurement& measurement,
                       std::uint64_t seed, const LearningAim& aim = {});

// Half of the range between the 5 and 95 % quantiles of equally likely values, one at least.
double HalfWidth90(const Eigen::VectorXd& values);

}  // namespace talus::optimizer
