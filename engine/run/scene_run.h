// A scene run to its stop rule.
//
// Written into `folder`: state_NNNN.vtp and .csv at the times of the scene, final.vtp and .csv,
// series.csv when the scene asks for it, result.json last.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "engine/run/series.h"
#include "engine/run/state_writer.h"
#include "engine/scene/scene_spec.h"
#include "engine/simulation.h"

namespace talus::engine {

// What the run knows beside the engine's state.
struct SceneRunState {
  std::int64_t quiet_steps = 0;  // for which the spheres have been at rest
  double energy_ratio = 0;       // mean kinetic energy of a sphere / (m g d) [-]
  double particle_steps = 0;
  std::int64_t num_left = 0;      // spheres that have left the domain
  std::int64_t num_at_start = 0;  // spheres; those that are poured are numbered from here on
  std::vector<PourState> pours{};
  SeriesState series;
  std::string stop_reason;  // "time", "steps", "at_rest"; empty before the end

  TALUS_FIELDS(quiet_steps, energy_ratio, particle_steps, num_left, num_at_start, pours, series,
               stop_reason);
};

class SceneRun : public Run {
 public:
  SceneRun(const SceneSpec& spec, const Scene& scene, std::filesystem::path folder);
  SceneRun(const SceneSpec& spec, std::filesystem::path folder, const RunCheckpoint& checkpoint);

  bool Advance() override;
  RunProgress Progress() const override;
  std::vector<std::string> TakeMessages() override;
  std::string Checkpoint(const RunTiming& timing) const override;
  void WriteResults(const RunTiming& timing) const override;

 private:
  std::int64_t NextSteps() const;
  double NextPourTime() const;  // [s]
  void AdvancePours();
  void CheckDomain();
  void CheckStop();
  void TellOfEnd();
  bool AtRest();
  double LastEvent() const;  // time of the last thing that is prescribed [s]

  SceneSpec spec_;
  std::uint64_t input_hash_;
  std::filesystem::path folder_;
  Simulation simulation_;
  StateWriter states_;
  SceneRunState state_;
  std::vector<Pour> pours_;
  Series series_;
  std::int64_t check_steps_ = 1;  // between two looks at the energy
  std::vector<std::string> messages_;
};

// Identifies a scene in checkpoints and results; threads and checkpoint interval are left out.
std::uint64_t SceneHash(const SceneSpec& spec);

}  // namespace talus::engine
