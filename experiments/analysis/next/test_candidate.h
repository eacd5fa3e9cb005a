// Tests of the same powder that could be made next, in the form of a campaign's experiments but
// without what they measure.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

struct TestCandidate {
  std::string name;
  std::optional<rigs::Device> device{};    // default: that of the campaign's first experiment
  std::optional<rigs::HeapRules> rules{};  // default: likewise
  int runs = 3;                            // that would be photographed, >= 1

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "what the table calls it"});
    visit("device", self.device, {.doc = "tube and plate; default: the first experiment's"});
    visit("rules", self.rules, {.doc = "when each phase ends; default: the first experiment's"});
    visit("runs", self.runs, {.doc = "that would be photographed, >= 1"});
  }
  void Validate(base::Problems& problems) const;
};

// What `talus next DIR CANDIDATES` reads: {"candidates": [{"name": …, "device": …}, …]}.
std::vector<TestCandidate> LoadTests(const std::filesystem::path& file);

// Those that most laboratories can make, without the ones that the campaign has: a plate three
// times as wide as the tube at two lift velocities, and a rough plate.
std::vector<TestCandidate> UsualTests(const campaign::JointView& view);

// The campaign's spec with this test as its only experiment.
campaign::CampaignSpec SpecOf(const campaign::JointView& view, const TestCandidate& test);

// What its simulated images are drawn in: the plate and a margin, at the first experiment's pixels.
imaging::Frame FrameOf(const campaign::JointView& view, const TestCandidate& test);

// Of its files: letters, digits and dashes.
std::string FileName(const TestCandidate& test);

}  // namespace talus::analysis
