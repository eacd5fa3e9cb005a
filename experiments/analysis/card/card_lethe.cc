// Lethe: the definitions of docs/physics.md are Lethe's, values of a material are given, and Lethe
// mixes them by the same rules (P5, P6). Nothing is converted.
#include <sstream>

#include "base/text/joined.h"
#include "experiments/analysis/card/card_formats.h"

namespace talus::analysis {
namespace {

struct Key {
  const char* name;
  double engine::Material::*part;
};
constexpr Key kKeys[] = {
    {"young modulus", &engine::Material::youngs_modulus},
    {"poisson ratio", &engine::Material::poisson_ratio},
    {"restitution coefficient", &engine::Material::restitution},
    {"friction coefficient", &engine::Material::sliding_friction},
    {"rolling friction", &engine::Material::rolling_friction},
    {"rolling viscous damping", &engine::Material::rolling_damping},
    {"surface energy", &engine::Material::surface_energy},
    {"hamaker constant", &engine::Material::hamaker_constant},
};

std::string Lines(const engine::Material& material, const std::string& body, const char* indent) {
  std::string text;
  for (const Key& key : kKeys) {
    text += std::string(indent) + "set " + key.name + " " + body + " = " +
            CardNumber(material.*key.part) + "\n";
  }
  return text;
}

// Particle–particle and particle–wall names of the contact model.
std::pair<const char*, const char*> ContactNames(engine::Adhesion adhesion) {
  if (adhesion == engine::Adhesion::kDmt) return {"DMT", "DMT"};
  if (adhesion == engine::Adhesion::kJkr) return {"hertz_JKR", "JKR"};
  return {"hertz_mindlin_limit_overlap", "nonlinear"};
}

const char* RollingName(engine::Rolling rolling) {
  switch (rolling) {
    case engine::Rolling::kNone:
      return "none";
    case engine::Rolling::kConstant:
      return "constant";
    case engine::Rolling::kViscous:
      return "viscous";
    case engine::Rolling::kEpsd:
      return "epsd";
    case engine::Rolling::kEpsd2:  // which Lethe has not; the card says so
      return "none";
  }
  return "";
}

std::string LetheSizes(const Card& card) {
  if (card.sizes.size() == 1) {
    return "    set size distribution type = uniform\n    set diameter = " +
           CardNumber(card.sizes.front().diameter) + "\n";
  }
  const auto listed = [&](double CardSize::*part) {
    return base::Joined(card.sizes, ", ", [&](const CardSize& s) { return CardNumber(s.*part); });
  };
  return "    set size distribution type = custom\n    set custom diameters = " +
         listed(&CardSize::diameter) +
         "\n    set custom volume fractions = " + listed(&CardSize::volume_share) + "\n";
}

}  // namespace

std::string LetheCard(const Card& card) {
  const engine::Material& powder = card.materials.front().material;
  // The plate, or the tube where only that differs from the grains.
  const CardTest& test = card.tests.front();
  const std::size_t wall = test.plate > 0 ? test.plate : test.tube;
  const auto [particles, walls] = ContactNames(card.models.adhesion);
  std::ostringstream text;
  text << CardHead(card, "Lethe", "# ") << PairsNotIncluded(card, 0, "# ");
  if (card.models.rolling == engine::Rolling::kEpsd2) {
    text << RollingNotIncluded(card, "Lethe", "# ");
  }
  for (std::size_t i = 1; i < card.materials.size(); ++i) {
    if (i == wall) continue;
    text << "# NOT INCLUDED: " << card.materials[i].name
         << ". Lethe has one wall material: " << card.materials[wall].name << ".\n";
  }
  if (test.plate > 0 && test.tube == 0) {
    text << "# NOT INCLUDED: the tube is of the grains' material. Lethe has one wall material: "
         << card.materials[wall].name << ".\n";
  }
  text << "subsection lagrangian physical properties\n  subsection particle type 0\n"
       << LetheSizes(card) << "    set density particles = " << CardNumber(powder.density) << "\n"
       << Lines(powder, "particles", "    ") << "  end\n"
       << Lines(card.materials[wall].material, "wall", "  ") << "end\n"
       << "subsection model parameters\n"
       << "  set particle particle contact force method = " << particles << "\n"
       << "  set particle wall contact force method = " << walls << "\n"
       << "  set dmt cut-off threshold = " << CardNumber(card.models.adhesion_cutoff) << "\n"
       << "  set rolling resistance torque method = " << RollingName(card.models.rolling) << "\n"
       << "  set f coefficient = " << CardNumber(card.models.full_mobilisation_damping) << "\n"
       << "end\nsubsection simulation control\n  set time step = " << CardNumber(card.time_step)
       << "\nend\n";
  return text.str();
}

}  // namespace talus::analysis
