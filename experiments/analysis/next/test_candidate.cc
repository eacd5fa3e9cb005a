#include "experiments/analysis/next/test_candidate.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/rigs/rig_list.h"

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
  }
};

rigs::HeapCase TypicalOf(const campaign::JointView& view, const TestCandidate& test) {
  return campaign::TypicalCase(SpecOf(view, test), 0, view.spec.coarse_graining.Levels().front());
}

// The numbers that tell most of a rig's observables, with what a careful laboratory reaches.
std::vector<ExpectedNumber> UsualNumbers(rigs::RigKind kind) {
  switch (kind) {
    case rigs::RigKind::kLiftedTube:
      return {{.metric = "mass_fallen_kg"}};
    case rigs::RigKind::kTappedDensity:
      return {{.metric = "tapped_density_kg_per_m3", .relative_error = 0.005}};
    case rigs::RigKind::kColumnCollapse:
      return {{.metric = "runout_m", .relative_error = 0.02},
              {.metric = "height_m", .relative_error = 0.02}};
    case rigs::RigKind::kTiltingBox:
      return {{.metric = "angle_deg", .standard_error = 1}};
    case rigs::RigKind::kDrawDown:
      return {{.metric = "mass_left_kg"},
              {.metric = "discharge_time_s", .relative_error = 0.02},
              {.metric = "angle_deg", .standard_error = 1}};
    case rigs::RigKind::kDrum:
      return {{.metric = "angle_deg", .standard_error = 1}};
  }
  return {};
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

}  // namespace

void TestCandidate::Validate(base::Problems& problems) const {
  problems.Require(!name.empty(), "name", "is empty");
  problems.Require(runs >= 1 && runs <= 1000, "runs", runs, "must be from 1 to 1000");
}

std::vector<TestCandidate> LoadTests(const std::filesystem::path& file) {
  return base::LoadOptions<CandidateFile>(base::ReadJsonFile(file)).candidates;
}

campaign::CampaignSpec SpecOf(const campaign::JointView& view, const TestCandidate& test) {
  campaign::CampaignSpec spec = view.spec;
  campaign::ExperimentSpec only = campaign::ExperimentsOf(view.spec).front();
  only.name = test.name;
  only.numbers = {};
  if (test.rig) only.rig = test.rig;
  if (test.device) only.device = test.device;
  if (test.filling) only.filling = test.filling;
  if (test.rules) only.rules = test.rules;
  spec.experiment.reset();
  spec.experiments = {only};
  return spec;
}

std::string WhyNot(const campaign::JointView& view, const TestCandidate& test) {
  base::Problems problems(test.name, {});
  TypicalOf(view, test).Validate(problems);
  if (problems.empty()) {
    const auto known = rigs::EntryOf(TypicalOf(view, test)).observables;
    const auto numbers = campaign::ScalarsOf(test.numbers);
    for (const campaign::ScalarSpec& number : numbers) {
      problems.Require(std::find(known.begin(), known.end(), number.metric) != known.end(),
                       number.key, "is not measured by the rig");
    }
  }
  try {
    problems.ThrowIfAny();
  } catch (const base::ConfigError& error) {
    return error.what();
  }
  return {};
}

std::optional<imaging::Frame> FrameOf(const campaign::JointView& view, const TestCandidate& test) {
  constexpr double kMargin = 0.1;  // of the plate diameter, on either side
  if (test.frame) return test.frame;
  const rigs::HeapCase heap_case = TypicalOf(view, test);
  if (rigs::KindOf(heap_case) != rigs::RigKind::kLiftedTube) return std::nullopt;
  const auto seen = std::find_if(view.references.begin(), view.references.end(),
                                 [](const campaign::Reference& r) { return r.has_image(); });
  imaging::Frame frame = seen != view.references.end()
                             ? seen->frame().value()
                             : UsualFrame(heap_case.device.plate_diameter,
                                          rigs::EstimateHeap(heap_case).mean_diameter);
  frame.plate_diameter = heap_case.device.plate_diameter;
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
  return numbers.empty() ? UsualNumbers(rigs::KindOf(TypicalOf(view, test))) : numbers;
}

std::string ExperimentText(const campaign::JointView& view, const TestCandidate& test) {
  const campaign::ExperimentSpec only = campaign::ExperimentsOf(SpecOf(view, test)).front();
  nlohmann::ordered_json json{{"name", test.name}};
  if (only.rig) json["rig"] = base::ToJson(*only.rig);
  json["device"] = base::ToJson(*only.device);
  json["filling"] = base::ToJson(*only.filling);
  json["rules"] = base::ToJson(*only.rules);
  return base::JsonText(json, 2) + "\n";
}

std::string FileName(const TestCandidate& test) {
  std::string name;
  for (const char c : test.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  return name.empty() ? "test" : name;
}

}  // namespace talus::analysis
