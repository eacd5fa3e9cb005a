// `talus predict`: what draws of a campaign's posterior give in another test or process.
//
// Everything is kept in DIR/predict/NAME: draws.csv, trials/, prediction.json, pictures. What of it
// is there is not simulated again.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/campaign.h"

namespace talus::analysis {

struct PredictOptions {
  static constexpr int kMostDraws = 200;
  static constexpr int kMostSeeds = 100;

  std::filesystem::path file;            // of a case or a scene
  std::optional<int> num_draws{};        // of the posterior, from 2 to kMostDraws; default: 12
  std::optional<int> num_seeds{};        // of each, from 1 to kMostSeeds; default: 3, of one set 8
  std::optional<double> scale_factor{};  // >= 1; default: the case's, or what is affordable
  std::map<std::string, std::string> set{};  // NAME: VALUE of one set, instead of draws
  bool recommended = false;                  // or the recommended set
  std::filesystem::path measured{};          // on the real process; or empty
  // Draws, seeds and scale factor that are not given are those of an earlier call for the same
  // test, even where trials have ended since: a number as a function of the sets is still that.
  bool as_before = false;
};

// Throws base::Interrupted when the user ends it, with what there is written.
Prediction Predict(const campaign::JointView& view, const PredictOptions& options,
                   campaign::CampaignParts parts);

// DIR/predict, absolute.
std::filesystem::path PredictFolder(const std::filesystem::path& campaign);

}  // namespace talus::analysis
