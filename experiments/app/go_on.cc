#include "experiments/app/go_on.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/duration_text.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/next/advise.h"
#include "experiments/analysis/next/campaign_goal.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/sensitivity.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/campaign/make_parts.h"
#include "experiments/campaign/plan/core_time.h"

namespace talus::app {
namespace {

// A finished campaign as it is told, all of it free of the campaign's lock.
struct Ended {
  campaign::CampaignEnd end;
  std::optional<campaign::Answer> answer;
  campaign::CampaignSpec spec;
};

// What looks at the spec's goal; null where it has none.
std::unique_ptr<campaign::GoalJudge> GoalOf(const campaign::CampaignSpec& spec,
                                            const std::filesystem::path& folder) {
  if (!spec.goal) return nullptr;
  // A queue's own files stand beside the goal's runs, not among those of the campaign's trials.
  return std::make_unique<analysis::CampaignGoal>(
      spec, folder, campaign::MakeParts(spec, campaign::GoalFolder(folder)));
}

Ended RunCampaign(const std::filesystem::path& folder, const campaign::ResumeOptions& options,
                  const TellOptions& tell) {
  const base::InterruptGuard interrupt;
  campaign::Console console(campaign::CampaignFolder{folder}.log(), tell.output());
  // A goal that cannot be looked at is refused before anything of the campaign is changed.
  const auto check = [&](const campaign::CampaignSpec& spec, const journal::CampaignRecord&) {
    GoalOf(spec, std::filesystem::absolute(folder));
  };
  campaign::OpenedCampaign opened = campaign::OpenCampaign(folder, options, console, check);
  campaign::CampaignParts parts = campaign::MakeParts(opened.spec, opened.folder.root);
  parts.goal = GoalOf(opened.spec, opened.folder.root);
  parts.engine_is_new = opened.engine_is_new;
  campaign::Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal),
                              opened.spec, std::move(parts), console);
  const campaign::CampaignEnd end = campaign.Run(interrupt);
  return {.end = end, .answer = campaign.result(), .spec = opened.spec};
}

void PrintEvent(const char* event, const char* key, const std::string& json) {
  std::cout << base::JsonText(nlohmann::ordered_json{{"event", event},
                                                     {key, nlohmann::ordered_json::parse(json)}})
            << std::endl;
}

void PrintAnswer(const campaign::Answer& answer, const std::filesystem::path& folder,
                 const TellOptions& tell) {
  if (tell.quiet) return;
  if (tell.json) return PrintEvent("result", "result", campaign::AnswerJson(answer));
  std::cout << campaign::AnswerSummary(answer, folder) << "  written to        "
            << (folder / "result.json").string() << "\n  report            talus report "
            << base::ShellWord(folder.string()) << std::endl;
}

// Whether a further test is worth looking into without being asked: another set-up comes first
// where no set fits, and a queue or a foreign engine may make of it more than a few simulations.
bool IsWorthAdvice(const Ended& ended) {
  const campaign::Answer& answer = *ended.answer;
  return ended.spec.next.share > 0 && ended.spec.engine.kind == campaign::EngineKind::kTalus &&
         ended.spec.runner.kind == campaign::RunnerKind::kLocal && answer.verdict &&
         answer.verdict->kind != campaign::VerdictKind::kPoint && !campaign::IsDoubtful(answer);
}

// The few simulations that tell which further test would narrow the answer.
void PrintAdvice(const Ended& ended, const std::filesystem::path& folder, const TellOptions& tell) {
  analysis::AdviceRequest request{
      .simulate = true,
      .core_time = ended.spec.next.share * ended.answer->cost.core_hours * 3600,
      .is_in_all = true};
  if (!tell.quiet && !tell.json) {
    std::cerr << "looks into further tests for at most " << base::DurationText(*request.core_time)
              << " of core time in all (the spec's next.share)" << std::endl;
    request.say = [](const std::string& text) { std::cerr << text << std::endl; };
  }
  const analysis::NextTable table = analysis::Advise(folder, request);
  if (tell.json) return PrintEvent("next", "next", analysis::NextJson(table));
  if (tell.quiet) return;
  std::cout << campaign::WithFolder(analysis::NextSummary(table), folder) << std::flush;
}

// What the spec allows of it at the end of a campaign.
void FindSensitivityWithin(double share, const std::filesystem::path& folder,
                           const TellOptions& tell) {
  const campaign::JointView view = campaign::ReadJointView(folder);
  const std::filesystem::path place = analysis::SensitivityFolder(view.folder.root);
  analysis::SensitivityOptions options{.most_replicates = analysis::kFirstReplicates,
                                       .parts = campaign::MakeParts(view.spec, place)};
  const double takes = analysis::FirstCoreTime(view, options);
  const double allowed = share * campaign::CoreTime(view.spec).OfSearch(view.trials);
  if (takes > allowed) {
    const std::string why = "not simulated, as it takes " + base::DurationText(takes) +
                            " of processor time and the spec allows " +
                            base::DurationText(allowed) + ": talus sensitivity " +
                            base::ShellWord(folder.string());
    if (tell.json) {
      PrintEvent("message", "text", base::JsonText(nlohmann::ordered_json("sensitivity " + why)));
    } else if (!tell.quiet) {
      std::cout << "  sensitivity       " << why << std::endl;
    }
    return;
  }
  options.core_time = allowed;
  const analysis::SensitivityTable table = analysis::FindSensitivity(view, options);
  analysis::WriteSensitivity(table, view.folder.root);
  if (tell.json) {
    PrintEvent("sensitivity", "sensitivity", base::JsonText(base::ToJson(table)));
  } else if (!tell.quiet) {
    std::cout << analysis::SensitivityText(table) << std::flush;
  }
}

// What follows an answer by itself: where it fails the campaign has its answer all the same.
void Afterwards(const std::string& verb, const std::filesystem::path& folder,
                const std::function<void()>& run) {
  const auto warn = [&](const std::string& error) {
    std::cerr << "warning: `talus " << verb << "`, which follows the answer, failed: " << error
              << std::endl;
  };
  try {
    run();
  } catch (const base::Interrupted&) {
    throw base::Interrupted("interrupted after the answer was written; `talus resume " +
                            base::ShellWord(folder.string()) + "` goes on with what follows it");
  } catch (const base::Error& error) {
    warn(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    warn(error.what());
  }
}

}  // namespace

campaign::Console::Output TellOptions::output() const {
  if (quiet) return campaign::Console::Output::kQuiet;
  return json ? campaign::Console::Output::kJson : campaign::Console::Output::kStandardError;
}

void AddTellFlags(CLI::App& command, TellOptions& tell) {
  CLI::Option* quiet = command.add_flag("--quiet", tell.quiet, "say nothing unless it fails");
  command
      .add_flag("--json", tell.json,
                "one JSON object a line on standard output: each trial, progress, the result")
      ->excludes(quiet);
}

void GoOn(const std::filesystem::path& folder, const campaign::ResumeOptions& options,
          const TellOptions& tell) {
  const Ended ended = RunCampaign(folder, options, tell);
  switch (ended.end) {
    case campaign::CampaignEnd::kInterrupted:
      throw base::Interrupted("interrupted; `talus resume " + base::ShellWord(folder.string()) +
                              "` goes on");
    case campaign::CampaignEnd::kFailed:
      throw base::Error("the campaign has no result; `talus status " +
                        base::ShellWord(folder.string()) + "` says why");
    case campaign::CampaignEnd::kFinished:
      break;
  }
  PrintAnswer(*ended.answer, folder, tell);
  // First, since a further test that depends on something unknown is worth less.
  if (ended.spec.budget.sensitivity_share > 0) {
    Afterwards("sensitivity", folder,
               [&] { FindSensitivityWithin(ended.spec.budget.sensitivity_share, folder, tell); });
  }
  if (IsWorthAdvice(ended)) Afterwards("next", folder, [&] { PrintAdvice(ended, folder, tell); });
}

}  // namespace talus::app
