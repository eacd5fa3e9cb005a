// result.json of a bulk test: how each phase ended, what was measured, what it cost, and the
// conditions that calibrated values hold for.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/number_text.h"
#include "base/version.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/case_warnings.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/rigs/phased/rig.h"

namespace talus::rigs {
namespace {

using nlohmann::ordered_json;

ordered_json DenseFilling(const Case& c, const RigState& state) {
  const bool done = state.fill_overlap <= c.rules.fill_max_overlap;
  return {{"name", "filling"},
          {"reason", done ? "no_overlap" : "sweep_cap"},
          {"sweeps", state.fill_sweeps},
          {"max_overlap_over_radius", state.fill_overlap},
          {"filled_height_m", state.filled_height}};
}

ordered_json PhasesOf(const Case& c, const RigState& state, const std::vector<Phase>& phases) {
  ordered_json list = ordered_json::array();
  if (c.filling.kind == FillingKind::kDense) list.push_back(DenseFilling(c, state));
  for (std::size_t i = 0; i < phases.size(); ++i) {
    ordered_json phase{{"name", phases[i].name}};
    phase.update(base::ToJson(state.phases[i]));
    list.push_back(std::move(phase));
  }
  return list;
}

ordered_json RegimeJson(const Regime& regime) {
  return {{"inertial_number", regime.inertial_number},
          {"pressure_Pa", regime.pressure},
          {"shear_rate_per_s", regime.shear_rate}};
}

std::vector<std::string> CapWarnings(const RigState& state, const std::vector<Phase>& phases) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (state.phases[i].reason != PhaseEnd::kTimeCap) continue;
    warnings.push_back(phases[i].cap_warning.empty()
                           ? phases[i].name + " had not come to its end at its time cap"
                           : phases[i].cap_warning);
  }
  return warnings;
}

std::vector<std::string> LateTimes(const std::vector<double>& times, double end) {
  const auto late = std::ranges::count_if(times, [&](double time) { return time > end; });
  if (late == 0) return {};
  return {"outputs.times: " + std::to_string(late) + " of " + std::to_string(times.size()) +
          " lie after the test's end at " + base::ShortNumber(end) +
          " s: no state is written there"};
}

ordered_json CommonConditions(const Case& c, const engine::Simulation& simulation) {
  // Between two grains, a pair of them counted.
  const auto between_grains = [](const Case& sized) {
    return engine::With(UsedMaterial(sized), engine::StatedOf(PairsOf(sized), kPowder, kPowder));
  };
  Case true_size = c;
  true_size.coarse_graining = {};
  const engine::Material given = between_grains(true_size);
  const engine::Material used = between_grains(c);
  return {{"scale_factor", c.coarse_graining.scale_factor},
          {"surface_energy_exponent", c.coarse_graining.surface_energy_exponent},
          {"surface_energy_J_per_m2", given.surface_energy},
          {"surface_energy_used_J_per_m2", used.surface_energy},
          {"youngs_modulus_Pa", used.youngs_modulus},
          {"rayleigh_fraction", c.rayleigh_fraction},
          {"time_step_s", simulation.time_step()},
          {"seed", c.seed}};
}

void AddReadings(const std::vector<Reading>& readings, ordered_json& result) {
  result["observables"] = ordered_json::object();
  for (const Reading& reading : readings) {
    const std::string name = MetricName(reading.observable);
    if (reading.undefined.empty()) {
      result["observables"][name] = reading.value;
    } else {
      result["undefined"][name] = reading.undefined;
    }
  }
}

// Where the picture is, and how it is to be read; of a film also the pictures one by one.
ordered_json ProfileJson(const Case& c, const CameraMemory& camera) {
  ordered_json profile = base::ToJson(ProfileFrameOf(c));
  profile["file"] = kProfileFile;
  profile["num_views"] = NumViewsOf(c);
  if (!c.rig.camera) return profile;
  profile["num_frames"] = camera.num_frames;
  profile["sd_file"] = "profile_sd.png";
  if (c.rig.camera->num_pictures() == 1) return profile;
  for (int i = 0; i < c.rig.camera->num_pictures(); ++i) {
    profile["film"].push_back({{"time_s", c.rig.camera->BeginOf(i)}, {"file", PictureFile(i)}});
  }
  return profile;
}

}  // namespace

// How the last phase ended, and which before it ended at their caps.
std::string Rig::Reason() const {
  std::string reason(base::NameOf(state_.phases.back().reason));
  for (std::size_t i = phases_.size() - 1; i-- > 0;) {
    if (state_.phases[i].reason == PhaseEnd::kTimeCap) {
      reason += ", " + phases_[i].name + ": time_cap";
    }
  }
  return reason;
}

std::vector<std::pair<const char*, std::int64_t>> Rig::Counts(GrainSpan grains) const {
  const auto present = static_cast<std::int64_t>(grains.size());
  return {
      {"filled", state_.num_filled}, {"present", present}, {"left", state_.num_filled - present}};
}

std::string Rig::ResultText(const std::vector<engine::Particle>& grains,
                            const engine::RunTiming& timing) const {
  ordered_json result;
  result["kind"] = base::NameOf(case_.rig.kind);
  result["status"] = "ok";
  result["reason"] = Reason();
  result["talus_version"] = base::Version();
  result["input_hash"] = base::Hex(CaseHash(case_));
  result["phases"] = PhasesOf(case_, state_, phases_);
  result["bed"]["filling"] = base::NameOf(case_.filling.kind);
  if (vessel_.is_prism) {
    result["bed"]["height_m"] = state_.bed.height;
    result["bed"]["solid_fraction"] = state_.bed.solid_fraction;
  }
  result["bed"]["contacts_per_grain"] = state_.bed.coordination;
  result["num_grains"] = state_.num_filled;
  for (const auto& [name, count] : Counts(grains)) result["counts"][name] = count;
  std::vector<Reading> readings = Readings(grains);
  if (case_.rig.camera) {
    readings.push_back(CohesiveIndex(state_.camera, case_.frame.value(), *case_.rig.camera));
  }
  AddReadings(readings, result);
  if (const auto regime = RegimeOf(state_.regime)) result["regime"] = RegimeJson(*regime);
  result["conditions"] = CommonConditions(case_, simulation_);
  for (const auto& [name, value] : Conditions()) result["conditions"][name] = value;
  if (case_.frame) result["profile"] = ProfileJson(case_, state_.camera);
  result["num_steps"] = simulation_.step();
  result["simulated_time_s"] = simulation_.time();
  result["timing"] = {{"wall_time_s", timing.wall_time},
                      {"cpu_time_s", timing.cpu_time},
                      {"particle_steps", state_.particle_steps},
                      {"threads", case_.threads}};
  std::vector<std::string> warnings = CaseWarnings(case_);
  if (std::string shallow = ShallowWarning(case_, vessel_); !shallow.empty()) {
    warnings.push_back(std::move(shallow));
  }
  for (std::string& text : CapWarnings(state_, phases_)) warnings.push_back(std::move(text));
  for (std::string& text : Warnings(grains)) warnings.push_back(std::move(text));
  for (std::string& text : LateTimes(case_.outputs.times, simulation_.time())) {
    warnings.push_back(std::move(text));
  }
  result["warnings"] = warnings;
  return base::WithChecksum(base::JsonText(result, 2) + "\n");
}

}  // namespace talus::rigs
