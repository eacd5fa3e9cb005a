// What is known of the parameters before any observation: a density over the unit cube.
//
//   ln p(u) = Σ_i ln N(t(v_i(u_i)) | mean, sd) + ln |dt/du_i|  +  ln p_draws(u_j, u_k, …)
//
// v the value of a parameter, t = v or ln v: normal or log-normal densities of single parameters;
// and what draws of an earlier posterior say of several together (draws_density.h). Uniform in the
// coordinates that neither speaks of. It is not cut off at the faces of the cube: the domain is.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "optimizer/space/scale.h"

namespace talus::optimizer {

class DrawsDensity;

// A normal density of a parameter's value, or of the value's logarithm.
struct NormalPrior {
  double mean = 0;
  double sd = 1;  // > 0
  bool of_logarithm = false;
};

class Prior {
 public:
  // `range`: that the coordinate's values are searched in.
  void Add(Eigen::Index coordinate, const ScaledRange& range, const NormalPrior& normal);
  // `draws`: one a row, of these coordinates in the unit cube, DrawsDensity::kFewest at least.
  void Add(std::vector<Eigen::Index> coordinates, const Eigen::MatrixXd& draws);

  bool IsUniform() const { return normals_.empty() && joint_.empty(); }

  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points) const;  // one point a row
  // One a row, `dimension` coordinates each; some may lie outside the cube or be NaN.
  Eigen::MatrixXd Draw(Eigen::Index count, Eigen::Index dimension, std::uint64_t seed) const;

  // How far the mean of `draws` (one a row) lies from that of the prior inside the range, in its
  // standard deviations there, on the scale that it is normal on; NaN where it is uniform.
  Eigen::VectorXd Offset(const Eigen::MatrixXd& draws) const;

 private:
  struct Single {
    Eigen::Index coordinate = 0;
    ScaledRange range;
    NormalPrior normal;

    struct Moments {
      double mean = 0;
      double sd = 1;
    };

    double Score(double unit) const;  // (t - mean) / sd
    Moments ScoreWithin() const;      // of the score of the prior that the range cuts
    double LogDensity(double unit) const;
    double AtScore(double score) const;  // its inverse
  };
  struct Joint {
    std::vector<Eigen::Index> coordinates;
    std::shared_ptr<const DrawsDensity> density;
  };

  std::vector<Single> normals_;
  std::vector<Joint> joint_;
};

}  // namespace talus::optimizer
