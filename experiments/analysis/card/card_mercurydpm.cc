// MercuryDPM, HertzianViscoelasticMindlinRollingTorsionSpecies. Converted:
//   Y, ν     effective moduli of the pair: E* (P3), and 3/2 G* (P4): its tangential spring is
//            (2/3) 8 G √(R*δ) per length, ours 8 G* √(R*δ)
//   η_t      sliding dissipation × √(m* 8 G √(R*δ)) is our dashpot (N4)
//   μ_r      the rolling force is limited by μ |F_n| and acts on an arm of 2R*, ours on R*: μ_r/2
//   k_r      the rolling stiffness is a constant [N/m] on that arm: k_r/(2R*)² = (9/16) k_n μ_r²,
//            at the typical contact; the dissipation is C_r/(2R*)²
#include <cmath>
#include <sstream>

#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {

std::string MercuryDpmCard(const Card& card) {
  const engine::Material powder = ActingOn(card, 0, 0);  // these lines are of two grains
  const TypicalContact typical = TypicalContactOf(card);
  const double friction = typical.pair.rolling_friction;
  const double stiffness = 9.0 / 16 * typical.normal_stiffness * friction * friction;
  const double radius = 2 * typical.r_star;
  const double inertia = 0.7 * 2 * typical.m_star * radius * radius;
  const double dissipation =
      powder.rolling_damping * std::sqrt(inertia * stiffness) / typical.r_star;
  const bool rolls = card.models.rolling == engine::Rolling::kEpsd;
  std::ostringstream text;
  text << CardHead(card, "MercuryDPM", "// ") << WallsNotIncluded(card, "// ")
       << PairsNotIncluded(card, 1, "// ")
       << "// Converted: effective moduli, shear 3/2 G* (its spring is 2/3 of Mindlin's); rolling "
          "friction\n"
       << "// mu_r/2 (its arm is 2 R*); rolling stiffness and dissipation of a contact that bears "
          "ten grain weights.\n";
  if (card.models.adhesion != engine::Adhesion::kNone) {
    text << "// NOT INCLUDED: the adhesion; choose an adhesive species and calibrate with it.\n";
  }
  if (!rolls && card.models.rolling != engine::Rolling::kNone) {
    text << RollingNotIncluded(card, "MercuryDPM", "// ");
  }
  text << "HertzianViscoelasticMindlinRollingTorsionSpecies species;\n"
       << "species.setDensity(" << CardNumber(powder.density) << ");\n"
       << "species.setEffectiveElasticModulusAndRestitutionCoefficient("
       << CardNumber(typical.pair.y_star) << ", " << CardNumber(powder.restitution) << ");\n"
       << "species.setEffectiveShearModulus(" << CardNumber(1.5 * typical.pair.shear_stiffness / 8)
       << ");\nspecies.setSlidingDissipation("
       << CardNumber(typical.pair.tangential_damping /
                     std::sqrt(1.5 * typical.pair.shear_stiffness))
       << ");\nspecies.setSlidingFrictionCoefficient(" << CardNumber(powder.sliding_friction)
       << ");\n";
  if (rolls) {
    text << "species.setRollingStiffness(" << CardNumber(stiffness) << ");\n"
         << "species.setRollingDissipation(" << CardNumber(dissipation) << ");\n"
         << "species.setRollingFrictionCoefficient(" << CardNumber(friction / 2) << ");\n";
  }
  text << "setTimeStep(" << CardNumber(card.time_step) << ");\n";
  return text.str();
}

}  // namespace talus::analysis
