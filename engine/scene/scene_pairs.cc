#include "engine/scene/scene_pairs.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/nearest.h"

namespace talus::engine {
namespace {

// What to do about a name in `between` that no material has.
std::string UnknownMaterial(const SceneSpec& spec, const std::string& name) {
  const std::string text = "\"" + name + "\" is not the name of a material";
  for (const WallSpec& wall : spec.walls) {
    if (wall.name == name) return text + " but of a wall; give the wall a material, and name that";
  }
  std::vector<std::string> known;
  for (const NamedMaterial& material : spec.materials) known.push_back(material.name);
  return text + base::DidYouMean(name, known);
}

// Spheres touch one another and walls; walls touch no walls. What is in a file not read yet may be
// of any material.
bool MayTouch(const SceneSpec& spec, int a, int b) {
  if (!spec.sphere_files.empty()) return true;
  const auto has = [&](const auto& list, int material) {
    return std::ranges::any_of(
        list, [&](const auto& body) { return MaterialIndex(spec, body.material) == material; });
  };
  const auto spheres = [&](int m) {
    return has(spec.spheres, m) || has(spec.fills, m) || has(spec.pours, m);
  };
  const auto bodies = [&](int m) { return spheres(m) || has(spec.walls, m); };
  return (spheres(a) && bodies(b)) || (bodies(a) && spheres(b));
}

// The pair of a spec whose names are right; else their problems, and nothing.
std::optional<MaterialPair> FindMaterials(const SceneSpec& spec, const PairSpec& pair,
                                          base::Problems& problems) {
  std::vector<int> found;
  for (std::size_t k = 0; k < pair.between.size(); ++k) {
    found.push_back(MaterialIndex(spec, pair.between[k]));
    if (found.back() >= 0 && !pair.between[k].empty()) continue;
    problems.Add("between[" + std::to_string(k) + "]", UnknownMaterial(spec, pair.between[k]));
    return {};
  }
  if (found.size() != 2) return {};
  return MaterialPair{found[0], found[1], pair.stated};
}

}  // namespace

void ValidatePairs(const SceneSpec& spec, base::Problems& problems) {
  std::vector<MaterialPair> before;
  for (std::size_t i = 0; i < spec.pairs.size(); ++i) {
    problems.Within("pairs[" + std::to_string(i) + "]", [&] {
      const auto pair = FindMaterials(spec, spec.pairs[i], problems);
      if (!pair) return;
      const auto [a, b, stated] = *pair;
      problems.Require(MayTouch(spec, a, b), "between",
                       "never touch: no sphere of the one meets a sphere or wall of the other");
      problems.Require(std::ranges::none_of(
                           before, [a = a, b = b](const MaterialPair& p) { return p.Joins(a, b); }),
                       "between", "is a pair that stands before; keep one of them");
      before.push_back(*pair);
    });
  }
}

std::vector<MaterialPair> BuildPairs(const SceneSpec& spec) {
  std::vector<MaterialPair> pairs;
  for (const PairSpec& pair : spec.pairs) {
    pairs.push_back(
        {MaterialIndex(spec, pair.between[0]), MaterialIndex(spec, pair.between[1]), pair.stated});
  }
  return pairs;
}

}  // namespace talus::engine
