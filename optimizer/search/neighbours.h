// The surroundings of the best evaluation, which steps within a region round it stand on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/search/history.h"

namespace talus::optimizer {

struct Neighbours {
  Eigen::VectorXd middle;            // the best point
  Eigen::Index best = 0;             // its row in the history
  std::vector<Eigen::Index> others;  // rows of other points, nearest first; its repeats left out
  std::vector<double> distances;     // theirs to the middle

  // Distance of the neighbour of this rank, counted from 0, or of the last one there is.
  double DistanceOf(int rank) const;
};

// At most `count` of the others. At least one evaluation.
Neighbours NeighboursOfBest(const History& history, int count);

}  // namespace talus::optimizer
