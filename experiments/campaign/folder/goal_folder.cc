#include "experiments/campaign/folder/goal_folder.h"

#include <algorithm>
#include <cmath>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/counted.h"
#include "experiments/campaign/folder/record_file.h"
#include "experiments/campaign/folder/time_taken.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {
namespace {

constexpr const char* kGoalFile = "goal.json";
constexpr std::int64_t kFirstLook = 16;  // number of ended trials

bool IsJudgedWith(const CampaignSpec& spec, const GoalState& state) {
  const GoalState now = NewGoalState(spec, state.after);
  return state.num_experiments == now.num_experiments && state.num_parameters == now.num_parameters;
}

}  // namespace

std::filesystem::path GoalFolder(const std::filesystem::path& campaign) {
  return std::filesystem::absolute(campaign) / "goal";
}

std::vector<std::filesystem::path> GoalLooks(const std::filesystem::path& campaign) {
  std::vector<std::filesystem::path> looks;
  if (!std::filesystem::is_directory(GoalFolder(campaign))) return looks;
  for (const auto& entry : std::filesystem::directory_iterator(GoalFolder(campaign))) {
    if (entry.is_directory()) looks.push_back(entry.path());
  }
  std::sort(looks.begin(), looks.end());
  return looks;
}

double LookCoreTime(const std::filesystem::path& look) {
  double seconds = TimeTaken(look);  // of runs that were removed
  if (!std::filesystem::is_directory(look / "trials")) return seconds;
  for (const auto& entry : std::filesystem::directory_iterator(look / "trials")) {
    if (entry.is_directory()) seconds += TimeTaken(entry.path());
  }
  return seconds;
}

double GoalCoreTime(const std::filesystem::path& campaign) {
  double seconds = 0;
  for (const std::filesystem::path& look : GoalLooks(campaign)) seconds += LookCoreTime(look);
  return seconds;
}

double GoalCoreTime(const std::filesystem::path& campaign, const CampaignSpec& spec) {
  const std::optional<GoalState> last = LastGoal(campaign, spec);
  return last ? last->core_time : GoalCoreTime(campaign);
}

GoalState NewGoalState(const CampaignSpec& spec, std::int64_t after) {
  return {.goal = GoalText(spec),
          .after = after,
          .num_experiments = static_cast<int>(ExperimentsOf(spec).size()),
          .num_parameters = static_cast<int>(SpaceOf(spec).Free().size())};
}

std::optional<GoalState> LastGoal(const std::filesystem::path& campaign, const CampaignSpec& spec) {
  std::optional<GoalState> last;
  if (!spec.goal) return last;
  for (const std::filesystem::path& look : GoalLooks(campaign)) {
    auto state = ReadRecordFile<GoalState>(look / kGoalFile);
    if (state && state->goal == GoalText(spec)) last = std::move(state);
  }
  if (!last) return last;
  if (!IsJudgedWith(spec, *last)) last->reason.reset();
  // A look that was ended has runs, too, and so have looks at what another spec asked for.
  last->core_time = std::max(last->core_time, GoalCoreTime(campaign));
  return last;
}

void KeepGoal(const std::filesystem::path& look, const GoalState& state) {
  WriteRecordFile(look / kGoalFile, state);
}

std::string GoalText(const CampaignSpec& spec) {
  return spec.goal ? base::JsonText(base::ToJson(*spec.goal)) : "";
}

std::string TextOf(const GoalState& state, const GoalSpec& asked) {
  const auto shown = [&](double width) { return rigs::ShownNumber(asked.metric(), width, 2); };
  return rigs::SpokenName(asked.metric()) + " of " + asked.file.stem().string() +
         (std::isfinite(state.half_width) ? " known to ± " + shown(state.half_width) + " (90 %)"
                                          : " not known") +
         " after " + std::to_string(state.after) + " trials, asked for ± " +
         shown(asked.half_width_in_results()) + "; " + base::Counted(state.num_runs, "run") +
         " of it" + (state.failure.empty() ? "" : ": " + state.failure);
}

std::int64_t NextLook(std::int64_t last) { return last == 0 ? kFirstLook : last + last / 2; }

std::int64_t NextLook(const std::optional<GoalState>& last, const CampaignSpec& spec) {
  const std::int64_t next = NextLook(last ? last->after : 0);
  if (!last || IsJudgedWith(spec, *last)) return next;
  return std::min(next, last->after + kFirstLook);
}

}  // namespace talus::campaign
