// What the model that answered looks like from the sides that a page can show.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

// The expected objective along one parameter, the others held; low and high bound the mean's 90 %
// band, NaN where the model does not know its own uncertainty.
struct ModelSlice {
  std::size_t parameter = 0;
  std::vector<double> x;  // SI
  std::vector<double> mean;
  std::vector<double> low;
  std::vector<double> high;
};

// The posterior density of one parameter over its searched range and that of its prior, as
// multiples of the even density.
struct Marginal {
  std::size_t parameter = 0;
  std::vector<double> x;  // SI
  std::vector<double> density;
  std::vector<double> prior;
};

// Over two parameters, by cell, x fastest: the share of the posterior in denser cells, so that
// cells below 0.5 and 0.9 are the joint regions.
struct PairMap {
  std::size_t i = 0;
  std::size_t j = 0;
  std::vector<double> x_edges;  // of the cells, parameter i, SI
  std::vector<double> y_edges;  // parameter j
  std::vector<double> value;
  double plane = 1;  // what the cells cover together, share of the searched plane
};

// Through `point` of the unit cube.
std::vector<ModelSlice> SliceModel(const Evidence& evidence, const Eigen::VectorXd& point);

std::vector<Marginal> Marginals(const Evidence& evidence);

// Every pair of parameters that are asked for.
std::vector<PairMap> PosteriorPairs(const Evidence& evidence);

}  // namespace talus::analysis
