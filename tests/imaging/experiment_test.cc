#include "imaging/photos/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "base/error.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/spheres/projection.h"
#include "tests/imaging/synthetic_photo.h"

namespace talus::imaging {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kPlate = 0.01;  // [m]

Scene SmallScene() {
  return {.width = 420, .height = 220, .plate_depth = 30, .center_x = 210, .baseline = 165};
}

// Layers of a lattice of grains under a cone, each grain moved a little, so that no line of sight
// passes between them; the lowest layer lies on the plate.
std::vector<base::Sphere> Cone() {
  constexpr double kRadius = 2e-4;
  constexpr double kSlope = 0.55;
  std::vector<base::Sphere> spheres;
  base::Random random(5, base::Stream("cone"));
  for (int layer = 0; layer < 20; ++layer) {
    const double z = kRadius * (1 + 1.6 * layer);
    const double reach = kPlate / 2 - z / kSlope;
    for (double x = -kPlate / 2; x < kPlate / 2; x += 1.9 * kRadius) {
      for (double y = -kPlate / 2; y < kPlate / 2; y += 1.9 * kRadius) {
        const double dx = x + (layer % 2 + 0.3 * random.Normal()) * kRadius;
        const double dy = y + (layer % 2 + 0.3 * random.Normal()) * kRadius;
        if (std::hypot(dx, dy) > reach) continue;
        spheres.push_back({.position = {dx, dy, z}, .radius = kRadius});
      }
    }
  }
  return spheres;
}

fs::path EmptyFolder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("experiment_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string Name(int run, int view) {
  return "run" + std::to_string(run) + "_view" + std::to_string(view) + ".png";
}

ExperimentOptions Options(const fs::path& folder) {
  ExperimentOptions options;
  options.photos = folder;
  options.plate_diameter = kPlate;
  return options;
}

// 1 % of NEBP is, along an outline of 330 px, an error of a third of a pixel.
TEST(Experiment, PhotographedSpheresGiveTheirDirectProjection) {
  const std::vector<base::Sphere> spheres = Cone();
  const fs::path folder = EmptyFolder("spheres");
  constexpr int kViews = 4;
  for (int run = 1; run <= 2; ++run) {
    for (int view = 0; view < kViews; ++view) {
      Scene scene = SmallScene();
      scene.tilt = (run == 1 ? 0.8 : -1.7) * std::numbers::pi / 180;
      scene.center_x += 3.3 * run;
      scene.baseline -= 2.7 * run;
      scene.seed = static_cast<std::uint64_t>(10 * run + view);
      const double angle = std::numbers::pi * view / kViews;
      WritePng(folder / Name(run, view), Photograph(scene, spheres, kPlate, angle));
    }
  }
  const Experiment experiment = MeasureExperiment(Options(folder));
  const Profile direct = ProjectHeap(spheres, experiment.aehp.frame, kViews);
  EXPECT_LT(Sad(experiment.aehp.image, direct.image), 0.01 * Nebp(direct.image));
  EXPECT_NEAR(experiment.aehp.frame.plate_diameter / experiment.aehp.frame.pixel_size, 300, 0.2);
  // The same heap twice: what is left is what the camera's place does to the pixels.
  EXPECT_LT(experiment.noise_floor->mean_sad_relative, 0.01);
  for (const MeasuredRun& run : experiment.runs) {
    for (const MeasuredView& view : run.views) {
      const int number = run.name == "1" ? 1 : 2;
      EXPECT_NEAR(view.plate.center_x, 210 + 3.3 * number, 0.1) << view.photo;
      EXPECT_NEAR(view.plate.baseline, 165 - 2.7 * number, 0.25) << view.photo;
    }
  }
}

GrayImage Triangle(const Scene& scene) {
  return Photograph(scene, [&](double x) { return 0.5 * (150 - std::abs(x)); });
}

// Two runs of two views, all good.
fs::path GoodFolder(const std::string& name) {
  const fs::path folder = EmptyFolder(name);
  static const GrayImage photo = Triangle(SmallScene());
  for (int run = 1; run <= 2; ++run) {
    for (int view = 0; view < 2; ++view) WritePng(folder / Name(run, view), photo);
  }
  return folder;
}

std::string ErrorOf(const ExperimentOptions& options) {
  try {
    MeasureExperiment(options);
  } catch (const base::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

GrayImage Uniform(std::uint8_t grey) {
  const Scene scene = SmallScene();
  const auto num_pixels = static_cast<std::size_t>(scene.width) * scene.height;
  return {.width = scene.width,
          .height = scene.height,
          .pixels = std::vector<std::uint8_t>(num_pixels, grey)};
}

// A triangle with one thing of the scene changed.
template <typename T>
void WriteTriangle(const fs::path& path, T Scene::*member, T value) {
  Scene scene = SmallScene();
  scene.*member = value;
  WritePng(path, Triangle(scene));
}

// What is wrong with one photograph of four, and what the error says of it.
struct PhotoFault {
  const char* name;
  void (*spoil)(const fs::path& photo);
  const char* file;  // named by the error
  const char* reason;
};

constexpr PhotoFault kPhotoFaults[] = {
    {"MissingView", [](const fs::path& photo) { fs::remove(photo); }, "experiment_MissingView",
     "run 2 has no view 1"},
    {"UnreadableImage", [](const fs::path& photo) { std::ofstream(photo) << "this is no image"; },
     "run2_view1.png", "no image we can read"},
    {"EmptyFile", [](const fs::path& photo) { std::ofstream(photo).flush(); }, "run2_view1.png",
     "is empty"},
    {"BlackImage", [](const fs::path& photo) { WritePng(photo, Uniform(3)); }, "run2_view1.png",
     "black everywhere"},
    {"BlankImage", [](const fs::path& photo) { WritePng(photo, Uniform(200)); }, "run2_view1.png",
     "nothing darker"},
    {"OtherSize", [](const fs::path& photo) { WriteTriangle(photo, &Scene::width, 460); },
     "run2_view1.png", "460 x 220 px"},
    {"OtherScale", [](const fs::path& photo) { WriteTriangle(photo, &Scene::plate_width, 310.0); },
     "run2_view1.png", "one scale"},
    // A heap without plate: nothing with straight parallel sides.
    {"NoPlate", [](const fs::path& photo) { WriteTriangle(photo, &Scene::plate_width, 0.0); },
     "run2_view1.png", "no plate found"},
};

class ExperimentFaults : public testing::TestWithParam<PhotoFault> {};

// Each fault names the file and a remedy, and --allow-missing-views goes on without it and says so.
TEST_P(ExperimentFaults, IsNamedWithItsRemedy) {
  const PhotoFault& fault = GetParam();
  const fs::path folder = GoodFolder(fault.name);
  fault.spoil(folder / Name(2, 1));
  ExperimentOptions options = Options(folder);
  const std::string error = ErrorOf(options);
  EXPECT_THAT(error, HasSubstr(fault.file));
  EXPECT_THAT(error, HasSubstr(fault.reason));
  EXPECT_THAT(error, HasSubstr("--allow-missing-views"));
  options.allow_missing_views = true;
  const Experiment experiment = MeasureExperiment(options);
  std::size_t num_views = 0;
  for (const MeasuredRun& run : experiment.runs) num_views += run.views.size();
  EXPECT_EQ(num_views, 3u);
  ASSERT_EQ(experiment.warnings.size(), 1u);
  EXPECT_EQ(experiment.warnings[0].doubt, PhotoDoubt::kLeftOut);
  EXPECT_THAT(WarningText(experiment.warnings[0]), HasSubstr(fault.reason));
}

INSTANTIATE_TEST_SUITE_P(EachPhoto, ExperimentFaults, testing::ValuesIn(kPhotoFaults),
                         [](const auto& test) { return std::string(test.param.name); });

// The plate of one photograph of four is of another scale: it cannot be used, its picture is kept,
// and the message says where. A blank one has nothing to draw.
TEST(Experiment, FaultIsDrawnAndNamed) {
  const fs::path folder = GoodFolder("drawn");
  WriteTriangle(folder / Name(2, 1), &Scene::plate_width, 310.0);
  WritePng(folder / Name(2, 0), Uniform(200));
  std::vector<fs::path> drawn;
  const auto keep = [&](const fs::path& photo, const ColorImage& picture) {
    drawn.push_back(photo.filename());
    const auto is = [&](const Color& color) {
      return std::ranges::find(picture.pixels, color) != picture.pixels.end();
    };
    EXPECT_TRUE(is({230, 30, 30})) << "outline";
    EXPECT_TRUE(is({40, 90, 240})) << "plate";
    return fs::path("kept") / photo.filename();
  };
  try {
    MeasureExperiment(Options(folder), keep);
    FAIL() << "no error";
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("(see kept/run2_view1.png)"));
  }
  EXPECT_THAT(drawn, testing::ElementsAre(fs::path("run2_view1.png")));
}

TEST(Experiment, LeavingOutMostPhotographsIsNotOffered) {
  const fs::path folder = GoodFolder("most");
  for (const auto& name : {Name(1, 0), Name(1, 1), Name(2, 1)}) {
    WriteTriangle(folder / name, &Scene::plate_width, 0.0);
  }
  EXPECT_THAT(ErrorOf(Options(folder)), testing::Not(HasSubstr("--allow-missing-views")));
  EXPECT_THAT(ErrorOf(Options(folder)), HasSubstr("\"frame\""));
}

// A bright heap and plate before a dark background have the profile of the same heap lit from
// behind, and that they were taken so is said. Told that the powder is dark, the plate is not
// found.
TEST(Experiment, FrontLitHeapIsRecognised) {
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
  EXPECT_NE(ErrorOf(options), "no error");
}

// One doubt a photograph, each drawn so that nothing else is doubtful.
TEST(Experiment, DoubtfulPhotographsAreWarnedOf) {
  const fs::path folder = EmptyFolder("doubts");
  const Scene scene = SmallScene();
  for (int view = 0; view < 4; ++view) WritePng(folder / Name(1, view), Triangle(scene));
  // A thread over the heap from the left edge of the picture: touches it and reaches beyond the
  // rim.
  WritePng(folder / Name(1, 4), Photograph(scene, [](double x) {
             return x < 0 ? std::max(0.5 * (150 - std::abs(x)), 8.0) : 0.5 * (150 - x);
           }));
  WritePng(folder / Name(1, 5),
           Photograph(scene, [](double x) { return 0.2 * (150 - std::abs(x)); }));
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

// A table is a plate that ends nowhere.
Scene TableScene() {
  Scene scene = SmallScene();
  scene.plate_width = 5000;
  scene.plate_depth = 500;
  scene.tilt = 1.2 * std::numbers::pi / 180;
  scene.uneven = true;
  return scene;
}

// A triangle of 150 px height over 240 px, 15 mm by 24 mm at 0.1 mm a pixel, and at the left a
// ruler of 20 px by 60 px that stands on the table, too.
GrayImage HeapOnTable(const Scene& scene) {
  const auto dark = [](double x, double up) {
    const bool heap = up > 0 && up < 150 * (1 - std::abs(x - 10) / 120);
    return heap || (up > 0 && up < 60 && std::abs(x + 170) < 10);
  };
  return Expose(scene, Cover(scene, dark));
}

// The outline's corners are the blur's; the angle is of straight slopes. The centre of a triangle's
// area stands over the middle of its base.
TEST(Experiment, AHeapOnATableIsMeasuredByARuler) {
  const fs::path folder = EmptyFolder("table");
  for (int view = 0; view < 2; ++view) {
    Scene scene = TableScene();
    scene.center_x += 5.3 * view;
    scene.baseline -= 1.7 * view;
    scene.tilt *= 1 - 2 * view;
    WritePng(folder / Name(1, view), HeapOnTable(scene));
  }
  ExperimentOptions options;
  options.photos = folder;
  options.scale = "30,200 - 30,100 = 10 mm";
  const Experiment experiment = MeasureExperiment(options);
  EXPECT_TRUE(experiment.warnings.empty());
  const Frame& frame = experiment.aehp.frame;
  EXPECT_DOUBLE_EQ(frame.pixel_size, 1e-4);
  EXPECT_NEAR(frame.plate_diameter, 0.027, 1e-9);  // 1.1 × 24 mm, to the next millimetre
  EXPECT_NEAR(Nebp(experiment.aehp.image) * 0.01, 0.5 * 24 * 15, 0.01 * 180);  // [mm²]
  for (std::size_t view = 0; view < 2; ++view) {
    const MeasuredView& measured = experiment.runs[0].views[view];
    const double sign = 1 - 2 * static_cast<double>(view);
    EXPECT_NEAR(measured.plate.tilt, sign * 1.2 * std::numbers::pi / 180, 1e-3);
    EXPECT_NEAR(measured.plate.center_x, 210 + 5.3 * static_cast<double>(view) + 10, 0.7);
    const double angle = std::atan2(150, 120);  // [rad]
    EXPECT_NEAR(measured.angles[1].left.value, angle, 0.01);
    EXPECT_NEAR(measured.angles[1].right.value, angle, 0.01);
  }
  options.plate_diameter = 0.05;
  EXPECT_EQ(MeasureExperiment(options).aehp.frame.plate_diameter, 0.05);
}

TEST(Experiment, WithoutPlateTheErrorSaysHowToScale) {
  const fs::path folder = EmptyFolder("no_scale");
  WritePng(folder / Name(1, 0), HeapOnTable(TableScene()));
  EXPECT_THAT(ErrorOf(Options(folder)), HasSubstr("--scale \"104,310-884,312=30 mm\""));
  ExperimentOptions options;
  options.photos = folder;
  for (const auto& [scale, why] :
       {std::pair{"30,200-30", "no \",\" where"}, std::pair{"30,200-x,9=1 mm", "no number"},
        std::pair{"30,200-30,100=10 s", "ends in no length"},
        std::pair{"30,200-31,201=10 mm", "less than 10 px"}}) {
    options.scale = scale;
    EXPECT_THAT(ErrorOf(options), HasSubstr(why)) << scale;
    EXPECT_THAT(ErrorOf(options), HasSubstr("write two points")) << scale;
  }
  options.scale = "30,200-30,100=10 mm";
  options.frame = Frame{};
  EXPECT_THAT(ErrorOf(options), HasSubstr("leave it out with a map or a frame"));
}

TEST(Experiment, ATableThatIsNoneIsNamed) {
  const auto error_of = [](const GrayImage& photo) {
    const fs::path folder = EmptyFolder("no_table");
    WritePng(folder / Name(1, 0), photo);
    ExperimentOptions options;
    options.photos = folder;
    options.scale = "30,200-30,100=10 mm";
    return ErrorOf(options);
  };
  EXPECT_THAT(error_of(Triangle(SmallScene())), HasSubstr("lower border is not dark"));
  EXPECT_THAT(error_of(Photograph(TableScene(), [](double) { return 0.0; })),
              HasSubstr("nothing stands on the table"));
  const auto saw = [](double x) { return 20 + 1.7 * std::abs(std::fmod(x + 600, 60) - 30); };
  EXPECT_THAT(error_of(Photograph(TableScene(), saw)), HasSubstr("no straight, level top"));
}

std::vector<PhotoDoubt> DoubtsOf(const fs::path& folder) {
  std::vector<PhotoDoubt> doubts;
  for (const PhotoWarning& warning : MeasureExperiment(Options(folder)).warnings) {
    doubts.push_back(warning.doubt);
  }
  return doubts;
}

TEST(Experiment, AnEmptyPlateIsWarnedOf) {
  const fs::path folder = GoodFolder("empty_plate");
  WritePng(folder / Name(2, 1), Photograph(SmallScene(), [](double) { return 0.0; }));
  EXPECT_THAT(DoubtsOf(folder), testing::ElementsAre(PhotoDoubt::kNoPowder));
}

TEST(Experiment, PhotographsOfTwoKindsOfLightAreWarnedOf) {
  const fs::path folder = GoodFolder("mixed");
  GrayImage front_lit = Triangle(SmallScene());
  for (std::uint8_t& level : front_lit.pixels) level = static_cast<std::uint8_t>(255 - level);
  WritePng(folder / Name(2, 1), front_lit);
  EXPECT_THAT(DoubtsOf(folder), testing::ElementsAre(PhotoDoubt::kMixedLight));
}

// Grains that hang over the rim on both sides: no corner of the plate is seen.
TEST(Experiment, APlateWhoseTopNoPhotographShowsIsWarnedOf) {
  const fs::path folder = EmptyFolder("hidden_top");
  const Scene scene = SmallScene();
  const auto overhanging = [](double x, double up) {
    return up > -4 && up < 0.5 * (170 - std::abs(x)) && std::abs(x) < 156;
  };
  WritePng(folder / Name(1, 0), Expose(scene, Cover(scene, overhanging)));
  EXPECT_THAT(DoubtsOf(folder), testing::Contains(PhotoDoubt::kHiddenTop));
}

// Four heaps whose slopes differ by 1 %, and one by 12 %.
TEST(Experiment, ARunUnlikeTheOthersIsWarnedOf) {
  const fs::path folder = EmptyFolder("odd_run");
  int run = 0;
  for (const double slope : {0.5, 0.505, 0.56, 0.495, 0.5}) {
    WritePng(folder / Name(++run, 0),
             Photograph(SmallScene(), [&](double x) { return slope * (150 - std::abs(x)); }));
  }
  const auto warnings = MeasureExperiment(Options(folder)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].doubt, PhotoDoubt::kRunDisagrees);
  EXPECT_EQ(warnings[0].reason, "3");
}

TEST(Experiment, NothingIsLeft) {
  const fs::path folder = EmptyFolder("nothing");
  std::ofstream(folder / Name(1, 0)) << "no image";
  ExperimentOptions options = Options(folder);
  options.allow_missing_views = true;
  EXPECT_THAT(ErrorOf(options), HasSubstr("no photograph is left"));
  EXPECT_THAT(ErrorOf(Options(EmptyFolder("none"))), HasSubstr("no file matches"));
  EXPECT_THAT(ErrorOf(Options("/no/such/folder")), HasSubstr("/no/such/folder"));
}

TEST(ExperimentOptionsTest, BrokenRulesAreReportedTogether) {
  ExperimentOptions options;
  options.map = "a.png";
  options.photos = "b";
  options.plate_diameter = -1;
  options.threshold = 1.5;
  base::Problems problems;
  options.Validate(problems);
  EXPECT_EQ(problems.list().size(), 3u);
}

// The frame that was found, given by hand with the tilt, leads to the same profile: both rest on
// the same photographs, so only the found tilt's error of a few thousandths of a degree is left.
TEST(Experiment, FrameCanBeGivenInsteadOfFound) {
  const fs::path folder = EmptyFolder("frame");
  Scene scene = SmallScene();
  scene.tilt = 1.5 * std::numbers::pi / 180;
  WritePng(folder / Name(1, 0), Triangle(scene));
  const Experiment found = MeasureExperiment(Options(folder));
  ExperimentOptions options = Options(folder);
  options.frame = Frame{.width = 420,
                        .height = 220,
                        .pixel_size = kPlate / 300,
                        .center_x = 210,
                        .baseline = 165,
                        .plate_diameter = kPlate};
  options.tilt = scene.tilt;
  const Experiment given = MeasureExperiment(options);
  EXPECT_LT(Sad(found.aehp.image, given.aehp.image), 0.01 * Nebp(given.aehp.image));
}

// Half the pixels each way: a quarter of the powder's pixels, within the outline's rounding.
TEST(Experiment, PixelSizeCanBeChosen) {
  const fs::path folder = GoodFolder("pixel");
  const Experiment fine = MeasureExperiment(Options(folder));
  ExperimentOptions options = Options(folder);
  options.pixel_size = 2 * fine.aehp.frame.pixel_size;
  const Experiment coarse = MeasureExperiment(options);
  EXPECT_EQ(coarse.aehp.frame.width, 210);
  EXPECT_NEAR(4 * Nebp(coarse.aehp.image) / Nebp(fine.aehp.image), 1, 0.02);
}

// A speck that floats and one beside the plate go, a hole fills, a grain on the plate stays.
TEST(Experiment, KeepsWhatStandsOnThePlateAndFillsHoles) {
  const Scene scene = SmallScene();
  const auto in_disc = [](double x, double y, double cx, double cy, double r) {
    return std::hypot(x - cx, y - cy) < r;
  };
  const GrayImage photo = Expose(scene, Cover(scene, [&](double x, double up) {
                                   const bool heap = up > 0 && up < 0.6 * (90 - std::abs(x)) &&
                                                     !in_disc(x, up, 0, 20, 6);
                                   return heap || in_disc(x, up, -100, 60, 4) ||
                                          in_disc(x, up, 120, 6, 6) || in_disc(x, up, 180, 10, 5);
                                 }));
  const fs::path folder = EmptyFolder("specks");
  WritePng(folder / Name(1, 0), photo);
  const Experiment experiment = MeasureExperiment(Options(folder));
  const auto dark = [&](double along, double up) {
    const Frame& frame = experiment.aehp.frame;
    return experiment.aehp.image.at(static_cast<int>(frame.center_x + along),
                                    static_cast<int>(frame.baseline - up)) == 0;
  };
  EXPECT_TRUE(dark(0, 20));   // the hole
  EXPECT_TRUE(dark(120, 6));  // the grain on the plate
  EXPECT_FALSE(dark(-100, 60));
  EXPECT_FALSE(dark(180, 10));
}

}  // namespace
}  // namespace talus::imaging
