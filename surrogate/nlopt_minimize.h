// Minimises a function over a box by one of NLopt's algorithms. The only door to NLopt.
//
// Deterministic: no algorithm draws anything, and the limits count evaluations, never seconds. The
// best point seen is returned however the search ends, so an algorithm that gives up on rounding
// errors is no failure.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace talus::surrogate {

enum class SearchAlgorithm {
  kLbfgs,       // quasi-Newton, wants the gradient
  kBobyqa,      // quadratic model in a trust region
  kNelderMead,  // simplex
  kDirectL,     // dividing rectangles, locally biased
};

struct SearchTask {
  SearchAlgorithm algorithm = SearchAlgorithm::kLbfgs;
  Eigen::VectorXd lower = {};
  Eigen::VectorXd upper = {};
  Eigen::VectorXd start = {};  // inside the box; global algorithms only take its size
  int max_evaluations = 100;
  double relative_tolerance = 0;  // stop when a step changes the value by less; 0: never
  double absolute_tolerance = 0;  // stop when a step changes a coordinate by less; 0: never
  double initial_step = 0;        // first step of the derivative-free ones; 0: NLopt's own choice
};

struct Minimum {
  Eigen::VectorXd point;
  double value = 0;
  int num_evaluations = 0;
};

// Returns the value at x and, where `gradient` is not null, fills it. A value that is not finite is
// taken as very bad. An exception ends the search and reaches the caller of Minimize.
using SearchFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd* gradient)>;

Minimum Minimize(const SearchFunction& function, const SearchTask& task);

}  // namespace talus::surrogate
