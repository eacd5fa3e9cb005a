// LIGGGHTS-PUBLIC 3.8: hertz, history, epsd and epsd2 are (N1)–(N4), (T1), (T3), (R1)–(R4) with
// f = 0 and (R6), so that nothing is converted. The limit of (T2) caps its spring alone; the
// dashpot is added where it does not slide. Pair values are given as a matrix, as the pairs state
// them or mixed here by (P5).
#include <algorithm>
#include <sstream>

#include "base/prime.h"
#include "base/text/name.h"
#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {
namespace {

std::string PerType(const Card& card, const std::string& property, double engine::Material::*part) {
  std::string line = "fix talus_" + property + " all property/global " + property + " peratomtype";
  for (const CardMaterial& m : card.materials) line += " " + CardNumber(m.material.*part);
  return line + "\n";
}

std::string PerPair(const Card& card, const std::string& property, double engine::Material::*part) {
  std::string line = "fix talus_" + property + " all property/global " + property +
                     " peratomtypepair " + std::to_string(card.materials.size());
  for (std::size_t a = 0; a < card.materials.size(); ++a) {
    for (std::size_t b = 0; b < card.materials.size(); ++b) {
      line += " " + CardNumber(engine::HarmonicMean(ActingOn(card, a, b).*part,
                                                    ActingOn(card, b, a).*part));
    }
  }
  return line + "\n";
}

// Empty for no rolling resistance; nothing in LIGGGHTS is the viscous model.
std::string RollingModel(engine::Rolling rolling) {
  switch (rolling) {
    case engine::Rolling::kConstant:
      return " rolling_friction cdt";
    case engine::Rolling::kEpsd:
      return " rolling_friction epsd";
    case engine::Rolling::kEpsd2:
      return " rolling_friction epsd2";
    case engine::Rolling::kNone:
    case engine::Rolling::kViscous:
      return "";
  }
  return "";
}

// LIGGGHTS refuses moduli outside 5e6 to 1e9 Pa unless it is told so, and hardly any restitution.
std::string LiggghtsLimits(const Card& card) {
  const auto [softest, hardest] = std::ranges::minmax(
      card.materials, {}, [](const auto& m) { return m.material.youngs_modulus; });
  std::string text;
  if (softest.material.youngs_modulus < 5e6) text += "soft_particles yes  # before read_data\n";
  if (hardest.material.youngs_modulus > 1e9) text += "hard_particles yes  # before read_data\n";
  double least = 1;
  for (std::size_t a = 0; a < card.materials.size(); ++a) {
    for (std::size_t b = 0; b < card.materials.size(); ++b) {
      least = std::min(least, engine::HarmonicMean(ActingOn(card, a, b).restitution,
                                                   ActingOn(card, b, a).restitution));
    }
  }
  if (least > 0.05) return text;
  return text + "# NOT INCLUDED: a restitution of " + CardNumber(least) +
         "; LIGGGHTS refuses 0.05 and less.\n";
}

std::string LiggghtsRemarks(const Card& card) {
  std::string text = LiggghtsLimits(card);
  text +=
      "# Sliding limits the spring alone in LIGGGHTS, spring and dashpot in talus: spins after "
      "grazing collisions differ\n# by some percent where the restitution is 0.5, by up to a half "
      "where it is 0.2.\n";
  if (card.models.adhesion != engine::Adhesion::kNone) {
    text +=
        "# NOT INCLUDED: the adhesion. LIGGGHTS-PUBLIC has SJKR and liquid bridges, whose forces "
        "are others: this card\n# without it is not the calibrated powder.\n";
  }
  if (card.models.rolling == engine::Rolling::kViscous) {
    text += RollingNotIncluded(card, "LIGGGHTS", "# ");
  }
  if (card.models.rolling == engine::Rolling::kConstant) {
    text += "# cdt limits rolling by the spring's normal force, talus by that with the dashpot.\n";
  }
  const bool damped = card.models.full_mobilisation_damping > 0;
  if (card.models.rolling == engine::Rolling::kEpsd && damped) {
    text +=
        "# LIGGGHTS has no rolling damping once the limit is reached (f = 0); calibrated with " +
        CardNumber(card.models.full_mobilisation_damping) + ".\n";
  }
  return text;
}

std::string TypeText(std::size_t material) { return std::to_string(material + 1); }

// A primitive wall has no end and does not move: plate and tube before the lift.
std::string LiggghtsTube(const Card& card, const CardTest& test, const std::string& model) {
  const std::string mark = TestMark(card, test);
  const std::string wall = " all wall/gran " + model + " primitive type ";
  return "# Walls of " + (card.tests.size() == 1 ? "that test" : base::OneLine(test.name)) +
         " (a plate with a rim and a tube that is lifted need fix mesh/surface):\n# fix plate" +
         mark + wall + TypeText(test.plate) + " zplane 0.0\n# fix tube" + mark + wall +
         TypeText(test.tube) + " zcylinder " +
         CardNumber(test.rig.lifted_tube.tube_inner_diameter / 2) + " 0.0 0.0\n";
}

std::string LiggghtsWalls(const Card& card, const std::string& model) {
  std::string text;
  for (const CardTest& test : card.tests) {
    if (test.rig.kind == rigs::RigKind::kLiftedTube) {
      text += LiggghtsTube(card, test, model);
    } else if (test.tube > 0 || test.plate > 0) {
      text += "# Walls of " + base::OneLine(test.name) + ": type " + TypeText(test.tube) +
              ", its floor: type " + TypeText(test.plate) + "\n";
    }
  }
  return text;
}

// particledistribution/discrete weighs its templates by mass.
std::string LiggghtsSizes(const Card& card) {
  std::string templates;
  std::string distribution;
  std::uint64_t seed = 10000;  // LIGGGHTS wants primes above, each once
  for (std::size_t i = 0; i < card.sizes.size(); ++i) {
    const std::string id = "grain" + std::to_string(i + 1);
    seed = base::PrimeFrom(seed + 1);
    templates += "# fix " + id + " all particletemplate/sphere " + std::to_string(seed) +
                 " atom_type 1 density constant " +
                 CardNumber(card.materials.front().material.density) + " radius constant " +
                 CardNumber(card.sizes[i].diameter / 2) + "\n";
    distribution += " " + id + " " + CardNumber(card.sizes[i].volume_share);
  }
  return "# grains:\n" + templates + "# fix grains all particledistribution/discrete " +
         std::to_string(base::PrimeFrom(seed + 1)) + " " + std::to_string(card.sizes.size()) +
         distribution + "\n";
}

}  // namespace

std::string LiggghtsCard(const Card& card) {
  using M = engine::Material;
  std::ostringstream text;
  text << CardHead(card, "LIGGGHTS-PUBLIC 3.8", "# ") << LiggghtsRemarks(card) << "# Atom types:";
  for (std::size_t i = 0; i < card.materials.size(); ++i) {
    text << ' ' << i + 1 << ' ' << card.materials[i].name
         << (i + 1 < card.materials.size() ? "," : "; walls without a type of their own: 1\n");
  }
  const std::string model = "model hertz tangential history" + RollingModel(card.models.rolling);
  text << "# density of type 1: " << CardNumber(card.materials[0].material.density) << " kg/m3\n"
       << PerType(card, "youngsModulus", &M::youngs_modulus)
       << PerType(card, "poissonsRatio", &M::poisson_ratio)
       << PerPair(card, "coefficientRestitution", &M::restitution)
       << PerPair(card, "coefficientFriction", &M::sliding_friction);
  if (!RollingModel(card.models.rolling).empty()) {
    text << PerPair(card, "coefficientRollingFriction", &M::rolling_friction);
  }
  if (card.models.rolling == engine::Rolling::kEpsd) {
    text << PerPair(card, "coefficientRollingViscousDamping", &M::rolling_damping);
  }
  text << "pair_style gran " << model << "\npair_coeff * *\n"
       << "# and each wall: fix ID all wall/gran " << model << " ...\n"
       << LiggghtsWalls(card, model) << LiggghtsSizes(card) << "timestep "
       << CardNumber(card.time_step) << "\n";
  return text.str();
}

}  // namespace talus::analysis
