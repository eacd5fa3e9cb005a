#include "engine/scene/scene_warnings.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace talus::engine {

std::vector<std::string> AdhesionWarnings(const ContactModels& models,
                                          const std::vector<Material>& materials) {
  const bool sticky = std::any_of(materials.begin(), materials.end(),
                                  [](const Material& m) { return m.surface_energy > 0; });
  if (models.adhesion == Adhesion::kNone && sticky) {
    return {"surface_energy is given, but models.adhesion is none: nothing adheres"};
  }
  if (models.adhesion != Adhesion::kNone && !sticky) {
    return {"models.adhesion is " + std::string(base::NameOf(models.adhesion)) +
            ", but no surface_energy is above 0: nothing adheres"};
  }
  return {};
}

namespace {

template <class Bulk>
void AddLostSizes(const SceneSpec& spec, const Bulk& bulk, const std::string& place,
                  std::vector<std::string>& warnings) {
  const auto material = static_cast<std::size_t>(MaterialIndex(spec, bulk.material));
  const double density = spec.materials[material].material.density;
  const std::string lost = LostSizes(SizeCurve(bulk.sizes), bulk.mass / density);
  if (!lost.empty()) warnings.push_back(place + ".sizes: " + lost);
}

}  // namespace

std::vector<std::string> SceneWarnings(const SceneSpec& spec, const Scene& scene) {
  std::vector<Material> surfaces = scene.materials;
  for (const MaterialPair& pair : scene.pairs) {
    surfaces.push_back(With(scene.materials[pair.first], pair.stated));
  }
  std::vector<std::string> warnings = AdhesionWarnings(scene.models, surfaces);
  for (std::size_t i = 0; i < spec.fills.size(); ++i) {
    AddLostSizes(spec, spec.fills[i], "fills[" + std::to_string(i) + "]", warnings);
  }
  for (std::size_t i = 0; i < spec.pours.size(); ++i) {
    AddLostSizes(spec, spec.pours[i], "pours[" + std::to_string(i) + "]", warnings);
  }
  const double dt = TimeStep(scene);
  const double share = dt / std::min(SmallestRayleighTime(scene), PouredRayleighTime(spec));
  if (share > kWarnRayleighFraction * (1 + 1e-9)) {
    std::ostringstream text;
    text.precision(3);
    text << "the time step is " << share
         << " of the Rayleigh time of the smallest sphere; above 0.20 contacts are resolved poorly";
    warnings.push_back(text.str());
  }
  if (spec.stop.steps && !spec.outputs.times.empty() &&
      spec.outputs.times.back() > static_cast<double>(*spec.stop.steps) * dt) {
    warnings.push_back("the last of outputs.times comes after stop.steps and is not written");
  }
  return warnings;
}

}  // namespace talus::engine
