// Two ways of writing an image as a vector that is a smooth function of the parameters, and back.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "surrogate/images/column_edges.h"

namespace talus::surrogate {

class FieldCode {
 public:
  virtual ~FieldCode() = default;

  virtual std::string name() const = 0;  // for people
  virtual Eigen::VectorXd Encode(std::span<const float> field) const = 0;
  virtual std::vector<float> Decode(const Eigen::VectorXd& vector) const = 0;

  // The mean of images whose vectors are normal about `vector` with this variance of each element.
  virtual Eigen::VectorXd MeanOfImages(const Eigen::VectorXd& vector,
                                       const Eigen::VectorXd& variance) const = 0;

  // The other way round: of one such image, when `mean` is the vector of their mean.
  virtual Eigen::VectorXd OneOfMean(const Eigen::VectorXd& mean,
                                    const Eigen::VectorXd& variance) const = 0;

  // Σ |pixel - target| [px] of the decoded image: itself, and expected when each element of the
  // vector is normal with this variance. Wants a target.
  virtual double Sad(const Eigen::VectorXd& vector) const = 0;
  virtual double ExpectedSad(const Eigen::VectorXd& mean,
                             const Eigen::VectorXd& variance) const = 0;
};

// Column heights, then widths of the grey edge (column_edges.h), above the floor that the target
// shows. Widths count 0.8 of heights, which is what they change the sum of differences by:
// ∫|Φ(y) - Φ(y/(1+δ))| dy = δ √(2/π).
class EdgeCode : public FieldCode {
 public:
  // `target` may be empty when no SAD is asked for.
  EdgeCode(const FieldSize& size, std::span<const float> target);

  std::string name() const override { return "column heights"; }
  Eigen::VectorXd Encode(std::span<const float> field) const override;
  std::vector<float> Decode(const Eigen::VectorXd& vector) const override;
  // Edges that move up and down make a wider edge.
  Eigen::VectorXd MeanOfImages(const Eigen::VectorXd& vector,
                               const Eigen::VectorXd& variance) const override;
  Eigen::VectorXd OneOfMean(const Eigen::VectorXd& mean,
                            const Eigen::VectorXd& variance) const override;
  double Sad(const Eigen::VectorXd& vector) const override;
  double ExpectedSad(const Eigen::VectorXd& mean, const Eigen::VectorXd& variance) const override;

 private:
  ColumnEdges Edges(const Eigen::VectorXd& vector) const;

  FieldSize size_;
  Vessel vessel_;
  std::unique_ptr<EdgeSad> sad_;
};

// The pixels themselves, in blocks where there are many: for heaps that overhang, which have more
// than one edge a column.
class PixelCode : public FieldCode {
 public:
  PixelCode(const FieldSize& size, std::span<const float> target);

  std::string name() const override { return "pixels"; }
  Eigen::VectorXd Encode(std::span<const float> field) const override;
  std::vector<float> Decode(const Eigen::VectorXd& vector) const override;
  Eigen::VectorXd MeanOfImages(const Eigen::VectorXd& vector,
                               const Eigen::VectorXd&) const override {
    return vector;
  }
  Eigen::VectorXd OneOfMean(const Eigen::VectorXd& mean, const Eigen::VectorXd&) const override {
    return mean;
  }
  double Sad(const Eigen::VectorXd& vector) const override;
  double ExpectedSad(const Eigen::VectorXd& mean, const Eigen::VectorXd& variance) const override;

 private:
  FieldSize size_;
  int block_ = 1;               // edge of a block [px]
  int num_columns_ = 0;         // blocks a row
  Eigen::VectorXd num_pixels_;  // of each block; those at the right and bottom may be cut
  Eigen::VectorXd target_;      // mean of each block; empty without a target
};

}  // namespace talus::surrogate
