// MercuryDPM, HertzianViscoelasticMindlinRollingTorsionSpecies. Converted:
//   Y, ν     effective moduli of the pair: E* (P3), and 3/2 G* (P4): its tangential spring is
//            (2/3) 8 G √(R*δ) per length, ours 8 G* √(R*δ)
//   η_t      sliding dissipation × √(m* 8 G √(R*δ)) is our dashpot (N4)
//   μ_r      the rolling force is limited by μ |F_n| on an arm of R*, as ours
//   C_r      the rolling dissipation is C_r/R*², at the typical contact
// Its rolling spring is the tangential one, 8 G √(R*δ) on that arm, and cannot be set.
#include <cmath>
#include <sstream>

#include "base/text/number_text.h"
#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {

std::string MercuryDpmCard(const Card& card) {
  const engine::Material powder = ActingOn(card, 0, 0);  // these lines are of two grains
  const TypicalContact typical = TypicalContactOf(card);
  const double stiffness = typical.pair.rolling_stiffness * typical.radius;  // k_r/R*²
  const bool rolls = card.models.rolling == engine::Rolling::kEpsd;
  std::ostringstream text;
  text << CardHead(card, "MercuryDPM", "// ") << WallsNotIncluded(card, "// ")
       << PairsNotIncluded(card, 1, "// ")
       << "// Converted: effective moduli, shear 3/2 G* (its spring is 2/3 of Mindlin's). Sliding "
          "limits the spring alone, in talus spring and dashpot.\n";
  if (rolls) {
    text << "// Rolling dissipation of a contact that bears ten grain weights. The rolling spring "
            "is the tangential one\n// and cannot be set: here "
         << base::ShortNumber(1.5 * typical.pair.shear_stiffness / typical.pair.rolling_stiffness,
                              2)
         << " times as stiff as that of the calibrated law. Versions whose arm of rolling is 2 R* "
            "need\n// half of that friction and a quarter of that dissipation.\n";
  }
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
    text << "species.setRollingDissipation("
         << CardNumber(RollingDissipation(typical, stiffness, powder.rolling_damping)) << ");\n"
         << "species.setRollingFrictionCoefficient(" << CardNumber(powder.rolling_friction)
         << ");\n";
  }
  text << "setTimeStep(" << CardNumber(card.time_step) << ");\n";
  return text.str();
}

}  // namespace talus::analysis
