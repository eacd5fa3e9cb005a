#include "experiments/analysis/next/test_candidate.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.h"
#include "base/json/json_reader.h"

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

campaign::ExperimentSpec FirstOf(const campaign::JointView& view) {
  return campaign::ExperimentsOf(view.spec).front();
}

bool Alike(double a, double b) { return std::abs(a - b) <= 0.01 * b; }

bool IsMade(const campaign::JointView& view, const TestCandidate& test) {
  const auto all = campaign::ExperimentsOf(view.spec);
  return std::any_of(all.begin(), all.end(), [&](const campaign::ExperimentSpec& made) {
    return Alike(made.device->plate_diameter, test.device->plate_diameter) &&
           Alike(made.device->lift_velocity, test.device->lift_velocity) &&
           made.device->plate_material.has_value() == test.device->plate_material.has_value();
  });
}

}  // namespace

void TestCandidate::Validate(base::Problems& problems) const {
  problems.Require(!name.empty(), "name", "is empty");
  problems.Require(runs >= 1 && runs <= 1000, "runs", runs, "must be from 1 to 1000");
}

std::vector<TestCandidate> LoadTests(const std::filesystem::path& file) {
  return base::LoadOptions<CandidateFile>(base::ReadJsonFile(file)).candidates;
}

std::vector<TestCandidate> UsualTests(const campaign::JointView& view) {
  constexpr double kWide = 3;     // plate over tube
  constexpr double kSlow = 0.05;  // [m/s]
  constexpr double kFast = 0.20;  // [m/s]
  constexpr double kRough = 1.0;  // friction of a plate that grains are glued to
  const rigs::Device device = *FirstOf(view).device;
  rigs::Device slow = device;
  slow.plate_diameter = kWide * device.tube_inner_diameter;
  slow.plate = rigs::PlateKind::kDisc;
  slow.lift_velocity = kSlow;
  rigs::Device fast = slow;
  fast.lift_velocity = kFast;
  rigs::Device rough = device;
  rigs::WallMaterial material = device.plate_material.value_or(rigs::WallMaterial{});
  material.sliding_friction = kRough;
  material.rolling_friction = kRough;
  rough.plate_material = material;
  std::vector<TestCandidate> tests{{.name = "wide plate, 5 cm/s", .device = slow},
                                   {.name = "wide plate, 20 cm/s", .device = fast},
                                   {.name = "rough plate", .device = rough}};
  std::erase_if(tests, [&](const TestCandidate& test) { return IsMade(view, test); });
  return tests;
}

campaign::CampaignSpec SpecOf(const campaign::JointView& view, const TestCandidate& test) {
  campaign::CampaignSpec spec = view.spec;
  campaign::ExperimentSpec only = FirstOf(view);
  only.name = test.name;
  only.numbers = {};
  if (test.device) only.device = test.device;
  if (test.rules) only.rules = test.rules;
  spec.experiment.reset();
  spec.experiments = {only};
  return spec;
}

// Of the first experiment that has an image.
imaging::Frame ImageFrame(const campaign::JointView& view) {
  for (const campaign::Reference& reference : view.references) {
    if (reference.has_image()) return reference.frame().value();
  }
  throw base::ConfigError(view.folder.root.string() +
                          ": its experiments have numbers only; `talus next` looks at images");
}

imaging::Frame FrameOf(const campaign::JointView& view, const TestCandidate& test) {
  constexpr double kMargin = 0.1;  // of the plate diameter, on either side
  imaging::Frame frame = ImageFrame(view);
  if (test.device) frame.plate_diameter = test.device->plate_diameter;
  const double width = (1 + 2 * kMargin) * frame.plate_diameter / frame.pixel_size;
  frame.width = static_cast<int>(std::ceil(width));
  frame.center_x = 0.5 * frame.width;
  return frame;
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
