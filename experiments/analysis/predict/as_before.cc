#include "experiments/analysis/predict/as_before.h"

#include <algorithm>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_file.h"
#include "base/text/counted.h"
#include "experiments/analysis/predict/number_surrogate.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/prediction_design.h"
#include "experiments/campaign/folder/record_file.h"

namespace talus::analysis {

std::string SourceSeenFrom(const std::filesystem::path& campaign,
                           const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  const fs::path place = fs::weakly_canonical(fs::absolute(file));
  return place.lexically_proximate(fs::weakly_canonical(fs::absolute(campaign))).string();
}

std::string SourceToKeep(const PredictionDesign& stored, const PredictionDesign& wanted,
                         const std::filesystem::path& campaign,
                         const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (stored.source.empty()) return wanted.source;
  if (stored.test == wanted.test) return stored.source;  // not that of a copy
  // A file that is gone was moved, with the campaign or without.
  const fs::path other = fs::absolute(campaign) / stored.source;
  std::error_code absent;
  if (!fs::exists(other, absent)) return wanted.source;
  if (fs::equivalent(other, fs::absolute(campaign) / wanted.source, absent)) return wanted.source;
  throw base::ConfigError(folder.string() + ": holds the prediction of another case, " +
                          stored.source +
                          ", whose file has the same name; rename one of the files, or remove "
                          "this folder");
}

PredictOptions AsBefore(const campaign::JointView& view, PredictOptions options) {
  namespace fs = std::filesystem;
  const fs::path root = PredictionFolder(view.folder.root, {.file = options.file});
  const auto design = campaign::ReadRecordFile<PredictionDesign>(root / "design.json");
  const fs::path file = root / "prediction.json";
  if (!design || !fs::exists(file)) return options;
  const auto before = journal::ParseRecord<Prediction>(base::ReadFile(file), file.string());
  if (before.draws.empty() || before.by != PredictedBy::kPosterior) return options;
  // With more of them the sets are others: what was predicted, and compared, would be lost.
  if (design->num_draws < NumberSurrogate::kFewest) {
    throw base::ConfigError(
        root.string() + ": was predicted by " + base::Counted(design->num_draws, "draw") +
        ", and what goes with a number needs " + std::to_string(NumberSurrogate::kFewest) +
        "; predict it with --draws " + std::to_string(NumberSurrogate::kFewest) +
        " first, or move the folder away");
  }
  options.num_draws = design->num_draws;
  const auto stage =
      std::ranges::find(design->stages, before.scale_factor, &PredictionStage::scale_factor);
  if (stage != design->stages.end()) options.num_seeds = stage->num_seeds;
  const nlohmann::json given = base::ReadJsonFile(options.file).root;
  const bool states =
      given.contains("coarse_graining") && given["coarse_graining"].contains("scale_factor");
  if (before.test != kSceneTest && !states) options.scale_factors = {before.scale_factor};
  return options;
}

std::vector<PredictionStage> StagesAsBefore(const PredictionDesign& stored, int num_draws) {
  std::vector<PredictionStage> stages = stored.stages;
  for (PredictionStage& stage : stages) {
    if (stage.num_draws == stored.num_draws) stage.num_draws = num_draws;
  }
  return stages;
}

void KeepMeasured(const std::filesystem::path& file, Prediction& prediction) {
  if (!std::filesystem::exists(file)) return;
  auto before = journal::ParseRecord<Prediction>(base::ReadFile(file), file.string());
  const auto same = [](const PredictedDraw& a, const PredictedDraw& b) {
    return a.values == b.values;
  };
  if (!std::ranges::equal(before.draws, prediction.draws, same)) return;
  prediction.image = before.image;
  for (PredictedNumber& number : prediction.numbers) {
    const auto known = std::ranges::find(before.numbers, number.name, &PredictedNumber::name);
    if (known != before.numbers.end()) number.measured = known->measured;
  }
}

}  // namespace talus::analysis
