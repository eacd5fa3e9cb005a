// The lifted-cylinder heap test (docs/physics.md, 7): the powder is filled into the tube and
// settles there, the tube is lifted, the heap comes to rest. Physics only; HeapRun does the files.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "engine/scene/pour.h"
#include "engine/simulation.h"
#include "experiments/rigs/lifted_tube/connectivity.h"
#include "experiments/rigs/lifted_tube/heap_case.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"
#include "experiments/rigs/lifted_tube/heap_state.h"
#include "experiments/rigs/lifted_tube/rest.h"

namespace talus::rigs {

class HeapRig {
 public:
  // Fills the tube.
  explicit HeapRig(const HeapCase& heap_case);

  // Goes on from a checkpoint of the same case.
  HeapRig(const HeapCase& heap_case, const HeapState& state, engine::Simulation simulation);

  // Advances by a slice that ends, at the latest, with the first step at or after `until` [s];
  // false when the test has ended.
  bool Advance(double until = std::numeric_limits<double>::infinity());

  const HeapState& state() const { return state_; }
  const engine::Simulation& simulation() const { return simulation_; }
  double ExpectedEnd() const;  // of the simulated time [s]
  std::vector<std::string> TakeMessages();

 private:
  // The state at a check.
  struct View {
    std::vector<engine::Particle> particles;
    std::vector<engine::ContactInfo> contacts;
    Connectivity connected;
  };

  HeapRig(const HeapCase& heap_case, const HeapScene& made);

  void Check();
  void CheckPouring();
  void CheckSettling(const View& view);
  void CheckLifting(const View& view);
  View Look() const;
  View LookWithoutFallen();
  void DropTube(const View& view);
  bool AtRest(const View& view, const RestRule& rule);
  bool Held(bool holds, double hold_time);
  void EndPhase(PhaseEnd reason, HeapPhase next);
  void Tap();
  void LiftTube();
  void Say(const std::string& message);
  PhaseRecord& Record();
  double LiftMaxTime() const;  // [s]
  double TubeEdge() const;     // height of the tube's lower edge [m]

  HeapCase case_;
  engine::Simulation simulation_;
  HeapState state_;
  std::int64_t check_steps_ = 1;      // between two looks at the phase's criterion
  std::optional<engine::Pour> pour_;  // where the powder is poured
  double leave_height_ = 0;           // below which grains leave the scene [m]
  std::vector<std::string> messages_;
};

}  // namespace talus::rigs
