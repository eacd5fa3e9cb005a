// LAMMPS, pair_style granular. Converted:
//   restitution  `damping tsuji` damps by α(e) √(m* k_n) with a polynomial α; ours is √5 β(e) (N3).
//                It is given the e that makes both equal (0.481 for 0.6).
//   tangential   damped by a share of the normal dashpot: η_t/η_n = √(k_t/(3/2 k_n)) = 2√(G*/Y*)
//   rolling      sds has constants where EPSD grows with the load: k_roll = k_r/R*² = 2.25 k_n μ_r²
//                and γ_roll = C_r/R*², at the typical contact. The limit μ_r |F_n| R* is the same.
//   γ            4πγR* of two equal surfaces in LAMMPS is 2πγ* R* here, so γ*/2 is given.
//   walls        LAMMPS of 2022 makes E* = E/(2(1-ν)) of a wall's values and another spring of
//                `mindlin NULL`. With 2Y* and ν = 0, and 8 G* in place of NULL, every version has
//                ours.
// All this is for Debian's LAMMPS of 2022. Later ones refuse tsuji with adhesion, and that of
// 2 September 2026 damps √2 as much by it; a line for them stands beside.
#include <cmath>
#include <sstream>

#include "base/text/name.h"
#include "base/text/number_text.h"
#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {
namespace {

constexpr double kLeastTsuji = 0.01;         // LAMMPS takes what is above 0
constexpr double kLeastRestitution = 0.126;  // what it rebounds with then: √5 β(e) = α(0.01)

struct PairInput {
  const engine::Material& a;
  const engine::Material& b;
  TypicalContact typical;  // with the pair's constants
  Against against;
};

// The LAMMPS that a line is for.
enum class Version { kOf2022, kLater };

// What is given as the damping of the normal model, and the model that takes it.
struct Damping {
  double value = 0;
  const char* model = "tsuji";
};

// coeff_restitution is √5 β(e) itself. viscoelastic is η₀ s m*, which is ours at the typical
// contact.
Damping DampingOf(const PairInput& input, Version version) {
  const double restitution = engine::HarmonicMean(input.a.restitution, input.b.restitution);
  if (version == Version::kOf2022) return {TsujiRestitution(restitution), "tsuji"};
  if (!(input.typical.pair.surface_energy > 0)) return {restitution, "coeff_restitution"};
  return {
      input.typical.pair.normal_damping / std::sqrt(input.typical.radius * input.typical.m_star),
      "viscoelastic"};
}

std::string NormalModel(const Card& card, const PairInput& input, const Damping& damping) {
  const bool adhesive = input.typical.pair.surface_energy > 0;
  const std::string model = !adhesive                                        ? "hertz/material "
                            : card.models.adhesion == engine::Adhesion::kDmt ? "dmt "
                                                                             : "jkr ";
  const double poisson = input.against == Against::kWall ? 0 : input.a.poisson_ratio;
  const double modulus = 2 * (1 - poisson * poisson) * input.typical.pair.y_star;
  std::string text =
      model + CardNumber(modulus) + " " + CardNumber(damping.value) + " " + CardNumber(poisson);
  if (adhesive) text += " " + CardNumber(input.typical.pair.surface_energy / 2);
  return text;
}

std::string RollingModel(const Card& card, const PairInput& input) {
  if (card.models.rolling != engine::Rolling::kEpsd) return "rolling none";
  const double friction = input.typical.pair.rolling_friction;
  const double k_roll = 2.25 * input.typical.normal_stiffness * friction * friction;
  const double damping = engine::HarmonicMean(input.a.rolling_damping, input.b.rolling_damping);
  return "rolling sds " + CardNumber(k_roll) + " " +
         CardNumber(RollingDissipation(input.typical, k_roll, damping)) + " " +
         CardNumber(friction);
}

// The law of a grain of material a against another, or a wall, of material b.
std::string PairModel(const Card& card, const engine::Material& a, const engine::Material& b,
                      Against against, Version version) {
  const engine::PairConstants pair = engine::MakePairConstants(a, b, card.models);
  const PairInput input{a, b, TypicalContactOf(card, pair, against), against};
  const std::string spring =
      against == Against::kWall ? CardNumber(pair.shear_stiffness) : "NULL";  // 8 G*
  const double dashpot = 2 * std::sqrt(pair.shear_stiffness / 8 / pair.y_star);
  const Damping damping = DampingOf(input, version);
  return NormalModel(card, input, damping) + " tangential mindlin " + spring + " " +
         CardNumber(dashpot) + " " + CardNumber(pair.sliding_friction) + " " +
         RollingModel(card, input) + " damping " + damping.model;
}

// The pair's line for a LAMMPS in which the other is refused or means something else.
std::string LaterLine(const Card& card, const engine::Material& grain) {
  const bool adhesive = engine::MakePairConstants(grain, grain, card.models).surface_energy > 0;
  return (adhesive
              ? "# LAMMPS since 2023 refuses `damping tsuji` with adhesion. There the dashpot of a "
                "contact that bears\n# ten grain weights, at walls as they say:\n"
              : "# LAMMPS of 2 September 2026 and later damps more by `damping tsuji`. There, "
                "at walls as they say:\n") +
         std::string("# pair_coeff * * ") +
         PairModel(card, grain, grain, Against::kGrain, Version::kLater) + "\n";
}

// "fix plate2 all wall/gran/region granular … region plate2", of a body of this material, and the
// line for later versions below.
std::string WallLaw(const Card& card, const std::string& id, std::size_t wall) {
  const auto line = [&](Version version) {
    return "fix " + id + " all wall/gran/region granular " +
           PairModel(card, ActingOn(card, 0, wall), ActingOn(card, wall, 0), Against::kWall,
                     version) +
           " region " + id + "\n";
  };
  return line(Version::kOf2022) + "#   later: " + line(Version::kLater);
}

// Tube and plate of the lifted tube, ready to be uncommented.
std::string LammpsTube(const Card& card, const CardTest& test) {
  const std::string mark = TestMark(card, test);
  const rigs::LiftedTubeOptions& device = test.rig.lifted_tube;
  const std::string radius = CardNumber(device.tube_inner_diameter / 2);
  const std::string height = CardNumber(20 * device.tube_inner_diameter);
  const std::string moves = " move v_rest" + mark + " v_rest" + mark + " v_lift" + mark;
  return "# Walls of " + (card.tests.size() == 1 ? "that test" : base::OneLine(test.name)) +
         " (plate top at z = 0; the tube is lifted from time 0 on):\n# variable rest" + mark +
         " equal 0\n# variable lift" + mark + " equal time*" + CardNumber(device.lift_velocity) +
         "\n# region tube" + mark + " cylinder z 0 0 " + radius + " 0 " + height +
         " side in open 1 open 2" + moves + "\n# region plate" + mark + " cylinder z 0 0 " +
         CardNumber(device.plate_diameter / 2) + " -" + CardNumber(device.plate_height) +
         " 0 side out\n# " + WallLaw(card, "tube" + mark, test.tube) + "# " +
         WallLaw(card, "plate" + mark, test.plate);
}

// Rigs other than the lifted tube have the laws of their walls alone.
std::string LammpsWalls(const Card& card) {
  std::string text;
  for (const CardTest& test : card.tests) {
    if (test.rig.kind == rigs::RigKind::kLiftedTube) {
      text += LammpsTube(card, test);
      continue;
    }
    const std::string mark = TestMark(card, test);
    text += "# walls of " + (card.tests.size() == 1 ? "the vessel" : base::OneLine(test.name)) +
            ": " + WallLaw(card, "tube" + mark, test.tube) +
            "# floor: " + WallLaw(card, "plate" + mark, test.plate);
  }
  return text;
}

// `fix pour` counts grains: a class of volume share s has s/d³ of them, in proportion. It refuses
// shares that do not sum to 1 as they are written, so the largest is what the others leave.
std::vector<std::string> NumberShares(const Card& card) {
  double total = 0;
  for (const CardSize& s : card.sizes) total += s.volume_share / std::pow(s.diameter, 3);
  std::vector<std::string> shares;
  std::size_t largest = 0;
  for (const CardSize& s : card.sizes) {
    shares.push_back(CardNumber(s.volume_share / std::pow(s.diameter, 3) / total));
    if (std::stod(shares.back()) > std::stod(shares[largest])) largest = shares.size() - 1;
  }
  double left = 1;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (i != largest) left -= std::stod(shares[i]);
  }
  shares[largest] = base::ShortNumber(left, 15);
  return shares;
}

std::string LammpsSizes(const Card& card) {
  const std::vector<std::string> shares = NumberShares(card);
  std::string text = "# grains: fix ID all pour NUMBER 1 SEED region ID diam poly " +
                     std::to_string(card.sizes.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    text += " " + CardNumber(card.sizes[i].diameter) + " " + shares[i];
  }
  const std::string density = CardNumber(card.materials.front().material.density);
  return text + " dens " + density + " " + density + "\n";
}

// Nothing that `damping tsuji` is given damps as much as a very low restitution asks for.
std::string RestitutionRemarks(const Card& card) {
  std::string text;
  for (std::size_t i = 0; i < card.materials.size(); ++i) {
    const double restitution =
        engine::HarmonicMean(ActingOn(card, 0, i).restitution, ActingOn(card, i, 0).restitution);
    if (restitution >= kLeastRestitution) continue;
    text += "# NOT INCLUDED: the restitution of " + CardNumber(restitution) +
            " between powder and " + (i == 0 ? "itself" : card.materials[i].name) +
            ". `damping tsuji` ends at " + CardNumber(kLeastRestitution) + ", which stands here.\n";
  }
  return text;
}

std::string LammpsRemarks(const Card& card) {
  std::string text = RestitutionRemarks(card);
  if (card.models.adhesion == engine::Adhesion::kDmt) {
    text +=
        "# The limits of sliding and rolling are of the net force in LAMMPS of 2022, of that and "
        "twice the pull in\n# later ones, of the elastic force in talus. Adhesion acts in contact "
        "only.\n";
  } else if (card.models.adhesion == engine::Adhesion::kJkr) {
    text +=
        "# LAMMPS pulls beyond touch, up to 1.5 pi gamma* R*, and its dashpot and its tangential "
        "spring go with the radius of the JKR contact:\n# slow collisions stick, or rebound less, "
        "where they rebound in talus. NOT USABLE at walls in LAMMPS of\n# 29 September 2021 "
        "(Debian 12): a grain that lets go of a jkr wall is at nan from then on. Take dmt for the "
        "walls,\n# or a later LAMMPS.\n";
    if (card.models.jkr_rolling_limit == engine::JkrRollingLimit::kNetForce) {
      text += "# Adhesion raises the limit of rolling in LAMMPS, not in talus.\n";
    }
  }
  if (card.models.rolling == engine::Rolling::kEpsd) {
    text +=
        "# rolling sds: stiffness and damping of a contact that bears ten grain weights, which do "
        "not grow with the load;\n# its limit caps spring and dashpot together. After a grazing "
        "impact a grain spins up to a half faster than in talus.\n";
  } else if (card.models.rolling != engine::Rolling::kNone) {
    text += RollingNotIncluded(card, "LAMMPS", "# ");
  }
  return text;
}

}  // namespace

double TsujiAlpha(double e) {
  return 1.2728 +
         e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

// α falls from e = 0 to 1, so bisection finds it; e = 1 asks for no damping, which α(1) = 0.0005
// nearly has.
double TsujiRestitution(double restitution) {
  const double wanted = std::sqrt(5.0) * engine::DampingRatio(restitution);
  double low = kLeastTsuji;
  double high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (TsujiAlpha(middle) > wanted ? low : high) = middle;
  }
  return high;
}

std::string LammpsCard(const Card& card) {
  std::ostringstream text;
  text << CardHead(card, "LAMMPS (package GRANULAR)", "# ") << LammpsRemarks(card)
       << "# density: " << CardNumber(card.materials[0].material.density) << " kg/m3\n"
       << "# restitution is the input of `damping tsuji` that rebounds with "
       << CardNumber(ActingOn(card, 0, 0).restitution) << "\n"
       << "pair_style granular\n";
  const engine::Material grain = ActingOn(card, 0, 0);
  text << "pair_coeff * * " << PairModel(card, grain, grain, Against::kGrain, Version::kOf2022)
       << "\n"
       << LaterLine(card, grain) << LammpsWalls(card) << LammpsSizes(card);
  text << "timestep " << CardNumber(card.time_step) << "\n";
  return text.str();
}

}  // namespace talus::analysis
