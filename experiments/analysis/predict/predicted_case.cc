#include "experiments/analysis/predict/predicted_case.h"

#include <algorithm>

#include "base/json/json_file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/key_text.h"
#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/analysis/predict/affordable.h"
#include "experiments/analysis/predict/scene_engine.h"
#include "experiments/campaign/spec/deck_gaps.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/load_case.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using campaign::JointView;

// What the file says of contact laws must be what the set was calibrated with.
void RefuseOtherLaws(const JointView& view, const base::JsonFile& file, base::Problems& problems) {
  const auto given = file.root.find("models");
  if (given == file.root.end() || !given->is_object()) return;
  const nlohmann::json calibrated = base::ToJson(view.spec.models);
  for (const auto& [key, value] : given->items()) {
    const auto law = calibrated.find(key);
    if (law == calibrated.end() || *law == value) continue;
    problems.Add("models." + key, "is " + base::JsonText(value) +
                                      ", but the set was calibrated with " + base::JsonText(*law) +
                                      " and holds with that only; leave it out");
  }
}

// Walls are the case's own, unless the campaign has searched what they are made of.
void RefuseFixedWalls(const JointView& view, const base::JsonFile& file, const rigs::Case& given) {
  base::Problems problems(file.path.string(), file.places);
  const auto has = [](const auto& stated, const std::string& property) {
    return base::ToJson(stated).contains(property);
  };
  for (const journal::ParameterRecord& p : view.record.parameters) {
    const auto [body, is_pair, property] = campaign::PlaceOf(p.name);
    if (body == rigs::kPowder) continue;
    const auto& wall = body == rigs::kFloor ? given.materials.floor : given.materials.walls;
    const bool fixed =
        is_pair ? has(rigs::StatedWith(given.pairs, body), property) : wall && has(*wall, property);
    const std::string place =
        is_pair ? "pairs" : std::string("device.") + rigs::kBodyNames[body] + "_material";
    problems.Require(!fixed, place + "." + property,
                     "is fixed here, but the campaign has calibrated it as " + p.name +
                         "; leave it out, and the draws give it");
  }
  problems.ThrowIfAny();
}

// What tells two distributions apart: "D50 0.4 mm instead of D50 1 mm".
std::string OtherSizes(const engine::SizeDistribution& taken, const engine::SizeDistribution& own) {
  for (const int percent : {50, 10, 90}) {
    const auto text = [&](const engine::SizeDistribution& sizes) {
      return "D" + std::to_string(percent) + " " +
             base::ShortNumber(1e3 * engine::SizeCurve(sizes).VolumeQuantile(percent / 100.0)) +
             " mm";
    };
    if (text(taken) != text(own)) return text(taken) + " instead of " + text(own);
  }
  return "its size distribution";
}

// What the file states of its material and the campaign's powder has otherwise, but for what was
// searched: "density 1500 kg/m3 instead of 2500".
std::vector<std::string> OtherProperties(const JointView& view, const base::JsonFile& file,
                                         const engine::Material& own) {
  // With what the parameters fix.
  const nlohmann::json taken = base::ToJson(
      campaign::TypicalCase(view.spec, 0, view.spec.coarse_graining.Target()).powder.material);
  const nlohmann::json::json_pointer stated("/powder/material");
  std::vector<std::string> texts;
  engine::Material::Visit(own, [&](const std::string& key, double value, base::FieldInfo info) {
    const bool is_searched =
        std::ranges::count(view.record.parameters, key, &journal::ParameterRecord::name) > 0;
    if (is_searched || !file.root.contains(stated / key) || taken[key] == value) return;
    const std::string unit(base::SiUnit(info.dimension));
    texts.push_back(base::Spaced(key) + " " + base::WithUnit(taken[key].get<double>(), unit) +
                    " instead of " + base::ShortNumber(value));
  });
  return texts;
}

// The file has a powder of its own because `talus simulate` needs one.
void NotePowder(const JointView& view, const base::JsonFile& file, const rigs::Powder& own,
                PredictedCase& predicted) {
  const rigs::Powder& powder = view.spec.powder;
  std::string differs;
  const auto note = [&](const std::string& text) {
    differs += (differs.empty() ? "" : ", ") + text;
  };
  if (base::ToJson(own.sizes) != base::ToJson(powder.sizes)) {
    note(OtherSizes(powder.sizes, own.sizes));
  }
  for (const std::string& text : OtherProperties(view, file, own.material)) note(text);
  if (differs.empty()) return;
  predicted.notes.push_back("the powder is the campaign's (" + differs +
                            "); of the file's own only its mass counts, " +
                            base::ShortNumber(1e3 * own.mass) + " g");
}

void TakePowder(const JointView& view, rigs::Case& rig_case) {
  const double mass = rig_case.powder.mass;
  rig_case.powder = view.spec.powder;
  rig_case.powder.mass = mass;
  rig_case.models = view.spec.models;
  std::erase_if(rig_case.pairs, [](const engine::PairSpec& pair) {
    return rigs::PartnerOf(pair) == rigs::kPowder;
  });
  const std::vector<engine::PairSpec> of_grains = PairsOfGrains(view);
  rig_case.pairs.insert(rig_case.pairs.end(), of_grains.begin(), of_grains.end());
  rig_case.coarse_graining.surface_energy_exponent =
      view.spec.coarse_graining.surface_energy_exponent;
  rig_case.threads = view.spec.threads;
}

// What the deck is not told it takes as it stands: another rig would be the campaign's own again.
void CheckDeck(const JointView& view, const base::JsonFile& file, PredictedCase& predicted) {
  const campaign::DeckGap gap = campaign::DeckGapOf(view.spec, predicted.rig_case);
  if (gap.untold.empty()) return;
  const std::string lacks = "the engine's templates have no " + gap.untold +
                            ", in which it differs from \"" + gap.experiment + "\": ";
  if (gap.is_other_rig) {
    throw base::ConfigError(file.path.string() + ": " + lacks +
                            "they would simulate that again; it takes a campaign whose templates "
                            "are told (calibrate --reuse)");
  }
  predicted.notes.push_back(lacks + "it is simulated with those of that test");
}

void ReadRigCase(const JointView& view, const base::JsonFile& file,
                 std::optional<double> scale_factor, const RunBudget& budget,
                 PredictedCase& predicted) {
  rigs::Case& rig_case = predicted.rig_case;
  rig_case = rigs::LoadCase(file);
  RefuseFixedWalls(view, file, rig_case);
  const auto graining = file.root.find("coarse_graining");
  if (!scale_factor && graining != file.root.end() && graining->contains("scale_factor")) {
    scale_factor = rig_case.coarse_graining.scale_factor;
  }
  predicted.states_scale_factor = scale_factor.has_value();
  NotePowder(view, file, rig_case.powder, predicted);
  TakePowder(view, rig_case);
  if (!file.root.contains("rayleigh_fraction")) {
    rig_case.rayleigh_fraction = view.spec.rayleigh_fraction;
  }
  // Any set of the ranges will do for what a powder's sizes and a vessel say.
  rig_case = CaseWith(view, predicted,
                      view.space.ToNative(Eigen::VectorXd::Constant(
                          static_cast<Eigen::Index>(view.space.Free().size()), 0.5)),
                      view.spec.seed);
  rig_case.coarse_graining.scale_factor =
      scale_factor ? *scale_factor : AffordableScale(view, rig_case, budget);
  RequireSimulable(predicted, rig_case.coarse_graining.scale_factor);
  CheckDeck(view, file, predicted);
}

}  // namespace

PredictedCase ReadPredictedCase(const JointView& view, const fs::path& path,
                                std::optional<double> scale_factor, int num_runs,
                                double core_time) {
  const base::JsonFile file = base::ReadJsonFile(path);
  PredictedCase predicted{
      .file = path, .name = path.stem().string(), .rig_case = {}, .scene_text = {}, .notes = {}};
  base::Problems problems(path.string(), file.places);
  const bool is_case = file.root.is_object() && file.root.contains("powder");
  problems.Require(is_case || (file.root.is_object() && file.root.contains("materials")), "",
                   "is neither a case of a bulk test (it has \"powder\") nor a scene (it has "
                   "\"materials\")");
  if (is_case) {
    problems.Require(!file.root.contains("engine"), "engine",
                     "is of another engine's case; leave it out, and the campaign's own engine "
                     "simulates it");
  }
  if (problems.empty()) RefuseOtherLaws(view, file, problems);
  problems.ThrowIfAny();
  if (is_case) {
    ReadRigCase(view, file, scale_factor, {.num_runs = num_runs, .core_time = core_time},
                predicted);
  } else {
    ReadScene(view, file, scale_factor, predicted);
    if (view.spec.engine.kind == campaign::EngineKind::kCommand) {
      predicted.notes.emplace_back(
          "simulated by talus itself, but the sets were calibrated with another engine: parameters "
          "of one name need not mean the same");
    }
    predicted.states_scale_factor = true;  // by its grains
  }
  return predicted;
}

void RequireSimulable(const PredictedCase& predicted, double scale_factor) {
  if (!predicted.scene_text.empty()) return;
  rigs::Case rig_case = predicted.rig_case;
  rig_case.coarse_graining.scale_factor = scale_factor;
  base::Problems problems(predicted.file.string() + " with the campaign's powder at scale factor " +
                              base::ShortNumber(scale_factor),
                          {});
  rigs::ValidateCase(rig_case, problems);
  problems.ThrowIfAny();
}

std::string TestText(const PredictedCase& predicted) {
  if (!predicted.scene_text.empty()) return predicted.scene_text;
  rigs::Case rig_case = predicted.rig_case;
  rig_case.frame.reset();
  return rigs::CaseText(rig_case);
}

std::string FrameText(const PredictedCase& predicted) {
  const auto& frame = predicted.rig_case.frame;
  return frame ? base::JsonText(base::ToJson(*frame)) : "";
}

std::vector<engine::PairSpec> PairsOfGrains(const JointView& view) {
  std::vector<engine::PairSpec> pairs = view.spec.pairs;
  std::erase_if(
      pairs, [](const engine::PairSpec& pair) { return rigs::PartnerOf(pair) != rigs::kPowder; });
  return pairs;
}

rigs::Case CaseWith(const JointView& view, const PredictedCase& predicted,
                    std::span<const double> values, std::uint64_t seed) {
  rigs::Case rig_case = predicted.rig_case;
  for (std::size_t i = 0; i < view.space.parameters.size(); ++i) {
    const optimizer::Parameter& p = view.space.parameters[i];
    // What the campaign holds of its own walls says nothing of the case's, nor how much powder its
    // tests take.
    if (p.fixed && campaign::PlaceOf(p.name).body != rigs::kPowder) continue;
    if (p.name == "mass" || p.name == "fill") continue;
    campaign::SetParameter(rig_case, p.name, values[i]);
  }
  rig_case.seed = seed;
  return rig_case;
}

}  // namespace talus::analysis
