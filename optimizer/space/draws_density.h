// The density that a set of draws was drawn from: a mixture of normal kernels, one a draw, each as
// wide and as long as the draws round it lie.
//
// A posterior may be a bent, thin valley or several. One covariance for all kernels would fill the
// bend, and one Gaussian for all draws would miss it; kernels of their own follow it. A kernel adds
// its variance to that of the draws, so its centre is its draw moved towards the mean of those
// round it until both together are as wide as these, but where it reaches a face of the cube, which
// cuts what is round it: else six parameters would be a seventh wider. A twentieth of the mass is
// one broad Gaussian, so that draws which lie where an observation does not want them can be
// outvoted. What a kernel would have beyond one face of the unit cube is mirrored back: else draws
// that pile up there, as those of a posterior may, would have half their density. Beyond two faces
// at once it has nothing; its images would double with each parameter.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/random.h"

namespace talus::optimizer {

class DrawsDensity {
 public:
  static constexpr Eigen::Index kFewest = 50;  // draws that a density is made of

  // One draw a row, kFewest at least, in the unit cube.
  explicit DrawsDensity(Eigen::MatrixXd draws);

  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points) const;  // one point a row, in the cube
  Eigen::VectorXd Draw(base::Random& random) const;

  Eigen::Index dimension() const { return centres_.cols(); }
  const Eigen::RowVectorXd& mean() const { return mean_; }
  const Eigen::RowVectorXd& sd() const { return sd_; }

 private:
  struct Kernel {
    Eigen::MatrixXd root;          // L of its covariance L Lᵀ
    Eigen::MatrixXd inverse_root;  // L⁻¹
    double log_constant = 0;       // of its density, its weight included
  };
  static Kernel MakeKernel(const Eigen::MatrixXd& covariance, double weight);
  // The draws that a kernel is shaped by.
  Eigen::MatrixXd DrawsRound(Eigen::Index draw) const;
  Eigen::ArrayXd Reach(Eigen::Index draw) const;  // of its kernel, in each coordinate
  bool ReachesAFace(Eigen::Index draw) const;
  // The share of a kernel in the cube, with what is mirrored into it. `normals`: one draw a column.
  double MassInside(Eigen::Index draw, const Eigen::MatrixXd& normals) const;
  void Mirror(Eigen::Index draw, const Eigen::MatrixXd& normals,
              std::vector<Eigen::RowVectorXd>& images);

  Eigen::Index num_draws_;
  Eigen::MatrixXd centres_;  // of the kernels, of the broad Gaussian, and of mirror images
  Eigen::RowVectorXd mean_;  // of the draws
  Eigen::RowVectorXd sd_;
  std::vector<Kernel> kernels_;
};

}  // namespace talus::optimizer
