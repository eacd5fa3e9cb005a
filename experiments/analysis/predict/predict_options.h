// What `talus predict` is asked for.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/predict/prediction.h"

namespace talus::analysis {

struct PredictOptions {
  static constexpr int kMostDraws = 200;
  static constexpr int kMostSeeds = 100;
  static constexpr double kUsualTime = 150;

  std::filesystem::path file;      // of a case or a scene
  std::optional<int> num_draws{};  // of the posterior, from 2 to kMostDraws; default: 12
  std::optional<int> num_seeds{};  // of each, from 1 to kMostSeeds; default: 3, of one set 8
  // Distinct, >= 1: at the finest every seed, at others one of each draw. Default: the case's, or
  // those that are affordable.
  std::vector<double> scale_factors{};
  std::optional<double> core_time{};         // of all runs [s], > 0; default: kUsualTime
  std::map<std::string, std::string> set{};  // NAME: VALUE of one set, instead of draws
  bool recommended = false;                  // or the recommended set
  std::filesystem::path measured{};          // on the real process; or empty
  // Draws, seeds and scale factors that are not given are those of an earlier call for the same
  // test, even where trials have ended since: a number as a function of the sets is still that.
  bool as_before = false;

  PredictedBy By() const;
  int Draws() const;  // 1 of one set
  int Seeds() const;
  std::optional<double> Finest() const;  // of the scale factors given
  std::vector<double> Coarser() const;   // the others, the coarsest first
};

// Throws ConfigError.
void CheckOptions(const PredictOptions& options);

}  // namespace talus::analysis
