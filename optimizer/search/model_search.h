// Searches the unit cube for the best point of a cheap function: many candidates, some of them near
// given centres, then local searches from the best few. Deterministic for a seed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct SearchOptions {
  int num_candidates = 600;  // half of them even over the cube, half near the centres
  int num_local = 4;         // local searches from so many of the best candidates
  int max_evaluations = 40;  // of one local search
  double tolerance = 1e-7;   // of a coordinate, ends a local search
  bool kinked = false;       // the function has kinks: search by simplex, without gradients
  std::uint64_t seed = 1;
};

// To be minimised; called for several points at once.
struct CheapFunction {
  // One value a row of points.
  std::function<Eigen::VectorXd(const Eigen::MatrixXd&)> values;
  // One value, with the gradient where not null. Never asked for a gradient when kinked.
  std::function<double(const Eigen::VectorXd&, Eigen::VectorXd*)> value_and_gradient;
  double work = 0;  // about how many multiplications one value takes
};

struct Found {
  Eigen::VectorXd point;
  double value = 0;
};

// `centers`: one point a row, most promising first; may be empty. They are candidates themselves.
Found SearchCube(const CheapFunction& function, const Domain& domain,
                 const Eigen::MatrixXd& centers, const SearchOptions& options);

}  // namespace talus::optimizer
