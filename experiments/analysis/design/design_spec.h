// What `talus design` reads: a campaign's spec without data, and the tests that could be made.
#pragma once

#include <filesystem>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/analysis/next/test_candidate.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::analysis {

struct DesignSpec {
  campaign::CampaignSpec campaign;        // with the spec's own device as its only experiment
  std::vector<TestCandidate> candidates;  // default: the spec's own device and the usual tests

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    campaign::CampaignSpec::Visit(self.campaign, visit);
    visit("candidates", self.candidates,
          {.doc = "tests that could be made; default: the spec's own device and the usual ones"});
  }
  void Validate(base::Problems& problems) const;
};

// Throws one ConfigError with every problem.
DesignSpec LoadDesignSpec(const std::filesystem::path& path);

// The spec as a campaign without trials, in this folder.
campaign::JointView ViewOf(const DesignSpec& design, const std::filesystem::path& folder);

}  // namespace talus::analysis
