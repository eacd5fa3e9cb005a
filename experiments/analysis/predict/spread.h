// How a number of another test spreads: over the draws of a posterior, and from run to run of one.
//
// One-way random effects, y_ij = m + a_i + e_ij of draw i with weight w_i (Σ w = 1) and n_i runs:
//
//   σ_e² = Σ_ij (y_ij − ȳ_i)² / (n − k)                           scatter of a single run
//   σ_a² = [Σ w_i (ȳ_i − ȳ)² − σ_e² Σ w_i (1 − w_i)/n_i] / (1 − Σ w_i²), >= 0       parameters
//
// With equal weights and numbers of runs this is the analysis of variance. What a single run will
// give is the mixture of normals N(m_i, τ²) with weights w_i: the means m_i drawn in so that they
// spread by σ_a, both widened to Student's t for the few draws and runs that they come from.
//
// By a surrogate it is the mixture of N(m(x), s²(x) + σ_e²) over sets x of the posterior: many, so
// that nothing is widened but s.
//
// A run beyond what the number can be is one at its bound: a layer of which a fifth more would
// still cover the plate covers it. So the mixture's tail counts there, a range ends there, and as
// many runs lie in it as before.
#pragma once

#include <vector>

#include "base/not_known.h"
#include "experiments/rigs/observables/observable.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::analysis {

// Standard errors of a number's surrogate that are one: its hyper-parameters are estimates, from
// few runs. With 1.5 the 90 % intervals of 400 made-up processes held the next run in 88 %,
// with 1.75 in 90 %, with 2 in 91 % (predict_test).
inline constexpr double kOverconfidence = 1.75;

// The values of one number.
struct DrawValues {
  std::vector<std::vector<double>> runs;  // of each draw; a draw may have none
  std::vector<double> weight;             // of each draw, >= 0
};

struct Range {
  double low = 0;
  double high = 0;
};

class Spread {
 public:
  // At least one value; the number can be what `bounds` say.
  explicit Spread(const DrawValues& values, const rigs::Bounds& bounds = rigs::kAnyNumber);
  // By a surrogate's predictions for sets that are equally likely.
  Spread(const surrogate::Predictions& sets, double run_sd,
         const rigs::Bounds& bounds = rigs::kAnyNumber);

  double mean() const { return mean_; }
  double parameters_sd() const { return parameters_sd_; }
  // NaN where no draw has two runs: all of it then counts as the parameters'.
  double run_sd() const { return run_sd_; }
  // The error of what the surrogate gives for a set [rms]; 0 without one.
  double surrogate_sd() const { return surrogate_sd_; }
  // Share of the variance of a single run, in [0, 1]; NaN where the two cannot be told apart.
  double ParametersShare() const;
  // The same without the scatter of single runs: what means of many lie in.
  Spread OfMeans() const;
  // 90 % of single runs that are measured with an independent error of this standard deviation. A
  // run within the bounds, measured, is at most kNormal90 errors beyond them in 95 %. NaN by one
  // run, which tells no width.
  Range Ninety(double error_sd = 0) const;

 private:
  double Below(double value, double error_sd) const;
  double Quantile(double probability, double error_sd) const;

  rigs::Bounds bounds_;
  double mean_ = 0;
  double parameters_sd_ = 0;
  double run_sd_ = base::kNotKnown;
  double surrogate_sd_ = 0;
  std::vector<double> weight_;  // of the draws that have values; sums to 1
  std::vector<double> centre_;  // m_i
  std::vector<double> kernel_;  // τ_i
  std::vector<double> error_;   // of m_i, in τ_i
  bool is_one_run_ = false;
};

}  // namespace talus::analysis
