// Tests of the same powder that could be made next, in the form of a campaign's experiments but
// without what they measure.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/json/json_reader.h"
#include "base/problems.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

struct TestCandidate {
  std::string name;
  // Defaults: those of the campaign's first experiment.
  std::optional<rigs::RigOptions> rig{};
  std::optional<rigs::Device> device{};
  std::optional<std::vector<engine::PairSpec>> pairs{};
  std::optional<double> mass{};  // filled [kg]
  std::optional<rigs::FillingRule> filling{};
  std::optional<rigs::PhaseRules> rules{};
  std::optional<imaging::Frame> frame{};  // default: of the lifted tube's plate; others have none
  int runs = 3;                           // that would be made, >= 1
  campaign::ExpectedErrors numbers{};     // that would be measured; default: the rig's usual ones

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "what the table calls it"});
    visit("rig", self.rig, {.doc = "kind of bulk test; default: the first experiment's"});
    visit("device", self.device,
          {.doc = "tube and plate; default: those of the first lifted tube, else the campaign's"});
    visit("pairs", self.pairs,
          {.doc = "of the powder with its walls; default: the first experiment's"});
    visit("mass", self.mass,
          {.dimension = base::Dimension::kMass,
           .doc = "filled, > 0; default: the first experiment's"});
    visit("filling", self.filling,
          {.doc = "how the powder gets in; default: the first experiment's"});
    visit("rules", self.rules, {.doc = "when each phase ends; default: the first experiment's"});
    visit("frame", self.frame,
          {.doc = "of its photographs; default: the plate of a lifted tube, and no photographs of "
                  "another rig"});
    visit("runs", self.runs, {.doc = "that would be made, >= 1"});
    campaign::ExpectedErrors::Visit(self.numbers, visit);
  }
  void Validate(base::Problems& problems) const;
};

// Names that would share a folder.
void ValidateNames(const std::vector<TestCandidate>& candidates, base::Problems& problems);

// What `talus next DIR CANDIDATES` reads: {"candidates": [{"name": …, "device": …}, …]}.
std::vector<TestCandidate> LoadTests(const std::filesystem::path& file);
std::vector<TestCandidate> ReadTests(const base::JsonFile& file);  // the same, parsed already

// The device of the first lifted tube among the experiments, else the campaign's.
rigs::Device UsualTube(const campaign::CampaignSpec& spec);

// The campaign's spec with this test as its only experiment.
campaign::CampaignSpec SpecOf(const campaign::JointView& view, const TestCandidate& test);

// Why it cannot be simulated with the campaign's powder; empty where it can.
std::string WhyNot(const campaign::JointView& view, const TestCandidate& test);

// What its simulated images are drawn in: the plate and a margin, at the pixels of the first
// experiment that has images. None without images.
std::optional<imaging::Frame> FrameOf(const campaign::JointView& view, const TestCandidate& test);

// A number that it would measure.
struct ExpectedNumber {
  std::string metric;         // "tapped_density_kg_per_m3"
  double standard_error = 0;  // in the metric's unit; 0: what the test scatters by is larger
  double relative_error = 0;  // of the value, instead
};
std::vector<ExpectedNumber> NumbersOf(const campaign::JointView& view, const TestCandidate& test);

// The entry of `experiments` that the made test will be, all but its data.
std::string ExperimentText(const campaign::JointView& view, const TestCandidate& test);

// The stem of its files: letters, digits and dashes.
std::string FileName(const TestCandidate& test);

}  // namespace talus::analysis
