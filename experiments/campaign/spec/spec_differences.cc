// What may change of a campaign that has begun, and what its trials depend on.
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/json/json_writer.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// Keys that a running campaign may be given anew: what to spend and where, not what to find.
constexpr std::string_view kEndSearch[] = {"budget", "goal", "confirm", "retry_failed"};
constexpr std::string_view kOfRunning[] = {"name",    "next",           "workers",
                                           "threads", "trial_time_cap", "runner"};

// What a test has of the campaign is the same whether it states it or not, as one does to which
// another has been added; and so is the only one, whichever of the two keys it stands under.
void CompleteWhereTheyDiffer(const CampaignSpec& before, const CampaignSpec& after,
                             ordered_json& old_spec, ordered_json& new_spec) {
  const ordered_json old_tests = base::ToJson(ExperimentsOf(before));
  const ordered_json new_tests = base::ToJson(ExperimentsOf(after));
  if (!before.experiments || !after.experiments) {
    for (ordered_json* spec : {&old_spec, &new_spec}) spec->erase("experiment");
    old_spec["experiments"] = old_tests;
    new_spec["experiments"] = new_tests;
    return;
  }
  for (std::size_t i = 0; i < std::min(old_tests.size(), new_tests.size()); ++i) {
    ordered_json& old_test = old_spec.at("experiments").at(i);
    ordered_json& new_test = new_spec.at("experiments").at(i);
    ordered_json keys = old_tests[i];
    keys.update(new_tests[i]);
    for (const auto& [key, _] : keys.items()) {
      if (old_test.value(key, ordered_json()) == new_test.value(key, ordered_json())) continue;
      old_test[key] = old_tests[i].value(key, ordered_json());
      new_test[key] = new_tests[i].value(key, ordered_json());
    }
  }
}

// Its names, without those that lead out of a folder.
std::vector<fs::path> NamesIn(const fs::path& place) {
  std::vector<fs::path> names;
  for (const fs::path& name : place.lexically_normal()) {
    if (!name.empty() && name != "." && name != "..") names.push_back(name);
  }
  return names;
}

// Whether what lay in one place may lie in the other now: it has gone from there, as where the
// whole project was moved, and the spec in `folder` names it by the path that the former one did.
bool MayHaveMoved(const fs::path& before, const fs::path& after, const fs::path& folder) {
  std::error_code error;
  if (before.lexically_normal() == after.lexically_normal()) return true;
  if (fs::exists(before, error)) return false;
  const fs::path from_spec = after.lexically_normal().lexically_relative(folder);
  const std::vector<fs::path> had = NamesIn(before);
  const std::vector<fs::path> named = NamesIn(from_spec);
  return !from_spec.empty() && named.size() < had.size() &&
         std::equal(named.rbegin(), named.rend(), had.rbegin());
}

// Photographs, maps, files of sizes and former campaigns: what was read of them is kept.
void TakeMovedPlaces(const ordered_json& before, const fs::path& folder, ordered_json& after,
                     bool is_place = false) {
  constexpr std::string_view kPlaces[] = {"photos", "map", "file", "from"};
  if (before.is_object() && after.is_object()) {
    for (auto entry : after.items()) {
      const auto found = before.find(entry.key());
      if (found == before.end()) continue;
      TakeMovedPlaces(*found, folder, entry.value(), std::ranges::count(kPlaces, entry.key()) > 0);
    }
  } else if (before.is_array() && after.is_array() && before.size() == after.size()) {
    for (std::size_t i = 0; i < after.size(); ++i) {
      TakeMovedPlaces(before[i], folder, after[i], is_place);
    }
  } else if (is_place && before.is_string() && after.is_string() && before != after) {
    if (MayHaveMoved(before.get<std::string>(), after.get<std::string>(), folder)) after = before;
  }
}

}  // namespace

std::vector<base::JsonChange> ForbiddenChanges(const std::string& old_text,
                                               const std::string& new_text,
                                               const fs::path& folder) {
  // Read and written again, as keys may have come with their defaults since it was written.
  const CampaignSpec before = ParseSpecText(old_text);
  const CampaignSpec after = ParseSpecText(new_text);
  ordered_json old_spec = ordered_json::parse(SpecText(before));
  ordered_json new_spec = ordered_json::parse(new_text);
  if (before.experiments || after.experiments) {
    CompleteWhereTheyDiffer(before, after, old_spec, new_spec);
  }
  TakeMovedPlaces(old_spec, folder.lexically_normal(), new_spec);
  for (ordered_json* spec : {&old_spec, &new_spec}) {
    for (const std::string_view key : kEndSearch) spec->erase(std::string(key));
    for (const std::string_view key : kOfRunning) spec->erase(std::string(key));
    // Templates may lie elsewhere where they are the same: their hash says so.
    if (spec->contains("engine")) spec->at("engine").erase("templates");
  }
  return base::JsonChanges(old_spec, new_spec);
}

bool AsksMore(const std::string& old_text, const std::string& new_text) {
  ordered_json old_spec = ordered_json::parse(SpecText(ParseSpecText(old_text)));
  ordered_json new_spec = ordered_json::parse(new_text);
  for (ordered_json* spec : {&old_spec, &new_spec}) {
    if (spec->contains("budget")) spec->at("budget").erase("sensitivity_share");
    if (!spec->contains("goal")) continue;
    // The project may lie elsewhere now.
    ordered_json& file = spec->at("goal").at("case");
    file = std::filesystem::path(file.get<std::string>()).filename().string();
  }
  return std::ranges::any_of(kEndSearch, [&](std::string_view key) {
    return old_spec.value(std::string(key), ordered_json()) !=
           new_spec.value(std::string(key), ordered_json());
  });
}

std::string ChangeText(const base::JsonChange& change) {
  if (change.path == "engine.templates_hash") {
    return "engine.templates: holds other files than it did then";
  }
  return change.path + ": " + change.before + " → " + change.after;
}

}  // namespace talus::campaign
