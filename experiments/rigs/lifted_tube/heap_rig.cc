#include "experiments/rigs/lifted_tube/heap_rig.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "engine/wall_motion.h"
#include "experiments/rigs/lifted_tube/heap_result.h"
#include "experiments/rigs/lifted_tube/pouring.h"
#include "experiments/rigs/pace.h"

namespace talus::rigs {
namespace {

using engine::Particle;
using engine::Vec3;

// Mean kinetic energy relative to the tube, over m g d, below which grains stick to it: falling off
// it they would have that after a fiftieth of a diameter, swinging in their bonds they stay below.
constexpr double kStuckEnergy = 0.02;

template <class... Values>
std::string Format(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// `ids` ascending.
std::int64_t Remove(const std::vector<std::int64_t>& ids, engine::Simulation& simulation) {
  if (ids.empty()) return 0;
  return simulation.RemoveIf(
      [&](const Particle& p) { return std::binary_search(ids.begin(), ids.end(), p.id); });
}

}  // namespace

HeapRig::HeapRig(const HeapCase& heap_case, const HeapState& state, engine::Simulation simulation)
    : case_(heap_case),
      simulation_(std::move(simulation)),
      state_(state),
      check_steps_(CheckSteps(heap_case, simulation_.time_step())) {
  if (case_.filling.kind == FillingKind::kPour) pour_ = MakePour(case_, TubeOf(case_));
  leave_height_ = -case_.rules.leave_depth * case_.coarse_graining.scale_factor *
                  engine::SizeCurve(case_.powder.sizes).largest();
}

HeapRig::HeapRig(const HeapCase& heap_case, const FilledScene& made)
    : HeapRig(heap_case, {}, engine::Simulation(made.scene)) {
  if (pour_) {
    state_.phase = HeapPhase::kPouring;
    state_.filled_height = EstimateHeap(case_).filled_height;
    Say(Format("pouring %zu grains, %.4g mm deep, at %.4g g/s", pour_->plan().radii.size(),
               1e3 * DropHeight(case_, TubeOf(case_)), 1e3 * pour_->plan().rate));
    return;
  }
  state_.filled_height = made.filling.height;
  state_.fill_overlap = made.filling.max_overlap;
  state_.fill_sweeps = made.filling.num_sweeps;
  state_.num_filled = simulation_.num_particles();
  Say(Format("filled %lld grains to %.4g mm; %d sweeps, largest overlap %.2g of a radius",
             static_cast<long long>(state_.num_filled), 1e3 * state_.filled_height,
             state_.fill_sweeps, state_.fill_overlap));
}

HeapRig::HeapRig(const HeapCase& heap_case) : HeapRig(heap_case, MakeHeapScene(heap_case)) {}

HeapState HeapRig::ParseState(const std::string& line) { return ParseHeapState(line); }

void HeapRig::Validate(const HeapCase& c, base::Problems& problems) {
  const double filled_height = EstimateHeap(c).filled_height;
  problems.Require(filled_height <= c.device.tube_length.value_or(filled_height),
                   "device.tube_length", c.device.tube_length.value_or(0),
                   "cannot hold the mass, which fills " + std::to_string(filled_height) +
                       " m; leave it out or lengthen the tube");
}

bool HeapRig::Advance(double until) {
  if (state_.phase == HeapPhase::kEnded) return false;
  const bool pouring = state_.phase == HeapPhase::kPouring;
  const Slice slice = AdvanceSlice(simulation_, {.check_steps = check_steps_,
                                                 .until = until,
                                                 .pour = pouring ? &*pour_ : nullptr,
                                                 .pour_state = &state_.pour});
  state_.particle_steps += slice.particle_steps;
  Record().steps += slice.steps;
  if (simulation_.step() % check_steps_ == 0) Check();
  return state_.phase != HeapPhase::kEnded;
}

void HeapRig::Check() {
  const View view = LookWithoutFallen();
  const double phase_time = simulation_.time() - Record().start_time;
  switch (state_.phase) {
    case HeapPhase::kPouring:
      CheckPouring();
      break;
    case HeapPhase::kSettling:
      CheckSettling(view);
      break;
    case HeapPhase::kTapping:
      if (phase_time >= case_.filling.taps->count * case_.filling.taps->interval) {
        EndPhase(PhaseEnd::kTapped, HeapPhase::kSettling);
      }
      break;
    case HeapPhase::kLifting:
      CheckLifting(view);
      break;
    case HeapPhase::kResting:
      if (view.particles.empty()) {
        EndPhase(PhaseEnd::kEmpty, HeapPhase::kEnded);
      } else if (Held(AtRest(view, case_.rules.heap), case_.rules.heap.hold_time)) {
        EndPhase(PhaseEnd::kAtRest, HeapPhase::kEnded);
      } else if (phase_time >= case_.rules.heap.max_time) {
        EndPhase(PhaseEnd::kTimeCap, HeapPhase::kEnded);
      }
      break;
    case HeapPhase::kEnded:
      break;
  }
}

// The funnel runs dry, or what is in the tube reaches its mouth and nothing can come any more.
void HeapRig::CheckPouring() {
  const double cap = 2 * pour_->Duration() + case_.rules.settling.max_time;
  const bool done = pour_->Done(state_.pour);
  if (!done && simulation_.time() < cap) return;
  state_.num_filled = state_.pour.num_poured;
  EndPhase(done ? PhaseEnd::kPoured : PhaseEnd::kTimeCap, HeapPhase::kSettling);
}

void HeapRig::CheckSettling(const View& view) {
  const double phase_time = simulation_.time() - Record().start_time;
  const HeapPhase next = case_.filling.taps && state_.tapping.reason == PhaseEnd::kNone
                             ? HeapPhase::kTapping
                             : HeapPhase::kLifting;
  if (Held(AtRest(view, case_.rules.settling), case_.rules.settling.hold_time)) {
    EndPhase(PhaseEnd::kAtRest, next);
  } else if (phase_time >= case_.rules.settling.max_time) {
    EndPhase(PhaseEnd::kTimeCap, next);
  }
  if (state_.phase == HeapPhase::kTapping) Tap();
  if (state_.phase == HeapPhase::kLifting) LiftTube();
}

void HeapRig::Tap() {
  const std::vector<engine::MotionStep> motion =
      engine::TapMotion({.start = simulation_.time(),
                         .count = case_.filling.taps->count,
                         .height = case_.filling.taps->height,
                         .interval = case_.filling.taps->interval,
                         .gravity = {0, 0, -case_.gravity}});
  simulation_.SetMotion(kTube, motion);
  simulation_.SetMotion(kPlate, motion);
}

// The lifting ends when the tube's edge is above the heap, the tube does not touch the heap, and
// what sticks to the tube, if anything, moves with it; all that held for a time.
void HeapRig::CheckLifting(const View& view) {
  const auto& [particles, contacts, connected] = view;
  double top = 0;
  EnergyRatio stuck(case_.gravity);
  const Vec3 lifting{0, 0, case_.device.lift_velocity};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle& p = particles[i];
    if (connected.on_plate[i]) top = std::max(top, p.position.z + p.radius);
    if (connected.on_tube[i]) stuck.Add(p, p.velocity - lifting, {});
  }
  Record().energy_ratio = stuck.Value();
  const bool cleared =
      TubeEdge() > top && !connected.tube_touches_heap && stuck.Value() < kStuckEnergy;
  const bool held = Held(cleared, case_.rules.heap.hold_time);
  if (!held && simulation_.time() - Record().start_time < LiftMaxTime()) return;
  DropTube(view);
  EndPhase(held ? PhaseEnd::kCleared : PhaseEnd::kTimeCap, HeapPhase::kResting);
}

void HeapRig::DropTube(const View& view) {
  std::vector<std::int64_t> carried;
  for (std::size_t i = 0; i < view.particles.size(); ++i) {
    if (view.connected.on_tube[i]) carried.push_back(view.particles[i].id);
  }
  simulation_.RemoveWall(kTube);
  state_.num_carried += Remove(carried, simulation_);
}

HeapRig::View HeapRig::Look() const {
  View view{
      .particles = simulation_.Particles(), .contacts = simulation_.Contacts(), .connected = {}};
  view.connected = Connect(view.particles, view.contacts);
  return view;
}

// Before the tube is lifted nothing can fall.
HeapRig::View HeapRig::LookWithoutFallen() {
  View view = Look();
  if (state_.phase != HeapPhase::kLifting && state_.phase != HeapPhase::kResting) return view;
  std::vector<std::int64_t> fallen =
      CanOnlyFall(view.particles, view.connected, case_.device, case_.gravity);
  for (const Particle& p : view.particles) {
    if (p.position.z + p.radius < leave_height_) fallen.push_back(p.id);
  }
  std::sort(fallen.begin(), fallen.end());
  if (fallen.empty()) return view;
  state_.num_fallen += Remove(fallen, simulation_);
  const auto gone = [&](std::int64_t id) {
    return std::binary_search(fallen.begin(), fallen.end(), id);
  };
  std::erase_if(view.particles, [&](const Particle& p) { return gone(p.id); });
  std::erase_if(view.contacts, [&](const engine::ContactInfo& contact) {
    return gone(contact.first) || gone(contact.second);
  });
  view.connected = Connect(view.particles, view.contacts);
  return view;
}

bool HeapRig::AtRest(const View& view, const RestRule& rule) {
  Record().energy_ratio =
      RestingEnergy(view.particles, view.contacts,
                    {.gravity = case_.gravity,
                     .moving_share = rule.moving_share,
                     .spins_count = case_.powder.material.sliding_friction > 0});
  return Record().energy_ratio < rule.energy_fraction;
}

bool HeapRig::Held(bool holds, double hold_time) {
  state_.num_quiet_checks = holds ? state_.num_quiet_checks + 1 : 0;
  // The first quiet check starts the time.
  const auto steps = (state_.num_quiet_checks - 1) * check_steps_;
  return holds && static_cast<double>(steps) * simulation_.time_step() >= hold_time;
}

void HeapRig::EndPhase(PhaseEnd reason, HeapPhase next) {
  PhaseRecord& record = Record();
  record.reason = reason;
  record.end_time = simulation_.time();
  Say(Format("%s ended at %.4g s: %s; %lld grains left",
             std::string(base::NameOf(state_.phase)).c_str(), record.end_time,
             std::string(base::NameOf(reason)).c_str(),
             static_cast<long long>(simulation_.num_particles())));
  state_.phase = next;
  state_.num_quiet_checks = 0;
  if (next != HeapPhase::kEnded) Record().start_time = simulation_.time();
}

void HeapRig::LiftTube() {
  const double diameter = case_.device.tube_inner_diameter;
  state_.bed = engine::MeasureBed(simulation_,
                                  {.area = std::numbers::pi / 4 * diameter * diameter, .floor = 0});
  Say(Format("the bed is %.4g mm high; solid fraction %.3f, %.2f contacts a grain",
             1e3 * state_.bed.height, state_.bed.solid_fraction, state_.bed.coordination));
  if (pour_) state_.filled_height = state_.bed.height;
  simulation_.SetMotion(
      kTube, {{.time = simulation_.time(), .velocity = {0, 0, case_.device.lift_velocity}}});
}

PhaseRecord& HeapRig::Record() {
  if (state_.phase == HeapPhase::kPouring) return state_.pouring;
  if (state_.phase == HeapPhase::kSettling) return state_.settling;
  if (state_.phase == HeapPhase::kTapping) return state_.tapping;
  return state_.phase == HeapPhase::kLifting ? state_.lifting : state_.heap;
}

double HeapRig::LiftMaxTime() const {
  return case_.rules.lift_max_time.value_or(2 * state_.filled_height / case_.device.lift_velocity);
}

double HeapRig::TubeEdge() const {
  return (simulation_.time() - state_.lifting.start_time) * case_.device.lift_velocity;
}

double HeapRig::ExpectedEnd() const {
  constexpr double kStill = 0.05;  // settling, or coming to rest, as seen in runs [s]
  const double now = simulation_.time();
  const double lift = 0.8 * state_.filled_height / case_.device.lift_velocity;
  switch (state_.phase) {
    case HeapPhase::kPouring:
      return std::max(now, pour_->Duration()) + kStill + lift + kStill;
    case HeapPhase::kSettling:
    case HeapPhase::kTapping:
      return std::max(now, kStill) + lift + kStill;
    case HeapPhase::kLifting:
      return std::max(now, state_.lifting.start_time + lift) + kStill;
    case HeapPhase::kResting:
      return std::max(now, state_.heap.start_time + kStill);
    case HeapPhase::kEnded:
      break;
  }
  return now;
}

engine::RunProgress HeapRig::Progress() const {
  return {.phase = std::string(base::NameOf(state_.phase)),
          .time = simulation_.time(),
          .end_time = ExpectedEnd(),
          .num_particles = simulation_.num_particles(),
          .step = simulation_.step(),
          .particle_steps = state_.particle_steps};
}

std::string HeapRig::StateLine() const { return HeapStateLine(state_); }

std::vector<Particle> HeapRig::Grains() const { return GrainsOfHeap(simulation_); }

std::string HeapRig::ResultText(const std::vector<Particle>& grains,
                                const engine::RunTiming& timing) const {
  return HeapResultText(case_, *this, grains, timing);
}

void HeapRig::Say(const std::string& message) { messages_.push_back(message); }

std::vector<std::string> HeapRig::TakeMessages() { return std::exchange(messages_, {}); }

}  // namespace talus::rigs
