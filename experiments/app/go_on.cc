#include "experiments/app/go_on.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "experiments/campaign/make_parts.h"

namespace talus::experiments {
namespace {

struct Ended {
  CampaignEnd end;
  std::filesystem::path folder;
  TellOptions tell;
};

void PrintEnd(const Campaign& campaign, const Ended& ended) {
  const auto& [end, folder, tell] = ended;
  switch (end) {
    case CampaignEnd::kFinished:
      if (tell.quiet) return;
      if (tell.json) {
        const auto result = nlohmann::ordered_json::parse(ResultText(*campaign.result()));
        std::cout << nlohmann::ordered_json{{"event", "result"}, {"result", result}}.dump()
                  << std::endl;
        return;
      }
      std::cout << ResultSummary(*campaign.result()) << "  written to        "
                << (folder / "result.json").string() << "\n  report            talus report "
                << folder.string() << std::endl;
      return;
    case CampaignEnd::kInterrupted:
      throw base::Interrupted("interrupted; `talus resume " + folder.string() + "` goes on");
    case CampaignEnd::kFailed:
      throw base::Error("the campaign has no result; `talus status " + folder.string() +
                        "` says why");
  }
}

}  // namespace

Console::Output TellOptions::output() const {
  if (quiet) return Console::Output::kQuiet;
  return json ? Console::Output::kJson : Console::Output::kStandardError;
}

void AddTellFlags(CLI::App& command, TellOptions& tell) {
  CLI::Option* quiet = command.add_flag("--quiet", tell.quiet, "say nothing unless it fails");
  command
      .add_flag("--json", tell.json,
                "one JSON object a line on standard output: each trial, progress, the result")
      ->excludes(quiet);
}

void GoOn(const std::filesystem::path& folder, const ResumeOptions& options,
          const TellOptions& tell) {
  const base::InterruptGuard interrupt;
  Console console(CampaignFolder{folder}.log(), tell.output());
  OpenedCampaign opened = OpenCampaign(folder, options, console);
  CampaignParts parts{.runner = MakeRunner(opened.spec, opened.folder.root),
                      .engine = MakeEngine(opened.spec)};
  Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal), opened.spec,
                    std::move(parts), console);
  const CampaignEnd end = campaign.Run(interrupt);
  PrintEnd(campaign, {.end = end, .folder = folder, .tell = tell});
}

}  // namespace talus::experiments
