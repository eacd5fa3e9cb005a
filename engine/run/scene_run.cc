#include "engine/run/scene_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/counted.h"
#include "engine/bodies/wall_motion.h"
#include "engine/run/resisted_spins.h"
#include "engine/run/state_file.h"
#include "engine/scene/scene_json.h"
#include "engine/scene/scene_warnings.h"

namespace talus::engine {
namespace {

// Looks a hold time: often enough to end soon after it, seldom enough to cost nothing.
std::int64_t CheckSteps(const StopSpec& stop, double time_step) {
  constexpr int kLooks = 5;
  return std::max<std::int64_t>(1, std::llround(stop.hold_time / kLooks / time_step));
}

constexpr std::int64_t kDomainSteps = 100;  // between two looks at who has left the domain

StateFormats Formats(const OutputSpec& outputs) { return {outputs.vtp, outputs.csv}; }

}  // namespace

SceneRun::SceneRun(const SceneSpec& spec, const Scene& scene, std::filesystem::path folder)
    : spec_(spec),
      input_hash_(SceneHash(spec)),
      folder_(std::move(folder)),
      simulation_(scene),
      states_(folder_, spec.outputs.times, Formats(spec.outputs)),
      pours_(BuildPours(spec_, simulation_.time_step(), simulation_.num_particles())),
      series_(spec_),
      check_steps_(CheckSteps(spec.stop, simulation_.time_step())) {
  for (const std::string& warning : SceneWarnings(spec, scene)) {
    messages_.push_back("warning: " + warning);
  }
  state_.num_at_start = simulation_.num_particles();
  state_.pours.resize(pours_.size());
}

SceneRun::SceneRun(const SceneSpec& spec, std::filesystem::path folder,
                   const RunCheckpoint& checkpoint)
    : spec_(spec),
      input_hash_(SceneHash(spec)),
      folder_(std::move(folder)),
      simulation_(Simulation::Restore(checkpoint.simulation, spec.threads)),
      states_(folder_, spec.outputs.times, Formats(spec.outputs)),
      state_(base::LoadOptions<SceneRunState>(base::ParseJson(checkpoint.state, "checkpoint"))),
      pours_(BuildPours(spec_, simulation_.time_step(), state_.num_at_start)),
      series_(spec_),
      check_steps_(CheckSteps(spec.stop, simulation_.time_step())) {
  states_.SkipUntil(simulation_.time());
}

bool SceneRun::Advance() {
  if (!state_.stop_reason.empty()) return false;
  AdvancePours();
  states_.Write(simulation_);  // the one at time 0
  series_.Write(simulation_, state_.series);
  const std::int64_t steps = NextSteps();
  simulation_.Advance(steps);
  state_.particle_steps +=
      static_cast<double>(steps) * static_cast<double>(simulation_.num_particles());
  CheckDomain();
  AdvancePours();
  states_.Write(simulation_);
  series_.Write(simulation_, state_.series);
  CheckStop();
  return state_.stop_reason.empty();
}

void SceneRun::CheckDomain() {
  if (!spec_.domain || simulation_.step() % kDomainSteps != 0) return;
  state_.num_left += simulation_.RemoveIf([&](const Particle& p) {
    const bool leaves = !spec_.domain->Contains(p.position);
    if (leaves) series_.Leaves(p, state_.series);
    return leaves;
  });
}

double SceneRun::NextPourTime() const {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pours_.size(); ++i) {
    next = std::min(next, pours_[i].NextTime(state_.pours[i]));
  }
  return next;
}

void SceneRun::AdvancePours() {
  for (std::size_t i = 0; i < pours_.size(); ++i) {
    if (pours_[i].Done(state_.pours[i])) continue;
    pours_[i].Advance(simulation_, state_.pours[i]);
    if (pours_[i].Done(state_.pours[i])) {
      messages_.push_back("poured " + std::to_string(state_.pours[i].num_poured) + " spheres");
    }
  }
}

// Up to whatever comes first: the end, a state to write, a look at the energy or the domain, the
// slice's end.
std::int64_t SceneRun::NextSteps() const {
  const double until =
      std::min({spec_.stop.time.value_or(std::numeric_limits<double>::infinity()),
                states_.NextTime(), NextPourTime(), series_.NextTime(state_.series)});
  const double to_go = std::ceil((until - simulation_.time()) / simulation_.time_step());
  std::int64_t steps = SliceSteps(simulation_.num_particles());
  if (spec_.stop.steps) steps = std::min(steps, *spec_.stop.steps - simulation_.step());
  if (spec_.stop.energy_fraction) {
    steps = std::min(steps, check_steps_ - simulation_.step() % check_steps_);
  }
  if (spec_.domain) steps = std::min(steps, kDomainSteps - simulation_.step() % kDomainSteps);
  if (to_go < static_cast<double>(steps)) steps = static_cast<std::int64_t>(to_go);
  return std::max<std::int64_t>(1, steps);
}

void SceneRun::CheckStop() {
  const StopSpec& stop = spec_.stop;
  if (stop.energy_fraction && simulation_.step() % check_steps_ == 0 && AtRest()) {
    state_.stop_reason = "at_rest";
  } else if (stop.steps && simulation_.step() >= *stop.steps) {
    state_.stop_reason = "steps";
  } else if (stop.time && simulation_.time() >= *stop.time) {
    state_.stop_reason = "time";
  }
  if (!state_.stop_reason.empty()) TellOfEnd();
}

// What was asked for and will not come any more is said, too.
void SceneRun::TellOfEnd() {
  const bool at_rest = state_.stop_reason == "at_rest";
  messages_.push_back(at_rest ? "ended at rest (stop.energy_fraction)"
                              : "ended by stop." + state_.stop_reason);
  for (std::size_t i = 0; i < pours_.size(); ++i) {
    if (pours_[i].Done(state_.pours[i])) continue;
    const auto num = static_cast<std::int64_t>(pours_[i].plan().radii.size());
    messages_.push_back("warning: pours[" + std::to_string(i) +
                        "]: " + std::to_string(num - state_.pours[i].num_poured) + " of " +
                        base::Counted(num, "sphere") + " had not been poured by then");
  }
  const auto late = std::ranges::count_if(spec_.outputs.times,
                                          [&](double time) { return time > simulation_.time(); });
  if (late > 0) {
    messages_.push_back("warning: outputs.times: " + std::to_string(late) + " of " +
                        std::to_string(spec_.outputs.times.size()) +
                        " come after the end and are not written");
  }
}

// What lies still before its gate opens, or while its box tilts, is not at its end.
double SceneRun::LastEvent() const {
  double last = 0;
  for (const Wall& wall : simulation_.Walls()) {
    last = std::max(last, wall.removal_time.value_or(EndOf(wall.motion)));
  }
  return std::max(last, EndOf(simulation_.GravityTurns()));
}

bool SceneRun::AtRest() {
  double kinetic = 0;
  double weight = 0;
  const double gravity = Norm(spec_.gravity);
  const std::vector<Particle> particles = simulation_.Particles();
  const std::vector<bool> resists_spin = simulation_.ResistsSpin();
  const std::vector<Vec3> spins = ResistedSpins(particles, simulation_.Contacts());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle& p = particles[i];
    const auto number = static_cast<std::size_t>(p.material);
    const Material& material = spec_.materials[number].material;
    const double square = p.radius * p.radius;
    const double cube = material.density * p.radius * square;
    kinetic += cube * Dot(p.velocity, p.velocity) / 2;
    if (resists_spin[number]) kinetic += cube * 0.2 * square * Dot(spins[i], spins[i]);
    weight += cube * gravity * 2 * p.radius;
  }
  state_.energy_ratio = weight > 0 ? kinetic / weight : 0;
  const bool all_done = NextPourTime() == std::numeric_limits<double>::infinity() &&
                        simulation_.time() >= LastEvent();
  const bool quiet =
      all_done && (particles.empty() || kinetic < *spec_.stop.energy_fraction * weight);
  state_.quiet_steps = quiet ? state_.quiet_steps + check_steps_ : 0;
  const auto held = static_cast<double>(state_.quiet_steps - check_steps_);
  return quiet && held * simulation_.time_step() >= spec_.stop.hold_time * (1 - 1e-9);
}

RunProgress SceneRun::Progress() const {
  const double dt = simulation_.time_step();
  double end = std::numeric_limits<double>::infinity();
  if (spec_.stop.time) end = *spec_.stop.time;
  if (spec_.stop.steps) end = std::min(end, static_cast<double>(*spec_.stop.steps) * dt);
  return {.phase = "running",
          .time = simulation_.time(),
          .end_time = end,
          .num_particles = simulation_.num_particles(),
          .step = simulation_.step(),
          .particle_steps = state_.particle_steps};
}

std::vector<std::string> SceneRun::TakeMessages() { return std::exchange(messages_, {}); }

std::string SceneRun::Checkpoint(const RunTiming& timing) const {
  return Pack({.input_hash = input_hash_,
               .timing = timing,
               .state = base::JsonText(base::ToJson(state_)),
               .simulation = simulation_.Checkpoint()});
}

void SceneRun::WriteResults(const RunTiming& timing) const {
  const std::vector<Particle> particles = simulation_.Particles();
  const double time = simulation_.time();
  if (spec_.outputs.vtp) base::WriteFileAtomically(folder_ / "final.vtp", VtpOf(particles, time));
  if (spec_.outputs.csv) base::WriteFileAtomically(folder_ / "final.csv", CsvOf(particles));
  if (spec_.outputs.interval) {
    base::WriteFileAtomically(folder_ / "series.csv", series_.Head() + state_.series.text);
  }
  const EnergySums energies = simulation_.Energies();
  nlohmann::ordered_json result;
  result["kind"] = "scene";
  result["status"] = "ok";
  result["input_hash"] = base::Hex(input_hash_);
  result["reason"] = state_.stop_reason;
  result["num_particles"] = particles.size();
  result["num_left_domain"] = state_.num_left;
  if (!pours_.empty()) {
    for (std::size_t i = 0; i < pours_.size(); ++i) {
      const auto num = static_cast<std::int64_t>(pours_[i].plan().radii.size());
      result["pours"].push_back({{"num_poured", state_.pours[i].num_poured},
                                 {"num_waiting", num - state_.pours[i].num_poured},
                                 {"rate_kg_s", pours_[i].plan().rate}});
    }
  }
  result["num_steps"] = simulation_.step();
  result["time_step_s"] = simulation_.time_step();
  result["simulated_time_s"] = time;
  result["energies"] = {{"translational_j", energies.translational},
                        {"rotational_j", energies.rotational},
                        {"potential_j", energies.potential}};
  result["timing"] = {{"wall_time_s", timing.wall_time},
                      {"cpu_time_s", timing.cpu_time},
                      {"particle_steps", state_.particle_steps},
                      {"threads", spec_.threads}};
  base::WriteFileAtomically(folder_ / "result.json",
                            base::WithChecksum(base::JsonText(result, 2) + "\n"));
}

std::uint64_t SceneHash(const SceneSpec& spec) {
  SceneSpec relevant = spec;
  relevant.threads = 1;
  relevant.checkpoint_interval = 0;
  return base::Checksum(SceneText(relevant));
}

}  // namespace talus::engine
