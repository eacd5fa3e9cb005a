// The simulations of a sensitivity study: a set as it is and with one fixed thing moved, with
// common seeds, in DIR/sensitivity.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/sensitivity/moves.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/campaign.h"
#include "optimizer/observation.h"

namespace talus::analysis {

struct SensitivitySetting {
  const campaign::JointView& view;
  Eigen::VectorXd point;    // the recommended set, unit cube
  double scale_factor = 1;  // of the simulations
  const campaign::CampaignParts& parts;
};

// DIR/sensitivity, absolute.
std::filesystem::path SensitivityFolder(const std::filesystem::path& campaign);

// So many simulations of each experiment; `move` null: as recommended.
struct MovedSet {
  const Move* move = nullptr;
  const Move* beside = nullptr;            // only where this one acts; null: in every experiment
  std::optional<Eigen::VectorXd> point{};  // in place of the recommended one, unit cube
  int replicates = 0;
};

// An experiment's case with the set's move at its point; `experiment` is the campaign's index.
rigs::Case MovedCase(const SensitivitySetting& setting, const MovedSet& set, int experiment,
                     int replicate);

// Whether the move changes the experiment at all: a drum knows no lift.
bool ActsOn(const SensitivitySetting& setting, const Move& move, int experiment);

// Processor time of all these sets, by what the campaign's trials took [s].
double CoreTimeOf(const SensitivitySetting& setting, const std::vector<MovedSet>& sets);

// How many simulations these are, and what they take: "24 simulations, about 40 s of core time".
std::string WorkText(const SensitivitySetting& setting, const std::vector<MovedSet>& sets);

// Runs what is missing of all these sets.
void RunMoved(const SensitivitySetting& setting, const std::vector<MovedSet>& sets);

struct Simulated {
  optimizer::Observation observation;  // as a strategy is told of it
  bool has_ended = false;              // well
  double core_time = 0;                // [s]
};

// What a set has shown: of each experiment that the campaign answers by, its simulations by seed;
// none where the set has none.
using SimulatedSet = std::vector<std::vector<Simulated>>;
SimulatedSet ReadSet(const SensitivitySetting& setting, const MovedSet& set);

struct Tally {
  int num_simulations = 0;
  int num_failed = 0;
  double core_time = 0;  // [s]

  void Add(const SimulatedSet& set);
};

}  // namespace talus::analysis
