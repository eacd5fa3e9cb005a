// What fitting a Gaussian process decides, and what is thought of it beforehand.
//
// Values are scaled to mean 0 and standard deviation 1 and points to the unit cube, so that the
// priors mean the same for every output.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace talus::surrogate {

enum class Trend { kConstant, kQuadratic };

// How an output at a coarse scale factor goes with the one at the target (covariance.h).
struct ScaleTerm {
  double discrepancy = 0.3;  // u
  double decay = 0;          // a
  double length_ratio = 1;   // λ
};

// Wide enough that the mean of the values costs nothing, since they are scaled to mean 0.
inline constexpr double kConstantSd = 2;

// Standard deviations in units of the scaled values; lengths in warped coordinates.
struct Hyperparameters {
  Eigen::VectorXd length = {};  // ℓ, one a coordinate
  double signal = 1;            // s
  double trend = 0;             // t
  Eigen::VectorXd noise = {};   // n of one evaluation, one a scale factor
  Eigen::VectorXd warp = {};    // strength of each coordinate (warp.h); empty: none
  std::optional<ScaleTerm> scale = {};
  double constant = kConstantSd;  // c; 0: values that are far from all others go to the centre
};

struct LogNormal {
  double median = 1;
  double log_sd = 1;  // standard deviation of the logarithm
};

struct HyperPriors {
  // An output changes over the whole range of a parameter, seldom within a tenth of it.
  LogNormal length{.median = 0.7, .log_sd = 0.7};
  // The values are scaled to standard deviation 1, of which the trend takes an unknown part.
  LogNormal signal{.median = 1, .log_sd = 0.7};
  LogNormal trend{.median = 0.5, .log_sd = 1};
  // Coarse grains shift an output by a third of what the parameters do, give or take a factor of 2.
  LogNormal discrepancy{.median = 0.3, .log_sd = 0.7};
  // One a scale factor. A tenth of the spread, or anything from a thirtieth to a third.
  std::vector<LogNormal> noise = {{.median = 0.1, .log_sd = 1}};
  // Strengths of the input warping have a normal prior of mean 0; 1 stretches one end e times as
  // much as the other.
  double warp_sd = 1;
  // A coarse output follows the target's, or has lost some of it: e^-1 at one standard deviation.
  // Normal about 0, so it may as well amplify it.
  double decay_sd = 1;
  // The shift varies as fast over the parameters as the output itself, within a factor of 2.
  LogNormal length_ratio{.median = 1, .log_sd = 0.7};
};

// The priors of an image's modes and of numbers beside it. Each evaluation brings many such outputs
// of one test, whose lengths lie closer together than those of any objective. Heaps saturate: from
// no friction to a little they change more than over the rest of the range. That is the warping's
// to say, and what is left is smooth. `noise` is the caller's (output_noise.h of the optimizer).
//
// By these the truths of 53 virtual powders are likeliest (bench/RECORD.md).
inline HyperPriors PriorsOfOutputs(std::vector<LogNormal> noise) {
  return {.length = {.median = 1.4, .log_sd = 0.4},
          .discrepancy = {.median = 0.2, .log_sd = 0.7},
          .noise = std::move(noise),
          .warp_sd = 2};
}

}  // namespace talus::surrogate
