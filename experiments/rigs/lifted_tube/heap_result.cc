#include "experiments/rigs/lifted_tube/heap_result.h"

#include <algorithm>
#include <numbers>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/version.h"
#include "engine/run/scaling_json.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"
#include "experiments/rigs/lifted_tube/landing.h"

namespace talus::rigs {
namespace {

using nlohmann::ordered_json;

ordered_json Phases(const HeapCase& c, const HeapState& state) {
  ordered_json phases;
  if (c.filling.kind == FillingKind::kPour) {
    phases["filling"] = base::ToJson(state.pouring);
  } else {
    const bool done = state.fill_overlap <= c.rules.fill_max_overlap;
    phases["filling"] = {{"reason", done ? "no_overlap" : "sweep_cap"},
                         {"sweeps", state.fill_sweeps},
                         {"max_overlap_over_radius", state.fill_overlap},
                         {"filled_height_m", state.filled_height}};
  }
  if (c.filling.taps) phases["tapping"] = base::ToJson(state.tapping);
  phases["settling"] = base::ToJson(state.settling);
  phases["lifting"] = base::ToJson(state.lifting);
  phases["heap"] = base::ToJson(state.heap);
  return phases;
}

// How the test ended, in words.
std::string Reason(const HeapState& state) {
  std::string reason(base::NameOf(state.heap.reason));
  if (state.lifting.reason == PhaseEnd::kTimeCap) reason += ", lifting: time_cap";
  if (state.settling.reason == PhaseEnd::kTimeCap) reason += ", settling: time_cap";
  if (state.pouring.reason == PhaseEnd::kTimeCap) reason += ", pouring: time_cap";
  return reason;
}

ordered_json Conditions(const HeapCase& c, const engine::Simulation& simulation) {
  const engine::Material used = UsedMaterial(c);
  ordered_json conditions;
  conditions["scale_factor"] = c.coarse_graining.scale_factor;
  conditions["surface_energy_exponent"] = c.coarse_graining.surface_energy_exponent;
  conditions["surface_energy_J_per_m2"] = c.powder.material.surface_energy;
  conditions["surface_energy_used_J_per_m2"] = used.surface_energy;
  conditions["youngs_modulus_Pa"] = used.youngs_modulus;
  conditions["lift_velocity_m_per_s"] = c.device.lift_velocity;
  conditions["rayleigh_fraction"] = c.rayleigh_fraction;
  conditions["time_step_s"] = simulation.time_step();
  conditions["plate_over_mean_diameter"] = c.device.plate_diameter / EstimateHeap(c).mean_diameter;
  conditions["seed"] = c.seed;
  return conditions;
}

double Volume(const engine::Particle& p) {
  return 4.0 / 3 * std::numbers::pi * p.radius * p.radius * p.radius;
}

double Volume(const std::vector<engine::Particle>& grains) {
  double volume = 0;
  for (const engine::Particle& p : grains) volume += Volume(p);
  return volume;
}

ordered_json Heap(const HeapCase& c, const std::vector<engine::Particle>& grains) {
  double height = 0;
  for (const engine::Particle& p : grains) {
    height = std::max(height, p.position.z + p.radius);
  }
  return {{"mass_kg", Volume(grains) * c.powder.material.density},
          {"height_m", height},
          {"num_grains", grains.size()}};
}

double PlateRadius(const engine::Simulation& simulation) {
  const engine::WallShape& plate = simulation.Walls().at(kPlate).shape;
  if (const auto* disc = std::get_if<engine::Disc>(&plate)) return disc->radius;
  return std::get<engine::SolidCylinder>(plate).radius;
}

// What a balance would show: the heap is on the plate, and what is neither of it nor carried away
// by the tube has fallen, or is about to.
ordered_json Observables(const HeapCase& c, const HeapRig& rig,
                         const std::vector<engine::Particle>& heap) {
  const HeapState& state = rig.state();
  const std::vector<engine::Particle> present = rig.simulation().Particles();
  const auto num_falling = static_cast<std::int64_t>(present.size() - heap.size());
  const std::int64_t num_gone = state.num_fallen + state.num_carried;
  const double gone = std::max(0.0, FilledVolume(c, state.num_filled) - Volume(present));
  const double fallen_share =
      num_gone > 0 ? static_cast<double>(state.num_fallen) / static_cast<double>(num_gone) : 0;
  const double falling = Volume(present) - Volume(heap);
  const double density = c.powder.material.density;
  return {{"mass_on_plate_kg", density * Volume(heap)},
          {"mass_fallen_kg", density * (gone * fallen_share + falling)},
          {"num_fallen", state.num_fallen + num_falling}};
}

}  // namespace

std::vector<engine::Particle> GrainsOfHeap(const engine::Simulation& simulation) {
  const std::vector<engine::Particle> particles = simulation.Particles();
  Connectivity connected = Connect(particles, simulation.Contacts());
  AddLanding(particles, PlateRadius(simulation), connected.on_plate);
  std::vector<engine::Particle> heap;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (connected.on_plate[i]) heap.push_back(particles[i]);
  }
  return heap;
}

std::string HeapResultText(const HeapCase& c, const HeapRig& rig,
                           const std::vector<engine::Particle>& heap,
                           const engine::RunTiming& timing) {
  const HeapState& state = rig.state();
  const engine::Simulation& simulation = rig.simulation();
  const auto on_heap = static_cast<std::int64_t>(heap.size());
  ordered_json result;
  result["kind"] = "heap";
  result["status"] = "ok";
  result["reason"] = Reason(state);
  result["talus_version"] = base::Version();
  result["input_hash"] = base::Hex(HeapCaseHash(c));
  result["phases"] = Phases(c, state);
  result["bed_before_lift"] = {{"filling", base::NameOf(c.filling.kind)},
                               {"height_m", state.bed.height},
                               {"solid_fraction", state.bed.solid_fraction},
                               {"contacts_per_grain", state.bed.coordination}};
  result["num_grains"] = state.num_filled;
  result["counts"] = {{"filled", state.num_filled},
                      {"on_heap", on_heap},
                      {"fallen", state.num_fallen},
                      {"carried_by_tube", state.num_carried},
                      {"in_flight", simulation.num_particles() - on_heap}};
  result["heap"] = Heap(c, heap);
  result["observables"] = Observables(c, rig, heap);
  result["conditions"] = Conditions(c, simulation);
  if (c.frame) {
    result["profile"] = base::ToJson(*c.frame);
    result["profile"]["file"] = "profile.png";
    result["profile"]["num_views"] = c.num_views;
  }
  result["num_steps"] = simulation.step();
  result["simulated_time_s"] = simulation.time();
  result["timing"] = {{"wall_time_s", timing.wall_time},
                      {"cpu_time_s", timing.cpu_time},
                      {"particle_steps", state.particle_steps},
                      {"threads", c.threads},
                      {"scaling", engine::ScalingJson(simulation.Scaling())}};
  std::vector<std::string> warnings = HeapWarnings(c);
  if (state.heap.reason == PhaseEnd::kTimeCap) {
    warnings.push_back("the heap had not come to rest at rules.heap.max_time");
  }
  if (state.lifting.reason == PhaseEnd::kTimeCap) {
    warnings.push_back("the tube had not cleared the heap at its time cap and was taken away");
  }
  if (state.pouring.reason == PhaseEnd::kTimeCap) {
    warnings.push_back("not all grains could be poured: the powder reached the funnel's mouth");
  }
  if (heap.empty()) warnings.push_back("nothing is left on the plate");
  result["warnings"] = warnings;
  return base::WithChecksum(base::JsonText(result, 2) + "\n");
}

std::string HeapStateLine(const HeapState& state) { return base::JsonText(base::ToJson(state)); }

HeapState ParseHeapState(const std::string& line) {
  return base::LoadOptions<HeapState>(base::ParseJson(line, "checkpoint"));
}

std::uint64_t HeapCaseHash(const HeapCase& heap_case) {
  HeapCase relevant = heap_case;
  relevant.threads = 1;
  relevant.checkpoint_interval = 0;
  return base::Checksum(HeapCaseText(relevant));
}

}  // namespace talus::rigs
