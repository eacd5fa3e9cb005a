// YADE, Ip2_FrictMat_FrictMat_MindlinPhys and Law2_ScGeom_MindlinPhys_Mindlin. Converted:
//   μ_t      frictionAngle = atan μ_t
//   μ_r      the moment is limited by eta Rmean |F_n| with Rmean = (R₁ + R₂)/2, ours by μ_r R*
//   |F_n|:
//            eta = μ_r/2 for two equal grains; a wall counts as a grain's twin in YADE's R* and
//            Rmean, so that it takes the same eta for half of our R*: eta = μ_r there.
//   k_r      krot is a constant [N m/rad]; taken at the typical contact.
//   γ        pulls with 4πγR*, which for two equal surfaces is ours.
#include <cmath>
#include <sstream>

#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {
namespace {

// makeCloud takes the share of the mass up to each diameter.
std::string YadeSizes(const Card& card) {
  std::string diameters;
  std::string shares;
  double sum = 0;
  for (const CardSize& size : card.sizes) {
    sum += size.volume_share;
    const char* comma = diameters.empty() ? "" : ", ";
    diameters += comma + CardNumber(size.diameter);
    shares += comma + CardNumber(sum);
  }
  return "# grains: pack.SpherePack().makeCloud(..., psdSizes=[" + diameters + "], psdCumm=[" +
         shares + "], distributeMass=True)\n";
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
  text << CardHead(card, "YADE (HertzMindlin)", "# ") << WallsNotIncluded(card, "# ")
       << PairsNotIncluded(card, 1, "# ")
       << "# Converted: frictionAngle = atan(mu_t); eta = mu_r/2 (between grains; walls: mu_r); "
          "krot\n"
       << "# of a contact that bears ten grain weights. YADE's spring in rolling has no dashpot, "
          "and\n"
       << "# its normal force is cut at zero.\n";
  if (!rolls && card.models.rolling != engine::Rolling::kNone) {
    text << RollingNotIncluded(card, "YADE", "# ");
  }
  if (card.models.adhesion == engine::Adhesion::kJkr) {
    text << "# NOT INCLUDED: JKR adhesion, which YADE has not.\n";
  } else if (adheres) {
    text << "# Adhesion raises the limit of sliding in YADE, not in talus, and acts in contact "
            "only.\n";
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
