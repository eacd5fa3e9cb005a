// The objective as a functional of a predicted image.
//
//   objective(x) = E[metric(image of c)] + r(x),   c the coefficients of the image's modes at x
//
// The expectation is over the posterior of the mean coefficients, not over the noise of single
// evaluations. r is the reconstruction error: the objective of the image less that of its decoded
// code, known exactly at each evaluation, hence a process of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "optimizer/outputs/field_objective.h"
#include "optimizer/outputs/image_functional.h"
#include "optimizer/outputs/output_model.h"
#include "optimizer/search/objective_model.h"
#include "surrogate/images/field_code.h"

namespace talus::optimizer {

// Evaluations as a code writes them.
struct CodedImages {
  OutputData outputs;
  Eigen::VectorXd values;                 // the objective's
  Eigen::VectorXd reconstruction_errors;  // objective of the image less that of the decoded image

  Eigen::MatrixXd Points() const;  // one a row
};

// Everything that fitting decides.
struct ImageState {
  OutputState outputs;
  std::optional<surrogate::GaussianProcessState> reconstruction;  // none where errors are tiny
};

struct ImageModelOptions {
  bool deterministic = false;
  std::uint64_t seed = 1;
};

// First and second derivatives of the predicted objective by the coefficients, one point a row, one
// mode a column: differences over one posterior standard deviation to either side.
struct Sensitivities {
  Eigen::MatrixXd slope;
  Eigen::MatrixXd curvature;
};

class ImageModel : public ObjectiveModel {
 public:
  // `frozen`, where not null, is taken instead of fitting.
  ImageModel(std::shared_ptr<const surrogate::FieldCode> code, const FieldObjective& objective,
             const CodedImages& data, const ImageModelOptions& options, const ImageState* frozen);

  double PredictionWork() const override;
  Moments Predict(const Eigen::MatrixXd& points) const override;
  // Draws of the objective to a target that is drawn too, within what is not known of it.
  Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws,
                       base::Random random) const override;
  double NoiseSd(const Eigen::VectorXd& x) const override;

  double Mean(const Eigen::VectorXd& x) const;
  Eigen::VectorXd Means(const Eigen::MatrixXd& points) const override;

  // ln E[max(0, incumbent - objective)]. Without noise by draws; where no draw improves, a number
  // below all others that says by how much the incumbent is missed. With noise, `noise` > 0, from
  // the mean and standard deviation of the draws and weighted for noise (acquisition.h): a handful
  // of draws never finds the small chance that a point far off is better, and the search would not
  // leave the first valley it sees.
  Eigen::VectorXd LogImprovement(const Eigen::MatrixXd& points, double incumbent,
                                 double noise) const override;

  // What evaluations are expected to give, each from the others: noise included.
  Eigen::VectorXd LeaveOneOut() const;

  // Adds the prediction at x as if it were an evaluation.
  void AddFantasy(const Eigen::VectorXd& x);

  Sensitivities SensitivitiesAt(const Eigen::MatrixXd& points) const;

  ImageState state() const;
  const OutputModel& outputs() const { return outputs_; }
  // The process of the reconstruction error; none where errors are tiny.
  const std::optional<surrogate::GaussianProcess>& reconstruction() const {
    return reconstruction_;
  }
  int num_modes() const { return static_cast<int>(outputs_.num_modes()); }

 private:
  // What one evaluation, with its noise, is expected to give.
  double ExpectedOfOne(const Coefficients& at) const;
  double Reach(const Coefficients& at) const;
  // What is to be improved on, and what blurs it.
  struct Goal {
    double value = 0;           // of the decoded image
    double noise = 0;           // noise sd of one evaluation; 0 when deterministic
    double error_variance = 0;  // of the reconstruction error
  };
  double LogImprovementAt(const Coefficients& at, const Goal& goal) const;
  double LogImprovementOfDraws(const Eigen::VectorXd& draws, double incumbent) const;
  double ImageWork() const;  // multiplications of one image
  // Calls body(i) of each of `count` points or draws, which works out `num_images` images; several
  // at once.
  void ForEachPoint(Eigen::Index count, double num_images,
                    const std::function<void(Eigen::Index)>& body) const;
  surrogate::Predictions ReconstructionError(const Eigen::MatrixXd& points) const;
  // What the target may be off by, a draw a row; empty where it is exact. `nearest`: the
  // coefficients that fit the target best.
  Eigen::MatrixXd TargetErrors(const Coefficients& nearest, int num_draws,
                               base::Random random) const;
  Coefficients Nearest(const ModeMoments& modes) const;

  std::shared_ptr<const surrogate::FieldCode> code_;
  FieldObjective objective_;
  OutputModel outputs_;
  ImageFunctional functional_;
  std::optional<surrogate::GaussianProcess> reconstruction_;
  bool deterministic_ = false;
  Eigen::MatrixXd residuals_;  // what the modes leave of each evaluation, a row each
  Eigen::VectorXd target_;     // as the code writes it; empty without a target
};

}  // namespace talus::optimizer
