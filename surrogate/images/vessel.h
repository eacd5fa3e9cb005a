// Where powder can be in an image: above the floor of what holds it. A plate along the bottom of
// the image leaves every pixel open; the floor of a drum is round.
//
// Columns are from the bottom up, as in column_edges.cc.
#pragma once

#include <Eigen/Core>
#include <span>

namespace talus::surrogate {

// The size of an image.
struct FieldSize {
  int width = 0;   // [px]
  int height = 0;  // [px]

  int num_pixels() const { return width * height; }
};

class Vessel {
 public:
  // Every pixel is open.
  explicit Vessel(const FieldSize& size);
  // The floor is what stays black under the powder of `field`, a field as in column_edges.h. There
  // is one only where most columns with powder show it: single ones may overhang.
  Vessel(std::span<const float> field, const FieldSize& size);

  // The share of each pixel that powder can fill, 1 above the floor.
  const Eigen::MatrixXd& open() const { return open_; }
  // One pixel's; and the sum of those below a row.
  double Open(Eigen::Index row, Eigen::Index column) const { return open_(row, column); }
  double OpenBelow(Eigen::Index row, Eigen::Index column) const { return below_(row, column); }
  // What the floor takes of a column [px].
  double Floor(Eigen::Index column) const {
    return static_cast<double>(open_.rows()) - below_(open_.rows(), column);
  }

 private:
  void Sum();

  Eigen::MatrixXd open_;   // one column of the image a column
  Eigen::MatrixXd below_;  // one row more
};

// One column of a field a column, from the bottom up.
Eigen::MatrixXd Columns(std::span<const float> field, const FieldSize& size);

}  // namespace talus::surrogate
