// A campaign without simulations: heaps are drawn, in a millisecond, from the parameters and the
// seed. For the tests of everything that goes on round a simulation.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "base/json/json_file.h"
#include "experiments/campaign/make_parts.h"
#include "experiments/campaign/start.h"
#include "tests/experiments/drawn_runner.h"
#include "tests/experiments/fake_engine.h"

namespace talus::campaign {

// spec.json and the experiment's map in `folder`; `more` are further members of the spec.
inline std::filesystem::path WriteFakeSpec(const std::filesystem::path& folder,
                                           const std::string& more) {
  std::filesystem::create_directories(folder);
  imaging::WritePng(folder / "map.png", DrawHeap(kTrueSliding, kTrueRolling, 12345));
  std::ofstream(folder / "spec.json") << R"({
  "name": "fake",
  "experiment": {"map": "map.png", "plate_diameter": "10 mm",
    "frame": {"width_px": 120, "height_px": 80, "pixel_size": "0.1 mm", "center_x_px": 60,
              "baseline_px": 76, "plate_diameter": "10 mm"}},
  "powder": {"material": {"density": 2500},
             "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
  "parameters": {"sliding_friction": {"min": 0.1, "max": 0.8},
                 "rolling_friction": {"min": 0.05, "max": 0.5}})"
                                      << more << "\n}\n";
  return folder / "spec.json";
}

// One session of a campaign with drawn heaps.
inline CampaignEnd RunFake(const std::filesystem::path& folder, const FakeEngineOptions& engine,
                           const ResumeOptions& resume = {}) {
  const base::InterruptGuard interrupt;
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  OpenedCampaign opened = OpenCampaign(folder, resume, console);
  CampaignParts parts{.runner = MakeDrawnRunner(opened.spec, opened.folder.root),
                      .engine = std::make_unique<FakeEngine>(engine)};
  Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal), opened.spec,
                    std::move(parts), console);
  return campaign.Run(interrupt);
}

// What two campaigns that did the same have in common: everything of a trial but times and places.
inline std::string TrialTable(const std::filesystem::path& folder) {
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  std::string table;
  for (const journal::TrialRecord& t : journal.Trials()) {
    table += std::to_string(t.id) + " " + std::string(base::NameOf(t.kind)) + " " + t.origin + " " +
             std::string(base::NameOf(t.status)) + " " + std::to_string(t.seed) + " " +
             std::to_string(t.finish_order);
    char number[32];
    for (const double value : t.unit) {
      std::snprintf(number, sizeof number, " %.17g", value);
      table += number;
    }
    std::snprintf(number, sizeof number, " %.17g\n", t.Metric("sad_mm2").value_or(-1));
    table += number;
  }
  return table;
}

}  // namespace talus::campaign
