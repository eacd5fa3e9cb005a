// What one experiment's simulations say of its outputs at the target scale factor: the principal
// modes of its images and its scalars, each a process over parameters and scale factor.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "optimizer/fidelity/experiment_target.h"
#include "optimizer/fidelity/levels.h"
#include "optimizer/fidelity/posterior_summary.h"
#include "optimizer/models/objective_model.h"
#include "surrogate/fidelity/fidelity_process.h"
#include "surrogate/images/field_code.h"
#include "surrogate/images/principal_modes.h"

namespace talus::optimizer {

// The surrogate's sd is taken for so many times as large in the misfit: point-estimated
// hyper-parameters and constant noise make it overconfident where the posterior selects, the more
// the fewer evaluations there are at the finest scale factor (bench/optimizers/README.md).
double SurrogateCaution(int num_finest);

// The evaluations of one experiment.
struct ExperimentData {
  std::vector<Eigen::VectorXd> points;  // unit cube
  std::vector<int> level;
  std::vector<Eigen::VectorXd> vectors;  // images as the code writes them; empty without images
  std::vector<std::vector<double>> scalars;

  int size() const { return static_cast<int>(points.size()); }
};

// Everything that fitting decides.
struct ExperimentState {
  surrogate::PrincipalModes modes;
  std::vector<surrogate::FidelityState> outputs;
};

// Misfit of the predicted outputs from the measured ones, one point a row.
struct OutputMisfit {
  Eigen::MatrixXd residual;  // (measured - predicted mean) / sd, one output a column; sd with the
                             // surrogate's part inflated
  Eigen::VectorXd log_sd;    // Σ ln sd over the outputs, not inflated
};

// The outputs at the target scale factor, and every variance that hides the truth from them.
struct OutputPredictions {
  Eigen::MatrixXd mean;      // one point a row, one output a column
  Eigen::MatrixXd variance;  // the surrogate's, inflated as in OutputMisfit
  Eigen::VectorXd measured;  // variance of what the experiment has measured, of each output
  Eigen::VectorXd model;     // what no simulation can match (FidelityOptions::model_error)
  Eigen::VectorXd single;    // of one heap about the mean of many
};

class ExperimentModel {
 public:
  struct Setup {
    const ExperimentTarget* target = nullptr;          // outlives the model
    std::shared_ptr<const surrogate::FieldCode> code;  // null without images
    const Levels* levels = nullptr;
    double model_error = 1;  // FidelityOptions
  };
  // `frozen`, where not null, is taken instead of fitting.
  ExperimentModel(const Setup& setup, const ExperimentData& data, const ExperimentState* frozen);

  int num_outputs() const { return static_cast<int>(outputs_.size()); }
  ExperimentState state() const;

  OutputMisfit MisfitOf(const Eigen::MatrixXd& points) const { return MisfitOf(points, caution_); }
  OutputPredictions Predict(const Eigen::MatrixXd& points) const;
  // The larger of √(mean squared residual) over the image's modes and each scalar's |residual|.
  double Misfit(const Eigen::VectorXd& x) const;
  // Sum of the squared residuals of all outputs, one point a row; without caution: a region may be
  // too wide, but no disagreement may hide in that.
  Eigen::VectorXd SquaredMisfit(const Eigen::MatrixXd& points) const;

  // Of each evaluation, predicted from the others, in their sd: one evaluation a row.
  Eigen::MatrixXd LeaveOneOut() const;

  // How much one more simulation at a site (a row) and a level (a column) narrows the misfit's sd
  // at the points `draws`: the mean over them of Σ over outputs of ½ ln((V + B)/(V' + B)), V and V'
  // the surrogate's variance at the target before and after, B what the experiment itself leaves
  // open. A simulation at the target teaches the discrepancy far around, a coarse one does not.
  Eigen::MatrixXd Gains(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& sites) const;
  // The same for perfect knowledge at each point (V' = 0): where something is left to learn.
  Eigen::VectorXd GainOfAll(const Eigen::MatrixXd& points) const;

  void AddFantasy(const Eigen::VectorXd& x, int level);

  double weight() const { return setup_.target->weight; }
  bool has_image() const { return setup_.code != nullptr; }
  // Of the objective of the mean image at the target; wants an image.
  Moments Objective(const Eigen::MatrixXd& points) const;
  double ObjectiveNoise(const Eigen::VectorXd& x) const;  // sd of one heap's at the target

  // Without the implausibility, which wants the posterior's temper.
  ExperimentStanding StandingAt(const Eigen::VectorXd& x) const;

  // Each scalar at the target, expected and its surrogate's sd, in its own unit; one a column.
  std::vector<Moments> Scalars(const Eigen::MatrixXd& points) const;

  // The mean image at the target, as FieldObjective's; wants an image.
  std::vector<float> MeanImage(const Eigen::VectorXd& x) const;

 private:
  OutputMisfit MisfitOf(const Eigen::MatrixXd& points, double caution) const;
  // The coefficients of the images and the scalars, one evaluation a row; NaN where undefined.
  Eigen::MatrixXd OutputValues(const ExperimentData& data) const;
  void FitOutputs(const ExperimentData& data, const ExperimentState* frozen);
  void MeasureImages();
  void MeasureScalars();
  double TargetNoise(std::size_t output) const;  // variance of one heap at the target
  double ObjectiveOf(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& variance) const;
  Eigen::VectorXd ObjectiveDraws(const Eigen::VectorXd& mean, const Eigen::VectorXd& sd) const;

  Setup setup_;
  double caution_ = 1;  // SurrogateCaution
  surrogate::PrincipalModes modes_;
  std::vector<surrogate::FidelityProcess> outputs_;     // modes, then scalars
  std::vector<std::vector<Eigen::Index>> evaluations_;  // rows of the data that each has
  Eigen::Index num_evaluations_ = 0;
  Eigen::VectorXd measured_;  // of each output
  Eigen::VectorXd error_;     // variance of `measured_`
  Eigen::VectorXd open_;      // B: variance that experiment and model leave, of each output
  Eigen::VectorXd blur_;      // variance of each image element among the target's heaps
};

}  // namespace talus::optimizer
