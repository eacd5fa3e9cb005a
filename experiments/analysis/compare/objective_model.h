// An objective between the trials: a Gaussian process of the measured quantity.
//
// The quantity is modelled, not the objective: an angle is smooth where |angle - reference| has a
// kink. The number of points is capped so that 10 000 trials are answered in seconds; those kept
// are the ones nearest to the best set and an even share of the rest, never those with the best
// values, whose noise would flatter the model.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "experiments/analysis/compare/criterion.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::analysis {

struct ModelPoint {
  Eigen::VectorXd point;  // unit cube
  double quantity = 0;
};

struct ObjectivePrediction {
  double quantity = 0;
  double sd = 0;         // of the mean quantity
  double objective = 0;  // of the mean quantity, which a process may put below 0
  double low = 0;        // 90 % band of the objective
  double high = 0;
};

class ObjectiveModel {
 public:
  // Needs at least kFewestPoints points.
  static constexpr std::size_t kFewestPoints = 6;
  static ObjectiveModel Fit(std::span<const ModelPoint> points, const Eigen::VectorXd& best,
                            const Criterion& info, double reference);

  // One point a row.
  std::vector<ObjectivePrediction> Predict(const Eigen::MatrixXd& points) const;

  // The least predicted objective, from `start` and an even sample of the cube; where there are
  // constraints, of what `feasible` allows.
  using Feasible = std::function<bool(const Eigen::VectorXd&)>;
  Eigen::VectorXd Minimiser(const Eigen::VectorXd& start, const Feasible& feasible) const;

  double noise_sd() const;  // scatter of one evaluation of the quantity

 private:
  ObjectiveModel(surrogate::GaussianProcess process, const Criterion& info, double reference)
      : process_(std::move(process)), info_(info), reference_(reference) {}

  surrogate::GaussianProcess process_;
  Criterion info_;
  double reference_ = 0;
};

// Sobol's points of the unit cube, one a row.
Eigen::MatrixXd EvenSample(int num_points, Eigen::Index num_parameters);

}  // namespace talus::analysis
