// result.json of a phased test.
#include <nlohmann/json.hpp>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/version.h"
#include "engine/run/scaling_json.h"
#include "experiments/rigs/lifted_tube/heap_result.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"
#include "experiments/rigs/phased/phased_rig.h"
#include "experiments/rigs/rig_list.h"

namespace talus::rigs {
namespace {

using nlohmann::ordered_json;

ordered_json Conditions(const HeapCase& c, const engine::Simulation& simulation) {
  const engine::Material used = UsedMaterial(c);
  return {{"scale_factor", c.coarse_graining.scale_factor},
          {"surface_energy_exponent", c.coarse_graining.surface_energy_exponent},
          {"surface_energy_J_per_m2", c.powder.material.surface_energy},
          {"surface_energy_used_J_per_m2", used.surface_energy},
          {"youngs_modulus_Pa", used.youngs_modulus},
          {"rayleigh_fraction", c.rayleigh_fraction},
          {"time_step_s", simulation.time_step()},
          {"seed", c.seed}};
}

}  // namespace

std::string PhasedRig::ResultText(const std::vector<engine::Particle>& grains,
                                  const engine::RunTiming& timing) const {
  ordered_json result;
  std::vector<std::string> warnings = HeapWarnings(case_);
  std::string reason;
  ordered_json phases = ordered_json::array();
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const PhaseRecord& record = state_.phases[i];
    ordered_json phase{{"name", phases_[i].name}};
    phase.update(base::ToJson(record));
    phases.push_back(std::move(phase));
    reason = base::NameOf(record.reason);
    if (record.reason == PhaseEnd::kTimeCap) {
      warnings.push_back(phases_[i].name + " had not come to its end at its time cap");
    }
  }
  result["kind"] = base::NameOf(KindOf(case_));
  result["status"] = "ok";
  result["reason"] = reason;
  result["talus_version"] = base::Version();
  result["input_hash"] = base::Hex(HeapCaseHash(case_));
  result["phases"] = std::move(phases);
  result["bed"] = {{"filling", base::NameOf(case_.filling.kind)},
                   {"height_m", state_.bed.height},
                   {"solid_fraction", state_.bed.solid_fraction},
                   {"contacts_per_grain", state_.bed.coordination}};
  result["num_grains"] = state_.num_filled;
  result["counts"] = {
      {"filled", state_.num_filled}, {"present", grains.size()}, {"left", state_.num_left}};
  result["observables"] = ordered_json::object();
  for (const Observable& o : Observables()) {
    if (o.undefined.empty()) {
      result["observables"][o.name] = o.value;
    } else {
      result["undefined"][o.name] = o.undefined;
    }
  }
  result["conditions"] = Conditions(case_, simulation_);
  if (case_.frame) {
    result["profile"] = base::ToJson(*case_.frame);
    result["profile"]["file"] = "profile.png";
    result["profile"]["num_views"] = NumViewsOf(case_);
  }
  result["num_steps"] = simulation_.step();
  result["simulated_time_s"] = simulation_.time();
  result["timing"] = {{"wall_time_s", timing.wall_time},
                      {"cpu_time_s", timing.cpu_time},
                      {"particle_steps", state_.particle_steps},
                      {"threads", case_.threads},
                      {"scaling", engine::ScalingJson(simulation_.Scaling())}};
  result["warnings"] = warnings;
  return base::WithChecksum(base::JsonText(result, 2) + "\n");
}

}  // namespace talus::rigs
