#include "engine/scene/scene_warnings.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "base/text/number_text.h"
#include "engine/laws/longest_step.h"
#include "engine/laws/pressed_bed.h"

namespace talus::engine {

namespace {

// What of a scene has a surface energy above 0.
struct Stickiness {
  bool is_stated = false;  // a material, or what a pair states
  bool adheres = false;    // a pair that may touch
};

bool IsSticky(const Material& m) { return m.surface_energy > 0; }

std::vector<std::string> AdhesionTexts(const ContactModels& models, const Stickiness& stickiness) {
  if (models.adhesion == Adhesion::kNone) {
    if (!stickiness.is_stated) return {};
    return {"surface_energy is given, but models.adhesion is none: nothing adheres"};
  }
  if (stickiness.adheres) return {};
  return {"models.adhesion is " + std::string(base::NameOf(models.adhesion)) +
          (stickiness.is_stated
               ? ", but of no two materials that touch both have a surface_energy above 0"
               : ", but no surface_energy is above 0") +
          ": nothing adheres"};
}

}  // namespace

std::vector<std::string> AdhesionWarnings(const ContactModels& models,
                                          const std::vector<Material>& materials,
                                          std::span<const MaterialPair> pairs,
                                          std::span<const int> of_spheres) {
  Stickiness stickiness{.is_stated = std::ranges::any_of(materials, IsSticky)};
  for (const MaterialPair& pair : pairs) {
    stickiness.is_stated |= pair.stated.surface_energy.value_or(0) > 0;
  }
  for (const int own : of_spheres) {
    for (std::size_t other = 0; other < materials.size(); ++other) {
      const PairProperties both = Joined(materials[static_cast<std::size_t>(own)], materials[other],
                                         StatedOf(pairs, own, static_cast<int>(other)));
      stickiness.adheres |= both.surface_energy.value_or(0) > 0;
    }
  }
  return AdhesionTexts(models, stickiness);
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

// The smallest sphere of each material, 0 without any [m], and what all of them fill [m³].
struct Grains {
  std::vector<double> smallest;
  double volume = 0;

  void Add(int material, double radius, double more) {
    double& least = smallest[static_cast<std::size_t>(material)];
    least = least > 0 ? std::min(least, radius) : radius;
    volume += more;
  }
};

Grains GrainsOf(const SceneSpec& spec, const Scene& scene) {
  Grains grains{.smallest = std::vector<double>(scene.materials.size(), 0.0)};
  for (const Particle& p : scene.particles) {
    grains.Add(p.material, p.radius, SphereMass({.density = 1}, p.radius));
  }
  for (const auto& pour : spec.pours) {
    const int material = MaterialIndex(spec, pour.material);
    grains.Add(material, SizeCurve(pour.sizes).smallest() / 2,
               pour.mass / scene.materials[static_cast<std::size_t>(material)].density);
  }
  return grains;
}

std::vector<int> MaterialsOfSpheres(const Grains& grains) {
  std::vector<int> materials;
  for (std::size_t m = 0; m < grains.smallest.size(); ++m) {
    if (grains.smallest[m] > 0) materials.push_back(static_cast<int>(m));
  }
  return materials;
}

// What the step does not resolve, as its material's key, and less of what it needs.
struct Unresolved {
  const char* what;
  const char* remedy;
};

Unresolved TextsOf(StepBound bound) {
  switch (bound) {
    case StepBound::kRollingDashpot:
      return {"rolling_damping: its dashpot", "M6), or less damping"};
    case StepBound::kRollingSpring:
      return {"rolling_friction: its spring", "M6), or less rolling friction"};
    case StepBound::kSlidingDashpot:
      break;
  }
  return {"restitution: the friction's dashpot", "M7), or a larger restitution or Young's modulus"};
}

// Dashpots and springs that the step does not resolve.
void AddLongStep(const SceneSpec& spec, const Scene& scene, double dt,
                 std::vector<std::string>& warnings) {
  const Grains grains = GrainsOf(spec, scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (grains.smallest[m] == 0) continue;
    const int own = static_cast<int>(m);
    const Material material = With(scene.materials[m], StatedOf(scene.pairs, own, own));
    const double stress = BedStress(material.density, base::Norm(scene.gravity), grains.volume);
    const StepLimit longest =
        LongestStep(MakePairConstants(material, material, scene.models),
                    {.radius = grains.smallest[m], .density = material.density, .stress = stress},
                    scene.models.rolling);
    if (dt <= longest.step) continue;
    const auto [what, remedy] = TextsOf(longest.bound);
    warnings.push_back("materials[" + std::to_string(m) + "]." + what +
                       " would keep the spheres of a bed spinning at this time step: take a "
                       "time_step of " +
                       base::ShortNumber(longest.step, 2) + " s or less (docs/physics.md, " +
                       remedy);
  }
}

// What is to happen when the scene has ended for certain never does.
void AddLateEvents(const SceneSpec& spec, double dt, std::vector<std::string>& warnings) {
  double end = spec.stop.time.value_or(std::numeric_limits<double>::infinity());
  if (spec.stop.steps) end = std::min(end, static_cast<double>(*spec.stop.steps) * dt);
  const auto check = [&](const std::string& key, double time) {
    if (!(time > end * (1 + 1e-9))) return;
    warnings.push_back(key + ": is " + base::ShortNumber(time) + " s, after the end at " +
                       base::ShortNumber(end) + " s: nothing comes of it");
  };
  for (std::size_t i = 0; i < spec.walls.size(); ++i) {
    const std::string wall = "walls[" + std::to_string(i) + "].";
    const WallSpec& w = spec.walls[i];
    if (w.removed_at) check(wall + "removed_at", *w.removed_at);
    if (w.taps) check(wall + "taps.start", w.taps->start);
    for (std::size_t k = 0; k < w.motion.size(); ++k) {
      check(wall + "motion[" + std::to_string(k) + "].time", w.motion[k].time);
    }
  }
  for (std::size_t i = 0; i < spec.gravity_turns.size(); ++i) {
    check("gravity_turns[" + std::to_string(i) + "].time", spec.gravity_turns[i].time);
  }
  for (std::size_t i = 0; i < spec.pours.size(); ++i) {
    check("pours[" + std::to_string(i) + "].start", spec.pours[i].start);
  }
  if (spec.outputs.interval) check("outputs.interval", *spec.outputs.interval);
  if (!spec.outputs.times.empty() && spec.outputs.times.back() > end) {
    warnings.push_back("the last of outputs.times comes after stop.steps and is not written");
  }
}

}  // namespace

std::vector<std::string> SceneWarnings(const SceneSpec& spec, const Scene& scene) {
  const std::vector<int> of_spheres = MaterialsOfSpheres(GrainsOf(spec, scene));
  std::vector<std::string> warnings =
      AdhesionWarnings(scene.models, scene.materials, scene.pairs, of_spheres);
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
  AddLongStep(spec, scene, dt, warnings);
  AddLateEvents(spec, dt, warnings);
  return warnings;
}

}  // namespace talus::engine
