// The card for people and for scripts, and what the codes' cards share.
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {

std::string CardNumber(double value) { return base::ShortNumber(value, 6); }

std::string CardHead(const Card& card, const std::string& code, const std::string& mark) {
  std::ostringstream text;
  text << mark << base::OneLine(card.title) << ", calibrated with talus, for " << code
       << ". SI units.\n"
       << mark << "Holds together with: scale factor " << CardNumber(card.scale_factor)
       << " (grains of " << CardNumber(card.mean_diameter * 1e3)
       << " mm, D50), Young's modulus as below, time step up to " << CardNumber(card.time_step)
       << " s,\n"
       << mark << "tube of " << CardNumber(card.tube_inner_diameter * 1e3) << " mm lifted at "
       << CardNumber(card.lift_velocity * 1e3) << " mm/s off a plate of "
       << CardNumber(card.plate_diameter * 1e3) << " mm.\n";
  if (card.surface_energy_given > 0) {
    text << mark << "Surface energy: " << CardNumber(card.materials[0].material.surface_energy)
         << " J/m2 is used at this scale factor for " << CardNumber(card.surface_energy_given)
         << " J/m2 of the powder.\n";
  }
  for (const std::string& note : card.notes)
    text << mark << "Warning: " << base::OneLine(note) << '\n';
  return text.str();
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

std::string TableCard(const Card& card) {
  std::ostringstream text;
  text << CardHead(card, "any code (definitions: docs/physics.md)", "");
  for (const CardRange& r : card.ranges) {
    text << "  " << r.name << " = " << CardNumber(r.value) << ' ' << r.unit
         << ", 90 %: " << CardNumber(r.low) << " ... " << CardNumber(r.high) << '\n';
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
                              {"time_step_s", card.time_step},
                              {"lift_velocity_m_per_s", card.lift_velocity},
                              {"plate_diameter_m", card.plate_diameter},
                              {"tube_inner_diameter_m", card.tube_inner_diameter},
                              {"models", base::ToJson(card.models)},
                              {"mixing", "harmonic mean 2ab/(a+b)"}};
  for (const CardMaterial& m : card.materials) json["materials"][m.name] = base::ToJson(m.material);
  for (const engine::MaterialPair& pair : card.pairs) {
    nlohmann::ordered_json stated = base::ToJson(pair.stated);
    stated["between"] = {card.materials[pair.first].name, card.materials[pair.second].name};
    json["pairs"].push_back(std::move(stated));
  }
  for (const CardRange& r : card.ranges) {
    json["parameters"].push_back({{"name", r.name},
                                  {"unit", r.unit},
                                  {"value", r.value},
                                  {"low_90", base::ToJson(r.low)},
                                  {"high_90", base::ToJson(r.high)}});
  }
  json["warnings"] = card.notes;
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::analysis
