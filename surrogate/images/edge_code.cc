#include "surrogate/images/field_code.h"

namespace talus::surrogate {
namespace {

constexpr double kWidthWeight = 0.8;
constexpr double kSmallVariance = 1e-8;  // [px²]: below it the expectation is the value

}  // namespace

EdgeCode::EdgeCode(const FieldSize& size, std::span<const float> target)
    : size_(size), vessel_(target.empty() ? Vessel(size) : Vessel(target, size)) {
  if (!target.empty()) sad_ = std::make_unique<EdgeSad>(target, size, vessel_);
}

Eigen::VectorXd EdgeCode::Encode(std::span<const float> field) const {
  const ColumnEdges edges = FitEdges(field, size_, vessel_);
  Eigen::VectorXd vector(2 * size_.width);
  vector << edges.height, kWidthWeight * edges.width;
  return vector;
}

ColumnEdges EdgeCode::Edges(const Eigen::VectorXd& vector) const {
  return {.height = vector.head(size_.width),
          .width = (vector.tail(size_.width) / kWidthWeight).cwiseMax(kSharpestEdge)};
}

std::vector<float> EdgeCode::Decode(const Eigen::VectorXd& vector) const {
  return Render(Edges(vector), size_, vessel_);
}

// Φ(y / w) blurred by a normal distribution of variance v is Φ(y / √(w² + v)).
Eigen::VectorXd EdgeCode::MeanOfImages(const Eigen::VectorXd& vector,
                                       const Eigen::VectorXd& variance) const {
  const Eigen::ArrayXd width = (vector.tail(size_.width) / kWidthWeight).cwiseMax(kSharpestEdge);
  Eigen::VectorXd mean = vector;
  mean.tail(size_.width) =
      kWidthWeight * (width.square() + variance.head(size_.width).array()).sqrt();
  return mean;
}

Eigen::VectorXd EdgeCode::OneOfMean(const Eigen::VectorXd& mean,
                                    const Eigen::VectorXd& variance) const {
  const Eigen::ArrayXd width = mean.tail(size_.width) / kWidthWeight;
  const Eigen::ArrayXd squared = width.square() - variance.head(size_.width).array();
  Eigen::VectorXd one = mean;
  one.tail(size_.width) = kWidthWeight * squared.max(kSharpestEdge * kSharpestEdge).sqrt();
  return one;
}

double EdgeCode::Sad(const Eigen::VectorXd& vector) const { return sad_->Of(Edges(vector)); }

double EdgeCode::ExpectedSad(const Eigen::VectorXd& mean, const Eigen::VectorXd& variance) const {
  const auto of_heights = variance.head(size_.width);
  if (of_heights.maxCoeff() < kSmallVariance) return Sad(mean);
  return sad_->Expected(Edges(mean), of_heights);
}

}  // namespace talus::surrogate
