// Photographs of a drum as the images of an experiment.
#include "experiments/campaign/spec/drum_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "base/json/json_file.h"
#include "experiments/campaign/start.h"
#include "experiments/trials/measure/measure_request.h"
#include "imaging/formats/images/image_file.h"
#include "tests/error_in.h"
#include "tests/experiments/drawn_drum.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::campaign {
namespace drum_images_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class DrumImages : public ::testing::Test {
 public:
  DrumImages() {
    fs::create_directories(scratch_.path() / "photos");
    imaging::WritePng(photo_, DrawDrum(false));
    imaging::WritePng(scratch_.path() / "map.png", DrawDrum(true));
    imaging::WritePng(hazy_, DrawDrum(true, 16));
  }
  // `more` are keys of the second experiment, whose series turns the other way.
  CampaignSpec Read(const std::string& more = "", bool fill_is_searched = true) const {
    return ReadCampaignSpec(
        base::ParseJson(SpecText(more, fill_is_searched), scratch_.path() / "spec.json"));
  }
  static std::string SpecText(const std::string& more, bool fill_is_searched,
                              const std::string& first_keys = "") {
    const std::string experiments = "{" + first_keys + R"("experiments": [
        {"name": "slow", "map": "map.png",
         "rig": {"kind": "drum", "diameter": "84 mm", "width": "20 mm", "speed": "15 rpm"}},
        {"name": "fast", "photos": "photos")" +
                                    more;
    const std::string rest = R"(,
         "rig": {"kind": "drum", "diameter": "84 mm", "width": "20 mm", "speed": "45 rpm",
                 "turns": 0.2, "camera": {"frames": 20, "interval": "10 ms"}}}],
      "powder": {"material": {"density": 1580},
                 "sizes": {"kind": "mono", "diameter": "1.2 mm"}},
      "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9})";
    const std::string fill = fill_is_searched ? R"(, "fill": {"min": 0.4, "max": 0.5}}})" : "}}";
    return experiments + rest + fill;
  }
  std::string ErrorOf(const std::string& more) const {
    return ErrorIn([&] { Read(more, false); });
  }

 protected:
  ScratchFolder scratch_;
  const fs::path hazy_ = scratch_.path() / "hazy.png";
  const fs::path photo_ = scratch_.path() / "photos/one.png";
};

TEST_F(DrumImages, DiameterIsTheRigsAndTheFillThatOfThePicture) {
  const CampaignSpec spec = Read("", false);
  ASSERT_EQ(ExperimentsOf(spec).size(), 2u);
  for (const ExperimentSpec& e : ExperimentsOf(spec)) {
    EXPECT_EQ(e.images.plate_diameter, 0.084);
    EXPECT_NEAR(e.rig->drum.fill.value(), 0.5, 0.01);
    EXPECT_FALSE(e.mass);
  }
}

// Without the photographs half a drum was taken for what had been measured, and the change
// refused.
TEST_F(DrumImages, TheFillStaysWhereThePhotographsAreGone) {
  const fs::path spec = scratch_.path() / "spec.json";
  const auto write = [&](int simulations) {
    std::ofstream(spec) << SpecText(
        "", false, R"("budget": {"simulations": )" + std::to_string(simulations) + "}, ");
  };
  write(9);
  const fs::path folder = scratch_.path() / "run";
  BeginCampaign(spec, folder);
  fs::remove_all(scratch_.path() / "photos");
  write(10);
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  const CampaignSpec going = OpenCampaign(folder, {}, console).spec;
  EXPECT_EQ(going.budget.simulations, 10);
  EXPECT_NEAR(going.experiments->at(1).rig->drum.fill.value(), 0.5, 0.02);
  EXPECT_NE(going.experiments->at(1).rig->drum.fill.value(), 0.5);
}

// At 45 rpm and more powder may turn with its drum.
TEST_F(DrumImages, PowderWithoutASurfaceSaysNoFill) {
  imaging::GrayImage ring = DrawDrum(false);
  for (int y = 0; y < kDrumSide; ++y) {
    for (int x = 0; x < kDrumSide; ++x) {
      const double right = x + 0.5 - kDrumSide / 2.0, down = y + 0.5 - kDrumSide / 2.0;
      const bool powder = std::hypot(right, down + 4) > 0.7 * kDrumRadius;
      if (std::hypot(right, down) < kDrumRadius) ring.at(x, y) = powder ? 20 : 240;
    }
  }
  imaging::WritePng(photo_, ring);
  EXPECT_THAT(ErrorOf(""), AllOf(HasSubstr("photos: shows no fill: the surface is too short"),
                                 HasSubstr("give rig.fill")));
}

// The fill is searched in place of what the picture says: in the middle of its range.
TEST_F(DrumImages, ASearchedFillIsTheMassOfATrial) {
  const double disc = std::numbers::pi / 4 * 0.084 * 0.084;
  const double expected = 0.45 * rigs::kSeenSolidFraction * disc * 0.02 * 1580;
  EXPECT_NEAR(TypicalCase(Read(), 1, 1).powder.mass, expected, 1e-12);
  rigs::Case alone;  // as `talus predict` sets what was searched
  alone.rig = *ExperimentsOf(Read())[1].rig;
  alone.powder.material.density = 1580;
  SetParameter(alone, "fill", 0.45);
  EXPECT_NEAR(alone.powder.mass, expected, 1e-12);
}

// The picture's outermost circle is the ring's outside: the drum is 92 of its 95 px wide.
TEST_F(DrumImages, TheCirclesDiameterIsTheScale) {
  ExperimentSpec e = ExperimentsOf(Read())[0];
  e.circle_diameter = 0.084 * kDrumRadius / (kDrumRadius - kDrumRing);
  const imaging::Frame frame = MeasureImages(e).aehp.frame;
  EXPECT_NEAR(frame.pixel_size, 0.042 / (kDrumRadius - kDrumRing), 0.005 * frame.pixel_size);
  EXPECT_NEAR(frame.plate_diameter, 0.084, 1e-12);
  EXPECT_NEAR(frame.baseline, kDrumSide / 2.0 + kDrumRadius - kDrumRing, 1);
}

// Mirrored, the drum that turns the other way shows what the first shows.
TEST_F(DrumImages, ProfilesTurnAsTheRigDoesAndKnowTheDiscOnly) {
  const std::vector<ExperimentSpec> all = ExperimentsOf(Read());
  const imaging::Profile first = MeasureImages(all[0]).aehp;
  const imaging::Profile second = MeasureImages(all[1]).aehp;
  EXPECT_EQ(first.image.pixels, second.image.pixels);
  EXPECT_EQ(first.image.at(kDrumSide / 2 - 60, kDrumSide / 2), 0);
  EXPECT_EQ(first.image.at(kDrumSide / 2 + 60, kDrumSide / 2), 255);
  for (int y = 0; y < kDrumSide; ++y) {
    for (int x = 0; x < kDrumSide; ++x) {
      EXPECT_TRUE(first.frame.Knows(x, y) || first.image.at(x, y) == 255);
    }
  }
  EXPECT_LT(first.frame.disc_diameter.value(), 0.084 * (kDrumRadius - kDrumRing) / kDrumRadius);
}

// The mean shows half of the haze, and a binary map all or nothing of it. Its level comes out
// within a tenth of half-way: it counts among those that powder and light are read from.
TEST_F(DrumImages, PowderInAnyPictureIsWhatIsDarkerThanTheThreshold) {
  ExperimentSpec e = ExperimentsOf(Read())[0];
  e.images.map = hazy_;
  e.rig->camera = {.frames = 20, .interval = 0.01};
  const double mean = imaging::Nebp(MeasureImages(e).aehp.image);
  e.rig->camera->shows = rigs::Shown::kAny;
  e.images.threshold = 0.9;
  const double any = imaging::Nebp(MeasureImages(e).aehp.image);
  e.images.threshold = 0.1;
  const double all = imaging::Nebp(MeasureImages(e).aehp.image);
  EXPECT_GT(any, 1.1 * all);
  EXPECT_NEAR(mean, (any + all) / 2, 0.1 * (any - all));
}

// A map with its frame, as films have them, was compared in grey all the same.
TEST_F(DrumImages, AMapWithItsFrameIsMadeBinaryToo) {
  ExperimentSpec e = ExperimentsOf(Read())[0];
  e.images.map = hazy_;
  e.images.frame = imaging::Frame{.width = kDrumSide,
                                  .height = kDrumSide,
                                  .pixel_size = 0.042 / kDrumRadius,
                                  .center_x = kDrumSide / 2.0,
                                  .baseline = kDrumSide / 2.0 + kDrumRadius,
                                  .plate_diameter = 0.084,
                                  .disc_diameter = 0.08};
  e.rig->camera = {.frames = 20, .interval = 0.01, .shows = rigs::Shown::kAny};
  base::Problems problems;
  ValidateDrumImages(e, "", problems);
  EXPECT_THAT(ErrorIn([&] { problems.ThrowIfAny(); }), HasSubstr("threshold: is missing"));
  e.images.threshold = 0.9;
  for (const std::uint8_t level : MeasureImages(e).aehp.image.pixels) {
    EXPECT_TRUE(level == 0 || level == 255);
  }
  e.rig->camera->shows = rigs::Shown::kMean;
  ValidateDrumImages(e, "", problems);
  EXPECT_THAT(ErrorIn([&] { problems.ThrowIfAny(); }),
              HasSubstr("threshold: is of photographs: in a map grey tells"));
}

TEST_F(DrumImages, ErrorsSayWhatToDo) {
  EXPECT_THAT(ErrorOf(R"(, "turning": "clockwise")"), HasSubstr("turns the other way"));
  EXPECT_EQ(ErrorOf(R"(, "turning": "counter-clockwise")"), "");
  EXPECT_THAT(
      ErrorOf(R"(, "circle_diameter": "80 mm")"),
      HasSubstr(
          "experiments[1].circle_diameter: is 0.08 (\"80 mm\"), must be from the rig's diameter"));
  EXPECT_EQ(ErrorOf(R"(, "circle_diameter": "87 mm")"), "");
  EXPECT_THAT(ErrorOf(R"(, "pixel_size": "0.5 mm")"), HasSubstr("which are of heaps"));
  EXPECT_THAT(ErrorOf(R"(, "pattern": "{run}.png")"), HasSubstr("from all pictures of the folder"));
  EXPECT_THAT(ErrorOf(R"(, "mass": 0)"), HasSubstr("experiments[1].mass: is 0, must be positive"));
  EXPECT_EQ(ErrorOf(R"(, "cohesive_index": {"values": ["1 mm", "1.2 mm"]})"), "");
}

// Powder that leans against the stated turning was said to be higher on that turning's side.
TEST(MeasuredDrums, AreSaidToBeHigherWhereTheyAre) {
  const ScratchFolder scratch;
  trials::MeasureRequest request;
  for (const char* name : {"first.png", "second.png"}) {
    request.inputs.push_back(scratch.path() / name);
    imaging::WritePng(request.inputs.back(), DrawDrum(false, 0, 3));
    request.drum.emplace();
    request.drum->diameter = 0.084;
    request.drum->turning = imaging::Turning::kClockwise;
    std::ostringstream print;
    trials::MeasureDrums(request, print);
    EXPECT_THAT(print.str(), HasSubstr("turning clockwise, powder higher on the right\n"));
    EXPECT_THAT(print.str(), ::testing::ContainsRegex("dynamic angle -(2[.]9|3)"));
  }
}

// It counted twice, and narrowed the angle's standard error.
TEST(MeasuredDrums, APhotographIsNamedOnce) {
  const ScratchFolder scratch;
  imaging::WritePng(scratch.path() / "first.png", DrawDrum(false, 0, 20));
  trials::MeasureRequest request;
  request.inputs = {scratch.path(), scratch.path() / "." / "first.png"};
  request.drum.emplace();
  request.drum->diameter = 0.084;
  std::ostringstream print;
  EXPECT_THAT(ErrorIn([&] { trials::MeasureDrums(request, print); }),
              HasSubstr("first.png: is named twice; name each photograph once"));
}

// A measured series that is not part of the project: TALUS_REAL_DATA names its folder. Its README
// says how it turns and what it covers: 0.499 and 0.503 of the disc within 41.4 mm.
TEST(RealDrum, MicrocrystallineCellulose) {
  const char* const folder = std::getenv("TALUS_REAL_DATA");
  if (folder == nullptr) GTEST_SKIP() << "TALUS_REAL_DATA is not set";
  for (const char* file : {"gd_15rpm.png", "gd_45rpm.png"}) {
    ExperimentSpec e;
    e.rig.emplace();
    e.rig->kind = rigs::RigKind::kDrum;
    e.images.map = fs::path(folder) / "drum_mcc" / file;
    e.images.plate_diameter = 0.084;
    e.turning = imaging::Turning::kClockwise;
    const imaging::Profile profile = MeasureImages(e).aehp;
    const double known = std::numbers::pi / 4 * std::pow(profile.frame.disc_diameter.value(), 2);
    const double pixel = profile.frame.pixel_size;
    // Half-way between powder and light, and within 41.3 mm: 1.5 % of the disc more.
    EXPECT_NEAR(imaging::Nebp(profile.image) * pixel * pixel / known, 0.51, 0.015);
  }
}

}  // namespace drum_images_test
}  // namespace talus::campaign
