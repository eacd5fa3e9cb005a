#include "experiments/campaign/add_parameter.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/error.h"
#include "base/nearest.h"
#include "base/problems.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/spec/parameter_names.h"
#include "experiments/campaign/start.h"

namespace talus::campaign {
namespace {

// Calls `change` with the range of this name, of whatever dimension it is.
template <class Ranges, class Change>
void OfName(Ranges& ranges, const std::string& name, const Change& change) {
  ParameterRanges::Visit(
      ranges, [&]<class T>(std::string_view key, T& range, base::FieldInfo = {}) {
        if constexpr (!std::is_same_v<std::remove_const_t<T>, std::optional<EarlierPosterior>>) {
          if (key == name) change(range);
        }
      });
}

// The one value that all trials have, whatever set and experiment they are of.
double ValueOfTrials(const CampaignSpec& spec, const std::string& name) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  const auto num_free = static_cast<Eigen::Index>(space.Free().size());
  std::optional<double> value;
  for (std::size_t e = 0; e < ExperimentsOf(spec).size(); ++e) {
    for (const double corner : {0.0, 1.0}) {
      const rigs::Case rig_case = CaseAt(spec, Eigen::VectorXd::Constant(num_free, corner),
                                         static_cast<int>(e), spec.coarse_graining.Target());
      const std::optional<double> here = HeldAt(space, rig_case, name);
      if (!here) continue;
      if (value && *here != *value) {
        throw base::ConfigError(
            "--search: " + name +
            " is not the same in all trials: over what is searched it goes from " +
            base::ShortNumber(*value) + " to " + base::ShortNumber(*here) +
            "; begin a new campaign that searches it");
      }
      value = here;
    }
  }
  if (!value)
    throw base::ConfigError(
        "--search: " + name +
        " has no value in the trials so far: begin a new campaign that searches it");
  return *value;
}

std::size_t CoordinateOf(const CampaignSpec& spec, const std::string& name) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  const std::vector<int> free = space.Free();
  const auto found = std::ranges::find_if(
      free, [&](int i) { return space.parameters[static_cast<std::size_t>(i)].name == name; });
  return static_cast<std::size_t>(found - free.begin());
}

// 0.5..2MPa is read by people as two of megapascals, where the bare end is in pascals.
void RequireUnitsAtBothEnds(const std::string& name, const std::string& low,
                            const std::string& high) {
  const bool is_low_bare = base::IsBareNumber(low), is_high_bare = base::IsBareNumber(high);
  if (is_low_bare == is_high_bare) return;
  const std::string& bare = is_low_bare ? low : high;
  const std::string& other = is_low_bare ? high : low;
  if (base::UnitIn(other).empty() || base::ParseQuantity(bare, base::Dimension::kNone) == 0) return;
  throw base::ConfigError("--search: " + name + ": " + bare + " has no unit beside " + other +
                          "; a bare number is in SI: write the unit at both ends");
}

}  // namespace

AddedParameter ParseAddedParameter(const std::string& text) {
  const auto equals = text.find('=');
  const auto dots = text.find("..");
  if (equals == std::string::npos || dots == std::string::npos || dots < equals) {
    throw base::ConfigError("--search: \"" + text +
                            "\" is no range; write NAME=LOW..HIGH, such as restitution=0.3..0.95");
  }
  AddedParameter added{.name = text.substr(0, equals)};
  const std::vector<std::string> names = ParameterNames();
  if (std::ranges::count(names, added.name) == 0) {
    throw base::ConfigError("--search: \"" + added.name + "\" is no parameter" +
                            base::DidYouMean(added.name, names) + "; there are " +
                            base::Joined(names, ", "));
  }
  const std::string low = text.substr(equals + 1, dots - equals - 1), high = text.substr(dots + 2);
  RequireUnitsAtBothEnds(added.name, low, high);
  try {
    added.low = ParseProperty(added.name, low);
    added.high = ParseProperty(added.name, high);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError("--search: " + added.name + ": " + error.what());
  }
  if (!(added.low < added.high)) {
    throw base::ConfigError("--search: " + text +
                            ": the low end must be below the high one; write " + added.name +
                            "=LOW..HIGH");
  }
  return added;
}

CampaignSpec SpecWith(const CampaignSpec& spec, const AddedParameter& added) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  for (const int i : space.Free()) {
    if (space.parameters[static_cast<std::size_t>(i)].name != added.name) continue;
    throw base::ConfigError("--search: " + added.name + " is searched already");
  }
  if (spec.HasOwnProposer()) {
    throw base::ConfigError("--search: strategy.kind must be \"auto\", and is \"" +
                            std::string(base::NameOf(spec.strategy.kind)) +
                            "\", which would not look at the new range as a whole; begin a new "
                            "campaign that searches " +
                            added.name);
  }
  const double value = ValueOfTrials(spec, added.name);
  if (!(value >= added.low && value <= added.high)) {
    throw base::ConfigError("--search: " + added.name + ": the range must hold " +
                            base::WithUnit(value, UnitOf(added.name)) +
                            ", which the trials so far were made with");
  }
  CampaignSpec with = spec;
  OfName(*with.parameters, added.name, [&](auto& range) {
    range.emplace();
    range->min = added.low;
    range->max = added.high;
    range->nuisance = true;
    range->added_at = value;
  });
  base::Problems problems("--search", {});
  CheckSpec(with, problems);
  if (problems.empty()) CheckTemplates(with, problems);
  problems.ThrowIfAny();
  return with;
}

void KeepAddedParameters(const CampaignSpec& going, CampaignSpec& read) {
  for (const optimizer::Parameter& p : SpaceOf(going).parameters) {
    if (!p.added_at) continue;
    OfName(*read.parameters, p.name, [&](auto& range) {
      if (range && !range->fixed) {
        range->added_at = p.added_at;
        return;
      }
      OfName(*going.parameters, p.name, [&](const auto& known) {
        if constexpr (std::is_same_v<decltype(range), std::decay_t<decltype(known)>&>) {
          range = known;
        }
      });
    });
  }
}

// The folders first: what ends the process between the two leaves the campaign as it was, and the
// same command begins again.
void WriteAddedParameters(const CampaignFolder& folder, const CampaignSpec& spec,
                          const std::string& spec_text, journal::Journal& journal) {
  journal::CampaignRecord record = journal.Campaign();
  const CampaignSpec before = ParseSpecText(record.spec_json);
  std::vector<journal::TrialRecord> trials = journal.Trials();
  const optimizer::ParameterSpace space = SpaceOf(spec);
  for (const int i : space.Free()) {
    const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(i)];
    const auto coordinate = static_cast<std::ptrdiff_t>(CoordinateOf(spec, p.name));
    const bool was_searched = CoordinateOf(before, p.name) < SpaceOf(before).Free().size();
    if (was_searched || !p.added_at) continue;
    for (journal::TrialRecord& trial : trials) {
      trial.unit.insert(trial.unit.begin() + coordinate, p.ToUnit(*p.added_at));
      trial.native.insert(trial.native.begin() + coordinate, *p.added_at);
    }
  }
  record.parameters = SearchedParameters(spec);
  record.spec_text = spec_text;
  record.spec_json = SpecText(spec);
  for (const journal::TrialRecord& trial : trials) KeepTrial(folder, trial);
  KeepCampaign(folder, record);
  journal.SetParameters(record, trials);
}

}  // namespace talus::campaign
