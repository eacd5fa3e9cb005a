// How far a move shifts the outputs of an experiment, from simulations with and without it.
#pragma once

#include <Eigen/Core>

namespace talus::analysis {

// The mean of an output over the simulations that have it.
struct ColumnMean {
  double value = 0;
  double count = 0;
};

// `outputs`: those of a simulation a row, NaN where one is undefined.
ColumnMean MeanOfColumn(const Eigen::MatrixXd& outputs, Eigen::Index k);

struct Shift {
  Eigen::VectorXd mean;      // a number an output
  Eigen::VectorXd variance;  // that chance gives it; 0 of what is not known
  // Whether some simulation with the move and one without have the output.
  Eigen::Array<bool, Eigen::Dynamic, 1> is_known{};
};

// Outputs of simulations with and without the move, one a row; `noise`: the variance of each output
// from seed to seed. One that is undefined in all of either is not known: its shift and variance
// are 0.
Shift ShiftOf(const Eigen::MatrixXd& moved, const Eigen::MatrixXd& base,
              const Eigen::VectorXd& noise);

// Whether chance makes such a sum of squares of so many independent shifts in their standard
// deviations once in a thousand times or more often (χ², as campaign::Tension scores it). Of
// nothing it does.
bool IsByChance(double squares, double degrees);

}  // namespace talus::analysis
