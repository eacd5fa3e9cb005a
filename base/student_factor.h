// How many standard errors chance alone makes, where the standard error itself is of a few values.
//
//   P(|T| ≤ t) = p      T of Student's t with ν degrees of freedom
//   f(x) = C (1 + x²/ν)^(-(ν+1)/2),  x = √ν tan θ:  P = 2 C √ν ∫₀^θ cos^(ν-1) u du
//   C √ν = Γ((ν+1)/2) / (√π Γ(ν/2))
//
// With two values (ν = 1) 99 of 100 lie within 64 standard errors, with endlessly many within 2.58.
#pragma once

namespace talus::base {

// Standard deviations on each side of a normal variable's 90 %.
inline constexpr double kNormal90 = 1.6448536269514722;

// t for `share` p in (0, 1) and `degrees` ν >= 1, infinity among them.
double StudentFactor(double degrees, double share);

// Its inverse: P(|T| ≤ t), t >= 0.
double StudentShare(double degrees, double t);

// The standard error of a normal variable with as wide a 90 % range; 0 degrees: it is exact.
double NormalError(double standard_error, int degrees);

}  // namespace talus::base
