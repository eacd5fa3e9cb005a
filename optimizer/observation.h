// What a strategy and a campaign tell each other: the next evaluation, and what came of it.
#pragma once

#include <Eigen/Core>
#include <vector>

// Strategies and their callers free each other's vectors, so both must have Eigen allocate alike.
static_assert(EIGEN_MALLOC_ALREADY_ALIGNED,
              "compile what includes this without -mavx and -march=native, or with "
              "-DEIGEN_DONT_VECTORIZE -DEIGEN_MALLOC_ALREADY_ALIGNED=1; with the address "
              "sanitizer, with -DEIGEN_MALLOC_ALREADY_ALIGNED=1");

namespace talus::optimizer {

inline constexpr double kLargestValue = 1e100;  // squares of values are summed up

enum class Origin { kDesign, kRepeat, kModel, kSearch };  // why a point was proposed

struct Proposal {
  Eigen::VectorXd point;  // unit cube, size = number of parameters
  Origin origin = Origin::kModel;
  int experiment = 0;       // which of the experiments to simulate
  double scale_factor = 0;  // of the coarse graining, >= 1; 0: the only one there is
};

// One finished evaluation: one simulation of one experiment.
struct Observation {
  Eigen::VectorXd point;             // unit cube
  int experiment = 0;                // which of the experiments was simulated
  double scale_factor = 1;           // of the coarse graining [-], >= 1
  double cost = 0;                   // [core seconds]; 0: not known
  bool is_paid_for = true;           // by this search; false where it was made before
  bool failed = false;               // crashed or infeasible: value and field mean nothing
  double value = 0;                  // the objective, to be minimised
  std::vector<float> field = {};     // the whole image, row by row from the top, in [0, 1] with 1 =
                                     // powder; empty where an evaluation is only a number
  std::vector<double> scalars = {};  // what else was measured, in the experiment's order and units;
                                     // NaN where it is not defined
};

// The same without its image, for strategies to keep: many images would fill the memory, and a
// vector that is only cleared keeps its own.
inline Observation WithoutImage(Observation observation) {
  observation.field = std::vector<float>();
  return observation;
}

}  // namespace talus::optimizer
