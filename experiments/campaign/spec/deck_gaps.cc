#include "experiments/campaign/spec/deck_gaps.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "base/text/joined.h"
#include "experiments/trials/engines/case_values.h"
#include "experiments/trials/engines/template_folder.h"

namespace talus::campaign {
namespace {

constexpr std::string_view kRigKind = "rig_kind";

// The placeholders that tell one and the same thing, by the one that stands for them; empty for
// what is no test's own. A deck that has one of them takes it.
std::string ThingOf(const std::string& name) {
  static const std::map<std::string, std::string, std::less<>> kStandsFor{
      {"tube_inner_radius", "tube_inner_diameter"},
      {"plate_radius", "plate_diameter"},
      {"num_grains", "mass"},
      {"mass", "mass"},
      {"rig_fill", "mass"},  // of a drum: the one follows from the other
      {"lift_velocity", "lift_velocity"}};
  if (const auto same = kStandsFor.find(name); same != kStandsFor.end()) return same->second;
  if (name.starts_with("rig_camera")) return "";  // pictures are the deck's result, not its input
  for (const std::string_view body : {"tube_", "plate_"}) {
    const std::string pair = std::string(body) + "pair_";
    if (name.starts_with(pair)) return std::string(body) + name.substr(pair.size());
    if (name.starts_with(body)) return name == "tube_length" ? "" : name;
  }
  return name.starts_with("rig_") ? name : "";
}

bool IsOfLiftedTube(const std::string& thing) {
  return thing == "tube_inner_diameter" || thing == "plate_diameter" || thing == "lift_velocity";
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
  // A deck that asks for the kind knows which of its keys it needs, and which are the lifted
  // tube's.
  std::erase_if(differences, [](const auto& difference) {
    const auto& [thing, names] = difference;
    const bool is_drums = names == std::set<std::string>{"rig_fill"};
    return thing != kRigKind && (thing.starts_with("rig_") || IsOfLiftedTube(thing) || is_drums);
  });
  return differences;
}

// "{{ plate_diameter }} and {{ lift_velocity }}": in which the two differ and no template takes.
std::vector<std::string> Untold(const trials::TemplateFolder& templates,
                                const trials::CommandOptions& command, const rigs::Case& made,
                                const rigs::Case& test) {
  std::vector<std::string> untold;
  for (auto& [thing, names] :
       Differences(trials::CaseValues(made).scalars, trials::CaseValues(test).scalars)) {
    if (thing == "mass") names.insert({"mass", "num_grains", "grains", "rig_fill"});
    const bool is_taken = std::ranges::any_of(
        names, [&](const std::string& name) { return templates.Uses(command, name); });
    if (!is_taken) untold.push_back("{{ " + thing + " }}");
  }
  return untold;
}

}  // namespace

void CheckDeckTellsApart(const CampaignSpec& spec, base::Problems& problems) {
  if (spec.engine.kind != EngineKind::kCommand) return;
  if (!std::filesystem::is_directory(*spec.engine.command.templates)) return;  // which is said
  const trials::TemplateFolder templates(*spec.engine.command.templates);
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  std::vector<rigs::Case> cases;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    cases.push_back(TypicalCase(spec, static_cast<int>(e), spec.coarse_graining.Levels().front()));
    for (std::size_t made = 0; made < e; ++made) {
      const std::vector<std::string> untold =
          Untold(templates, spec.engine.command, cases[made], cases[e]);
      if (untold.empty()) continue;
      problems.Add(
          "experiments[" + std::to_string(e) + "].rig",
          "the engine's templates have no " + base::Listed(untold) + ", in which \"" +
              experiments[e].name + "\" differs from \"" + experiments[made].name +
              "\": they would simulate both alike in that; let a template take it, be it in a "
              "comment");
      break;
    }
  }
}

DeckGap DeckGapOf(const CampaignSpec& spec, const rigs::Case& rig_case) {
  if (spec.engine.kind != EngineKind::kCommand) return {};
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  const auto kin = std::ranges::find_if(
      experiments, [&](const ExperimentSpec& e) { return KindOf(e) == rig_case.rig.kind; });
  const auto nearest = kin == experiments.end() ? experiments.begin() : kin;
  const rigs::Case test = TypicalCase(spec, static_cast<int>(nearest - experiments.begin()),
                                      rig_case.coarse_graining.scale_factor);
  const trials::TemplateFolder templates(*spec.engine.command.templates);
  return {.experiment = nearest->name,
          .untold = base::Listed(Untold(templates, spec.engine.command, test, rig_case)),
          .is_other_rig = kin == experiments.end() &&
                          !templates.Uses(spec.engine.command, std::string(kRigKind))};
}

std::vector<std::string> DeckWarnings(const CampaignSpec& spec) {
  if (spec.engine.kind != EngineKind::kCommand) return {};
  if (!std::filesystem::is_directory(*spec.engine.command.templates)) return {};
  const trials::TemplateFolder templates(*spec.engine.command.templates);
  const auto takes_none = [&](const std::vector<std::string>& names) {
    return std::ranges::none_of(
        names, [&](const std::string& name) { return templates.Uses(spec.engine.command, name); });
  };
  std::vector<std::string> warnings;
  if (takes_none({"seed", "prime_seed", "grains"})) {
    warnings.emplace_back(
        "the engine's templates take no {{ seed }}, {{ prime_seed }} or {{# grains }}: unless the "
        "deck draws its own, repeated and confirming trials are one run again, and the noise is "
        "taken to be none");
  }
  const std::vector<std::string> sizes{"scale_factor",     "mean_diameter", "smallest_diameter",
                                       "largest_diameter", "num_grains",    "grains"};
  if (spec.coarse_graining.Levels().size() > 1 && takes_none(sizes)) {
    warnings.push_back("the engine's templates take none of " + base::Joined(sizes, ", ") +
                       ": trials at all scale factors are the same");
  }
  return warnings;
}

}  // namespace talus::campaign
