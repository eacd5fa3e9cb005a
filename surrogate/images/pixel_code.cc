#include <algorithm>
#include <cmath>
#include <numbers>

#include "surrogate/images/field_code.h"
#include "surrogate/images/normal_table.h"

namespace talus::surrogate {
namespace {

// More would cost time and say nothing: modes of a heap are far wider than a block.
constexpr int kMaxBlocks = 6000;

// E|x - t| for x normal: s √(2/π) exp(-z²/2) + d (2 Φ(z) - 1), d = mean - t, z = d / s.
double MeanDistance(double difference, double variance) {
  const double sd = std::sqrt(variance);
  const double z = std::abs(difference) / sd;
  if (!(z < 6)) return std::abs(difference);
  return sd * std::sqrt(2 / std::numbers::pi) * std::exp(-z * z / 2) +
         std::abs(difference) * (2 * NormalTable::Cdf(z) - 1);
}

}  // namespace

PixelCode::PixelCode(const FieldSize& size, std::span<const float> target) : size_(size) {
  while ((size.width / block_) * (size.height / block_) > kMaxBlocks) ++block_;
  num_columns_ = (size.width + block_ - 1) / block_;
  const int num_rows = (size.height + block_ - 1) / block_;
  num_pixels_ = Eigen::VectorXd::Zero(num_columns_ * num_rows);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      num_pixels_[(y / block_) * num_columns_ + x / block_] += 1;
    }
  }
  if (!target.empty()) target_ = Encode(target);
}

Eigen::VectorXd PixelCode::Encode(std::span<const float> field) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_pixels_.size());
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      sum[(y / block_) * num_columns_ + x / block_] +=
          field[static_cast<std::size_t>(y * size_.width + x)];
    }
  }
  return sum.cwiseQuotient(num_pixels_);
}

std::vector<float> PixelCode::Decode(const Eigen::VectorXd& vector) const {
  std::vector<float> field(static_cast<std::size_t>(size_.num_pixels()));
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      const double value = vector[(y / block_) * num_columns_ + x / block_];
      field[static_cast<std::size_t>(y * size_.width + x)] =
          static_cast<float>(std::clamp(value, 0.0, 1.0));
    }
  }
  return field;
}

double PixelCode::Sad(const Eigen::VectorXd& vector) const {
  const Eigen::ArrayXd grey = vector.array().max(0).min(1);
  return ((grey - target_.array()).abs() * num_pixels_.array()).sum();
}

double PixelCode::ExpectedSad(const Eigen::VectorXd& mean, const Eigen::VectorXd& variance) const {
  double sum = 0;
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    sum += num_pixels_[i] * MeanDistance(std::clamp(mean[i], 0.0, 1.0) - target_[i], variance[i]);
  }
  return sum;
}

}  // namespace talus::surrogate
