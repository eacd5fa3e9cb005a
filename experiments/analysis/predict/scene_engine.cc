#include "experiments/analysis/predict/scene_engine.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/not_known.h"
#include "base/sphere.h"
#include "engine/scene/scene_json.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSceneFile = "scene.json";

engine::SceneSpec ParseScene(const std::string& text) {
  return base::LoadOptions<engine::SceneSpec>(base::ParseJson(text, kSceneFile));
}

// The material of all grains, or the one called "powder"; -1 where neither is plain.
int PowderOf(const engine::SceneSpec& scene) {
  const int named = engine::MaterialIndex(scene, "powder");
  int only = -2;
  const auto look = [&](const auto& grains) {
    for (const auto& g : grains) {
      const int index = engine::MaterialIndex(scene, g.material);
      only = only == -2 || only == index ? index : -1;
    }
  };
  look(scene.spheres);
  look(scene.fills);
  look(scene.pours);
  return only >= 0 ? only : named;
}

// Volume [m³] by diameter [m].
using Volumes = std::map<double, double>;

// A curve of sizes as so many parts of equal volume: an odd number, so that the median of one curve
// is its own.
constexpr int kParts = 101;

// Volumes of the powder's own grains: `density` [kg/m³] makes volumes of the masses that are filled
// in.
Volumes VolumesOf(const engine::SceneSpec& scene, int powder, double density) {
  Volumes volumes;
  const auto is_powder = [&](const auto& grains) {
    return engine::MaterialIndex(scene, grains.material) == powder;
  };
  for (const engine::SphereSpec& s : scene.spheres) {
    if (is_powder(s)) volumes[s.diameter] += base::SphereVolume(s.diameter / 2);
  }
  const auto add = [&](const auto& grains) {
    if (!is_powder(grains)) return;
    const engine::SizeCurve curve(grains.sizes);
    for (int part = 0; part < kParts; ++part) {
      volumes[curve.VolumeQuantile((part + 0.5) / kParts)] += grains.mass / density / kParts;
    }
  };
  for (const auto& fill : scene.fills) add(fill);
  for (const auto& pour : scene.pours) add(pour);
  return volumes;
}

// Median diameter by volume [m]; 0 of nothing.
double MedianDiameter(const Volumes& volumes) {
  double total = 0;
  for (const auto& [diameter, volume] : volumes) total += volume;
  double finer = 0;
  for (const auto& [diameter, volume] : volumes) {
    finer += volume;
    if (finer >= total / 2) return diameter;
  }
  return 0;
}

engine::SceneSpec SceneWith(engine::SceneSpec scene, const rigs::Case& rig_case) {
  engine::NamedMaterial& powder = scene.materials[static_cast<std::size_t>(PowderOf(scene))];
  powder.material = rigs::UsedMaterial(rig_case);
  for (const engine::MaterialPair& pair : rigs::PairsOf(rig_case)) {
    scene.pairs.push_back({.between = {powder.name, powder.name}, .stated = pair.stated});
  }
  scene.models = rig_case.models;
  scene.seed = rig_case.seed;
  return scene;
}

struct ScalarList {
  std::vector<journal::MetricRecord>& list;
  void Add(const std::string& name, double value, const std::string& unit) {
    list.push_back({.name = name, .value = value, .unit = unit, .undefined = ""});
  }
};

// The mean of each column over the second half of the rows, when what was set going has settled.
void AddSeries(const fs::path& file, ScalarList scalars) {
  if (!fs::exists(file)) return;
  std::istringstream lines(base::ReadFile(file));
  std::string line;
  std::getline(lines, line);
  std::vector<std::string> names;
  std::istringstream head(line);
  for (std::string name; std::getline(head, name, ',');) names.push_back(name);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      double& value = row.emplace_back(base::kNotKnown);
      std::from_chars(cell.data(), cell.data() + cell.size(), value);
    }
    if (row.size() != names.size()) {
      throw base::Error(file.string() + ": line " + std::to_string(rows.size() + 1) +
                        " is cut off: it has " + std::to_string(row.size()) + " of " +
                        std::to_string(names.size()) + " cells");
    }
  }
  const std::size_t first = rows.size() / 2;
  for (std::size_t c = 1; c < names.size() && first < rows.size(); ++c) {
    double sum = 0;
    for (std::size_t r = first; r < rows.size(); ++r) sum += rows[r].at(c);
    scalars.Add("mean_" + names[c], sum / static_cast<double>(rows.size() - first), "");
  }
}

}  // namespace

void ReadScene(const campaign::JointView& view, const base::JsonFile& file,
               std::optional<double> scale_factor, PredictedCase& predicted) {
  if (scale_factor) {
    throw base::ConfigError(file.path.string() +
                            ": is a scene, whose grains have the sizes that it states; leave "
                            "--scale out");
  }
  engine::SceneSpec scene = engine::LoadScene(file).spec;
  base::Problems problems(file.path.string(), file.places);
  problems.Require(PowderOf(scene) >= 0, "materials",
                   "do not say which one is the powder: its grains have several; call the one that "
                   "the campaign has calibrated \"powder\"");
  problems.ThrowIfAny();
  const std::string& powder = scene.materials[static_cast<std::size_t>(PowderOf(scene))].name;
  const bool states = std::ranges::any_of(scene.pairs, [&](const engine::PairSpec& pair) {
    return pair.between == std::vector{powder, powder};
  });
  problems.Require(!states, "pairs",
                   "state what two grains of the powder do, which the campaign gives; leave that "
                   "pair out");
  problems.ThrowIfAny();
  rigs::Case& rig_case = predicted.rig_case;
  rig_case.powder = view.spec.powder;
  rig_case.models = view.spec.models;
  rig_case.pairs = PairsOfGrains(view);
  const Volumes volumes = VolumesOf(scene, PowderOf(scene), view.spec.powder.material.density);
  const double scale =
      MedianDiameter(volumes) / engine::SizeCurve(view.spec.powder.sizes).VolumeQuantile(0.5);
  rig_case.coarse_graining = {
      .scale_factor = scale,
      .surface_energy_exponent = view.spec.coarse_graining.surface_energy_exponent};
  scene.threads = view.spec.threads;
  predicted.scene_text = engine::SceneText(scene);
  // With the campaign's powder the time step may be too long, or a pair contradict it.
  try {
    const auto middle = view.space.ToNative(
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(view.space.Free().size()), 0.5));
    engine::LoadScene(base::ParseJson(
        engine::SceneText(SceneWith(scene, CaseWith(view, predicted, middle, scene.seed))),
        file.path));
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(std::string(error.what()) + " (with the campaign's powder in it)");
  }
}

SceneEngine::SceneEngine(std::string scene_text) : scene_text_(std::move(scene_text)) {}

void SceneEngine::Prepare(const rigs::Case& rig_case, const fs::path& folder) {
  trials::PrepareFolder(folder, kSceneFile,
                        engine::SceneText(SceneWith(ParseScene(scene_text_), rig_case)));
}

bool SceneEngine::IsPrepared(const rigs::Case& rig_case, const fs::path& folder) {
  return trials::HoldsKey(folder, kSceneFile,
                          engine::SceneText(SceneWith(ParseScene(scene_text_), rig_case)));
}

std::vector<std::string> SceneEngine::Command(const fs::path&) {
  return {trials::TalusEngine::ThisProgram().string(), "simulate", kSceneFile, "--out", "."};
}

bool SceneEngine::IsComplete(const fs::path& folder) { return engine_.IsComplete(folder); }

trials::TrialOutput SceneEngine::Collect(const rigs::Case& rig_case, const fs::path& folder) {
  trials::TrialOutput output = engine_.Collect(rig_case, folder);
  const auto result =
      nlohmann::json::parse(base::IfWhole(base::ReadFile(folder / rigs::kResultFile)).value_or(""));
  ScalarList scalars{output.scalars};
  scalars.Add("num_left_domain", result.at("num_left_domain").get<double>(), "-");
  scalars.Add("simulated_time_s", result.at("simulated_time_s").get<double>(), "s");
  for (const auto& [name, value] : result.at("energies").items()) {
    scalars.Add(name, value.get<double>(), "J");
  }
  AddSeries(folder / "series.csv", scalars);
  return output;
}

}  // namespace talus::analysis
