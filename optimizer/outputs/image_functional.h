// The objective as a functional of an image that normal coefficients of its modes stand for.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "optimizer/outputs/field_objective.h"
#include "surrogate/images/field_code.h"
#include "surrogate/images/principal_modes.h"

namespace talus::optimizer {

// Normal coefficients of the modes at one point.
struct Coefficients {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;
};

struct Moment {
  double mean = 0;
  double sd = 0;
};

class ImageFunctional {
 public:
  // `blur`: variance of each element of the code among the target's heaps; the mean image of
  // several heaps has wider edges than each of them. Empty for none.
  ImageFunctional(std::shared_ptr<const surrogate::FieldCode> code, const FieldObjective& objective,
                  const surrogate::PrincipalModes& modes, Eigen::VectorXd blur);

  // The code of one heap's image, and of an image of the target's kind, the mean of several heaps.
  Eigen::VectorXd OneHeap(const Eigen::VectorXd& coefficients) const;
  Eigen::VectorXd MeanImage(const Eigen::VectorXd& coefficients) const;

  double Value(const Eigen::VectorXd& vector) const;  // of a code
  // Expectation of the mean image's value.
  double Expected(const Coefficients& at) const;
  // The same, of a metric the value of the expected image: a value takes milliseconds, and an
  // expectation dozens of them.
  double Outlined(const Coefficients& at) const;
  // The mean image's value for fixed draws of the coefficients, the same at every point.
  Eigen::VectorXd Draws(const Coefficients& at) const;
  double SdOfDraws(const Coefficients& at) const;
  // Expected and SdOfDraws together, which of a metric come from the same draws.
  Moment MomentsAt(const Coefficients& at) const;

  Eigen::Index num_draws() const { return normals_.rows(); }

 private:
  std::shared_ptr<const surrogate::FieldCode> code_;
  FieldObjective objective_;
  surrogate::PrincipalModes modes_;
  Eigen::VectorXd blur_;
  Eigen::MatrixXd normals_;  // one draw a row, one mode a column
};

}  // namespace talus::optimizer
