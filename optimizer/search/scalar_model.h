// The objective as a Gaussian process of numbers.
//
// A deterministic objective may be fitted through t(v) = ln(v - least + δ), which resolves the
// small values of an objective that spans decades. Never under noise, where the lowest values are
// luck.
#pragma once

#include <array>
#include <limits>

#include "optimizer/search/history.h"
#include "optimizer/search/objective_model.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

// v → ln(v - least + delta), or v itself when delta is 0.
struct ValueTransform {
  double least = 0;
  double delta = 0;

  double Forward(double value) const;
  double Backward(double transformed) const;
  double BackwardSlope(double transformed) const;  // dv / dt
};

// Fitted hyper-parameters and the transform they hold for.
struct ScalarFit {
  ValueTransform transform;
  surrogate::GaussianProcess process;
  bool deterministic = false;  // the process's noise is a floor that keeps it solvable
};

// By what δ, or none at all, is chosen.
enum class FitFor {
  kSearch,  // the marginal likelihood of the values, which favours what resolves the lowest
  kAnswer,  // how well each value is predicted from the others, which favours what holds elsewhere
};

// Fits a growing history. The thorough fit, from many starts and over all transforms, is made of
// the first 8, 11, 16, 23, … evaluations, and later ones start from its result. So a fit is a
// function of the history alone, not of the fits asked for before, and yet most of them are cheap.
class ScalarFitter {
 public:
  explicit ScalarFitter(std::uint64_t seed) : seed_(seed) {}

  // At least one evaluation.
  ScalarFit Fit(const History& history, bool deterministic, FitFor purpose);

  // Whether the last fit is that of both purposes, as it always is under noise.
  bool ServesBoth() const {
    return milestone_.choices[0].delta_share == milestone_.choices[1].delta_share;
  }

 private:
  struct Choice {
    double delta_share = 0;  // ValueTransform::delta / (median - least)
    surrogate::Hyperparameters hyper = {};
    double merit = -std::numeric_limits<double>::infinity();  // log density that it was chosen by
  };
  struct Milestone {
    int num_evaluations = 0;  // 0: none yet
    bool deterministic = false;
    std::array<Choice, 2> choices = {};  // by FitFor
  };

  void ReachMilestone(const History& history, int num_evaluations, bool deterministic);

  std::uint64_t seed_;
  Milestone milestone_;
};

// In units of the objective: the mean is transformed back, the standard deviation to first order.
class ScalarModel : public ObjectiveModel {
 public:
  // `inflation`: factor on the posterior standard deviations and on the deviations of draws.
  explicit ScalarModel(ScalarFit fit, double inflation = 1)
      : fit_(std::move(fit)), inflation_(inflation) {}

  Moments Predict(const Eigen::MatrixXd& points) const override;
  Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws,
                       base::Random random) const override;
  double NoiseSd(const Eigen::VectorXd& x) const override;

 private:
  ScalarFit fit_;
  double inflation_ = 1;
};

// In units of the transformed objective, in which the process is Gaussian: for acquisition.
class TransformedModel : public ObjectiveModel {
 public:
  explicit TransformedModel(surrogate::GaussianProcess process) : process_(std::move(process)) {}

  Moments Predict(const Eigen::MatrixXd& points) const override;
  MomentsGradient PredictWithGradient(const Eigen::VectorXd& x) const override;
  Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws,
                       base::Random random) const override;
  double NoiseSd(const Eigen::VectorXd& x) const override;

  double PredictionWork() const override;

  const surrogate::GaussianProcess& process() const { return process_; }

 private:
  surrogate::GaussianProcess process_;
};

}  // namespace talus::optimizer
