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
#include "imaging/photos/overlay.h"
#include "imaging/spheres/projection.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace experiment_test {

using testing::HasSubstr;

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
      WritePng(folder / Name(run, view), PhotographOf(scene, spheres, kPlate, angle));
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

// Three runs of one view, the third steeper than the others by 12 %.
TEST(Experiment, NoiseFloorAndDeviationAreThoseOfTheRuns) {
  const fs::path folder = EmptyFolder("floor");
  for (int run = 1; run <= 3; ++run) {
    Scene scene = SmallScene();
    scene.seed = static_cast<std::uint64_t>(run);
    WritePng(folder / Name(run, 0), Triangle(scene, run == 3 ? 0.56 : 0.5));
  }
  const Experiment experiment = MeasureExperiment(Options(folder));
  const NoiseFloor& floor = *experiment.noise_floor;
  ASSERT_EQ(floor.sad_px.size(), 3u);
  // Between two triangles over 300 px lie 0.06 × 150²/1 px; the first two differ from the mean of
  // the others by half of it.
  const double between = 0.06 * 150 * 150;
  EXPECT_NEAR(floor.sad_px[0], between / 2, 0.1 * between);
  EXPECT_NEAR(floor.sad_px[1], between / 2, 0.1 * between);
  EXPECT_NEAR(floor.sad_px[2], between, 0.1 * between);
  EXPECT_NEAR(floor.mean_sad_px, (floor.sad_px[0] + floor.sad_px[1] + floor.sad_px[2]) / 3, 1e-9);
  const double pixel = 1e3 * experiment.aehp.frame.pixel_size;  // [mm]
  EXPECT_NEAR(floor.mean_sad_mm2, floor.mean_sad_px * pixel * pixel, 1e-9);
  EXPECT_NEAR(floor.mean_sad_relative, floor.mean_sad_px / Nebp(experiment.aehp.image), 1e-9);
  // Black in one run of three: a standard deviation of 255/√3.
  const Frame& frame = experiment.aehp.frame;
  const int x = static_cast<int>(frame.center_x), y = static_cast<int>(frame.baseline - 79.5);
  EXPECT_NEAR(experiment.standard_deviation.at(x, y), 255 / std::sqrt(3.0), 1);
  EXPECT_EQ(experiment.standard_deviation.at(x, y + 40), 0);
}

// Darker than a share of the light: an edge that the lens blurs moves out by 1.84 px from 0.3 to
// 0.8 of it, the plate's sides and the outline of 335 px alike (1.2 px × 1.53: the Gaussian's
// quantiles at shares of 0.22 and 0.78 powder, which lets a tenth of the light through). In the
// frame the plate stays as wide, so that 11 250 px of powder shrink by twice 3.7 of 300 px.
TEST(Experiment, AThresholdMovesTheOutline) {
  const fs::path folder = EmptyFolder("threshold");
  WritePng(folder / Name(1, 0), Triangle(SmallScene()));
  const auto measured = [&](double threshold) {
    ExperimentOptions options = Options(folder);
    options.threshold = threshold;
    return MeasureExperiment(options);
  };
  const Experiment low = measured(0.3), high = measured(0.8);
  const auto width = [](const Experiment& e) { return e.runs[0].views[0].plate.width; };
  EXPECT_NEAR(width(high) - width(low), 2 * 1.84, 0.3);
  const double shrinks = 2 * 2 * 1.84 / 300 * 11250;
  EXPECT_NEAR(Nebp(high.aehp.image) - Nebp(low.aehp.image), 1.84 * 335 - shrinks, 60);
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

// The plate of one photograph of four is of another scale: it cannot be used, and what was found in
// it can be drawn. A blank one has nothing to draw.
TEST(Experiment, FaultsCanBeDrawn) {
  const fs::path folder = GoodFolder("drawn");
  WriteTriangle(folder / Name(2, 1), &Scene::plate_width, 310.0);
  WritePng(folder / Name(2, 0), Uniform(200));
  ExperimentOptions options = Options(folder);
  try {
    MeasureExperiment(options);
    FAIL() << "no error";
  } catch (const UnusablePhotosError& error) {
    EXPECT_EQ(error.photos().size(), 2u);
  }
  options.allow_missing_views = true;
  const Experiment measured = MeasureExperiment(options);
  const std::vector<UnusablePhoto>& left_out = measured.left_out;
  ASSERT_EQ(left_out.size(), 2u);
  EXPECT_THAT(measured.reading, testing::StartsWith("1 heap (1), 2 photographs"));
  EXPECT_FALSE(left_out[0].is_drawable);
  EXPECT_TRUE(left_out[1].is_drawable);
  EXPECT_THROW(FaultOf(left_out[0], options), base::ConfigError);
  const ColorImage picture = FaultOf(left_out[1], options);
  const auto has = [&](const Color& color) {
    return std::ranges::find(picture.pixels, color) != picture.pixels.end();
  };
  EXPECT_TRUE(has({230, 30, 30})) << "outline";
  EXPECT_TRUE(has({40, 90, 240})) << "plate";
}

TEST(Experiment, LeavingOutMostPhotographsIsNotOffered) {
  const fs::path folder = GoodFolder("most");
  for (const auto& name : {Name(1, 0), Name(1, 1), Name(2, 1)}) {
    WriteTriangle(folder / name, &Scene::plate_width, 0.0);
  }
  EXPECT_THAT(ErrorOf(Options(folder)), testing::Not(HasSubstr("--allow-missing-views")));
  EXPECT_THAT(ErrorOf(Options(folder)), HasSubstr("\"frame\""));
}

// Nothing that the hint proposes would help these photographs.
TEST(Experiment, TheHintAtThePlateIsGivenWhereNoneWasFoundOnly) {
  const auto error_of = [](const char* name, void (*spoil)(const fs::path&)) {
    const fs::path folder = GoodFolder(name);
    for (const auto& photo : {Name(1, 0), Name(1, 1), Name(2, 1)}) spoil(folder / photo);
    return ErrorOf(Options(folder));
  };
  const auto hint = HasSubstr("most photographs have a fault");
  EXPECT_THAT(error_of("most_no_image", [](const auto& photo) { std::ofstream(photo) << "text"; }),
              testing::Not(hint));
  EXPECT_THAT(error_of("most_black", [](const auto& photo) { WritePng(photo, Uniform(3)); }),
              testing::Not(hint));
  EXPECT_THAT(error_of("most_no_plate",
                       [](const auto& photo) { WriteTriangle(photo, &Scene::plate_width, 0.0); }),
              hint);
}

// It was printed once for each of 80.
TEST(Experiment, AFaultThatManyPhotographsHaveIsSaidOnce) {
  const fs::path folder = EmptyFolder("many_faults");
  for (int view = 0; view < 12; ++view) WritePng(folder / Name(1, view), Uniform(3));
  std::ofstream(folder / Name(1, 12)) << "text";
  const std::string error = ErrorOf(Options(folder));
  EXPECT_EQ(std::ranges::count(error, '\n'), 1) << error;
  EXPECT_THAT(error, HasSubstr(Name(1, 0) + ": is black everywhere"));
  EXPECT_THAT(error, HasSubstr("; the same holds for " + (folder / Name(1, 1)).string() + ", "));
  EXPECT_THAT(error, HasSubstr(Name(1, 8) + " and 3 more photographs"));
  EXPECT_THAT(error, HasSubstr(Name(1, 12) + ": is no image"));
}

TEST(Experiment, NothingIsLeft) {
  const fs::path folder = EmptyFolder("nothing");
  std::ofstream(folder / Name(1, 0)) << "no image";
  ExperimentOptions options = Options(folder);
  options.allow_missing_views = true;
  EXPECT_THAT(ErrorOf(options), HasSubstr("no photograph is left"));
  EXPECT_THAT(ErrorOf(Options(EmptyFolder("none"))), HasSubstr("holds no image"));
  EXPECT_THAT(ErrorOf(Options("/no/such/folder")), HasSubstr("/no/such/folder"));
}

// As `talus init` and `talus measure` do, so that an entry with "photos" alone is enough.
TEST(ExperimentTest, WithoutAPatternTheOneThatFitsIsTakenAndSaid) {
  const fs::path folder = EmptyFolder("no_pattern");
  const GrayImage photo = Triangle(SmallScene());
  const GrayImage other = Triangle(SmallScene(), 0.51);
  int taken = 0;
  for (const char* name : {"h1/IMG_3.png", "h1/IMG_4.png", "h2/IMG_5.png", "h2/IMG_6.png"}) {
    fs::create_directories((folder / name).parent_path());
    WritePng(folder / name, TakenAgain(taken < 2 ? photo : other, taken));
    ++taken;
  }
  fs::create_directories(folder / "h2" / "more");
  WritePng(folder / "h2" / "more" / "IMG_7.png", photo);
  const Experiment experiment = MeasureExperiment(Options(folder));
  EXPECT_EQ(experiment.runs.size(), 2u);
  EXPECT_EQ(experiment.reading, "2 heaps (h1, h2), 4 photographs, read by the pattern \"{run}/*\"");
  ASSERT_EQ(experiment.warnings.size(), 1u);
  EXPECT_EQ(WarningText(experiment.warnings[0]), "1 image not read: h2/more/IMG_7.png");
  ExperimentOptions named = Options(folder);
  named.pattern = "{run}/*";  // whoever names it knows what it leaves out
  EXPECT_TRUE(MeasureExperiment(named).warnings.empty());
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

GrayImage Enlarged(const GrayImage& image, int factor) {
  GrayImage large{.width = image.width * factor, .height = image.height * factor, .pixels = {}};
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) large.pixels.push_back(image.at(x / factor, y / factor));
  }
  return large;
}

// 27 Mpx are read as means of 2 × 2: the heap is as large as on the small photograph whether the
// plate is found or its place is given in pixels of the file. The enlarged pixels' steps move the
// outline by up to half a small pixel of 75.
TEST(Experiment, APhotographOfManyPixelsIsMeasuredByMeansOfThem) {
  constexpr int kFactor = 17;
  const fs::path small = EmptyFolder("small");
  const fs::path large = EmptyFolder("large");
  const GrayImage photo = Triangle(SmallScene());
  WritePng(small / Name(1, 0), photo);
  WritePng(large / Name(1, 0), Enlarged(photo, kFactor));
  const auto area = [](const Experiment& e) {
    return Nebp(e.aehp.image) * e.aehp.frame.pixel_size * e.aehp.frame.pixel_size;
  };
  const double usual = area(MeasureExperiment(Options(small)));
  const Experiment found = MeasureExperiment(Options(large));
  EXPECT_EQ(found.aehp.frame.width, 420 * kFactor / 2);
  EXPECT_NEAR(area(found) / usual, 1, 0.02);
  ExperimentOptions options = Options(large);
  options.frame = Frame{.width = 420 * kFactor,
                        .height = 220 * kFactor,
                        .pixel_size = kPlate / 300 / kFactor,
                        .center_x = 210 * kFactor,
                        .baseline = 165 * kFactor,
                        .plate_diameter = kPlate};
  EXPECT_NEAR(area(MeasureExperiment(options)) / usual, 1, 0.02);
}

// As a camera of many pixels shows what it is not focussed on. The plate's bare top, ten blurs
// wide, bends down at the rim by a tenth of a blur where the corner is looked at.
TEST(Experiment, ABlurredPhotographShowsThePlatesTop) {
  const fs::path folder = EmptyFolder("blurred");
  Scene scene = SmallScene();
  scene.blur = 4;
  WritePng(folder / Name(1, 0), PhotographOf(scene, [](double along) {
             return std::max(0.0, 0.8 * (110 - std::abs(along)));
           }));
  const Experiment experiment = MeasureExperiment(Options(folder));
  EXPECT_THAT(experiment.warnings, testing::IsEmpty());
  EXPECT_NEAR(experiment.runs.at(0).views.at(0).plate.baseline, scene.baseline, 0.2 * scene.blur);
}

}  // namespace experiment_test
}  // namespace talus::imaging
