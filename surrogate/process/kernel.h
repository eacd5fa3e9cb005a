// Stationary correlation functions ρ of the scaled squared distance q = Σ ((xₖ - x'ₖ) / ℓₖ)².
//
//   Matérn 5/2          ρ = (1 + s + s²/3) exp(-s),  s = √(5 q)     ρ' = -(5/6) (1 + s) exp(-s)
//   squared exponential ρ = exp(-q / 2)                             ρ' = -ρ / 2
//
// ρ' = dρ/dq. Written in q, not in the distance, so that the slope is finite at zero distance.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace talus::surrogate {

enum class Kernel { kMatern52, kSquaredExponential };

struct Correlation {
  double value = 0;  // ρ [-]
  double slope = 0;  // dρ/dq [-]
};

inline Correlation CorrelationAt(Kernel kernel, double q) {
  switch (kernel) {
    case Kernel::kMatern52: {
      const double s = std::sqrt(5 * q);
      const double decay = std::exp(-s);
      return {.value = (1 + s + s * s / 3) * decay, .slope = -5.0 / 6.0 * (1 + s) * decay};
    }
    case Kernel::kSquaredExponential:
      break;
  }
  const double decay = std::exp(-q / 2);
  return {.value = decay, .slope = -decay / 2};
}

// ρ at each q: the operations of CorrelationAt, and the bits of its exponential, which is not
// Eigen's.
inline Eigen::ArrayXd CorrelationsAt(Kernel kernel, const Eigen::ArrayXd& q) {
  const auto exponential = [](double x) { return std::exp(x); };
  switch (kernel) {
    case Kernel::kMatern52: {
      const Eigen::ArrayXd s = (5 * q).sqrt();
      return (1 + s + s * s / 3) * (-s).unaryExpr(exponential);
    }
    case Kernel::kSquaredExponential:
      break;
  }
  return (-q / 2).unaryExpr(exponential);
}

}  // namespace talus::surrogate
