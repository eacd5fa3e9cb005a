#include "experiments/analysis/next/deck_gaps.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/joined.h"
#include "experiments/trials/engines/case_values.h"
#include "experiments/trials/engines/template_folder.h"

namespace talus::analysis {
namespace {

constexpr std::string_view kRigKind = "rig_kind";

// The placeholders that tell one and the same thing, by the one that stands for them; empty for
// what is no test's own. A deck that has one of them takes it.
std::string ThingOf(const std::string& name) {
  static const std::map<std::string, std::string, std::less<>> kSame{
      {"tube_inner_radius", "tube_inner_diameter"},
      {"plate_radius", "plate_diameter"},
      {"num_grains", "mass"},
      {"mass", "mass"},
      {"lift_velocity", "lift_velocity"}};
  if (const auto same = kSame.find(name); same != kSame.end()) return same->second;
  if (name.starts_with("rig_camera")) return "";  // pictures are the deck's result, not its input
  for (const std::string_view body : {"tube_", "plate_"}) {
    const std::string pair = std::string(body) + "pair_";
    if (name.starts_with(pair)) return std::string(body) + name.substr(pair.size());
    if (name.starts_with(body)) return name == "tube_length" ? "" : name;
  }
  return name.starts_with("rig_") ? name : "";
}

using Values = std::map<std::string, std::string, std::less<>>;

// What differs, by the thing's name with all placeholders that tell it.
std::map<std::string, std::set<std::string>> Differences(const Values& made, const Values& test) {
  std::map<std::string, std::set<std::string>> differences;
  const auto look = [&](const Values& one, const Values& other) {
    for (const auto& [name, value] : one) {
      const auto found = other.find(name);
      if (found != other.end() && found->second == value) continue;
      if (const std::string thing = ThingOf(name); !thing.empty()) differences[thing].insert(name);
    }
  };
  look(made, test);
  look(test, made);
  if (!differences.contains(std::string(kRigKind))) return differences;
  // A deck that asks for the kind knows which of its keys it needs.
  std::erase_if(differences, [](const auto& difference) {
    return difference.first.starts_with("rig_") && difference.first != kRigKind;
  });
  return differences;
}

}  // namespace

std::string WhyNotByDeck(const campaign::JointView& view, const rigs::Case& test) {
  const campaign::EngineOptions& engine = view.spec.engine;
  if (engine.kind != campaign::EngineKind::kCommand || view.record.experiments.empty()) return "";
  const rigs::Case made =
      campaign::TypicalCase(view.spec, 0, view.spec.coarse_graining.Levels().front());
  const trials::TemplateFolder templates(engine.command.templates.value());
  std::vector<std::string> missing;
  for (auto& [thing, names] :
       Differences(trials::CaseValues(made).scalars, trials::CaseValues(test).scalars)) {
    if (thing == "mass") names.insert("grains");
    const bool is_taken = std::ranges::any_of(
        names, [&](const std::string& name) { return templates.Uses(engine.command, name); });
    if (!is_taken) missing.push_back("{{ " + thing + " }}");
  }
  if (missing.empty()) return "";
  return "the engine's templates have no " + base::Listed(missing) +
         ", in which it differs from \"" + view.record.experiments.front().name +
         "\": they would simulate that again";
}

}  // namespace talus::analysis
