// Scenes as trials: the powder and the laws of a case put into a scene, simulated by our own
// engine.
#pragma once

#include <optional>
#include <string>

#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/trials/engines/talus_engine.h"

namespace talus::analysis {

// What ReadPredictedCase does of a scene. Throws ConfigError where no material of it is plainly the
// powder: that of all grains, or the one called "powder".
void ReadScene(const campaign::JointView& view, const base::JsonFile& file,
               std::optional<double> scale_factor, PredictedCase& predicted);

// Its measured numbers: grains that left the domain, what poured in, the time to its end, energies
// there, and each column of series.csv as the mean over its second half.
class SceneEngine : public trials::TrialEngine {
 public:
  explicit SceneEngine(std::string scene_text);

  void Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  bool IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::vector<std::string> Command(const std::filesystem::path& folder) override;
  bool IsComplete(const std::filesystem::path& folder) override;
  trials::TrialOutput Collect(const rigs::Case& rig_case,
                              const std::filesystem::path& folder) override;
  std::optional<std::string> WhyNotTaken(const rigs::Case&, const std::filesystem::path&) override {
    return "a scene has no image that could be drawn anew";
  }
  bool TakeOver(const rigs::Case&, const std::filesystem::path&,
                const std::filesystem::path&) override {
    return false;
  }

 private:
  std::string scene_text_;
  trials::TalusEngine engine_;
};

}  // namespace talus::analysis
