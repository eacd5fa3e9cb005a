// The lifted-cylinder heap test (docs/physics.md, 7): the powder is filled into the tube and
// settles there, the tube is lifted, the heap comes to rest.
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
#include "experiments/rigs/rig.h"

namespace talus::rigs {

class HeapRig : public Rig {
 public:
  static constexpr const char* kObservables[] = {"mass_on_plate_kg", "mass_fallen_kg"};

  // Of its entry in rig_list.cc.
  static Vessel VesselOf(const HeapCase& c) { return TubeOf(c); }
  static void Validate(const HeapCase& c, base::Problems& problems);
  static double Width(const HeapCase& c) { return c.device.plate_diameter; }
  static double TestTime(const HeapCase& c, double filled_height) {
    return filled_height / c.device.lift_velocity;
  }
  static HeapState ParseState(const std::string& line);

  // Fills the tube.
  explicit HeapRig(const HeapCase& heap_case);

  // Goes on from a checkpoint of the same case.
  HeapRig(const HeapCase& heap_case, const HeapState& state, engine::Simulation simulation);

  bool Advance(double until = std::numeric_limits<double>::infinity()) override;

  const engine::Simulation& simulation() const override { return simulation_; }
  engine::RunProgress Progress() const override;
  std::vector<std::string> TakeMessages() override;
  std::string StateLine() const override;
  std::vector<engine::Particle> Grains() const override;
  std::string ResultText(const std::vector<engine::Particle>& grains,
                         const engine::RunTiming& timing) const override;

  const HeapState& state() const { return state_; }

 private:
  // The state at a check.
  struct View {
    std::vector<engine::Particle> particles;
    std::vector<engine::ContactInfo> contacts;
    Connectivity connected;
  };

  HeapRig(const HeapCase& heap_case, const FilledScene& made);

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
  double ExpectedEnd() const;  // of the simulated time [s]
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
