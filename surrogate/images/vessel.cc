#include "surrogate/images/vessel.h"

namespace talus::surrogate {
namespace {

constexpr double kPowder = 0.5;  // a pixel at least this bright is powder

// The lowest row of powder in a column; the number of rows where there is none.
Eigen::Index LowestPowder(const Eigen::MatrixXd& columns, Eigen::Index column) {
  Eigen::Index row = 0;
  while (row < columns.rows() && columns(row, column) < kPowder) ++row;
  return row;
}

}  // namespace

Eigen::MatrixXd Columns(std::span<const float> field, const FieldSize& size) {
  Eigen::MatrixXd columns(size.height, size.width);
  for (int row = 0; row < size.height; ++row) {
    const auto start = static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width);
    for (int c = 0; c < size.width; ++c) {
      columns(size.height - 1 - row, c) = field[start + static_cast<std::size_t>(c)];
    }
  }
  return columns;
}

Vessel::Vessel(const FieldSize& size) : open_(Eigen::MatrixXd::Ones(size.height, size.width)) {
  Sum();
}

Vessel::Vessel(std::span<const float> field, const FieldSize& size) : Vessel(size) {
  const Eigen::MatrixXd columns = Columns(field, size);
  int num_powder = 0;
  int num_floors = 0;
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    const Eigen::Index lowest = LowestPowder(columns, c);
    if (lowest == columns.rows()) continue;
    ++num_powder;
    if (lowest == 0) continue;
    ++num_floors;
    open_.col(c).head(lowest + 1) = columns.col(c).head(lowest + 1);
  }
  if (2 * num_floors <= num_powder) open_.setOnes();
  Sum();
}

void Vessel::Sum() {
  below_ = Eigen::MatrixXd::Zero(open_.rows() + 1, open_.cols());
  for (Eigen::Index r = 0; r < open_.rows(); ++r) {
    below_.row(r + 1) = below_.row(r) + open_.row(r);
  }
}

}  // namespace talus::surrogate
