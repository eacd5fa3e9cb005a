// A calibrated set as another DEM code is given it: what the codes share, and what holds only
// together. card_text.h writes it in each code's own lines and conventions.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/field.h"
#include "engine/laws/material.h"
#include "engine/laws/material_pair.h"
#include "engine/laws/pair_constants.h"
#include "experiments/rigs/case/case.h"

namespace talus::analysis {

struct CardMaterial {
  std::string name;           // "powder", "tube", "plate"
  engine::Material material;  // surface energy as used, after the coarse graining (C1)
};

// A calibrated parameter with its range, SI.
struct CardRange {
  std::string name;
  std::string unit;
  double value = 0;
  double low = 0;
  double high = 0;
};

struct Card {
  std::string title;
  std::vector<CardMaterial> materials;  // the powder first; walls only where they differ from it
  std::vector<engine::MaterialPair> pairs;  // what pairs of these state themselves
  engine::ContactModels models;
  double scale_factor = 1;           // f [-]
  double surface_energy_given = 0;   // γ before the coarse graining [J/m²]
  double mean_diameter = 0;          // of the simulated grains, D50 [m]
  double time_step = 0;              // [s]
  double gravity = 9.81;             // [m/s²]
  double lift_velocity = 0;          // [m/s]
  double plate_diameter = 0;         // [m]
  double tube_inner_diameter = 0;    // [m]
  std::vector<CardRange> ranges{};   // none for a lone case
  std::vector<std::string> notes{};  // of the campaign: what is doubtful
};

Card CardOf(const rigs::Case& rig_case);

// The card of a campaign's folder (its recommended set, at the scale factor that it holds for) or
// of a case.json. Throws ConfigError when the campaign has no result yet.
Card ReadCard(const std::filesystem::path& path);

// The material as it acts on another: with what their pair states in place of its own. Two grains
// act on each other as ActingOn(card, 0, 0).
engine::Material ActingOn(const Card& card, std::size_t material, std::size_t other);

// Two grains of the powder, of the mean diameter, pressed together by ten times a grain's weight:
// where a code takes a constant for what grows with the load in ours.
struct TypicalContact {
  engine::PairConstants pair;
  double r_star = 0;            // [m]
  double m_star = 0;            // [kg]
  double normal_stiffness = 0;  // k_n [N/m] (N1)
};
TypicalContact TypicalContactOf(const Card& card);

enum class CardFormat { kTable, kJson, kLethe, kLiggghts, kLammps, kYade, kMercuryDpm };
std::string CardText(const Card& card, CardFormat format);

}  // namespace talus::analysis

template <>
struct talus::base::Names<talus::analysis::CardFormat> {
  using enum talus::analysis::CardFormat;
  static constexpr std::array kList{
      std::pair{"table", kTable},          std::pair{"json", kJson},     std::pair{"lethe", kLethe},
      std::pair{"liggghts", kLiggghts},    std::pair{"lammps", kLammps}, std::pair{"yade", kYade},
      std::pair{"mercurydpm", kMercuryDpm}};
};
