#include "experiments/app/go_on.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/make_parts.h"

namespace talus::app {
namespace {

struct Ended {
  campaign::CampaignEnd end;
  std::filesystem::path folder;
  TellOptions tell;
};

void PrintEnd(const campaign::Campaign& campaign, const Ended& ended) {
  const auto& [end, folder, tell] = ended;
  switch (end) {
    case campaign::CampaignEnd::kFinished:
      if (tell.quiet) return;
      if (tell.json) {
        const auto result = nlohmann::ordered_json::parse(campaign::AnswerJson(*campaign.result()));
        std::cout << base::JsonText(nlohmann::ordered_json{{"event", "result"}, {"result", result}})
                  << std::endl;
        return;
      }
      std::cout << campaign::AnswerSummary(*campaign.result(), folder) << "  written to        "
                << (folder / "result.json").string() << "\n  report            talus report "
                << base::ShellWord(folder.string()) << std::endl;
      return;
    case campaign::CampaignEnd::kInterrupted:
      throw base::Interrupted("interrupted; `talus resume " + folder.string() + "` goes on");
    case campaign::CampaignEnd::kFailed:
      throw base::Error("the campaign has no result; `talus status " + folder.string() +
                        "` says why");
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
  const base::InterruptGuard interrupt;
  campaign::Console console(campaign::CampaignFolder{folder}.log(), tell.output());
  campaign::OpenedCampaign opened = campaign::OpenCampaign(folder, options, console);
  campaign::CampaignParts parts{.runner = campaign::MakeRunner(opened.spec, opened.folder.root),
                                .engine = campaign::MakeEngine(opened.spec)};
  campaign::Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal),
                              opened.spec, std::move(parts), console);
  const campaign::CampaignEnd end = campaign.Run(interrupt);
  PrintEnd(campaign, {.end = end, .folder = folder, .tell = tell});
}

}  // namespace talus::app
