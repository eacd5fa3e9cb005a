#include "experiments/analysis/predict/predict_options.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/text/number_text.h"

namespace talus::analysis {
namespace {

constexpr int kUsualDraws = 12;
constexpr int kUsualSeeds = 3;
constexpr int kUsualSeedsOfOne = 8;  // scatter is all there is to tell

void Require(bool ok, const std::string& message) {
  if (!ok) throw base::ConfigError(message);
}

void CheckScaleFactors(const PredictOptions& options) {
  std::vector<double> sorted = options.scale_factors;
  std::ranges::sort(sorted);
  for (const double f : sorted) {
    Require(f >= 1 && std::isfinite(f),
            "--scale: is " + base::ShortNumber(f) +
                ", must be 1 or more: no grain is smaller than the powder's own");
  }
  Require(std::ranges::adjacent_find(sorted) == sorted.end(), "--scale: names one twice");
  Require(sorted.size() < 2 || options.By() == PredictedBy::kPosterior,
          "--scale: names several, which only draws of the posterior tell together; give one");
}

}  // namespace

PredictedBy PredictOptions::By() const {
  if (recommended) return PredictedBy::kRecommended;
  return set.empty() ? PredictedBy::kPosterior : PredictedBy::kSet;
}

int PredictOptions::Draws() const {
  return By() == PredictedBy::kPosterior ? num_draws.value_or(kUsualDraws) : 1;
}

int PredictOptions::Seeds() const {
  return num_seeds.value_or(Draws() > 1 ? kUsualSeeds : kUsualSeedsOfOne);
}

std::optional<double> PredictOptions::Finest() const {
  if (scale_factors.empty()) return std::nullopt;
  return std::ranges::min(scale_factors);
}

std::vector<double> PredictOptions::Coarser() const {
  std::vector<double> coarser = scale_factors;
  std::ranges::sort(coarser, std::greater<>{});
  if (!coarser.empty()) coarser.pop_back();
  return coarser;
}

void CheckOptions(const PredictOptions& options) {
  const int draws = options.num_draws.value_or(kUsualDraws);
  const int seeds = options.num_seeds.value_or(kUsualSeeds);
  Require(draws >= 2 && draws <= PredictOptions::kMostDraws,
          "--draws: is " + std::to_string(draws) +
              ", must be from 2 to 200; --set or --recommended "
              "predicts by one set");
  Require(seeds >= 1 && seeds <= PredictOptions::kMostSeeds,
          "--seeds: is " + std::to_string(seeds) + ", must be from 1 to 100");
  Require(!options.core_time || *options.core_time > 0,
          "--budget: must be positive, such as \"2 min\"");
  CheckScaleFactors(options);
}

}  // namespace talus::analysis
