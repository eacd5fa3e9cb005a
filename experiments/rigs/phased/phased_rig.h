// What the tests other than the lifted tube share: the powder is filled into a vessel and settles,
// then phases of the rig's own follow, each with a change of the scene at its start and a criterion
// for its end.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/pour.h"
#include "experiments/rigs/phased/phased_state.h"
#include "experiments/rigs/rig.h"
#include "experiments/rigs/vessel.h"

namespace talus::rigs {

struct Phase {
  std::string name;
  PhaseEnd ends_with = PhaseEnd::kDone;  // what the result calls its regular end
  std::optional<RestRule> rest{};        // it ends at rest, or at the rule's cap
  double duration = std::numeric_limits<double>::infinity();  // without `rest` [s]
  std::function<void()> begin{};                              // what changes in the scene
  std::function<void()> end{};                                // what is measured
};

class PhasedRig : public Rig {
 public:
  bool Advance(double until = std::numeric_limits<double>::infinity()) override;
  const engine::Simulation& simulation() const override { return simulation_; }
  engine::RunProgress Progress() const override;
  std::vector<std::string> TakeMessages() override;
  std::string StateLine() const override;
  std::vector<engine::Particle> Grains() const override { return simulation_.Particles(); }
  std::string ResultText(const std::vector<engine::Particle>& grains,
                         const engine::RunTiming& timing) const override;

  static PhasedState ParseState(const std::string& line);
  const PhasedState& state() const { return state_; }
  virtual std::vector<Observable> Observables() const = 0;

 protected:
  // `walls` of the scene, given the height that they must hold above the vessel's floor [m].
  using WallMaker = std::function<std::vector<engine::Wall>(double)>;

  // Fills the vessel, or with a state goes on from it. The derived class calls SetPhases.
  PhasedRig(const HeapCase& heap_case, const Vessel& vessel, const WallMaker& walls);
  PhasedRig(const HeapCase& heap_case, const Vessel& vessel, const PhasedState& state,
            engine::Simulation simulation);

  // After the filling and settling, which are added; the filling's taps too.
  void SetPhases(std::vector<Phase> phases);

  // A phase in which all walls are lifted and let fall.
  Phase Tapping(const TapRule& taps);
  Phase Settling() const;

  // At each look of the phase, before its criterion; true ends it.
  virtual bool Look() { return false; }

  const HeapCase& heap_case() const { return case_; }
  const Vessel& vessel() const { return vessel_; }
  engine::Simulation& scene() { return simulation_; }
  PhasedState& memory() { return state_; }
  const std::string& phase_name() const { return phases_[state_.phase].name; }
  double phase_start() const { return state_.phases[state_.phase].start_time; }  // [s]
  engine::Bed BedNow() const;
  double MassOf(std::span<const engine::Particle> grains) const;  // [kg]
  double FilledMass() const;                                      // [kg]
  double MeanDiameter() const;  // of the scaled grains, by volume [m]
  void Say(const std::string& message) { messages_.push_back(message); }

 private:
  void Check();
  bool AtRest(const RestRule& rule);
  void EndPhase(PhaseEnd reason);
  bool HasPoured();
  Phase Pouring();

  HeapCase case_;
  Vessel vessel_;
  engine::Simulation simulation_;
  PhasedState state_;
  std::vector<Phase> phases_;
  std::int64_t check_steps_ = 1;
  std::optional<engine::Pour> pour_;
  std::vector<std::string> messages_;
};

}  // namespace talus::rigs
