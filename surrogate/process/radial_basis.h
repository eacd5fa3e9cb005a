// Radial basis functions with a linear tail.
//
//   s(x) = Σ λᵢ φ(|x - xᵢ|) + c₀ + c·x        Σ λᵢ = 0,  Σ λᵢ xᵢ = 0
//   φ(r) = r³ (cubic)   or   r² ln r (thin plate)
//
//   [Φ + ρ I   P] [λ]   [y]
//   [Pᵀ        0] [c] = [0]      P = [1 X]
//
// ρ >= 0 smooths; it is chosen by leave-one-out cross-validation, whose residuals come from the
// inverse, λᵢ / (A⁻¹)ᵢᵢ, as for a Gaussian process [dubrule1983]. Without noise the choice is 0,
// which interpolates, where the function is smooth: a rough one is predicted better by a smoother.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace talus::surrogate {

enum class RadialFunction { kCubic, kThinPlate };

class RadialBasis {
 public:
  // `points` n × d, `values` n >= 1. With points that do not span the space the tail is a constant.
  static RadialBasis Fit(const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
                         RadialFunction function,
                         std::optional<double> smoothing = std::nullopt);  // ρ; else chosen

  double Predict(const Eigen::VectorXd& x) const;
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const;
  const Eigen::VectorXd& LeaveOneOut() const { return left_out_; }  // each from the others
  double smoothing() const { return smoothing_; }                   // ρ

 private:
  // Solves for one ρ; false when the system is singular.
  bool Solve(const Eigen::VectorXd& values, double smoothing);

  RadialFunction function_ = RadialFunction::kCubic;
  Eigen::MatrixXd points_;  // d × n
  bool has_slope_ = true;
  Eigen::VectorXd weights_;  // λ
  double constant_ = 0;      // c₀
  Eigen::VectorXd slope_;    // c
  Eigen::VectorXd left_out_;
  double smoothing_ = 0;
};

}  // namespace talus::surrogate
