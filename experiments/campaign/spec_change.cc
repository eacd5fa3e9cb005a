#include "experiments/campaign/spec_change.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/text/counted.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/add_parameter.h"
#include "experiments/campaign/earlier_posterior.h"
#include "experiments/campaign/mended_engine.h"
#include "experiments/campaign/plan/core_time.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

constexpr int kOfAddedParameter = 16;  // simulations of each experiment, where nobody says

// Templates that are not where they were, as after the whole project has been moved: they are
// looked for beside the spec that is named, or beside the campaign's folder, by the path that the
// spec's text has.
void FollowTemplates(const journal::CampaignRecord& record, const fs::path& root,
                     const fs::path& named, SpecChange& change) {
  auto& templates = change.spec.engine.command.templates;
  if (!templates || fs::is_directory(*templates)) return;
  const nlohmann::json written = base::ParseJson(record.spec_text, record.spec_path).root;
  const fs::path beside = named.empty() ? root.parent_path() : fs::absolute(named).parent_path();
  const fs::path moved =
      (beside / written.at("engine").at("templates").get<std::string>()).lexically_normal();
  if (!fs::is_directory(moved)) return;
  templates = moved;
  change.event = "moved";
  change.words = "its templates lie in " + moved.string() + " now";
}

// How many tests the campaign began with: its file need have no others.
std::size_t NumBegunWith(const nlohmann::json& begun_with, const CampaignSpec& going) {
  const std::size_t num_listed =
      begun_with.contains("experiments") ? begun_with.at("experiments").size() : 1;
  const auto num_added = static_cast<std::size_t>(going.num_added.value_or(0));
  return std::min(num_listed, going.experiments->size() - num_added);
}

// What the campaign was given after it began, and the spec's file may not know of: further tests,
// of which it may list the first ones, and a budget, unless the file's own has been changed since.
void KeepWhatWasGiven(const nlohmann::json& begun_with, const nlohmann::json& written,
                      const CampaignSpec& going, CampaignSpec& read) {
  const auto budget = [](const nlohmann::json& spec) {
    return spec.value("budget", nlohmann::json());
  };
  if (budget(begun_with) == budget(written)) read.budget = going.budget;
  read.num_added = going.num_added;
  if (!going.experiments) return;
  const std::vector<ExperimentSpec>& all = *going.experiments;
  std::vector<ExperimentSpec> listed = ExperimentsOf(read);
  if (listed.size() < NumBegunWith(begun_with, going) || listed.size() >= all.size()) return;
  listed.insert(listed.end(), all.begin() + std::ssize(listed), all.end());
  read.experiments = std::move(listed);
  read.experiment.reset();
}

// A drum's fill was read off its photographs, which need not be there any more.
void KeepDrumFills(const nlohmann::json& written, const CampaignSpec& begun, CampaignSpec& read) {
  const auto states_fill = [](const nlohmann::json& place) {
    return place.contains("rig") && place.at("rig").contains("fill");
  };
  if (!states_fill(written) && read.rig && begun.rig) read.rig->drum.fill = begun.rig->drum.fill;
  if (!read.experiments || !begun.experiments || !written.contains("experiments")) return;
  const nlohmann::json& entries = written.at("experiments");
  for (std::size_t i = 0; i < std::min(entries.size(), begun.experiments->size()); ++i) {
    std::optional<rigs::RigOptions>& rig = (*read.experiments)[i].rig;
    const std::optional<rigs::RigOptions>& had = (*begun.experiments)[i].rig;
    if (rig && had && !states_fill(entries[i])) rig->drum.fill = had->drum.fill;
  }
}

// Not in somebody's private folder, say.
bool IsReadable(const fs::path& path) { return ::access(path.c_str(), R_OK) == 0; }

// No trial has succeeded with the one before.
void NoteMendedEngine(SpecChange& change) {
  change.engine_is_new = change.asks_more = true;
  change.event = "engine";
  change.words += (change.words.empty() ? "" : ", ") +
                  std::string("its engine has changed, with which no trial had succeeded");
}

// The spec as it is to be from now on; says what has changed where that is not allowed.
SpecChange SpecToGoOnWith(const journal::CampaignRecord& record,
                          const std::vector<journal::TrialRecord>& trials, const fs::path& root,
                          const ResumeOptions& options) {
  const bool named = !options.spec.empty();
  const fs::path path = named ? options.spec : fs::path(record.spec_path);
  SpecChange change{.spec = {}, .text = record.spec_text, .event = {}, .words = {}};
  if (named) change.path = fs::absolute(path).lexically_normal().string();
  if (named || IsReadable(path)) {
    change.text = base::ReadFile(path);
  } else {
    change.note = path.string() + ": is not there or cannot be read; it goes on by the spec in " +
                  (root / "campaign.json").string() +
                  ", and `talus resume DIR --spec FILE` by another file";
  }
  if (change.text == record.spec_text) {
    change.spec = ParseSpecText(record.spec_json);
    FollowTemplates(record, root, options.spec, change);
    if (TakeMendedTemplates(trials, change.spec)) NoteMendedEngine(change);
    return change;
  }
  const CampaignSpec begun = ParseSpecText(record.spec_json);
  const base::JsonFile file = base::ReadJsonFile(path);
  change.spec = ReadSpecWithPosteriors(file, &begun);
  const nlohmann::json begun_with = base::ParseJson(record.spec_text, record.spec_path).root;
  // `calibrate --hold-out` is of the campaign and not in the file.
  const auto held_out = [](const nlohmann::json& spec) {
    return spec.value("hold_out", nlohmann::json());
  };
  if (held_out(begun_with) == held_out(file.root)) change.spec.hold_out = begun.hold_out;
  KeepAddedParameters(begun, change.spec);
  KeepDrumFills(file.root, begun, change.spec);
  KeepWhatWasGiven(begun_with, file.root, begun, change.spec);
  auto forbidden =
      ForbiddenChanges(record.spec_json, SpecText(change.spec), fs::absolute(path).parent_path());
  const bool engine_is_new = AllowMendedEngine(trials, forbidden);
  if (!forbidden.empty()) {
    std::string message = path.string() +
                          ": has changed since the campaign began, in what its trials depend on; "
                          "undo this, or begin a new campaign, which takes over what it can "
                          "(`talus calibrate " +
                          base::ShellWord(path.string()) + " --out NEW --reuse " +
                          base::ShellWord(root.string()) + "`):";
    for (const base::JsonChange& what : forbidden) message += "\n  " + ChangeText(what);
    throw base::ConfigError(message);
  }
  change.event = "spec";
  change.asks_more = AsksMore(record.spec_json, SpecText(change.spec));
  change.words = change.asks_more ? "changed in what the search is to find or may spend"
                                  : "changed in what no search depends on";
  if (engine_is_new) NoteMendedEngine(change);
  return change;
}

// [core s] of one more simulation, by what those so far took.
double UsualCoreTime(const CampaignSpec& spec, const std::vector<journal::TrialRecord>& trials) {
  CoreTime core_time(spec);
  const double sum = core_time.OfSearch(trials);
  const auto num = std::ranges::count_if(trials, &journal::TrialRecord::IsPaidFor);
  return num > 0 ? sum / static_cast<double>(num)
                 : core_time.OfOne(0, spec.coarse_graining.scale_factor);
}

// A search that has ended is counted in simulations from now on, whatever ended it. One that has
// not keeps its budget, larger by what so many take, and its rule, which waits for so many more.
void AddSimulations(journal::Journal& journal, int num_more, SpecChange& change) {
  const std::vector<journal::TrialRecord> trials = journal.Trials();
  const auto num_search =
      static_cast<int>(std::ranges::count_if(trials, &journal::TrialRecord::IsPaidFor));
  const auto num_told =
      static_cast<int>(std::ranges::count_if(trials, &journal::TrialRecord::IsOfSearch));
  const journal::ProgressRecord progress = journal.Progress();
  BudgetOptions& budget = change.spec.budget;
  const bool ended = SearchHasEnded(progress, budget);
  const int from = ended ? num_search : std::max(num_search, budget.simulations);
  if (num_more > BudgetOptions::kMostSimulations - from) {
    throw base::ConfigError("--add-simulations: " + std::to_string(num_more) +
                            " more would be above " +
                            std::to_string(BudgetOptions::kMostSimulations) + " simulations");
  }
  if (ended) budget.core_time.reset();
  if (budget.core_time) {
    *budget.core_time += num_more * UsualCoreTime(change.spec, trials);
    // Where none has succeeded all are run again, and have taken their time for nothing.
    const bool all_again = std::ranges::none_of(trials, [](const journal::TrialRecord& trial) {
      return trial.status == journal::TrialStatus::kOk;
    });
    if (all_again) *budget.core_time += CoreTime(change.spec).OfSearch(trials);
  }
  if (!budget.core_time || budget.simulations > 0) budget.simulations = from + num_more;
  // The least is counted with what was reused.
  const int least = std::min(BudgetOptions::kMostSimulations, num_told + num_more);
  budget.min_simulations = ended ? least : std::max(budget.min_simulations, least);
  if (ended || progress.elapsed_s >= budget.wall_clock.value_or(0)) budget.wall_clock.reset();
  if (!change.asks_more) change.event = "extend";
  change.asks_more = true;
  change.words += (change.words.empty() ? "by " : ", by ") + base::Counted(num_more, "simulation");
}

void AddParameters(const std::vector<std::string>& search, SpecChange& change) {
  for (const std::string& text : search) {
    const AddedParameter added = ParseAddedParameter(text);
    change.spec = SpecWith(change.spec, added);
    change.event = "search";
    change.asks_more = true;
    change.words += (change.words.empty() ? "" : ", ") + added.name + " from now on";
  }
}

}  // namespace

bool SearchHasEnded(const journal::ProgressRecord& progress, const BudgetOptions& budget) {
  const bool ran_out =
      progress.elapsed_s >= budget.wall_clock.value_or(std::numeric_limits<double>::infinity());
  return !progress.stop_json.empty() || (progress.state == journal::CampaignState::kFinished &&
                                         (ran_out || !progress.result_json.empty()));
}

SpecChange ChangeOf(journal::Journal& journal, const std::filesystem::path& root,
                    const ResumeOptions& options) {
  const journal::CampaignRecord record = journal.Campaign();
  SpecChange change = SpecToGoOnWith(record, journal.Trials(), root, options);
  AddParameters(options.search, change);
  const int num_more = options.add_simulations > 0 || options.search.empty()
                           ? options.add_simulations
                           : kOfAddedParameter * static_cast<int>(record.experiments.size());
  if (num_more > 0) AddSimulations(journal, num_more, change);
  return change;
}

}  // namespace talus::campaign
