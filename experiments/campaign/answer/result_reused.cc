#include "experiments/campaign/answer/result_reused.h"

#include <algorithm>
#include <filesystem>

#include "base/text/counted.h"
#include "base/text/plain_number.h"
#include "experiments/campaign/plan/core_time.h"

namespace talus::campaign {

std::vector<ResultReused> ReusedBy(std::span<const journal::TrialRecord> trials, int num_cores) {
  std::vector<ResultReused> list;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.kind != journal::TrialKind::kReused) continue;
    // FOLDER/trials/0001
    const std::string from =
        std::filesystem::path(trial.origin).parent_path().parent_path().string();
    auto found = std::ranges::find(list, from, &ResultReused::from);
    if (found == list.end()) found = list.insert(list.end(), {.from = from});
    ++found->num_trials;
    found->core_hours += MeasuredCoreTime(trial, num_cores) / 3600;
  }
  return list;
}

std::string ReusedText(const ResultReused& reused) {
  return base::Counted(reused.num_trials, "simulation") + " of " + reused.from + " (" +
         base::PlainNumber(reused.core_hours, 2) + " core hours there)";
}

std::string ReusedLines(const std::vector<ResultReused>& list) {
  std::string text;
  for (const ResultReused& reused : list)
    text += "  reused            " + ReusedText(reused) + "\n";
  return text;
}

}  // namespace talus::campaign
