// Drawn heaps of the same powder by two tests, for the tests of what experiments say together.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/experiments/fake_heap.h"
#include "tests/experiments/finished_campaigns.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::campaign {

// A map of a heap, and another with what fell beside it: 23 mg of powder as the drawn heaps'
// balance shows for their true sliding friction.
class TwoExperiments : public ::testing::Test {
 public:
  std::filesystem::path Begin(const std::string& name, const std::string& fallen = "23 mg",
                              int simulations = 20, const BeginOptions& options = {}) const {
    BeginIn(scratch_.path(), name, fallen, simulations, options);
    return scratch_.path() / name;
  }
  // The same, finished: run once a program, and copied.
  std::filesystem::path Finished(const std::string& name, const std::string& fallen = "23 mg",
                                 int simulations = 20) const {
    static FinishedCampaigns<std::pair<std::string, int>> campaigns;
    campaigns.Copy({fallen, simulations}, scratch_.path() / name,
                   [&](const std::filesystem::path& in) {
                     BeginIn(in, "run", fallen, simulations, {});
                     EXPECT_EQ(RunFake(in / "run", {}), CampaignEnd::kFinished);
                   });
    return scratch_.path() / name;
  }
  static std::string FastLift(const std::string& fallen) {
    return std::string(R"({"name": "fast lift", )") + kMap +
           R"(, "device": {"lift_velocity": "20 cm/s"}, "mass_fallen": {"value": ")" + fallen +
           R"(", "sd": "1 mg"}})";
  }
  static constexpr const char* kMap = R"("map": "map.png", "plate_diameter": "10 mm",
      "frame": {"width_px": 120, "height_px": 80, "pixel_size": "0.1 mm", "center_x_px": 60,
                "baseline_px": 76, "plate_diameter": "10 mm"})";
  ScratchFolder scratch_;

 private:
  static void BeginIn(const std::filesystem::path& parent, const std::string& name,
                      const std::string& fallen, int simulations, const BeginOptions& options) {
    const std::filesystem::path in = parent / (name + "_in");
    WriteFakeSpec(in, "");
    std::ofstream(in / "spec.json")
        << R"({
      "experiments": [
        {"name": "heap", )"
        << kMap << R"(},
        )"
        << FastLift(fallen) << R"(],
      "powder": {"material": {"density": 2500},
                 "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
      "coarse_graining": {"scale_factor": 2},
      "parameters": {"sliding_friction": {"min": 0.1, "max": 0.8},
                     "rolling_friction": {"min": 0.05, "max": 0.5}},
      "budget": {"simulations": )"
        << simulations << R"(}, "confirm": {"candidates": 1, "replicates": 2}, "workers": 1})";
    BeginCampaign(in / "spec.json", parent / name, options);
  }
};

}  // namespace talus::campaign
