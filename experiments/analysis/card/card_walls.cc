#include "experiments/analysis/card/card_walls.h"

#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"

namespace talus::analysis {
namespace {

template <class T>
bool Same(const T& a, const T& b) {
  return base::ToJson(a) == base::ToJson(b);
}

// The index of what a case's walls or floor are of among the card's materials, which gain it where
// it is new.
std::size_t IndexOfWall(const rigs::Case& rig_case, int body, Card& card) {
  const engine::Material material = rigs::MaterialsOf(rig_case)[static_cast<std::size_t>(body)];
  const engine::PairProperties stated =
      engine::StatedOf(rigs::PairsOf(rig_case), rigs::kPowder, body);
  // Walls of the powder's material are not its grains where two grains state something themselves.
  const bool as_grains = !stated.Any() && !engine::StatedOf(card.pairs, 0, 0).Any();
  if (as_grains && Same(material, card.materials.front().material)) return 0;
  for (std::size_t i = 1; i < card.materials.size(); ++i) {
    const CardMaterial& known = card.materials[i];
    if (known.body == body && Same(known.material, material) &&
        Same(engine::StatedOf(card.pairs, 0, static_cast<int>(i)), stated)) {
      return i;
    }
  }
  const std::size_t index = card.materials.size();
  card.materials.push_back({.name = rigs::kBodyNames[body], .material = material, .body = body});
  if (stated.Any()) {
    card.pairs.push_back({.first = 0, .second = static_cast<int>(index), .stated = stated});
  }
  return index;
}

bool Has(const CardTest& test, std::size_t material) {
  return test.tube == material || test.plate == material;
}

}  // namespace

void AddTest(const rigs::Case& rig_case, const std::string& name, Card& card) {
  CardTest test{.name = name, .rig = rig_case.rig};
  test.tube = IndexOfWall(rig_case, rigs::kWalls, card);
  test.plate = IndexOfWall(rig_case, rigs::kFloor, card);
  card.tests.push_back(std::move(test));
}

void NameWalls(Card& card) {
  for (std::size_t i = 1; i < card.materials.size(); ++i) {
    std::string tests;
    std::size_t count = 0;
    for (const CardTest& test : card.tests) {
      if (!Has(test, i)) continue;
      tests += (count++ == 0 ? " of " : ", ") + base::OneLine(test.name);
    }
    if (count < card.tests.size()) card.materials[i].name += tests;
  }
}

}  // namespace talus::analysis
