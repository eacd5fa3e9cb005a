// The image of a heap as one edge a column: where the powder ends, and how wide the grey there is.
//
//   pixel(y) = Φ((h - y) / s)        y: height of the pixel's centre above the bottom [px]
//
// h height, s width of the edge [px]. From the sums over a column, exact for s ≳ 0.5 px well inside
// the image:
//   Σ pixel = h          Σ pixel (1 - pixel) = s / √π
// An average of silhouettes is grey where they differ, so s is mostly their standard deviation.
// Heights are smooth functions of the parameters where pixels jump from black to white. Below the
// floor of a vessel pixels stay black: each is multiplied by the share of it that powder can fill,
// and h is the height above the bottom of the image all the same.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "surrogate/images/vessel.h"

namespace talus::surrogate {

inline constexpr double kSharpestEdge = 0.2;  // least width [px]; pixels cannot tell less

struct ColumnEdges {
  Eigen::VectorXd height;  // h [px], one a column; far below 0 where there is no powder
  Eigen::VectorXd width;   // s [px], > 0
};

// Fields are row by row from the top, in [0, 1] with 1 = powder.
ColumnEdges FitEdges(std::span<const float> field, const FieldSize& size, const Vessel& vessel);
std::vector<float> Render(const ColumnEdges& edges, const FieldSize& size, const Vessel& vessel);

// Σ |pixel - target| over an image given by its edges, and its expectation when heights are normal.
class EdgeSad {
 public:
  EdgeSad(std::span<const float> target, const FieldSize& size, const Vessel& vessel);

  // [px], the sum over all pixels of differences in [0, 1].
  double Of(const ColumnEdges& edges) const;
  // `variance` of each column's height [px²]. Only the marginals matter: it is a sum of columns.
  double Expected(const ColumnEdges& edges, const Eigen::VectorXd& variance) const;

 private:
  double Column(Eigen::Index column, double height, double width) const;

  FieldSize size_;
  Vessel vessel_;
  Eigen::MatrixXd target_;      // one column of the image a column, from the bottom up
  Eigen::MatrixXd cumulative_;  // sum of the target below each row; height + 1 rows
};

}  // namespace talus::surrogate
