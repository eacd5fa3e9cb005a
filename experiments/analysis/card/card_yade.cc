// YADE, Ip2_FrictMat_FrictMat_MindlinPhys and Law2_ScGeom_MindlinPhys_Mindlin. Converted:
//   μ_t      frictionAngle = atan μ_t
//   μ_r      the moment is limited by eta Rmean |F_n| with Rmean = (R₁ + R₂)/2, ours by μ_r R*
//   |F_n|:
//            eta = μ_r/2 for two equal grains. A Wall counts as a grain's twin, so that Rmean is
//            our R* there: eta = μ_r. A facet counts as a sphere of 2R: Rmean = 1.5R, eta = 2μ_r/3.
//   k_r      krot is a constant [N m/rad]; taken at the typical contact.
//   γ        pulls with 4πγR*, which for two equal surfaces is ours.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {
namespace {

// makeCloud takes the share of the mass up to each diameter, from 0 to 1, and spreads what lies
// between two of them evenly: each class is a narrow band.
std::string YadeSizes(const Card& card) {
  const std::string call = "# grains: pack.SpherePack().makeCloud(..., ";
  if (card.sizes.size() == 1) {
    return call + "rMean=" + CardNumber(card.sizes.front().diameter / 2) + ", rRelFuzz=0)\n";
  }
  double half_width = 1e-3;  // of a band, in shares of its diameter
  for (std::size_t i = 1; i < card.sizes.size(); ++i) {
    const double step = card.sizes[i].diameter / card.sizes[i - 1].diameter - 1;
    if (step > 0) half_width = std::min(half_width, step / 4);
  }
  std::vector<std::string> diameters, shares;
  double sum = 0;
  for (std::size_t i = 0; i < card.sizes.size(); ++i) {
    const double diameter = card.sizes[i].diameter;
    const bool is_as_before = i > 0 && diameter == card.sizes[i - 1].diameter;
    if (!is_as_before) {
      diameters.push_back(CardNumber((1 - half_width) * diameter));
      shares.push_back(CardNumber(sum));
      diameters.push_back(CardNumber((1 + half_width) * diameter));
      shares.emplace_back();
    }
    sum += card.sizes[i].volume_share;
    shares.back() = CardNumber(sum);
  }
  return call + "psdSizes=[" + base::Joined(diameters, ", ") + "], psdCumm=[" +
         base::Joined(shares, ", ") + "], distributeMass=True)\n";
}

}  // namespace

std::string YadeCard(const Card& card) {
  const engine::Material powder = ActingOn(card, 0, 0);  // these lines are of two grains
  const TypicalContact typical = TypicalContactOf(card);
  const double friction = typical.pair.rolling_friction;
  const double lever = friction * typical.r_star;
  const bool rolls = card.models.rolling == engine::Rolling::kEpsd;
  const bool adheres = card.models.adhesion == engine::Adhesion::kDmt;
  std::ostringstream text;
  text
      << CardHead(card, "YADE (HertzMindlin)", "# ") << WallsNotIncluded(card, "# ")
      << PairsNotIncluded(card, 1, "# ")
      << "# Converted: frictionAngle = atan(mu_t); eta = mu_r/2 (between grains; at a Wall mu_r, "
         "at facets 2 mu_r/3);\n"
      << "# krot of two grains of D50 that bear ten grain weights: a constant, which is a fifth of "
         "ours at a Wall and a tenth for\n"
      << "# grains of twice the size. YADE's spring in rolling has no dashpot, and its normal "
         "force is cut at zero: it rebounds\n"
      << "# with 0.90 for 0.9, 0.63 for 0.6, 0.40 for 0.3. Sliding limits the spring alone, in "
         "talus spring and dashpot; es is not read:\n"
      << "# YADE's dashpot in sliding is that of the normal, "
      << base::ShortNumber(0.5 / std::sqrt(typical.pair.shear_stiffness / 8 / typical.pair.y_star),
                           3)
      << " times ours.\n";
  if (!rolls && card.models.rolling != engine::Rolling::kNone) {
    text << RollingNotIncluded(card, "YADE", "# ");
  }
  if (card.models.adhesion == engine::Adhesion::kJkr) {
    text << "# NOT INCLUDED: JKR adhesion, which YADE has not.\n";
  } else if (adheres) {
    text << "# Adhesion acts in contact only. YADE limits rolling by the net force, talus by the "
            "elastic one; at a Wall it\n# pulls with half of ours, at facets with two thirds.\n";
  }
  text << "powder = O.materials.append(FrictMat(young=" << CardNumber(powder.youngs_modulus)
       << ", poisson=" << CardNumber(powder.poisson_ratio)
       << ", frictionAngle=" << CardNumber(std::atan(powder.sliding_friction))
       << ", density=" << CardNumber(powder.density) << ", label='powder'))\n"
       << "physics = Ip2_FrictMat_FrictMat_MindlinPhys(en=" << CardNumber(powder.restitution)
       << ", es=" << CardNumber(powder.restitution);
  if (rolls) {
    text << ", krot=" << CardNumber(2.25 * typical.normal_stiffness * lever * lever)
         << ", eta=" << CardNumber(friction / 2);
  }
  if (adheres) text << ", gamma=" << CardNumber(typical.pair.surface_energy / 2);
  text << ")\nlaw = Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=" << (rolls ? "True" : "False")
       << ", includeAdhesion=" << (adheres ? "True" : "False") << ")\n"
       << YadeSizes(card) << "O.dt = " << CardNumber(card.time_step) << "\n";
  return text.str();
}

}  // namespace talus::analysis
