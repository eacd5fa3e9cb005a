// Another test or process, simulated with a campaign's powder: what of the two files counts.
//
// From the case: vessel, motion, filling, rules, gravity, mass, walls, frame. From the campaign:
// grain sizes, density, moduli and all else of the powder, the contact laws, how γ goes with the
// scale factor; from a draw: what was searched. A scene's grains keep the sizes that it gives them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "experiments/rigs/case/case.h"

namespace talus::analysis {

struct PredictedCase {
  std::filesystem::path file;
  std::string name;                  // of the file, without its ending
  rigs::Case rig_case;               // of a scene: its powder and laws alone
  std::string scene_text;            // scene.json; empty: a bulk test
  std::vector<std::string> notes;    // on what was replaced, for people
  bool states_scale_factor = false;  // the file or the user, so that no other is simulated
};

// Throws ConfigError where the file is none, contradicts the campaign, or cannot be simulated with
// its powder at the scale factor. `num_runs` simulations are meant to be made: without a scale
// factor, given here or in the file, they get the finest of the campaign's that they can afford in
// this core time [s].
PredictedCase ReadPredictedCase(const campaign::JointView& view, const std::filesystem::path& file,
                                std::optional<double> scale_factor, int num_runs,
                                double core_time = 240);

// Throws ConfigError where the case cannot be simulated at this scale factor.
void RequireSimulable(const PredictedCase& predicted, double scale_factor);

// What the runs are of, but for the frame: scene.json or case.json.
std::string TestText(const PredictedCase& predicted);
// Empty without a frame.
std::string FrameText(const PredictedCase& predicted);

// What two grains of the campaign's powder state as a pair; one pair at most.
std::vector<engine::PairSpec> PairsOfGrains(const campaign::JointView& view);

// With what was searched at `values` (all of the space's parameters, in its order).
rigs::Case CaseWith(const campaign::JointView& view, const PredictedCase& predicted,
                    std::span<const double> values, std::uint64_t seed);

}  // namespace talus::analysis
