#include "experiments/app/go_on.h"

#include <iostream>
#include <string>

#include "base/error.h"
#include "experiments/campaign/make_parts.h"

namespace talus::experiments {
namespace {

void PrintEnd(const Campaign& campaign, CampaignEnd end, const std::filesystem::path& folder) {
  switch (end) {
    case CampaignEnd::kFinished:
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

void GoOn(const std::filesystem::path& folder, const ResumeOptions& options) {
  const base::InterruptGuard interrupt;
  Console console(CampaignFolder{folder}.log());
  OpenedCampaign opened = OpenCampaign(folder, options, console);
  CampaignParts parts{.runner = MakeRunner(opened.spec, opened.folder.root),
                      .engine = MakeEngine(opened.spec)};
  Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal), opened.spec,
                    std::move(parts), console);
  const CampaignEnd end = campaign.Run(interrupt);
  PrintEnd(campaign, end, folder);
}

}  // namespace talus::experiments
