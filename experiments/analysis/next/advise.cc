#include "experiments/analysis/next/advise.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/rank_next.h"
#include "experiments/analysis/next/usual_tests.h"
#include "experiments/analysis/predict/predict.h"
#include "experiments/campaign/answer/standing_answer.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/folder/goal_folder.h"
#include "experiments/campaign/make_parts.h"
#include "experiments/campaign/plan/core_time.h"

namespace talus::analysis {
namespace {

// What a finished campaign's alarms ask for, as its report puts it first.
int SimulateFirst(const std::filesystem::path& campaign) {
  const std::optional<campaign::Answer> answer = campaign::StandingAnswer(campaign);
  return answer && campaign::AsksForSimulations(*answer) ? campaign::MoreSimulations(*answer) : 0;
}

std::string WordsOf(const AdviceRequest& request) {
  std::string words;
  if (!request.candidates.empty()) words += " " + base::ShellWord(request.candidates.string());
  if (!request.goal) return words;
  words += " --for " + base::ShellWord(request.goal->file.string());
  if (request.goal->observable.empty()) return words;
  return words + " --observable " + base::ShellWord(request.goal->observable);
}

// What the campaign itself has taken [s], its goal's runs included.
double CoreTimeOf(const campaign::JointView& view) {
  std::vector<journal::TrialRecord> own = view.trials;
  std::erase_if(own, [](const journal::TrialRecord& trial) {
    return trial.kind == journal::TrialKind::kReused;
  });
  return campaign::CoreTime(view.spec).Of(own) +
         campaign::GoalCoreTime(view.folder.root, view.spec);
}

}  // namespace

NextTable Advise(const std::filesystem::path& campaign, const AdviceRequest& request) {
  const campaign::JointView view = campaign::ReadJointView(campaign);
  const std::filesystem::path folder = campaign::NextFolder(view.folder.root);
  std::vector<TestCandidate> tests =
      request.candidates.empty() ? UsualTests(view) : LoadTests(request.candidates);
  std::optional<campaign::CampaignLock> lock;  // its simulations are one process's at a time
  if (request.simulate) {
    std::filesystem::create_directories(folder);
    lock.emplace(folder);
  }
  std::optional<Goal> goal;
  if (request.goal) {
    goal = SimulateGoal(
        view, *request.goal,
        campaign::MakeParts(view.spec,
                            PredictionFolder(view.folder.root, {.file = request.goal->file})));
  }
  // A queue's own files stand beside the designs, not among those of the campaign's trials.
  NextTable table = RankNext(view, {.tests = std::move(tests),
                                    .simulate = request.simulate,
                                    .core_time = request.core_time.value_or(CoreTimeOf(view)),
                                    .is_in_all = request.is_in_all,
                                    .say = request.say,
                                    .parts = campaign::MakeParts(view.spec, folder),
                                    .goal = std::move(goal)});
  table.simulate_first = SimulateFirst(view.folder.root);
  table.asked = WordsOf(request);
  table.has_simulated = request.simulate;
  if (base::MayWriteInto(folder)) {  // of somebody else's campaign the table is shown only
    std::filesystem::create_directories(folder);
    base::WriteFileAtomically(folder / "next.json", NextJson(table));
  }
  return table;
}

}  // namespace talus::analysis
