// A kind of bulk test: its powder is filled into a vessel and settles, then phases of the rig's own
// follow. Physics only; RigRun does the files. rig_list.h knows all rigs.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/run/run.h"
#include "engine/scene/pour.h"
#include "engine/simulation.h"
#include "experiments/rigs/filling/vessel.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/phased/phase.h"
#include "experiments/rigs/phased/rig_state.h"
#include "imaging/gray_image.h"

namespace talus::rigs {

class Rig {
 public:
  virtual ~Rig() = default;

  // Advances by a slice that ends, at the latest, with the first step at or after `until` [s];
  // false when the test has ended.
  bool Advance(double until = std::numeric_limits<double>::infinity());

  const engine::Simulation& simulation() const { return simulation_; }
  const RigState& state() const { return state_; }
  std::string phase_name() const;                               // "ended" after the last
  const PhaseRecord& RecordOf(const std::string& phase) const;  // the last of this name
  engine::RunProgress Progress() const;
  std::vector<std::string> TakeMessages() { return std::exchange(messages_, {}); }

  // What it knows beside the engine's state: one line of a checkpoint.
  virtual std::string StateLine() const = 0;

  // The grains that an image shows, in a frame whose centre is x = 0 and whose baseline is z = 0.
  virtual std::vector<engine::Particle> Grains() const { return simulation_.Particles(); }

  // A picture from above, of rigs that are looked at so; `grains` as Grains gives them.
  virtual std::optional<imaging::GrayImage> FromAbove(std::span<const engine::Particle>) const {
    return std::nullopt;
  }

  // The content of result.json; `grains` as Grains gives them.
  std::string ResultText(const std::vector<engine::Particle>& grains,
                         const engine::RunTiming& timing) const;

 protected:
  using GrainSpan = std::span<const engine::Particle>;
  using Numbers = std::vector<std::pair<const char*, double>>;

  // Goes on from a state, which may be that of a scene just filled. The derived class calls
  // SetPhases.
  Rig(const Case& rig_case, const Vessel& vessel, RigState state, engine::Simulation simulation);

  // After the filling and settling, which are added; the filling's taps too. They are expected to
  // take `test_time` [s].
  void SetPhases(std::vector<Phase> phases, double test_time);
  Phase Tapping(const TapRule& taps);  // all walls are lifted and let fall
  // It lasts until the powder is at rest, and `also` holds where it is given.
  Phase Resting(const std::string& name, const RestRule& rule, std::function<bool()> also = {});
  static Phase Lasting(const std::string& name, double duration);

  // At each look, before the phase's criterion; an end ends the phase.
  virtual std::optional<PhaseEnd> Look() { return std::nullopt; }

  // The content of the result.
  virtual std::vector<Reading> Readings(GrainSpan grains) const = 0;
  virtual std::vector<std::pair<const char*, std::int64_t>> Counts(GrainSpan grains) const;
  virtual Numbers Conditions() const { return {}; }
  virtual std::vector<std::string> Warnings(GrainSpan) const { return {}; }

  // The scene at a look.
  struct View {
    std::vector<engine::Particle> particles;
    std::vector<engine::ContactInfo> contacts;
  };
  const View& view() const;
  // Takes grains out of the scene and of the view, and adds their mass to `mass` [kg]; `ids`
  // ascending. Returns how many they were.
  std::int64_t WeighOut(const std::vector<std::int64_t>& ids, double& mass);
  // The same of those that `leaves` picks.
  void WeighOut(const std::function<bool(const engine::Particle&)>& leaves, double& mass);

  const Case& rig_case() const { return case_; }
  const Vessel& vessel() const { return vessel_; }
  engine::Simulation& scene() { return simulation_; }
  double phase_start() const { return state_.phases[state_.phase].start_time; }  // [s]
  PhaseRecord& record() { return state_.phases[state_.phase]; }
  engine::Bed BedNow() const;
  double MassOf(GrainSpan grains) const;  // [kg]
  double FilledMass() const;              // [kg]
  double MeanDiameter() const;            // of the scaled grains, by volume [m]
  bool pours() const { return pour_.has_value(); }
  void Say(const std::string& message) { messages_.push_back(message); }

 private:
  double NextPicture() const;  // when it is due [s]; infinite when none is
  void TakeDuePicture();
  void Check();
  void LookAtRegime();
  bool Held(const Phase& phase);
  bool HasLanded() const;
  bool AtRest(const RestRule& rule);
  void EndPhase(PhaseEnd reason);
  Phase Pouring();
  void MeasureBed();
  std::string Reason() const;

  Case case_;
  Vessel vessel_;
  engine::Simulation simulation_;
  RigState state_;
  std::vector<Phase> phases_;
  std::size_t num_filling_phases_ = 0;  // of these, which come first
  double simulated_time_ = 0;           // expected, of all phases [s]
  std::int64_t check_steps_ = 1;        // between two looks
  std::optional<engine::Pour> pour_;
  mutable std::optional<View> view_;
  std::vector<std::string> messages_;
};

// The powder in its vessel, with the rig's walls around it.
struct FilledRig {
  RigState state;
  engine::Simulation simulation;
};
// `walls` are given the height that they must hold above the vessel's floor [m].
FilledRig FillRig(const Case& rig_case, const Vessel& vessel,
                  std::vector<engine::Wall> (*walls)(const Case&, double height));

}  // namespace talus::rigs
