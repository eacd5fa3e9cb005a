#include "experiments/analysis/next/test_candidate.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/spec/validate_numbers.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/heap/film_strip.h"

namespace talus::analysis {
namespace {

struct CandidateFile {
  std::vector<TestCandidate> candidates;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("candidates", self.candidates, {.required = true, .doc = "tests that could be made"});
  }
  void Validate(base::Problems& problems) const {
    problems.Require(!candidates.empty(), "candidates", "is empty: give one or more");
    ValidateNames(candidates, problems);
  }
};

rigs::Case TypicalOf(const campaign::JointView& view, const TestCandidate& test) {
  return campaign::TypicalCase(SpecOf(view, test), 0, view.spec.coarse_graining.Levels().front());
}

// The numbers that the rig's table marks as usual, with what a careful laboratory reaches.
std::vector<ExpectedNumber> UsualNumbers(const rigs::Case& rig_case) {
  std::vector<ExpectedNumber> numbers;
  for (const rigs::RigObservable& measured : rigs::EntryOf(rig_case).observables) {
    if (!measured.usual) continue;
    const rigs::UsualError& error = rigs::InfoOf(measured.observable).usual_error;
    numbers.push_back({.metric = rigs::MetricName(measured.observable),
                       .standard_error = error.absolute,
                       .relative_error = error.relative});
  }
  return numbers;
}

// Where no experiment has images to take the pixels from.
imaging::Frame UsualFrame(double plate, double grain) {
  constexpr double kPixelsPerGrain = 5;
  constexpr double kHeight = 0.7;  // of the plate diameter: a slope of 45° and a margin
  imaging::Frame frame{.pixel_size = grain / kPixelsPerGrain};
  frame.height = static_cast<int>(std::ceil(kHeight * plate / frame.pixel_size));
  frame.baseline = frame.height - 10;
  return frame;
}

// The campaign's spec with this test as its last experiment. The strategy is left to itself: what a
// test would teach does not depend on it.
campaign::CampaignSpec SpecWith(const campaign::JointView& view, const TestCandidate& test) {
  campaign::CampaignSpec spec = SpecOf(view, test);
  campaign::ExperimentSpec made = spec.experiments->front();
  made.images = {};
  made.turning.reset();
  made.circle_diameter.reset();
  if (campaign::HasFill(made)) made.mass.reset();
  spec.experiments->clear();
  if (!view.record.experiments.empty()) spec.experiments = campaign::ExperimentsOf(view.spec);
  spec.device = rigs::MaterialsOf(spec.device);  // every experiment has its own by now
  spec.experiments->push_back(std::move(made));
  spec.strategy = {};
  return spec;
}

// What `talus add-experiment` would refuse, by the keys of the test itself.
void ValidateAsAdded(const campaign::JointView& view, const TestCandidate& test,
                     base::Problems& problems) {
  const campaign::CampaignSpec spec = SpecWith(view, test);
  const campaign::ExperimentSpec& made = spec.experiments->back();
  const std::string place = "experiments[" + std::to_string(spec.experiments->size() - 1) + "]";
  base::Problems found;
  spec.Validate(found);
  const std::vector<campaign::ScalarSpec> numbers = campaign::ScalarsOf(test.numbers);
  campaign::ValidateMeasured(made, numbers, place, found);
  campaign::ValidateNeeds(made, numbers, place, found);
  if (found.empty()) campaign::ValidateCases(spec, found);
  campaign::AddByOwnKeys(found, spec, problems);
}

}  // namespace

void TestCandidate::Validate(base::Problems& problems) const {
  base::RequireName(problems, "name", name);
  problems.RequireFromTo("runs", runs, 1, 1000);
  problems.RequirePositive("mass", mass);
}

void ValidateNames(const std::vector<TestCandidate>& candidates, base::Problems& problems) {
  std::map<std::string, std::string> folders;  // and the name of the test that has it
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::string& name = candidates[i].name;
    const auto [other, is_new] = folders.emplace(FileName(candidates[i]), name);
    if (is_new) continue;
    problems.Add("candidates[" + std::to_string(i) + "].name",
                 "\"" + name + "\" and \"" + other->second + "\" would share the folder next/" +
                     other->first + ": give each its own name");
  }
}

std::vector<TestCandidate> LoadTests(const std::filesystem::path& file) {
  return ReadTests(base::ReadJsonFile(file));
}

std::vector<TestCandidate> ReadTests(const base::JsonFile& file) {
  return base::LoadOptions<CandidateFile>(file).candidates;
}

rigs::Device UsualTube(const campaign::CampaignSpec& spec) {
  for (const campaign::ExperimentSpec& experiment : campaign::ExperimentsOf(spec)) {
    if (campaign::KindOf(experiment) == rigs::RigKind::kLiftedTube) return *experiment.device;
  }
  return spec.device;
}

campaign::CampaignSpec SpecOf(const campaign::JointView& view, const TestCandidate& test) {
  campaign::CampaignSpec spec = view.spec;
  campaign::ExperimentSpec only = campaign::ExperimentsOf(view.spec).front();
  only.name = test.name;
  only.numbers = {};
  if (test.rig) only.rig = test.rig;
  const bool is_tube = campaign::KindOf(only) == rigs::RigKind::kLiftedTube;
  only.device = is_tube ? UsualTube(view.spec) : rigs::MaterialsOf(*only.device);
  if (test.device) only.device = test.device;
  if (test.pairs) only.pairs = test.pairs;
  if (test.mass) only.mass = test.mass;
  if (test.filling) only.filling = test.filling;
  if (test.rules) only.rules = test.rules;
  spec.experiment.reset();
  spec.experiments = {only};
  return spec;
}

std::string WhyNot(const campaign::JointView& view, const TestCandidate& test) {
  base::Problems problems;
  for (const journal::ExperimentRecord& made : view.record.experiments) {  // a plan has none
    problems.Require(made.name != test.name, "name",
                     "is that of an experiment of the campaign: give the test its own");
  }
  if (problems.empty()) ValidateAsAdded(view, test, problems);
  return problems.Text();
}

std::optional<imaging::Frame> FrameOf(const campaign::JointView& view, const TestCandidate& test) {
  constexpr double kMargin = 0.1;  // of the plate diameter, on either side
  rigs::Case rig_case = TypicalOf(view, test);
  if (test.frame) {
    rig_case.frame = test.frame;
    return rigs::ProfileFrameOf(rig_case);
  }
  if (rig_case.rig.kind != rigs::RigKind::kLiftedTube) return std::nullopt;
  const auto seen = std::find_if(view.references.begin(), view.references.end(),
                                 [](const campaign::Reference& r) { return r.has_image(); });
  imaging::Frame frame = seen != view.references.end()
                             ? imaging::OnePicture(seen->frame().value())
                             : UsualFrame(rig_case.rig.lifted_tube.plate_diameter,
                                          rigs::EstimateCase(rig_case).mean_diameter);
  frame.plate_diameter = rig_case.rig.lifted_tube.plate_diameter;
  const double width = (1 + 2 * kMargin) * frame.plate_diameter / frame.pixel_size;
  frame.width = static_cast<int>(std::ceil(width));
  frame.center_x = 0.5 * frame.width;
  return frame;
}

std::vector<ExpectedNumber> NumbersOf(const campaign::JointView& view, const TestCandidate& test) {
  std::vector<ExpectedNumber> numbers;
  for (const campaign::ScalarSpec& scalar : campaign::ScalarsOf(test.numbers)) {
    numbers.push_back({.metric = scalar.metric, .standard_error = scalar.standard_error});
  }
  return numbers.empty() ? UsualNumbers(TypicalOf(view, test)) : numbers;
}

std::string ExperimentText(const campaign::JointView& view, const TestCandidate& test) {
  const campaign::ExperimentSpec only = campaign::ExperimentsOf(SpecOf(view, test)).front();
  std::string name = test.name;  // files are named after an experiment, so that it has no slash
  for (auto at = name.find('/'); at != std::string::npos; at = name.find('/')) {
    name.replace(at, 1, " per ");
  }
  nlohmann::ordered_json json{{"name", name}};
  if (only.rig) json["rig"] = base::ToJson(*only.rig);
  if (only.mass && !campaign::HasFill(only)) json["mass"] = *only.mass;
  json["device"] = base::ToJson(*only.device);
  if (!only.pairs->empty()) json["pairs"] = base::ToJson(*only.pairs);
  json["filling"] = base::ToJson(*only.filling);
  json["rules"] = base::ToJson(*only.rules);
  return base::JsonText(json, 2) + "\n";
}

std::string FileName(const TestCandidate& test) { return base::FileWord(test.name); }

}  // namespace talus::analysis
