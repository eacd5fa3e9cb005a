#include "experiments/rigs/phased/phased_rig.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "engine/wall_motion.h"
#include "experiments/rigs/lifted_tube/pouring.h"
#include "experiments/rigs/lifted_tube/rest.h"
#include "experiments/rigs/pace.h"

namespace talus::rigs {
namespace {

constexpr const char* kPouring = "pouring";
constexpr const char* kSettling = "settling";

double CubeSum(std::span<const engine::Particle> grains) {
  double cubes = 0;
  for (const engine::Particle& p : grains) cubes += p.radius * p.radius * p.radius;
  return cubes;
}

}  // namespace

PhasedRig::PhasedRig(const HeapCase& heap_case, const Vessel& vessel, const PhasedState& state,
                     engine::Simulation simulation)
    : case_(heap_case),
      vessel_(vessel),
      simulation_(std::move(simulation)),
      state_(state),
      check_steps_(CheckSteps(heap_case, simulation_.time_step())) {
  if (case_.filling.kind == FillingKind::kPour) pour_ = MakePour(case_, vessel_);
}

namespace {

struct Filled {
  FilledScene made;
  engine::Simulation simulation;
};

Filled FillAndWall(const HeapCase& c, const Vessel& vessel,
                   const std::function<std::vector<engine::Wall>(double)>& walls) {
  FilledScene made = FillVessel(c, vessel);
  made.scene.walls = walls(c.filling.kind == FillingKind::kDense ? 1.1 * made.filling.height
                                                                 : PouredHeight(c, vessel));
  engine::Simulation simulation(made.scene);
  return {.made = std::move(made), .simulation = std::move(simulation)};
}

}  // namespace

PhasedRig::PhasedRig(const HeapCase& heap_case, const Vessel& vessel, const WallMaker& walls)
    : PhasedRig(heap_case, vessel, PhasedState{}, [&] {
        Filled filled = FillAndWall(heap_case, vessel, walls);
        return std::move(filled.simulation);
      }()) {
  state_.num_filled = simulation_.num_particles();
  Say(pour_ ? "pouring " + std::to_string(pour_->plan().radii.size()) + " grains"
            : "filled " + std::to_string(state_.num_filled) + " grains");
}

void PhasedRig::SetPhases(std::vector<Phase> phases) {
  if (pour_) phases_.push_back(Pouring());
  phases_.push_back(Settling());
  if (case_.filling.taps) {
    phases_.push_back(Tapping(*case_.filling.taps));
    phases_.push_back(Settling());
  }
  phases_.back().end = [this] { state_.bed = BedNow(); };
  for (Phase& phase : phases) phases_.push_back(std::move(phase));
  state_.phases.resize(phases_.size());
}

Phase PhasedRig::Pouring() {
  return {.name = kPouring, .ends_with = PhaseEnd::kPoured, .end = [this] {
            state_.num_filled = state_.pour.num_poured;
          }};
}

Phase PhasedRig::Settling() const {
  return {.name = kSettling, .ends_with = PhaseEnd::kAtRest, .rest = case_.rules.settling};
}

Phase PhasedRig::Tapping(const TapRule& taps) {
  const auto tap = [this, taps] {
    const auto motion = engine::TapMotion({.start = simulation_.time(),
                                           .count = taps.count,
                                           .height = taps.height,
                                           .interval = taps.interval,
                                           .gravity = {0, 0, -case_.gravity}});
    const int num_walls = static_cast<int>(simulation_.Walls().size());
    for (int wall = 0; wall < num_walls; ++wall) simulation_.SetMotion(wall, motion);
  };
  return {.name = "tapping",
          .ends_with = PhaseEnd::kTapped,
          .duration = taps.count * taps.interval,
          .begin = tap};
}

bool PhasedRig::Advance(double until) {
  if (state_.phase >= phases_.size()) return false;
  const bool pouring = pour_ && phase_name() == kPouring;
  const Slice slice = AdvanceSlice(simulation_, {.check_steps = check_steps_,
                                                 .until = until,
                                                 .pour = pouring ? &*pour_ : nullptr,
                                                 .pour_state = &state_.pour});
  state_.particle_steps += slice.particle_steps;
  state_.phases[state_.phase].steps += slice.steps;
  if (simulation_.step() % check_steps_ == 0) Check();
  return state_.phase < phases_.size();
}

// The funnel runs dry, or what is in the vessel reaches its mouth and nothing can come any more.
bool PhasedRig::HasPoured() {
  if (pour_->Done(state_.pour)) return true;
  if (simulation_.time() < 2 * pour_->Duration() + case_.rules.settling.max_time) return false;
  phases_[state_.phase].ends_with = PhaseEnd::kTimeCap;
  return true;
}

void PhasedRig::Check() {
  const Phase& phase = phases_[state_.phase];
  const double time = simulation_.time() - phase_start();
  if (Look()) return EndPhase(phase.ends_with);
  if (phase.name == kPouring) {
    if (HasPoured()) EndPhase(phases_[state_.phase].ends_with);
  } else if (!phase.rest) {
    if (time >= phase.duration) EndPhase(phase.ends_with);
  } else if (AtRest(*phase.rest)) {
    EndPhase(PhaseEnd::kAtRest);
  } else if (time >= phase.rest->max_time) {
    EndPhase(PhaseEnd::kTimeCap);
  }
}

bool PhasedRig::AtRest(const RestRule& rule) {
  const double energy = RestingEnergy(simulation_.Particles(), simulation_.Contacts(),
                                      {.gravity = case_.gravity,
                                       .moving_share = rule.moving_share,
                                       .spins_count = case_.powder.material.sliding_friction > 0});
  state_.phases[state_.phase].energy_ratio = energy;
  if (!(energy < rule.energy_fraction)) {
    state_.num_quiet_checks = 0;
    return false;
  }
  // The first quiet check starts the time.
  const auto steps = state_.num_quiet_checks++ * check_steps_;
  return static_cast<double>(steps) * simulation_.time_step() >= rule.hold_time;
}

void PhasedRig::EndPhase(PhaseEnd reason) {
  PhaseRecord& record = state_.phases[state_.phase];
  record.reason = reason;
  record.end_time = simulation_.time();
  const Phase& ended = phases_[state_.phase];
  char text[160];
  std::snprintf(text, sizeof text, "%s ended at %.4g s: %s; %lld grains", ended.name.c_str(),
                record.end_time, std::string(base::NameOf(reason)).c_str(),
                static_cast<long long>(simulation_.num_particles()));
  Say(text);
  if (ended.end) ended.end();
  state_.num_quiet_checks = 0;
  if (++state_.phase == phases_.size()) return;
  state_.phases[state_.phase].start_time = simulation_.time();
  if (phases_[state_.phase].begin) phases_[state_.phase].begin();
}

engine::Bed PhasedRig::BedNow() const {
  return engine::MeasureBed(simulation_, {.area = vessel_.area, .floor = vessel_.region.base.z});
}

double PhasedRig::MassOf(std::span<const engine::Particle> grains) const {
  return 4.0 / 3 * std::numbers::pi * CubeSum(grains) * case_.powder.material.density;
}

double PhasedRig::FilledMass() const {
  return FilledVolume(case_, state_.num_filled) * case_.powder.material.density;
}

double PhasedRig::MeanDiameter() const { return EstimateHeap(case_).mean_diameter; }

engine::RunProgress PhasedRig::Progress() const {
  const bool ended = state_.phase >= phases_.size();
  return {.phase = ended ? "ended" : phase_name(),
          .time = simulation_.time(),
          .end_time = std::max(simulation_.time(), EstimateHeap(case_).simulated_time),
          .num_particles = simulation_.num_particles(),
          .step = simulation_.step(),
          .particle_steps = state_.particle_steps};
}

std::vector<std::string> PhasedRig::TakeMessages() { return std::exchange(messages_, {}); }

PhasedState PhasedRig::ParseState(const std::string& line) {
  return base::LoadOptions<PhasedState>(base::ParseJson(line, "checkpoint"));
}

std::string PhasedRig::StateLine() const { return base::JsonText(base::ToJson(state_)); }

}  // namespace talus::rigs
