#include "optimizer/outputs/image_functional.h"

#include <utility>

#include "base/random.h"
#include "optimizer/outputs/mirrored_normals.h"
#include "surrogate/standard_deviation.h"

namespace talus::optimizer {
namespace {

constexpr Eigen::Index kFewestDraws = 16;

}  // namespace

ImageFunctional::ImageFunctional(std::shared_ptr<const surrogate::FieldCode> code,
                                 const FieldObjective& objective,
                                 const surrogate::PrincipalModes& modes, Eigen::VectorXd blur)
    : code_(std::move(code)),
      objective_(objective),
      modes_(modes),
      blur_(std::move(blur)),
      normals_(OrthogonalNormals(kFewestDraws, modes.basis.cols(),
                                 base::Random(1, base::Stream("objective draws")))) {}

Eigen::VectorXd ImageFunctional::OneHeap(const Eigen::VectorXd& coefficients) const {
  return modes_.mean + modes_.basis * coefficients;
}

Eigen::VectorXd ImageFunctional::MeanImage(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd vector = OneHeap(coefficients);
  return blur_.size() == 0 ? vector : code_->MeanOfImages(vector, blur_);
}

double ImageFunctional::Value(const Eigen::VectorXd& vector) const {
  if (objective_.metric) return objective_.metric(code_->Decode(vector));
  return objective_.sad_scale * code_->Sad(vector);
}

double ImageFunctional::Expected(const Coefficients& at) const {
  if (objective_.metric) return Draws(at).mean();
  return objective_.sad_scale *
         code_->ExpectedSad(MeanImage(at.mean), modes_.basis.cwiseAbs2() * at.variance);
}

double ImageFunctional::Outlined(const Coefficients& at) const {
  return objective_.metric ? Value(MeanImage(at.mean)) : Expected(at);
}

Eigen::VectorXd ImageFunctional::Draws(const Coefficients& at) const {
  const Eigen::VectorXd sd = at.variance.cwiseSqrt();
  Eigen::VectorXd values(num_draws());
  for (Eigen::Index i = 0; i < num_draws(); ++i) {
    values[i] = Value(MeanImage(at.mean + sd.cwiseProduct(normals_.row(i).transpose())));
  }
  return values;
}

double ImageFunctional::SdOfDraws(const Coefficients& at) const {
  return surrogate::StandardDeviation(Draws(at));
}

Moment ImageFunctional::MomentsAt(const Coefficients& at) const {
  const Eigen::VectorXd draws = Draws(at);
  return {.mean = objective_.metric ? draws.mean() : Expected(at),
          .sd = surrogate::StandardDeviation(draws)};
}

}  // namespace talus::optimizer
