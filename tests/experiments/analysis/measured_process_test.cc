// What was measured on a process that is predicted.
#include "experiments/analysis/predict/measured_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/profile_file.h"
#include "imaging/heap/metrics.h"
#include "tests/error_in.h"
#include "tests/experiments/drawn_drum.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::analysis {
namespace measured_process_test {

using campaign::DrawDrum;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class MeasuredDrumTest : public ::testing::Test {
 protected:
  MeasuredDrumTest() {
    drum_.name = "10rpm";
    drum_.rig_case.rig.kind = rigs::RigKind::kDrum;
    drum_.rig_case.rig.drum.diameter = 0.084;
    imaging::WritePng(scratch_.path() / "right.png", DrawDrum(true));
    imaging::WritePng(scratch_.path() / "left.png", DrawDrum(false));
    imaging::WritePng(scratch_.path() / "hazy.png", DrawDrum(true, 16));
  }
  MeasuredProcess Read(const std::string& text) const {
    std::ofstream(scratch_.path() / "measured.json") << text;
    return ReadMeasured(scratch_.path() / "measured.json", drum_);
  }
  std::string ErrorOf(const std::string& text) const {
    return ErrorIn([&] { Read(text); });
  }

  ScratchFolder scratch_;
  PredictedCase drum_;
};

// The drum's circle was sought for a plate, since only a campaign's maps were read as drums.
TEST_F(MeasuredDrumTest, AMapOfADrumIsReadByItsCircle) {
  const auto profile = Read(R"({"map": "right.png"})").profile;
  ASSERT_TRUE(profile.has_value());
  EXPECT_EQ(profile->frame.plate_diameter, 0.084);
  EXPECT_NEAR(profile->frame.pixel_size, 0.042 / campaign::kDrumRadius,
              0.01 * profile->frame.pixel_size);
  ASSERT_TRUE(profile->frame.disc_diameter.has_value());
  // Powder on the left of the middle, light on the right, whichever way it turned.
  const auto turned = Read(R"({"map": "left.png", "turning": "counter-clockwise"})").profile;
  for (const imaging::GrayImage* image : {&profile->image, &turned->image}) {
    EXPECT_EQ(image->at(campaign::kDrumSide / 2 - 60, campaign::kDrumSide / 2), 0);
    EXPECT_EQ(image->at(campaign::kDrumSide / 2 + 60, campaign::kDrumSide / 2), 255);
  }
  EXPECT_THAT(ErrorOf(R"({"map": "left.png", "turning": "clockwise"})"),
              HasSubstr("turns the other way"));
}

TEST_F(MeasuredDrumTest, NumbersStandBesideTheMap) {
  const MeasuredProcess measured =
      Read(R"({"map": "right.png", "angle": {"value": "38 deg", "sd": "1 deg"}})");
  EXPECT_TRUE(measured.profile.has_value());
  ASSERT_EQ(measured.numbers.size(), 1u);
  EXPECT_EQ(measured.numbers[0].key, "angle");
  EXPECT_THAT(ErrorOf(R"({"runout": {"value": "1 cm", "sd": "1 mm"}})"),
              HasSubstr("runout: is not measured by the rig drum"));
  EXPECT_THAT(ErrorOf("{}"), HasSubstr("has no data"));
}

// A camera that shows powder where any picture has it needs the map made binary.
TEST_F(MeasuredDrumTest, PowderOfAnyPictureNeedsAThreshold) {
  drum_.rig_case.rig.camera = {.frames = 20, .interval = 0.01, .shows = rigs::Shown::kAny};
  EXPECT_THAT(ErrorOf(R"({"map": "hazy.png"})"), HasSubstr("threshold: is missing"));
  const auto any = Read(R"({"map": "hazy.png", "threshold": 0.9})").profile;
  const auto most = Read(R"({"map": "hazy.png", "threshold": 0.3})").profile;
  for (const std::uint8_t level : any->image.pixels) EXPECT_TRUE(level == 0 || level == 255);
  EXPECT_GT(imaging::Nebp(any->image), 1.1 * imaging::Nebp(most->image));
  imaging::WriteProfile(scratch_.path() / "profile.png", *most);
  EXPECT_TRUE(ReadMeasured(scratch_.path() / "profile.png", drum_).profile.has_value());
  imaging::Profile grey = *most;
  grey.image.at(0, 0) = 128;
  imaging::WriteProfile(scratch_.path() / "profile.png", grey);
  EXPECT_THAT(ErrorIn([&] { ReadMeasured(scratch_.path() / "profile.png", drum_); }),
              HasSubstr("give a JSON file with it as \"map\", and a \"threshold\""));
}

TEST_F(MeasuredDrumTest, AnImageOfAnotherTestIsRefused) {
  EXPECT_THAT(ErrorOf(R"({"map": "right.png", "plate_diameter": "60 mm"})"),
              HasSubstr("is scaled by a width of 60 mm (plate_diameter) where that of the case is "
                        "84 mm"));
  drum_.rig_case.rig.camera.emplace();
  drum_.rig_case.rig.camera->times = {0.1, 0.2};
  EXPECT_THAT(ErrorOf(R"({"map": "right.png"})"),
              HasSubstr("shows 1 picture where the case takes"));
}

}  // namespace measured_process_test
}  // namespace talus::analysis
