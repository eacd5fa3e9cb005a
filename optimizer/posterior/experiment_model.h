// How well parameter sets match what one experiment has measured, by the model of its outputs at
// the target scale factor.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "optimizer/moments.h"
#include "optimizer/outputs/experiment_target.h"
#include "optimizer/outputs/image_functional.h"
#include "optimizer/outputs/levels.h"
#include "optimizer/outputs/output_model.h"
#include "optimizer/posterior_summary.h"
#include "surrogate/images/field_code.h"

namespace talus::optimizer {

// The surrogate's sd is taken for so many times as large in the misfit: point-estimated
// hyper-parameters and constant noise make it overconfident where the posterior selects, the more
// the fewer evaluations there are at the finest scale factor (bench/optimizers/README.md). Where
// the target is finer still, no number of them tells how the discrepancy goes on: six count at
// most.
double SurrogateCaution(double num_finest);

// Misfit of the predicted outputs from the measured ones, one point a row.
struct OutputMisfit {
  Eigen::MatrixXd residual;  // (measured - predicted mean) / sd, one output a column; sd with the
                             // surrogate's part inflated
  Eigen::VectorXd log_sd;  // Σ ln sd over the outputs, not inflated; what the surrogate adds to it
                           // counts three quarters
  Eigen::VectorXd share;   // of the surrogate in the inflated variances, mean over the outputs
};

// The surrogate's mean and variance of the outputs at the target scale factor, one point a row, one
// output a column; not inflated.
struct OutputMoments {
  Eigen::MatrixXd mean;
  Eigen::MatrixXd variance;
};

// What no simulation of an experiment can match, in standard deviations of one heap from run to
// run.
struct ModelError {
  double value = 1;  // >= 0
  double told = 0;   // share of its prior's sd that the measurements have taken away, in [0, 1]; 0
                     // where it is stated (learn_model_errors.h)
};

// The outputs at the target scale factor, and every variance that hides the truth from them.
struct OutputPredictions {
  Eigen::MatrixXd mean;      // one point a row, one output a column
  Eigen::MatrixXd variance;  // the surrogate's, inflated as in OutputMisfit
  Eigen::VectorXd measured;  // variance of what the experiment has measured, of each output
  Eigen::VectorXd model;     // what no simulation can match (PosteriorStrategyOptions::model_error)
  Eigen::VectorXd single;    // of one heap about the mean of many
};

class ExperimentModel {
 public:
  struct Setup {
    const ExperimentTarget* target = nullptr;          // outlives the model
    std::shared_ptr<const surrogate::FieldCode> code;  // null without images
    const Levels* levels = nullptr;
    double model_error = 1;  // PosteriorStrategyOptions
  };
  // `frozen`, where not null, is taken instead of fitting.
  ExperimentModel(const Setup& setup, const OutputData& data, const OutputState* frozen);

  int num_outputs() const { return outputs_.num_outputs(); }
  OutputState state() const { return outputs_.state(); }

  OutputMoments Outputs(const Eigen::MatrixXd& points) const;
  // A number's mean is one that it can be.
  surrogate::Predictions PredictOutput(Eigen::Index output, const Eigen::MatrixXd& points) const;
  // Joint draws of the surrogate's error at the target: element k of output k, one draw a row, one
  // point a column; not inflated.
  std::vector<Eigen::MatrixXd> ErrorDraws(const Eigen::MatrixXd& points, int num_draws,
                                          std::uint64_t seed) const;
  OutputMisfit MisfitOf(const OutputMoments& outputs) const {
    return MisfitOf(outputs, caution_, open_);
  }
  OutputPredictions Predict(const Eigen::MatrixXd& points) const;
  // With the model error as it was stated, as SquaredMisfit: no disagreement may hide in one that
  // was learnt from it.
  //
  // The larger of √(mean squared residual) over the image's modes and each scalar's |residual|.
  double Misfit(const Eigen::VectorXd& x) const;
  // Sum of the squared residuals of all outputs, one point a row; with the caution that is due to
  // few evaluations alone: a region may be too wide, but no disagreement may hide in that.
  Eigen::VectorXd SquaredMisfit(const Eigen::MatrixXd& points) const;

  // As OutputModel's.
  Eigen::MatrixXd LeaveOneOut() const { return outputs_.LeaveOneOut(); }

  // How much one more simulation at a site (a row) and a level (a column) narrows the misfit's sd
  // at the points `draws`: the mean over them of Σ over outputs of ½ ln((V + B)/(V' + B)), V and V'
  // the surrogate's variance at the target before and after, B what the experiment itself leaves
  // open. A simulation at the target teaches the discrepancy far around, a coarse one does not.
  Eigen::MatrixXd Gains(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& sites) const {
    return Gains(draws, sites, [](const Narrowed&) {});
  }
  // One term of it: what a simulation makes of an output's variance at the points `draws`.
  struct Narrowed {
    Eigen::Index output = 0;
    Eigen::Index site = 0;
    int level = 0;
    const Eigen::ArrayXd& before;  // V + B
    const Eigen::ArrayXd& after;   // V' + B
  };
  // The same, and shows every term.
  Eigen::MatrixXd Gains(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& sites,
                        const std::function<void(const Narrowed&)>& show) const;
  // The same for perfect knowledge at each point (V' = 0): where something is left to learn.
  Eigen::VectorXd GainOfAll(const Eigen::MatrixXd& points) const;

  void AddFantasy(const Eigen::VectorXd& x, int level) { outputs_.AddFantasy(x, level); }

  const ModelError& model_error() const { return model_error_; }
  const Eigen::VectorXd& open() const { return open_; }  // B, of each output
  // Takes the place of the stated one in MisfitOf, Predict, Gains and GainOfAll.
  void SetModelError(const ModelError& model_error);

  // From now on the surrogate is trusted as one of so many times the evaluations at the finest
  // scale factor.
  double caution() const { return caution_; }
  void TakeForFinest(double times);

  double weight() const { return setup_.target->weight; }
  bool has_image() const { return setup_.code != nullptr; }
  // The objective of the mean image at the target; wants an image.
  Moments Objective(const Eigen::MatrixXd& points) const;
  // Its mean alone, as ImageFunctional::Outlined has it: for thousands of points.
  Eigen::VectorXd OutlinedObjective(const Eigen::MatrixXd& points) const;
  double ObjectiveNoise(const Eigen::VectorXd& x) const;  // sd of one heap's at the target

  // Without the implausibility, which wants the posterior's temper.
  ExperimentStanding StandingAt(const Eigen::VectorXd& x) const;

  // Each scalar at the target, its median and its surrogate's sd, in its own unit; one a column.
  std::vector<Moments> Scalars(const Eigen::MatrixXd& points) const;

  // By how much each scatters from simulation to simulation at the target at x, in its own unit.
  std::vector<double> ScalarNoise(const Eigen::VectorXd& x) const;

  // The outputs of one simulation: the coefficients of its image and its numbers, compressed; NaN
  // for a number that is undefined. `field` is empty without images.
  Eigen::VectorXd OutputsOf(std::span<const float> field, const std::vector<double>& scalars) const;
  // Variance of each output of one simulation at a scale factor.
  Eigen::VectorXd NoiseAt(double scale_factor) const;
  // From now on the experiment has measured so much more of each output.
  void MoveMeasured(const Eigen::VectorXd& by) { measured_ += by; }

  // The mean image at the target, as FieldObjective's; wants an image.
  std::vector<float> MeanImage(const Eigen::VectorXd& x) const;

 private:
  OutputMisfit MisfitOf(const OutputMoments& outputs, double caution,
                        const Eigen::VectorXd& open) const;
  Eigen::VectorXd OpenWith(double model_error) const;
  void MeasureImages();
  void MeasureScalars();

  Setup setup_;
  double num_finest_ = 0;  // sets evaluated at the finest scale factor
  double caution_ = 1;     // SurrogateCaution
  OutputModel outputs_;
  Eigen::VectorXd measured_;   // each output
  Eigen::VectorXd error_;      // variance of `measured_`
  Eigen::VectorXd unmatched_;  // variance of an output that a model error of 1 adds: what no
                               // simulation can match
  ModelError model_error_;
  Eigen::VectorXd open_;  // B: variance that experiment and model leave, of each output
  std::optional<ImageFunctional> objective_;
};

}  // namespace talus::optimizer
