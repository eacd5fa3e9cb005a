#include "experiments/campaign/status.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/number_text.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/campaign/folder/goal_folder.h"
#include "experiments/campaign/plan/budget_use.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/plan/stop.h"
#include "experiments/campaign/record/stored.h"

namespace talus::campaign {
namespace {

struct Counts {
  std::array<int, static_cast<std::size_t>(LastOf(journal::TrialKind{})) + 1> by_kind{};
  int running = 0;
  int failed = 0;
  double seconds = 0;  // of the finished trials
  int finished = 0;

  explicit Counts(const std::vector<journal::TrialRecord>& trials) {
    for (const journal::TrialRecord& trial : trials) {
      ++by_kind[static_cast<std::size_t>(trial.kind)];
      running += trial.status == journal::TrialStatus::kRunning;
      failed += trial.status == journal::TrialStatus::kFailed;
      if (trial.status == journal::TrialStatus::kRunning || !(trial.duration_s > 0)) continue;
      seconds += trial.duration_s;
      ++finished;
    }
  }
};

// Trials of one experiment at one scale factor: only their objectives compare.
struct Kind {
  int experiment = 0;
  double scale_factor = 1;

  bool Is(const journal::TrialRecord& trial) const {
    return trial.experiment == experiment && trial.scale_factor == scale_factor;
  }
};

std::string BestLine(const std::vector<journal::TrialRecord>& trials,
                     const journal::CampaignRecord& campaign, const Reference& reference,
                     const Kind& kind) {
  if (!reference.has_image()) return "numbers only, so none is the best\n";
  const auto* best = BestOfSearch(trials, reference, kind.experiment, kind.scale_factor);
  if (best == nullptr) return "none has succeeded yet\n";
  return "best " + base::ShortNumber(*reference.Value(*best)) + " " +
         std::string(reference.info().unit) + (reference.info().is_angle ? " off" : "") +
         ", trial " + std::to_string(best->id) + ": " + SetText(campaign.parameters, best->native) +
         "\n";
}

std::string BestLines(const std::vector<journal::TrialRecord>& trials,
                      const journal::CampaignRecord& campaign, const CampaignSpec& spec) {
  const std::vector<Reference> references = ReferencesOf(campaign, spec);
  std::string text;
  for (std::size_t e = 0; e < references.size(); ++e) {
    for (const double factor : spec.coarse_graining.Levels()) {
      const Kind kind{.experiment = static_cast<int>(e), .scale_factor = factor};
      const auto count = std::count_if(
          trials.begin(), trials.end(),
          [&](const journal::TrialRecord& t) { return kind.Is(t) && t.IsOfSearch(); });
      text += "  " + campaign.experiments[e].name + " at scale factor " +
              base::ShortNumber(factor) + ": " + base::Counted(count, "trial") +
              " besides those that confirm; " + BestLine(trials, campaign, references[e], kind);
    }
  }
  return text;
}

// Reasons quote several lines of a log.
std::string Indented(std::string text, std::size_t blanks) {
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
    text.insert(at + 1, blanks, ' ');
  }
  return text;
}

// One for each run of digits: reasons that differ in seeds, times and folders are one and the same.
std::string WithoutNumbers(const std::string& reason) {
  std::string text;
  for (const char c : reason) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0)
      text += c;
    else if (text.empty() || text.back() != '#')
      text += '#';
  }
  return text;
}

struct Failures {
  std::string first;  // reason
  int count = 0;
  bool differ = false;  // in their numbers
};

std::string FailureLines(const std::vector<journal::TrialRecord>& trials) {
  std::map<std::string, Failures> reasons;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.status != journal::TrialStatus::kFailed) continue;
    Failures& failures = reasons[WithoutNumbers(trial.reason)];
    if (failures.count++ == 0) failures.first = trial.reason;
    failures.differ |= trial.reason != failures.first;
  }
  std::string text;
  for (const auto& [kind, failures] : reasons) {
    const std::string count = std::to_string(failures.count) + " × ";
    text += "    " + count + Indented(failures.first, 4 + count.size() - 1) +
            (failures.differ ? " (the numbers differ)" : "") + "\n";
  }
  return text;
}

// In words: where there is no result, why "finished" would mislead.
std::string StateText(const journal::ProgressRecord& progress, bool alive,
                      const std::vector<journal::TrialRecord>& trials) {
  using journal::CampaignState;
  if (progress.state == CampaignState::kRunning && !alive) {
    return std::string(kEndedSilently) + "; `talus resume DIR` goes on";
  }
  if (progress.state != CampaignState::kFinished || !progress.result_json.empty()) {
    return std::string(base::NameOf(progress.state));
  }
  return FailingExperiments(trials).empty()
             ? "ended without a result"
             : "ended without a result; mend the cause, and `talus resume DIR` runs the failed "
               "trials again";
}

// "  trials            24 (3 for the noise, 12 of the design, 9 of the search), 6 to confirm"
std::string TrialsLine(const Counts& counts) {
  const auto of = [&](journal::TrialKind kind) {
    return counts.by_kind[static_cast<std::size_t>(kind)];
  };
  const int noise = of(journal::TrialKind::kNoise);
  const int design = of(journal::TrialKind::kDesign);
  const int search = of(journal::TrialKind::kSearch);
  return "  trials            " + std::to_string(noise + design + search) + " (" +
         std::to_string(noise) + " for the noise, " + std::to_string(design) + " of the design, " +
         std::to_string(search) + " of the search), " +
         std::to_string(of(journal::TrialKind::kConfirm)) + " to confirm\n";
}

std::string NoiseLines(const std::vector<journal::ExperimentRecord>& experiments) {
  std::string text;
  for (const journal::ExperimentRecord& e : experiments) {
    if (!e.noise_mm2) continue;
    text += "  noise floor       " + base::ShortNumber(*e.noise_mm2) + " mm² (" +
            (experiments.size() > 1 ? e.name : "experiment") + ")\n";
  }
  return text;
}

// What it has taken so far, and the goal where there is one.
std::string TimeLines(const CampaignFolder& folder, const CampaignSpec& spec,
                      const std::vector<journal::TrialRecord>& trials,
                      const journal::ProgressRecord& progress) {
  const Counts counts(trials);
  std::string text;
  if (counts.finished > 0) {
    text += "  a trial takes     " + base::DurationText(counts.seconds / counts.finished) + "\n";
  }
  text += "  worked on for     " + base::DurationText(progress.elapsed_s) + "\n";
  const std::optional<GoalState> goal = LastGoal(folder.root, spec);
  const BudgetUse use = UseSoFar(folder.root, spec, trials, progress.elapsed_s);
  if (goal) text += "  goal              " + TextOf(*goal, *spec.goal) + "\n";
  if (spec.goal && !goal) text += "  goal              not looked at yet\n";
  text += "  budget used       " + UseText(spec.budget, use, progress.elapsed_s) + "\n";
  const bool goes_on =
      progress.result_json.empty() && progress.state != journal::CampaignState::kFinished;
  if (goes_on && use.seconds_left) {
    text += "  time left         at most " + base::DurationText(*use.seconds_left) + "\n";
  }
  return text;
}

}  // namespace

BudgetUse UseSoFar(const std::filesystem::path& folder, const CampaignSpec& spec,
                   const std::vector<journal::TrialRecord>& trials, double elapsed) {
  const auto running =
      std::ranges::count(trials, journal::TrialStatus::kRunning, &journal::TrialRecord::status);
  return UseOf(spec, trials, elapsed, AtATime(spec, static_cast<int>(running)),
               GoalCoreTime(folder, spec));
}

std::string StatusText(const std::filesystem::path& root) {
  const CampaignFolder folder{root};
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder.root));
  const journal::CampaignRecord campaign = journal.Campaign();
  const journal::ProgressRecord progress = journal.Progress();
  const std::vector<journal::TrialRecord> trials = journal.Trials();
  const CampaignSpec spec = SpecOfAnswer(campaign, progress);
  const Counts counts(trials);
  const bool alive = IsWorkedOn(folder.root);

  std::optional<Answer> answer;
  if (!progress.result_json.empty()) answer = ParseAnswer(progress.result_json);
  std::string text =
      campaign.name + ": " + WithFolder(StateText(progress, alive, trials), root) + "\n";
  // With an answer its alarms say it.
  if (!progress.stop_reason.empty() && !(answer && answer->unsettled))
    text += "  because           " + Indented(progress.stop_reason, 20) + "\n";
  text += TrialsLine(counts);
  if (!answer) text += ReusedLines(ReusedBy(trials, CoresOfTrial(spec)));
  text += "  now               " + std::to_string(counts.running) +
          (alive ? " under way\n" : " to be run or collected\n");
  text += "  failed            " + std::to_string(counts.failed) + "\n" + FailureLines(trials);
  text += BestLines(trials, campaign, spec) + NoiseLines(campaign.experiments) +
          TimeLines(folder, spec, trials, progress);
  if (answer) text += "\n" + AnswerSummary(*answer, root);
  return text;
}

}  // namespace talus::campaign
