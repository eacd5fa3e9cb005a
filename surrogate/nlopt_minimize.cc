#include "surrogate/nlopt_minimize.h"

#include <nlopt.h>

#include <cmath>
#include <exception>
#include <limits>
#include <memory>

#include "base/error.h"

namespace talus::surrogate {
namespace {

constexpr double kVeryBad = 1e100;  // finite, so that the algorithms' arithmetic stays finite

nlopt_algorithm NloptName(SearchAlgorithm algorithm) {
  switch (algorithm) {
    case SearchAlgorithm::kLbfgs:
      return NLOPT_LD_LBFGS;
    case SearchAlgorithm::kBobyqa:
      return NLOPT_LN_BOBYQA;
    case SearchAlgorithm::kNelderMead:
      return NLOPT_LN_NELDERMEAD;
    case SearchAlgorithm::kDirectL:
      return NLOPT_GN_DIRECT_L;
  }
  throw base::Error("unknown search algorithm");
}

// What the callback works on.
struct Search {
  const SearchFunction& function;
  nlopt_opt handle;
  Minimum best;
  std::exception_ptr failure;

  double Evaluate(unsigned size, const double* x, double* gradient) {
    const Eigen::VectorXd point = Eigen::Map<const Eigen::VectorXd>(x, size);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(gradient != nullptr ? size : 0);
    double value = function(point, gradient != nullptr ? &slope : nullptr);
    ++best.num_evaluations;
    if (!std::isfinite(value) || !slope.allFinite()) {
      value = kVeryBad;
      slope.setZero();
    }
    if (gradient != nullptr) Eigen::Map<Eigen::VectorXd>(gradient, size) = slope;
    if (value < best.value) {
      best.value = value;
      best.point = point;
    }
    return value;
  }
};

// C code must not see an exception: it is kept, the search ends, and Minimize throws it again.
double Callback(unsigned size, const double* x, double* gradient, void* data) {
  auto& search = *static_cast<Search*>(data);
  try {
    return search.Evaluate(size, x, gradient);
  } catch (...) {
    search.failure = std::current_exception();
    nlopt_force_stop(search.handle);
    return kVeryBad;
  }
}

void SetUp(nlopt_opt handle, const SearchTask& task) {
  nlopt_set_lower_bounds(handle, task.lower.data());
  nlopt_set_upper_bounds(handle, task.upper.data());
  nlopt_set_maxeval(handle, task.max_evaluations);
  if (task.relative_tolerance > 0) nlopt_set_ftol_rel(handle, task.relative_tolerance);
  if (task.absolute_tolerance > 0) nlopt_set_xtol_abs1(handle, task.absolute_tolerance);
  if (task.initial_step > 0) nlopt_set_initial_step1(handle, task.initial_step);
}

}  // namespace

Minimum Minimize(const SearchFunction& function, const SearchTask& task) {
  const auto size = static_cast<unsigned>(task.lower.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> handle(
      nlopt_create(NloptName(task.algorithm), size), nlopt_destroy);
  if (handle == nullptr) throw base::Error("NLopt has no memory for a search");
  Search search{function, handle.get(), {}, nullptr};
  search.best.value = std::numeric_limits<double>::infinity();
  search.best.point = task.start.cwiseMax(task.lower).cwiseMin(task.upper);
  SetUp(handle.get(), task);
  nlopt_set_min_objective(handle.get(), Callback, &search);
  Eigen::VectorXd x = search.best.point;
  double value = 0;
  const nlopt_result result = nlopt_optimize(handle.get(), x.data(), &value);
  if (search.failure) std::rethrow_exception(search.failure);
  if (result == NLOPT_INVALID_ARGS || result == NLOPT_OUT_OF_MEMORY) {
    throw base::Error("NLopt refuses the search: lower bounds above upper ones, or no memory");
  }
  return search.best;
}

}  // namespace talus::surrogate
