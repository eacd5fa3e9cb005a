// A calibrated set as another DEM code is given it: what the codes share, and what holds only
// together. card_text.h writes it in each code's own lines and conventions.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "engine/laws/material.h"
#include "engine/laws/material_pair.h"
#include "engine/laws/pair_constants.h"
#include "experiments/rigs/case/case.h"

namespace talus::analysis {

struct CardMaterial {
  std::string name;           // "powder", "tube", "plate"; where tests differ "plate of drum"
  engine::Material material;  // surface energy as used, after the coarse graining (C1)
  int body = 0;               // rigs::kPowder, kWalls or kFloor
};

// A calibrated parameter with its range, SI.
struct CardRange {
  std::string name;
  std::string unit;
  double value = 0;
  double low = base::kNotKnown;  // NaN: of one draw, which has none
  double high = base::kNotKnown;
  std::string prior{};  // as the spec gives it: "0.35 ± 0.05"; empty: none
};

// A class of the grains as they are simulated.
struct CardSize {
  double diameter = 0;      // [m]
  double volume_share = 0;  // of all grains; the classes' sum is 1
};

// A bulk test that the set comes from.
struct CardTest {
  std::string name;
  rigs::RigOptions rig;  // the lifted tube's own keys among them
  // What tube (or walls) and plate (or floor) are of, in the card's materials; 0: of the powder's.
  std::size_t tube = 0;
  std::size_t plate = 0;
};

struct CardPlaceholder {
  std::string name;
  std::string value;  // SI, with all digits
};

// Another engine's deck that a set was calibrated with (card_deck.h).
struct CardDeck {
  std::string command;
  std::string templates;                        // their folder
  std::vector<CardPlaceholder> placeholders{};  // of what was calibrated
  std::vector<CardPlaceholder> given{};         // what they hold together with
};

struct Card {
  std::string title;
  // The powder first; walls only where they act on it otherwise than its grains, and differ from
  // those of the tests before.
  std::vector<CardMaterial> materials;
  std::vector<engine::MaterialPair> pairs;  // what pairs of these state themselves
  engine::ContactModels models;
  double scale_factor = 1;           // f [-]
  double surface_energy_given = 0;   // γ before the coarse graining [J/m²]
  double mean_diameter = 0;          // of the simulated grains, D50 [m]
  double time_step = 0;              // [s]
  double gravity = 9.81;             // [m/s²]
  std::vector<CardSize> sizes{};     // the finest first
  std::vector<CardTest> tests{};     // one at least
  std::vector<CardRange> ranges{};   // none for a lone case
  std::vector<std::string> notes{};  // of the campaign: what is doubtful
  bool is_calibrated = true;         // not a case as it is
  std::optional<CardDeck> deck{};    // its values are the deck's, and our laws say nothing of them
};

Card CardOf(const rigs::Case& rig_case);

// The card of a campaign's folder (its recommended set, at the scale factor that it holds for) or
// of a case.json. Throws ConfigError when the campaign has no result yet.
Card ReadCard(const std::filesystem::path& path);

// The material as it acts on another: with what their pair states in place of its own. Two grains
// act on each other as ActingOn(card, 0, 0).
engine::Material ActingOn(const Card& card, std::size_t material, std::size_t other);

enum class CardFormat { kTable, kJson, kLethe, kLiggghts, kLammps, kYade, kMercuryDpm };

// A set of the posterior as a card, and what share of the posterior it stands for.
struct DrawCard {
  Card card;
  double weight = 0;
};

// Cards along the posterior of a campaign's folder, of so many sets (predict/draws.h); their values
// have no ranges. Throws as ReadCard does, and base::Error where there are too few trials.
std::vector<DrawCard> ReadDrawCards(const std::filesystem::path& folder, int count);

// Writes each card in each of the formats, and draws.csv with the weights and the sets.
void WriteDrawCards(const std::vector<DrawCard>& cards, const std::vector<CardFormat>& formats,
                    const std::filesystem::path& folder);

// A grain of the powder, of the mean diameter, pressed by ten times its weight against another or a
// wall: where a code takes a constant for what grows with the load in ours.
struct TypicalContact {
  engine::PairConstants pair;
  double grain_radius = 0;      // R [m]
  double r_star = 0;            // R/2, at a wall R [m]
  double m_star = 0;            // m/2, at a wall m [kg]
  double radius = 0;            // of the contact, s = √(R*δ) [m]
  double normal_stiffness = 0;  // k_n [N/m] (N1)
};
enum class Against { kGrain, kWall };
TypicalContact TypicalContactOf(const Card& card, const engine::PairConstants& pair,
                                Against against);
// The contact of two grains of the powder.
TypicalContact TypicalContactOf(const Card& card);

// C_r/R*² there [kg/s] (R3), by `stiffness`, k_r/R*² [N/m], and η_r.
double RollingDissipation(const TypicalContact& typical, double stiffness, double damping);

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
