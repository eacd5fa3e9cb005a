// The card for people and for scripts, and what the codes' cards share.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "experiments/analysis/card/card_formats.h"
#include "experiments/analysis/card/card_json.h"
#include "experiments/rigs/case/device_text.h"

namespace talus::analysis {

std::string CardNumber(double value) { return base::ShortNumber(value, 6); }

std::string CardRangeText(const CardRange& range) {
  if (!std::isfinite(range.low)) return "";
  return ", 90 %: " + CardNumber(range.low) + " ... " + CardNumber(range.high) +
         (range.prior.empty() ? "" : " (prior " + base::OneLine(range.prior) + ")");
}

nlohmann::ordered_json RangesJson(const Card& card) {
  nlohmann::ordered_json ranges;
  for (const CardRange& r : card.ranges) {
    ranges.push_back({{"name", r.name},
                      {"unit", r.unit},
                      {"value", r.value},
                      {"low_90", base::ToJson(r.low)},
                      {"high_90", base::ToJson(r.high)}});
    if (!r.prior.empty()) ranges.back()["prior"] = r.prior;
  }
  return ranges;
}

nlohmann::ordered_json TestJson(const CardTest& test) {
  nlohmann::ordered_json json{{"name", test.name}, {"rig", base::ToJson(test.rig)}};
  if (test.rig.kind == rigs::RigKind::kLiftedTube) {
    json["device"] = base::ToJson(test.rig.lifted_tube);
  }
  return json;
}

std::string TestText(const CardTest& test) {
  const std::string name = base::OneLine(test.name);
  if (test.rig.kind == rigs::RigKind::kLiftedTube) {
    const rigs::LiftedTubeOptions& tube = test.rig.lifted_tube;
    return name + ": tube of " + CardNumber(tube.tube_inner_diameter * 1e3) + " mm lifted at " +
           CardNumber(tube.lift_velocity * 1e3) + " mm/s off a plate of " +
           CardNumber(tube.plate_diameter * 1e3) + " mm";
  }
  return name + ", " + rigs::DeviceText(test.rig);
}

namespace {

// What differs from the published model, which the codes have.
std::string JkrText(const engine::ContactModels& models, const std::string& mark) {
  std::string text;
  if (models.adhesion != engine::Adhesion::kJkr) return text;
  if (models.jkr_rolling_limit == engine::JkrRollingLimit::kFromPullOff) {
    text += mark +
            "Rolling was bounded by the normal force above the pull-off, not by the net one "
            "(docs/physics.md, A6).\n";
  }
  if (models.jkr_sliding_spring == engine::JkrSlidingSpring::kShortened) {
    text += mark + "The tangential spring was shortened while it slides (docs/physics.md, A7).\n";
  }
  return text;
}

}  // namespace

std::string CardHead(const Card& card, const std::string& code, const std::string& mark) {
  std::ostringstream text;
  text << mark << base::OneLine(card.title)
       << (card.is_calibrated ? ", calibrated with talus" : ", a case of talus as it is")
       << ", for " << code << ". SI units.\n"
       << mark << "Holds together with: scale factor " << CardNumber(card.scale_factor)
       << " (grains of " << CardNumber(card.mean_diameter * 1e3)
       << " mm, D50), Young's modulus as below, gravity " << CardNumber(card.gravity)
       << " m/s2, time step up to " << CardNumber(card.time_step) << " s,\n"
       << mark << "and the tests that it comes from:\n";
  for (const CardTest& test : card.tests) text << mark << "  " << TestText(test) << "\n";
  text << mark << "Grains as simulated (diameter in mm, share of the volume):";
  for (const CardSize& size : card.sizes) {
    text << ' ' << CardNumber(size.diameter * 1e3) << " (" << CardNumber(size.volume_share) << ')';
  }
  text << '\n';
  if (card.surface_energy_given > 0) {
    text << mark << "Surface energy: " << CardNumber(card.materials[0].material.surface_energy)
         << " J/m2 is used at this scale factor for " << CardNumber(card.surface_energy_given)
         << " J/m2 of the powder.\n";
  }
  if (card.models.coulomb_limit == engine::CoulombLimit::kElasticForce) {
    text << mark << "Friction was bounded by the elastic normal force alone (docs/physics.md, T4); "
         << "most codes bound it by spring and dashpot.\n";
  }
  text << JkrText(card.models, mark);
  for (const std::string& note : card.notes)
    text << mark << "Warning: " << base::OneLine(note) << '\n';
  return text.str();
}

std::string RollingNotIncluded(const Card& card, const std::string& code, const std::string& mark) {
  return mark + "NOT INCLUDED: the " + std::string(base::NameOf(card.models.rolling)) +
         " rolling resistance, which " + code + " has not.\n";
}

std::string TestMark(const Card& card, const CardTest& test) {
  const auto index = &test - card.tests.data();
  return index == 0 ? "" : std::to_string(index + 1);
}

namespace {

// "powder and plate: sliding_friction = 0.25".
std::string StatedText(const Card& card, const engine::MaterialPair& pair) {
  std::string text = card.materials[pair.first].name + " and " +
                     (pair.first == pair.second ? "itself" : card.materials[pair.second].name) +
                     ":";
  const char* separator = " ";
  engine::PairProperties::Visit(
      pair.stated, [&](std::string_view key, const std::optional<double>& value, base::FieldInfo) {
        if (!value) return;
        text += separator + std::string(key) + " = " + CardNumber(*value);
        separator = ", ";
      });
  return text;
}

}  // namespace

std::string PairsNotIncluded(const Card& card, int first_material, const std::string& mark) {
  std::string text;
  for (const engine::MaterialPair& pair : card.pairs) {
    if (pair.second < first_material) continue;
    text += mark + "NOT INCLUDED: what a pair states itself, " + StatedText(card, pair) + "\n";
  }
  return text;
}

std::string WallsNotIncluded(const Card& card, const std::string& mark) {
  const nlohmann::ordered_json powder = base::ToJson(card.materials.front().material);
  std::string text;
  for (std::size_t i = 1; i < card.materials.size(); ++i) {
    std::string differs;
    const nlohmann::ordered_json wall = base::ToJson(card.materials[i].material);
    for (const auto& [key, value] : wall.items()) {
      if (value == powder[key]) continue;
      differs += (differs.empty() ? ": " : ", ") + key + " = " + CardNumber(value.get<double>());
    }
    if (!differs.empty()) text += mark + "NOT INCLUDED: " + card.materials[i].name + differs + "\n";
  }
  return text;
}

std::string TableCard(const Card& card) {
  std::ostringstream text;
  text << CardHead(card, "any code (definitions: docs/physics.md)", "");
  for (const CardRange& r : card.ranges) {
    text << "  " << r.name << " = " << CardNumber(r.value) << ' ' << r.unit << CardRangeText(r)
         << '\n';
  }
  for (const CardMaterial& m : card.materials) {
    text << "  " << m.name << '\n';
    const nlohmann::ordered_json json = base::ToJson(m.material);
    for (const auto& [key, value] : json.items()) {
      text << "    " << key << " = " << CardNumber(value.get<double>()) << '\n';
    }
  }
  for (const engine::MaterialPair& pair : card.pairs) {
    text << "  " << StatedText(card, pair) << '\n';
  }
  text << "  all other pairs: harmonic mean 2ab/(a+b) of restitution, frictions and rolling "
          "damping (P5)\n"
       << "  adhesion " << base::NameOf(card.models.adhesion) << ", rolling "
       << base::NameOf(card.models.rolling) << ", damping once fully mobilised "
       << CardNumber(card.models.full_mobilisation_damping) << '\n';
  return text.str();
}

std::string JsonCard(const Card& card) {
  nlohmann::ordered_json json{{"title", card.title},
                              {"scale_factor", card.scale_factor},
                              {"surface_energy_given_J_per_m2", card.surface_energy_given},
                              {"mean_diameter_m", card.mean_diameter},
                              {"gravity_m_per_s2", card.gravity},
                              {"time_step_s", card.time_step},
                              {"models", base::ToJson(card.models)},
                              {"mixing", "harmonic mean 2ab/(a+b)"}};
  for (const CardMaterial& m : card.materials) json["materials"][m.name] = base::ToJson(m.material);
  for (const engine::MaterialPair& pair : card.pairs) {
    nlohmann::ordered_json stated = base::ToJson(pair.stated);
    stated["between"] = {card.materials[pair.first].name, card.materials[pair.second].name};
    json["pairs"].push_back(std::move(stated));
  }
  if (!card.ranges.empty()) json["parameters"] = RangesJson(card);
  for (const CardSize& size : card.sizes) {
    json["sizes"].push_back({{"diameter_m", size.diameter}, {"volume_share", size.volume_share}});
  }
  for (const CardTest& test : card.tests) {
    nlohmann::ordered_json entry = TestJson(test);
    entry["tube_material"] = card.materials[test.tube].name;
    entry["plate_material"] = card.materials[test.plate].name;
    json["tests"].push_back(std::move(entry));
  }
  json["warnings"] = card.notes;
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::analysis
