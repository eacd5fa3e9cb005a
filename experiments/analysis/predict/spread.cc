#include "experiments/analysis/predict/spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/not_known.h"
#include "base/sample.h"
#include "base/student_factor.h"
#include "optimizer/answer.h"
#include "surrogate/standard_deviation.h"

namespace talus::analysis {
namespace {

// t quantile over normal quantile at 5 %; 1 for ν → ∞.
double StudentOverNormal(double freedom) {
  return base::StudentFactor(std::max(freedom, 1.0), optimizer::kRegionLevel) / base::kNormal90;
}

// What differs by rounding alone does not differ.
double Rounded(double sd, double mean) { return sd > 1e-12 * std::abs(mean) ? sd : 0; }

}  // namespace

Spread::Spread(const DrawValues& values, const rigs::Bounds& bounds) : bounds_(bounds) {
  double squares_within = 0;
  double num_runs = 0;
  std::vector<double> count;
  for (std::size_t i = 0; i < values.runs.size(); ++i) {
    const std::vector<double>& runs = values.runs[i];
    if (runs.empty() || !(values.weight[i] > 0)) continue;
    const double mean = base::SampleOf(runs).mean;
    for (const double y : runs) squares_within += (y - mean) * (y - mean);
    num_runs += static_cast<double>(runs.size());
    count.push_back(static_cast<double>(runs.size()));
    centre_.push_back(mean);
    weight_.push_back(values.weight[i]);
  }
  const double total = std::accumulate(weight_.begin(), weight_.end(), 0.0);
  for (double& w : weight_) w /= total;
  const auto num_draws = static_cast<double>(centre_.size());
  const double run_freedom = num_runs - num_draws;
  if (run_freedom > 0) run_sd_ = Rounded(std::sqrt(squares_within / run_freedom), centre_.front());

  double between = 0;   // Σ w_i (ȳ_i − ȳ)²
  double of_means = 0;  // Σ w_i (1 − w_i) / n_i
  double squares = 0;   // Σ w_i²
  for (std::size_t i = 0; i < centre_.size(); ++i) mean_ += weight_[i] * centre_[i];
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    between += weight_[i] * (centre_[i] - mean_) * (centre_[i] - mean_);
    of_means += weight_[i] * (1 - weight_[i]) / count[i];
    squares += weight_[i] * weight_[i];
  }
  const double run_variance = run_freedom > 0 ? run_sd_ * run_sd_ : 0;
  if (squares < 1) {
    parameters_sd_ = Rounded(
        std::sqrt(std::max(0.0, (between - run_variance * of_means) / (1 - squares))), mean_);
  }
  const double draw_freedom = 1 / squares - 1;
  const double wide = parameters_sd_ * std::sqrt(1 + squares) * StudentOverNormal(draw_freedom);
  const double drawn_in = between > 0 ? wide / std::sqrt(between) : 0;
  for (double& centre : centre_) centre = mean_ + drawn_in * (centre - mean_);
  const double run = std::sqrt(run_variance) * StudentOverNormal(run_freedom);
  kernel_.assign(centre_.size(), run * std::sqrt(1 + 1 / num_runs));
  error_.assign(centre_.size(), run * std::sqrt(1 / num_runs));
  is_one_run_ = num_runs < 2;
  if (is_one_run_) parameters_sd_ = base::kNotKnown;
}

Spread::Spread(const surrogate::Predictions& sets, double run_sd, const rigs::Bounds& bounds)
    : bounds_(bounds),
      mean_(sets.mean.mean()),
      parameters_sd_(surrogate::StandardDeviation(sets.mean)),
      run_sd_(run_sd),
      surrogate_sd_(kOverconfidence * std::sqrt(sets.variance.mean())),
      weight_(static_cast<std::size_t>(sets.mean.size()),
              1.0 / static_cast<double>(sets.mean.size())),
      centre_(sets.mean.begin(), sets.mean.end()) {
  for (const double variance : sets.variance) {
    error_.push_back(kOverconfidence * std::sqrt(variance));
    kernel_.push_back(std::hypot(error_.back(), run_sd));
  }
}

Spread Spread::OfMeans() const {
  Spread means = *this;
  means.kernel_ = error_;
  return means;
}

double Spread::ParametersShare() const {
  const double sum =
      parameters_sd_ * parameters_sd_ + surrogate_sd_ * surrogate_sd_ + run_sd_ * run_sd_;
  return sum > 0 ? parameters_sd_ * parameters_sd_ / sum : base::kNotKnown;
}

double Spread::Below(double value, double error_sd) const {
  double probability = 0;
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    const double sd = std::hypot(kernel_[i], error_sd);
    probability += weight_[i] * 0.5 * std::erfc((centre_[i] - value) / (sd * std::numbers::sqrt2));
  }
  return probability;
}

Range Spread::Ninety(double error_sd) const {
  if (is_one_run_) return {.low = base::kNotKnown, .high = base::kNotKnown};
  const auto within = [&](double quantile, double beyond) {
    return std::clamp(quantile, bounds_.low + beyond, bounds_.high + beyond);
  };
  return {.low = within(Quantile(0.05, error_sd), -base::kNormal90 * error_sd),
          .high = within(Quantile(0.95, error_sd), base::kNormal90 * error_sd)};
}

double Spread::Quantile(double probability, double error_sd) const {
  const auto [least, most] = std::minmax_element(centre_.begin(), centre_.end());
  // Draws of a number that never scatters stand for what lies between them.
  double error = error_sd;
  if (std::isnan(run_sd_))
    error = std::hypot(error, parameters_sd_ / std::sqrt(double(centre_.size())));
  const double widest = std::hypot(*std::ranges::max_element(kernel_), error);
  if (!(widest > 1e-12 * (*most - *least))) error = 1e-12 * (*most - *least);
  const double sd = std::hypot(*std::ranges::max_element(kernel_), error);
  if (sd == 0) return *least;
  constexpr double kFar = 10;
  double low = *least - kFar * sd;
  double high = *most + kFar * sd;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (Below(middle, error) < probability ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace talus::analysis
