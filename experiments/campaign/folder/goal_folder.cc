#include "experiments/campaign/folder/goal_folder.h"

#include <algorithm>
#include <cmath>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "experiments/campaign/folder/record_file.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {
namespace {

constexpr const char* kGoalFile = "goal.json";

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

std::optional<GoalState> LastGoal(const std::filesystem::path& campaign, const CampaignSpec& spec) {
  std::optional<GoalState> last;
  if (!spec.goal) return last;
  for (const std::filesystem::path& look : GoalLooks(campaign)) {
    auto state = ReadRecordFile<GoalState>(look / kGoalFile);
    if (state && state->goal == GoalText(spec)) last = std::move(state);
  }
  return last;
}

void KeepGoal(const std::filesystem::path& look, const GoalState& state) {
  WriteRecordFile(look / kGoalFile, state);
}

std::string GoalText(const CampaignSpec& spec) {
  return spec.goal ? base::JsonText(base::ToJson(*spec.goal)) : "";
}

std::string TextOf(const GoalState& state, const GoalSpec& asked) {
  return asked.metric() + " of " + asked.file.stem().string() +
         (std::isfinite(state.half_width)
              ? " known to ± " + base::ShortNumber(state.half_width, 2) + " (90 %)"
              : " not known") +
         " after " + std::to_string(state.after) + " trials, asked for ± " +
         base::ShortNumber(asked.half_width_in_results(), 2) + "; " +
         base::Counted(state.num_runs, "run") + " of it";
}

std::int64_t NextLook(std::int64_t last) {
  constexpr std::int64_t kFirst = 16;
  return last == 0 ? kFirst : last + last / 2;
}

}  // namespace talus::campaign
