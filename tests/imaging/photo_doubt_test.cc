// Photographs that are not as the test wants them: each doubt is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "imaging/formats/images/image_file.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace photo_doubt_test {

using testing::HasSubstr;

// A bright heap and plate before a dark background have the profile of the same heap lit from
// behind, and that they were taken so is said. Told that the powder is dark, the plate is not
// found.
TEST(PhotoDoubt, FrontLitHeapIsRecognised) {
  Scene scene = SmallScene();
  scene.uneven = false;
  const GrayImage backlit = Triangle(scene);
  GrayImage front_lit = backlit;
  for (std::uint8_t& level : front_lit.pixels) level = static_cast<std::uint8_t>(255 - level);
  const fs::path folder = EmptyFolder("front_lit");
  WritePng(folder / Name(1, 0), front_lit);
  const fs::path other = EmptyFolder("back_lit");
  WritePng(other / Name(1, 0), backlit);
  const Experiment experiment = MeasureExperiment(Options(folder));
  EXPECT_EQ(experiment.aehp.image, MeasureExperiment(Options(other)).aehp.image);
  ASSERT_EQ(experiment.warnings.size(), 1u);
  EXPECT_EQ(experiment.warnings[0].doubt, PhotoDoubt::kFrontLit);
  ExperimentOptions options = Options(folder);
  options.powder = PowderLook::kBright;
  EXPECT_TRUE(MeasureExperiment(options).warnings.empty());
  options.powder = PowderLook::kDark;
  EXPECT_NE(ErrorOf(options), "");
}

// One doubt a photograph, each drawn so that nothing else is doubtful.
TEST(PhotoDoubt, DoubtfulPhotographsAreWarnedOf) {
  const fs::path folder = EmptyFolder("doubts");
  const Scene scene = SmallScene();
  for (int view = 0; view < 4; ++view) WritePng(folder / Name(1, view), Triangle(scene));
  // A thread over the heap from the left edge of the picture: touches it and reaches beyond the
  // rim.
  WritePng(folder / Name(1, 4), PhotographOf(scene, [](double x) {
             return x < 0 ? std::max(0.5 * (150 - std::abs(x)), 8.0) : 0.5 * (150 - x);
           }));
  WritePng(folder / Name(1, 5),
           PhotographOf(scene, [](double x) { return 0.2 * (150 - std::abs(x)); }));
  GrayImage white = Triangle(scene);
  for (std::uint8_t& level : white.pixels) level = level > 130 ? 255 : level;
  WritePng(folder / Name(1, 6), white);
  std::vector<std::pair<std::string, PhotoDoubt>> found;
  for (const PhotoWarning& warning : MeasureExperiment(Options(folder)).warnings) {
    found.emplace_back(warning.photo.filename().string(), warning.doubt);
  }
  using enum PhotoDoubt;
  EXPECT_THAT(found, testing::UnorderedElementsAre(std::pair(Name(1, 4), kTouchesFrame),
                                                   std::pair(Name(1, 4), kBesidePlate),
                                                   std::pair(Name(1, 5), kViewDisagrees),
                                                   std::pair(Name(1, 6), kOverexposed)));
}

// A plate of 300 px, 30 px thick: at 6 degrees and more its sides and its top are not told apart,
// and the heap gained up to 6 % of its area at 8. Below four nothing is amiss.
TEST(PhotoDoubt, ATiltedPlateIsWarnedOf) {
  for (const double tilt : {-7.0, -2.0, 3.0, 6.0, 8.0}) {
    Scene scene = SmallScene();
    scene.tilt = tilt * base::kDegree;
    const fs::path folder = EmptyFolder("tilted");
    WritePng(folder / Name(1, 0), Triangle(scene));
    const std::vector<PhotoWarning> warnings = MeasureExperiment(Options(folder)).warnings;
    const auto tilted = std::ranges::find(warnings, PhotoDoubt::kTilted, &PhotoWarning::doubt);
    ASSERT_EQ(tilted != warnings.end(), std::abs(tilt) > 4) << tilt;
    if (tilted == warnings.end()) continue;
    EXPECT_EQ(tilted->photo.filename(), Name(1, 0));
    EXPECT_NEAR(tilted->value, std::abs(scene.tilt), base::kDegree);
    EXPECT_THAT(WarningText(*tilted), HasSubstr("level the camera"));
  }
}

// In each the heap's top is cut off by the photograph's upper border, which lies within the frame
// of those whose plate is farther up.
TEST(PhotoDoubt, AHeapCutByThePhotographIsWarnedOfWhereverItsPlateIs) {
  const fs::path folder = EmptyFolder("cut");
  Scene low = SmallScene();
  low.baseline = 120;
  Scene high = low;
  high.baseline = 60;
  const auto cut = [](double x) { return 0.55 * (150 - std::abs(x)); };  // 82 px high
  for (int view = 0; view < 3; ++view) WritePng(folder / Name(1, view), PhotographOf(low, cut));
  WritePng(folder / Name(1, 3), PhotographOf(high, cut));
  std::vector<std::string> touching;
  for (const PhotoWarning& warning : MeasureExperiment(Options(folder)).warnings) {
    if (warning.doubt != PhotoDoubt::kTouchesFrame) continue;
    touching.push_back(warning.photo.filename().string());
  }
  EXPECT_THAT(touching, testing::ElementsAre(Name(1, 3)));
}

// A tube that has been lifted and not taken away, as wide as the plate and larger than the heap.
TEST(PhotoDoubt, ATubeAboveTheHeapIsNotItsPlate) {
  Scene scene = SmallScene();
  scene.height = 400;
  scene.baseline = 345;
  const auto heap = [](double along, double up) { return up < 0.5 * (150 - std::abs(along)); };
  const fs::path without = EmptyFolder("without_tube"), with = EmptyFolder("with_tube");
  WritePng(without / Name(1, 0), Expose(scene, Cover(scene, [&](double along, double up) {
                                          return up > 0 && heap(along, up);
                                        })));
  WritePng(with / Name(1, 0),
           Expose(scene, Cover(scene, [&](double along, double up) {
                    return up > 0 && (heap(along, up) || (up > 120 && std::abs(along) < 150));
                  })));
  const Experiment alone = MeasureExperiment(Options(without));
  const Experiment below = MeasureExperiment(Options(with));
  EXPECT_NEAR(below.aehp.frame.baseline, alone.aehp.frame.baseline, 1);
  EXPECT_NEAR(Nebp(below.aehp.image), Nebp(alone.aehp.image), 0.01 * Nebp(alone.aehp.image));
}

// It was taken for the plate, as the lowest of those about as wide.
TEST(PhotoDoubt, APedestalNearlyAsWideAsThePlateIsNotThePlate) {
  Scene scene = SmallScene();
  for (const double share : {0.92, 0.955, 0.97, 0.985}) {
    scene.pedestal = share;
    const fs::path folder = EmptyFolder("wide_pedestal");
    WritePng(folder / Name(1, 0), Triangle(scene));
    const Frame frame = MeasureExperiment(Options(folder)).aehp.frame;
    EXPECT_NEAR(kPlate / frame.pixel_size, 300, 1) << share;
    EXPECT_NEAR(frame.baseline, scene.baseline, 1) << share;
  }
}

// Moist powder that has kept the form of the tube, 2 % wider than the plate, is no plate on one.
TEST(PhotoDoubt, PowderThatHangsOverTheRimIsNotThePlate) {
  Scene scene = SmallScene();
  const fs::path folder = EmptyFolder("column");
  WritePng(folder / Name(1, 0), Expose(scene, Cover(scene, [&](double along, double up) {
                                         return up > 0 && up < 100 && std::abs(along) < 153;
                                       })));
  const Frame frame = MeasureExperiment(Options(folder)).aehp.frame;
  EXPECT_NEAR(kPlate / frame.pixel_size, 300, 1);
}

// The pedestal, half as wide, was taken for the plate, and everything measured twice too large.
TEST(PhotoDoubt, APlateThatThePictureCutsIsRefused) {
  Scene scene = SmallScene();
  scene.pedestal = 0.5;
  for (const double center_x : {290.0, 130.0}) {
    scene.center_x = center_x;
    const fs::path folder = EmptyFolder("cut_plate");
    WritePng(folder / Name(1, 0), Triangle(scene));
    EXPECT_THAT(ErrorOf(Options(folder)), HasSubstr("cut by the picture's border"));
  }
}

// One of six is wider: it is the one that is not as the others.
TEST(PhotoDoubt, TheSizeIsThatOfMostPhotographs) {
  const fs::path folder = EmptyFolder("sizes");
  Scene wide = SmallScene();
  wide.width += 20;
  WritePng(folder / Name(1, 0), Triangle(wide));
  for (int view = 1; view < 6; ++view) WritePng(folder / Name(1, view), Triangle(SmallScene()));
  const std::string error = ErrorOf(Options(folder));
  EXPECT_THAT(error, HasSubstr(Name(1, 0) + ": has 440 x 220 px, most photographs 420 x 220 px"));
  EXPECT_THAT(error, testing::Not(HasSubstr(Name(1, 1))));
}

TEST(PhotoDoubt, ARegionOfTheRmseOutsideOfTheProfilesIsRefused) {
  const fs::path folder = GoodFolder("region");
  ExperimentOptions options = Options(folder);
  options.metrics.rmse_region = Region{.left = 300, .top = 0, .width = 121, .height = 10};
  EXPECT_THAT(ErrorOf(options), HasSubstr("metrics.rmse_region: is not within"));
  options.metrics.rmse_region->left = std::numeric_limits<int>::max();
  EXPECT_THAT(ErrorOf(options), HasSubstr("metrics.rmse_region: is not within"));
  options.metrics.rmse_region->left = 299;
  EXPECT_EQ(ErrorOf(options), "");
}

// A lamp too bright is one fault, however many photographs it spoils; the worst of them is named.
TEST(PhotoDoubt, AFaultOfTheSetUpIsSaidOnce) {
  const fs::path folder = EmptyFolder("all_white");
  for (int view = 0; view < 5; ++view) {
    GrayImage white = Triangle(SmallScene());
    for (std::size_t i = 0; i < white.pixels.size(); ++i) {
      const bool spoilt = i % 10 < (view == 2 ? 9 : 6);
      if (spoilt && white.pixels[i] > 130) white.pixels[i] = 255;
    }
    WritePng(folder / Name(1, view), white);
  }
  const std::vector<PhotoWarning> warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kOverexposed);
  EXPECT_EQ(warnings[0].num_photos, 5);
  EXPECT_EQ(warnings[0].photo.filename(), Name(1, 2));
  EXPECT_THAT(WarningText(warnings[0]),
              HasSubstr(Name(1, 2) + ", the worst of 5 such photographs: "));
}

std::vector<PhotoDoubt> DoubtsOf(const fs::path& folder) {
  std::vector<PhotoDoubt> doubts;
  for (const PhotoWarning& warning : MeasureExperiment(Options(folder)).warnings) {
    doubts.push_back(warning.doubt);
  }
  return doubts;
}

TEST(PhotoDoubt, AnEmptyPlateIsWarnedOf) {
  const fs::path folder = GoodFolder("empty_plate");
  WritePng(folder / Name(2, 1), PhotographOf(SmallScene(), [](double) { return 0.0; }));
  EXPECT_THAT(DoubtsOf(folder), testing::ElementsAre(PhotoDoubt::kNoPowder));
}

TEST(PhotoDoubt, PhotographsOfTwoKindsOfLightAreWarnedOf) {
  const fs::path folder = GoodFolder("mixed");
  GrayImage front_lit = Triangle(SmallScene());
  for (std::uint8_t& level : front_lit.pixels) level = static_cast<std::uint8_t>(255 - level);
  WritePng(folder / Name(2, 1), front_lit);
  const std::vector<PhotoWarning> warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kMixedLight);
  EXPECT_EQ(warnings[0].photo.filename(), Name(2, 1));
  EXPECT_THAT(WarningText(warnings[0]), HasSubstr("lit otherwise than most: 1 photographs"));
}

// It was the darkest, and had the first one's word.
TEST(PhotoDoubt, TheWorstOfSeveralHasItsOwnReason) {
  std::vector<PhotoWarning> warnings(
      5, {.doubt = PhotoDoubt::kOtherLight, .value = 2, .reason = "brighter"});
  warnings.back() = {
      .doubt = PhotoDoubt::kOtherLight, .photo = "dark.png", .value = 4, .reason = "darker"};
  const std::vector<PhotoWarning> gathered = Gathered(warnings);
  ASSERT_EQ(gathered.size(), 1u);
  EXPECT_EQ(gathered[0].num_photos, 5);
  EXPECT_THAT(WarningText(gathered[0]),
              testing::AllOf(HasSubstr("dark.png"), HasSubstr("4 times darker")));
}

// Its outline came out the same, and nothing was said of it.
TEST(PhotoDoubt, APhotographUnderLessLightIsNamed) {
  const fs::path folder = GoodFolder("darker");
  GrayImage darker = Triangle(SmallScene());
  for (std::uint8_t& level : darker.pixels) level = static_cast<std::uint8_t>(level / 2);
  WritePng(folder / Name(2, 1), darker);
  const std::vector<PhotoWarning> warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kOtherLight);
  EXPECT_EQ(warnings[0].photo.filename(), Name(2, 1));
  EXPECT_NEAR(warnings[0].value, 2, 0.05);  // half a grey level of some 100 is cut off
  EXPECT_THAT(WarningText(warnings[0]), HasSubstr("2 times darker than most"));
}

// Three heaps of one photograph each, which differ by a grey level only: no files are equal.
TEST(PhotoDoubt, HeapsThatAreAlikeAsNoTwoAreAreWarnedOf) {
  const fs::path folder = EmptyFolder("alike");
  const GrayImage photo = Triangle(SmallScene());
  for (int run = 1; run <= 3; ++run) WritePng(folder / Name(run, 0), TakenAgain(photo, run));
  const std::vector<PhotoWarning> warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kNoNoise);
  EXPECT_EQ(warnings[0].value, 0);
  EXPECT_THAT(WarningText(warnings[0]), HasSubstr("as no two heaps are"));
}

// Its runs would agree better than heaps do. The views of one run may be alike.
TEST(PhotoDoubt, AFileThatStandsInTwoRunsIsNamed) {
  const fs::path folder = GoodFolder("copied");
  fs::copy_file(folder / Name(1, 0), folder / Name(1, 1), fs::copy_options::overwrite_existing);
  EXPECT_THAT(DoubtsOf(folder), testing::IsEmpty());
  fs::copy_file(folder / Name(1, 0), folder / Name(2, 1), fs::copy_options::overwrite_existing);
  const std::vector<PhotoWarning> warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kCopied);
  EXPECT_EQ(warnings[0].photo.filename(), Name(2, 1));
  EXPECT_EQ(fs::path(warnings[0].reason).filename(), Name(1, 0));
  EXPECT_THAT(WarningText(warnings[0]), HasSubstr("is the same file as"));
}

// Grains that hang over the rim on both sides: no corner of the plate is seen.
TEST(PhotoDoubt, APlateWhoseTopNoPhotographShowsIsWarnedOf) {
  const fs::path folder = EmptyFolder("hidden_top");
  const Scene scene = SmallScene();
  const auto overhanging = [](double x, double up) {
    return up > -4 && up < 0.5 * (170 - std::abs(x)) && std::abs(x) < 156;
  };
  WritePng(folder / Name(1, 0), Expose(scene, Cover(scene, overhanging)));
  EXPECT_THAT(DoubtsOf(folder), testing::Contains(PhotoDoubt::kHiddenTop));
}

// Four heaps whose slopes differ by 1 %, and one by 12 %.
TEST(PhotoDoubt, ARunUnlikeTheOthersIsWarnedOf) {
  const fs::path folder = EmptyFolder("odd_run");
  int run = 0;
  for (const double slope : {0.5, 0.505, 0.56, 0.495, 0.502}) {
    WritePng(folder / Name(++run, 0),
             PhotographOf(SmallScene(), [&](double x) { return slope * (150 - std::abs(x)); }));
  }
  const auto warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kRunDisagrees);
  EXPECT_EQ(warnings[0].reason, "3");
}

}  // namespace photo_doubt_test
}  // namespace talus::imaging
