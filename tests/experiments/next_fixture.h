// What the tests of `talus next` begin with: a finished campaign of two scale factors.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "experiments/analysis/next/rank_next.h"
#include "experiments/analysis/next/usual_tests.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {

// What falls off the plate tells μ_t, and nobody has weighed it.
class NextFixture : public campaign::CampaignFixture {
 protected:
  // The drawn heap alone leaves μ_t and μ_r to 0.01: numbers that scatter by less tell more.
  static constexpr campaign::FakeEngineOptions kSharp{.mass_scatter = 1e-7, .density_scatter = 0.5};

  campaign::JointView Run() {
    folder_ = Finished(R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)",
                       kSharp);
    return campaign::ReadJointView(folder_);
  }
  static NextTable Rank(const campaign::JointView& view, std::vector<TestCandidate> tests,
                        bool simulate) {
    NextOptions options{.tests = std::move(tests), .simulate = simulate};
    options.parts = Parts(view);
    return RankNext(view, options);
  }
  static campaign::CampaignParts Parts(const campaign::JointView& view) {
    return {.runner = campaign::MakeDrawnRunner(view.spec, view.folder.root),
            .engine = std::make_unique<campaign::FakeEngine>(kSharp)};
  }
  std::filesystem::path Taps() const {
    const std::filesystem::path file = scratch_.path() / "taps.json";
    std::ofstream(file) << R"({"powder": {"material": {"density": 2500},
      "sizes": {"kind": "mono", "diameter": "0.4 mm"},
      "mass": "0.5 g"}, "rig": {"kind": "tapped_density", "diameter": "10 mm"},
      "filling": {"kind": "pour"}})";
    return file;
  }
  static const NextCandidate& Find(const NextTable& table, const std::string& name) {
    for (const NextCandidate& c : table.candidates) {
      if (c.name == name) return c;
    }
    throw base::Error("no candidate " + name);
  }
  std::filesystem::path folder_;
};

}  // namespace talus::analysis
