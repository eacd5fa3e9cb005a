// What a model of the objective looks like from the sides that a page can show.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/analysis/compare/compare.h"

namespace talus::analysis {

// Along one parameter, the others held.
struct ModelSlice {
  std::size_t parameter = 0;
  std::vector<double> x;  // SI
  std::vector<ObjectivePrediction> predicted;
};

// Over two parameters: the chance that a set ties with the best, averaged over the others.
struct PairChance {
  std::size_t i = 0;
  std::size_t j = 0;
  std::vector<double> x_edges;  // of the cells, parameter i, SI
  std::vector<double> y_edges;  // parameter j
  std::vector<double> chance;   // by cell, x fastest, in [0, 1]
};

// Through `point` of the unit cube.
std::vector<ModelSlice> SliceModel(const Evidence& evidence, const ModelFinding& finding,
                                   const Eigen::VectorXd& point);

// Every pair of parameters. `margin` as in ObjectiveFinding.
std::vector<PairChance> PairChances(const Evidence& evidence, const ObjectiveFinding& finding);

}  // namespace talus::analysis
