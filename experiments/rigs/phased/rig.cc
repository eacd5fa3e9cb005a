#include "experiments/rigs/phased/rig.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/error.h"
#include "engine/bodies/wall_motion.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rest.h"

namespace talus::rigs {
namespace {

constexpr const char* kPouring = "pouring";
constexpr const char* kSettling = "settling";

double CubeSum(std::span<const engine::Particle> grains) {
  double cubes = 0;
  for (const engine::Particle& p : grains) cubes += p.radius * p.radius * p.radius;
  return cubes;
}

template <class... Values>
std::string Format(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

Rig::Rig(const Case& rig_case, const Vessel& vessel, RigState state, engine::Simulation simulation)
    : case_(rig_case),
      vessel_(vessel),
      simulation_(std::move(simulation)),
      state_(std::move(state)),
      check_steps_(CheckSteps(rig_case, simulation_.time_step())) {
  if (case_.filling.kind == FillingKind::kPour) pour_ = MakePour(case_, vessel_);
  if (simulation_.step() > 0) return;
  if (pour_) {
    Say(Format("pouring %zu grains, from %.4g mm above the powder, at %.4g g/s",
               pour_->plan().radii.size(), 1e3 * DropHeight(case_, vessel_),
               1e3 * pour_->plan().rate));
  } else {
    Say(Format("filled %lld grains to %.4g mm; %d sweeps, largest overlap %.2g of a radius",
               static_cast<long long>(state_.num_filled), 1e3 * state_.filled_height,
               state_.fill_sweeps, state_.fill_overlap));
  }
}

FilledRig FillRig(const Case& c, const Vessel& vessel,
                  std::vector<engine::Wall> (*walls)(const Case&, double)) {
  FilledScene made = FillVessel(c, vessel);
  made.scene.walls = walls(c, c.filling.kind == FillingKind::kDense ? 1.1 * made.filling.height
                                                                    : PouredHeight(c, vessel));
  engine::Simulation simulation(made.scene);
  RigState state;
  state.fill_overlap = made.filling.max_overlap;
  state.filled_height = made.filling.height;
  state.fill_sweeps = made.filling.num_sweeps;
  if (c.filling.kind == FillingKind::kDense) {
    state.num_filled = std::min(FirstBedId(c, vessel), simulation.num_particles());
  }
  return {.state = std::move(state), .simulation = std::move(simulation)};
}

void Rig::SetPhases(std::vector<Phase> phases, double test_time) {
  simulated_time_ = SimulatedTime(case_, test_time) + (pour_ ? pour_->Duration() : 0);
  if (pour_) phases_.push_back(Pouring());
  phases_.push_back(Resting(kSettling, case_.rules.settling, [this] { return HasLanded(); }));
  if (case_.filling.taps) {
    phases_.push_back(Tapping(*case_.filling.taps));
    phases_.push_back(Resting(kSettling, case_.rules.settling));
  }
  phases_.back().end = [this] { MeasureBed(); };
  num_filling_phases_ = phases_.size();
  for (Phase& phase : phases) phases_.push_back(std::move(phase));
  state_.phases.resize(phases_.size());
}

// It ends when the funnel has run dry, or when what is in the vessel reaches its mouth and nothing
// can come any more.
Phase Rig::Pouring() {
  return {.name = kPouring,
          .ends_with = PhaseEnd::kPoured,
          .criterion = [this] { return pour_->Done(state_.pour); },
          .cap = [this] { return 2 * pour_->Duration() + case_.rules.settling.max_time; },
          .cap_warning = "not all grains could be poured: the powder reached the funnel's mouth",
          .end = [this] { state_.num_filled = state_.pour.num_poured; }};
}

Phase Rig::Resting(const std::string& name, const RestRule& rule, std::function<bool()> also) {
  return {.name = name,
          .ends_with = PhaseEnd::kAtRest,
          .criterion = [this, rule, also] { return AtRest(rule) && (!also || also()); },
          .hold_time = rule.hold_time,
          .cap = [rule] { return rule.max_time; }};
}

Phase Rig::Lasting(const std::string& name, double duration) {
  return {.name = name, .cap = [duration] { return duration; }, .at_cap = PhaseEnd::kDone};
}

Phase Rig::Tapping(const TapRule& taps) {
  Phase phase = Lasting("tapping", taps.count * taps.interval);
  phase.at_cap = PhaseEnd::kTapped;
  phase.begin = [this, taps] {
    const auto motion = engine::TapMotion({.start = simulation_.time(),
                                           .count = taps.count,
                                           .height = taps.height,
                                           .interval = taps.interval,
                                           .gravity = {0, 0, -case_.gravity}});
    const int num_walls = static_cast<int>(simulation_.Walls().size());
    for (int wall = 0; wall < num_walls; ++wall) simulation_.SetMotion(wall, motion);
  };
  return phase;
}

bool Rig::Advance(double until) {
  if (state_.phase >= phases_.size()) return false;
  const bool pouring = pour_ && phase_name() == kPouring;
  const Slice slice = AdvanceSlice(simulation_, {.check_steps = check_steps_,
                                                 .until = std::min(until, NextPicture()),
                                                 .pour = pouring ? &*pour_ : nullptr,
                                                 .pour_state = &state_.pour});
  state_.particle_steps += slice.particle_steps;
  record().steps += slice.steps;
  TakeDuePicture();
  if (simulation_.step() % check_steps_ == 0) Check();
  return state_.phase < phases_.size();
}

double Rig::NextPicture() const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (!case_.rig.camera || !phases_[state_.phase].filmed) return kNever;
  const CameraOptions& camera = *case_.rig.camera;
  const int taken = state_.camera.num_frames;
  if (taken == camera.num_frames()) return kNever;
  return phase_start() + camera.BeginOf(taken / camera.frames) +
         taken % camera.frames * camera.interval;
}

// At the step that is nearest to its time.
void Rig::TakeDuePicture() {
  if (simulation_.time() + simulation_.time_step() / 2 < NextPicture()) return;
  TakePicture(Grains(), case_.frame.value(), *case_.rig.camera, state_.camera);
}

void Rig::Check() {
  view_.reset();
  if (const auto end = Look()) return EndPhase(*end);
  LookAtRegime();
  const Phase& phase = phases_[state_.phase];
  if (Held(phase)) return EndPhase(phase.ends_with);
  if (phase.cap && simulation_.time() - phase_start() >= phase.cap()) EndPhase(phase.at_cap);
}

// At every eighth look: a grain falls a diameter meanwhile, and it costs less than 1 % of the run.
// Where the powder runs out of a funnel, filling is the test.
void Rig::LookAtRegime() {
  constexpr std::int64_t kLooks = 8;
  if (state_.phase < num_filling_phases_ && !vessel().funnel) return;
  if (simulation_.step() / check_steps_ % kLooks != 0) return;
  LookAtFlow({.particles = view().particles,
              .contacts = view().contacts,
              .diameter = MeanDiameter(),
              .density = case_.powder.material.density},
             state_.regime);
}

bool Rig::Held(const Phase& phase) {
  const bool holds = phase.criterion && phase.criterion();
  state_.num_quiet_checks = holds ? state_.num_quiet_checks + 1 : 0;
  // The first quiet check starts the time.
  const auto steps = (state_.num_quiet_checks - 1) * check_steps_;
  return holds && static_cast<double>(steps) * simulation_.time_step() >= phase.hold_time;
}

// What left the mouth last has come down: in flight it is too little to show.
bool Rig::HasLanded() const {
  if (!pour_) return true;
  const double fall = FallHeight(case_, vessel_, *pour_);
  return simulation_.time() - phase_start() >= std::sqrt(2 * fall / case_.gravity);
}

bool Rig::AtRest(const RestRule& rule) {
  record().energy_ratio = RestingEnergy(view().particles, view().contacts,
                                        {.gravity = case_.gravity,
                                         .moving_share = rule.moving_share,
                                         .spins_count = simulation_.ResistsSpin()[kPowder]});
  return record().energy_ratio < rule.energy_fraction;
}

void Rig::EndPhase(PhaseEnd reason) {
  const Phase& ended = phases_[state_.phase];
  if (std::isfinite(NextPicture())) {
    throw base::Error(Format(
        "the camera had taken %d of %d pictures when %s ended, after %.4g s: the powder had come "
        "to its end; take them earlier (rig.camera)",
        state_.camera.num_frames, case_.rig.camera->num_frames(), ended.name.c_str(),
        simulation_.time() - phase_start()));
  }
  record().reason = reason;
  record().end_time = simulation_.time();
  if (ended.end) ended.end();
  Say(Format("%s ended at %.4g s: %s; %lld grains", ended.name.c_str(), simulation_.time(),
             std::string(base::NameOf(reason)).c_str(),
             static_cast<long long>(simulation_.num_particles())));
  state_.num_quiet_checks = 0;
  if (++state_.phase == phases_.size()) return;
  record().start_time = simulation_.time();
  if (phases_[state_.phase].begin) phases_[state_.phase].begin();
}

void Rig::MeasureBed() {
  state_.bed = BedNow();
  const engine::Bed& bed = state_.bed;
  if (!vessel_.is_prism) return Say(Format("%.2f contacts a grain", bed.coordination));
  Say(Format("the bed is %.4g mm high; solid fraction %.3f, %.2f contacts a grain",
             1e3 * bed.height, bed.solid_fraction, bed.coordination));
}

const Rig::View& Rig::view() const {
  if (!view_) {
    view_ = View{.particles = simulation_.Particles(), .contacts = simulation_.Contacts()};
  }
  return *view_;
}

std::int64_t Rig::WeighOut(const std::vector<std::int64_t>& ids, double& mass) {
  if (ids.empty()) return 0;
  const auto gone = [&](std::int64_t id) { return std::binary_search(ids.begin(), ids.end(), id); };
  for (const engine::Particle& p : view().particles) {
    if (gone(p.id)) mass += MassOf({&p, 1});
  }
  if (view_) {
    std::erase_if(view_->particles, [&](const engine::Particle& p) { return gone(p.id); });
    std::erase_if(view_->contacts, [&](const engine::ContactInfo& contact) {
      return gone(contact.first) || gone(contact.second);
    });
  }
  return simulation_.RemoveIf([&](const engine::Particle& p) { return gone(p.id); });
}

void Rig::WeighOut(const std::function<bool(const engine::Particle&)>& leaves, double& mass) {
  std::vector<std::int64_t> leaving;
  for (const engine::Particle& p : view().particles) {
    if (leaves(p)) leaving.push_back(p.id);
  }
  WeighOut(leaving, mass);
}

engine::Bed Rig::BedNow() const {
  return engine::MeasureBed(
      simulation_,
      {.area = vessel_.area, .floor = vessel_.Floor(), .end_id = FirstBedId(case_, vessel_)});
}

double Rig::MassOf(GrainSpan grains) const {
  return 4.0 / 3 * std::numbers::pi * CubeSum(grains) * case_.powder.material.density;
}

double Rig::FilledMass() const {
  return FilledVolume(case_, state_.num_filled) * case_.powder.material.density;
}

double Rig::MeanDiameter() const { return EstimatePowder(case_).mean_diameter; }

std::string Rig::phase_name() const {
  return state_.phase < phases_.size() ? phases_[state_.phase].name : "ended";
}

const PhaseRecord& Rig::RecordOf(const std::string& phase) const {
  std::size_t found = 0;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    if (phases_[i].name == phase) found = i;
  }
  return state_.phases[found];
}

engine::RunProgress Rig::Progress() const {
  return {.phase = phase_name(),
          .time = simulation_.time(),
          .end_time = std::max(simulation_.time(), simulated_time_),
          .num_particles = simulation_.num_particles(),
          .step = simulation_.step(),
          .particle_steps = state_.particle_steps};
}

}  // namespace talus::rigs
