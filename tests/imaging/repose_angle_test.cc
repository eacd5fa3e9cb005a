#include "imaging/heap/repose_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>

#include "imaging/formats/images/image_file.h"
#include "imaging/photos/experiment.h"
#include "imaging/spheres/projection.h"
#include "tests/imaging/synthetic_photo.h"

namespace talus::imaging {
namespace repose_angle_test {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kBase = 300;  // [px]

using Height = std::function<double(double)>;

// One side of a drawn heap, `across` from its axis outwards.
struct Side {
  double foot = 0;      // [px]
  double shoulder = 0;  // where a flat top ends [px]
  Height height;
};

// The definition of methods 2 and 3, on the drawn shape itself.
double RegressionAngle(const Side& side, double share) {
  const double from = side.foot - share * (side.foot - side.shoulder);
  constexpr int kSteps = 20000;
  double x_mean = 0, h_mean = 0, sxx = 0, sxh = 0;
  const auto at = [&](int i) { return from + (side.foot - from) * (i + 0.5) / kSteps; };
  for (int i = 0; i < kSteps; ++i) {
    x_mean += at(i) / kSteps;
    h_mean += side.height(at(i)) / kSteps;
  }
  for (int i = 0; i < kSteps; ++i) {
    sxx += (at(i) - x_mean) * (at(i) - x_mean);
    sxh += (at(i) - x_mean) * (side.height(at(i)) - h_mean);
  }
  return std::atan(-sxh / sxx) / kDegree;
}

struct Shape {
  std::string name;
  double axis = 0;  // from the plate's middle [px]
  Side left;
  Side right;

  double HeightAt(double along) const {
    const double across = along - axis;
    const Side& side = across < 0 ? left : right;
    const double distance = std::abs(across);
    return distance < side.foot ? side.height(distance) : 0;
  }
};

Side Straight(double foot, double top, double shoulder) {
  return {.foot = foot, .shoulder = shoulder, .height = [=](double x) {
            return std::min(top, top * (foot - x) / (foot - shoulder));
          }};
}

// A parabola that bends inwards (bend > 0) or outwards (bend < 0, -1 for a level top).
Side Bent(double foot, double top, double bend) {
  return {.foot = foot,
          .height = [=](double x) { return top * (1 - x / foot) * (1 - bend * x / foot); }};
}

std::vector<Shape> Shapes() {
  const auto tan = [](double degrees) { return std::tan(degrees * kDegree); };
  const Side triangle = Straight(150, 150 * tan(30), 0);
  // Apex beside the middle: 25° on the left, 40° on the right.
  const double top = kBase / (1 / tan(25) + 1 / tan(40));
  const Side trapezium = Straight(150, 90 * tan(35), 60);
  const Side convex = Bent(150, 75, -1);
  const Side concave = Bent(150, 95, 0.4);
  return {{"triangle", 0, triangle, triangle},
          {"uneven", top / tan(25) - 150, Straight(top / tan(25), top, 0),
           Straight(top / tan(40), top, 0)},
          {"steep", 0, Straight(150, 150 * tan(50), 0), Straight(150, 150 * tan(50), 0)},
          {"trapezium", 0, trapezium, trapezium},
          {"convex", 0, convex, convex},
          {"concave", 0, concave, concave}};
}

struct Camera {
  std::string name;
  Scene scene;
};

std::vector<Camera> Cameras() {
  const Scene scene{
      .width = 420, .height = 260, .plate_depth = 30, .center_x = 210, .baseline = 205};
  Camera ideal{"ideal", scene};
  ideal.scene.blur = 0.5;
  ideal.scene.noise = 0;
  ideal.scene.uneven = false;
  Camera left{"tilted_left", scene};
  left.scene.tilt = -2 * kDegree;
  left.scene.blur = 1.8;
  Camera right{"tilted_right", scene};
  right.scene.tilt = 2 * kDegree;
  right.scene.noise = 6;
  return {ideal, left, right};
}

// Four views, each shifted by another fraction of a pixel.
std::vector<std::filesystem::path> Photos(const Shape& shape, const Camera& camera) {
  std::vector<std::filesystem::path> photos;
  Scene scene = camera.scene;
  for (int view = 0; view < 4; ++view) {
    scene.seed = static_cast<std::uint64_t>(view);
    scene.center_x += 0.7;
    scene.baseline -= 0.6;
    photos.push_back(std::filesystem::path(testing::TempDir()) /
                     ("repose_" + shape.name + camera.name + std::to_string(view) + ".png"));
    WritePng(photos.back(), PhotographOf(scene, [&](double x) { return shape.HeightAt(x); }));
  }
  return photos;
}

class DrawnShape : public testing::TestWithParam<std::tuple<Shape, Camera>> {};

// 0.2° at 300 px of base: a contour that is off by 0.5 px at one end of a side of 150 px. The whole
// way is tested: flat field, plate, registration, outline, angles.
TEST_P(DrawnShape, AnglesAreThoseOfTheDrawing) {
  const auto& [shape, camera] = GetParam();
  ExperimentOptions options;
  options.runs = {{.name = "1", .photos = Photos(shape, camera)}};
  options.plate_diameter = 0.01;
  const Experiment experiment = MeasureExperiment(options);
  const ReposeAngles angles = MeasureRepose(experiment.aehp.image, experiment.aehp.frame);
  const auto check = [&](const Measured& measured, const Side& side, std::size_t method) {
    ASSERT_TRUE(measured.defined()) << measured.not_defined;
    const double expected = method == 0 ? std::atan(side.height(0) / side.foot) / kDegree
                                        : RegressionAngle(side, method == 1 ? 1 : 0.5);
    EXPECT_NEAR(measured.value / kDegree, expected, 0.2) << "method " << method + 1;
  };
  for (std::size_t method = 0; method < angles.size(); ++method) {
    check(angles[method].left, shape.left, method);
    check(angles[method].right, shape.right, method);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryCamera, DrawnShape,
                         testing::Combine(testing::ValuesIn(Shapes()),
                                          testing::ValuesIn(Cameras())),
                         [](const auto& tested) {
                           return std::get<0>(tested.param).name + "_" +
                                  std::get<1>(tested.param).name;
                         });

Frame SmallFrame() {
  return {.width = 400,
          .height = 300,
          .pixel_size = 0.01 / kBase,
          .center_x = 200,
          .baseline = 280,
          .plate_diameter = 0.01};
}

GrayImage Silhouette(const Height& height) {
  const Frame frame = SmallFrame();
  GrayImage image{.width = frame.width,
                  .height = frame.height,
                  .pixels = std::vector<std::uint8_t>(400 * 300, 255)};
  for (int y = 0; y < 280; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (frame.baseline - y - 0.5 < height(x + 0.5 - frame.center_x)) image.at(x, y) = 0;
    }
  }
  return image;
}

void ExpectNoAngle(const ReposeAngles& angles, const std::string& reason) {
  for (const SideAngles& sides : angles) {
    for (const Measured* measured : {&sides.left, &sides.right, &sides.mean}) {
      EXPECT_FALSE(measured->defined());
      EXPECT_TRUE(std::isnan(measured->value));
      EXPECT_NE(measured->not_defined.find(reason), std::string::npos) << measured->not_defined;
    }
  }
}

Height Cone(double degrees) {
  return [degrees](double x) {
    return std::max(0.0, (kBase / 2 - std::abs(x)) * std::tan(degrees * kDegree));
  };
}

// Half of an even number of silhouettes have powder over a whole strip: the outline was that of the
// lower ones, 28 for 28 and 34 degrees.
TEST(MeanOfFewSilhouettes, HasTheMeanAngle) {
  const auto mean_of = [](std::initializer_list<double> degrees) {
    std::vector<GrayImage> images;
    for (const double angle : degrees) images.push_back(Silhouette(Cone(angle)));
    return MeasureRepose(MeanImage(images), SmallFrame());
  };
  for (const std::size_t method : {1, 2}) {
    EXPECT_NEAR(mean_of({28, 34})[method].mean.value / kDegree, 31, 0.3) << method;
    EXPECT_NEAR(mean_of({26, 28, 34, 36})[method].mean.value / kDegree, 31, 0.3) << method;
    EXPECT_NEAR(mean_of({28, 31, 34})[method].mean.value / kDegree, 31, 0.2) << method;
  }
  EXPECT_NEAR(mean_of({28, 34})[0].mean.value / kDegree, 31, 0.7);  // by its single top
  // Another program may round a half down.
  GrayImage floored = MeanImage(std::vector{Silhouette(Cone(28)), Silhouette(Cone(34))});
  for (std::uint8_t& g : floored.pixels) g = g == 128 ? 127 : g;
  EXPECT_NEAR(MeasureRepose(floored, SmallFrame())[1].mean.value / kDegree, 31, 0.3);
}

// Round caps of few rows. A degree: a row of eight, on a base of 80 px, is one and a half.
TEST(LowHeap, HasTheAngleOfItsShape) {
  for (const double top : {6.0, 7.0, 8.0, 8.9, 9.5, 12.0}) {
    const Side cap = Bent(40, top, -1);
    const ReposeAngles angles = MeasureRepose(
        Silhouette([&](double x) { return std::abs(x) < 40 ? cap.height(std::abs(x)) : 0; }),
        SmallFrame());
    ASSERT_TRUE(angles[1].mean.defined()) << angles[1].mean.not_defined;
    EXPECT_NEAR(angles[1].mean.value / kDegree, RegressionAngle(cap, 1), 1.0) << top;
  }
}

TEST(NoAngle, EmptyHeap) {
  ExpectNoAngle(MeasureRepose(Silhouette([](double) { return 0; }), SmallFrame()), "empty");
}

TEST(NoAngle, LayerWithoutASlope) {
  const auto layer = [](double x) { return std::abs(x) < 150 ? 2 : 0; };
  ExpectNoAngle(MeasureRepose(Silhouette(layer), SmallFrame()), "high");
}

TEST(NoAngle, WallsWithoutASlope) {
  const auto block = [](double x) { return std::abs(x) < 150 ? 80 : 0; };
  const ReposeAngles angles = MeasureRepose(Silhouette(block), SmallFrame());
  EXPECT_FALSE(angles[1].mean.defined());
  EXPECT_FALSE(angles[2].mean.defined());
}

// A mushroom: 30 px wider above than at its foot, on the left only.
GrayImage Mushroom() {
  GrayImage image = Silhouette([](double x) { return std::max(0.0, 80 - std::abs(x)); });
  for (int y = 220; y < 240; ++y) {
    for (int x = 90; x < 200; ++x) image.at(x, y) = 0;
  }
  return image;
}

TEST(NoAngle, OverhangOnOneSide) {
  const ReposeAngles angles = MeasureRepose(Mushroom(), SmallFrame());
  EXPECT_NE(angles[1].left.not_defined.find("overhangs"), std::string::npos);
  EXPECT_TRUE(angles[1].right.defined());
  EXPECT_FALSE(angles[1].mean.defined());
}

// A cake that stands as it came out of the tube: its bumpy top is no slope. The regressions over it
// gave a few degrees, the lowest angles of any powder.
TEST(NoAngle, AnUprightCakeWithABumpyTop) {
  const GrayImage cake = Silhouette(
      [](double x) { return std::abs(x) < 120 ? 100 - 5 * std::pow(std::sin(0.07 * x), 2) : 0; });
  const ReposeAngles angles = MeasureRepose(cake, SmallFrame());
  for (const std::size_t method : {1, 2}) {
    EXPECT_NE(angles[method].mean.not_defined.find("no slope"), std::string::npos) << method;
  }
  EXPECT_NEAR(angles[0].mean.value / kDegree, std::atan2(100, 120) / kDegree, 1);
}

// Blunt heaps that are no cakes keep the angle of their shoulders.
TEST(NoAngle, ABluntHeapHasOne) {
  for (const double power : {2.0, 4.0, 5.0}) {
    const GrayImage blunt = Silhouette([&](double x) {
      return std::abs(x) < 125 ? 60 * std::pow(1 - std::pow(std::abs(x) / 125, power), 1 / power)
                               : 0;
    });
    EXPECT_TRUE(MeasureRepose(blunt, SmallFrame())[1].mean.defined()) << power;
  }
  // Low ones with straight slopes: all of their widths are much the same.
  for (const auto& [height, degrees] : {std::pair{20.0, 60.0}, {28.0, 70.0}}) {
    const GrayImage low = Silhouette([top = height, slope = std::tan(degrees * kDegree)](double x) {
      return std::clamp((125 - std::abs(x)) * slope, 0.0, top);
    });
    EXPECT_NEAR(MeasureRepose(low, SmallFrame())[1].mean.value / kDegree, degrees, 3) << degrees;
  }
  // A flat top that is broad, with slopes on both sides.
  const GrayImage broad =
      Silhouette([](double x) { return std::clamp(60 * (125 - std::abs(x)) / 60, 0.0, 60.0); });
  EXPECT_NEAR(MeasureRepose(broad, SmallFrame())[1].mean.value / kDegree, 45, 1);
}

// Half of the plate is more than the mushroom's cap stands out by.
TEST(ReposeOptions, AnOverhangMayBeAsWideAsItIsTolerated) {
  const ReposeAngles angles = MeasureRepose(Mushroom(), SmallFrame(), {.overhang_tolerance = 0.5});
  EXPECT_TRUE(angles[0].left.defined()) << angles[0].left.not_defined;
  EXPECT_EQ(angles[0].right.value, MeasureRepose(Mushroom(), SmallFrame())[0].right.value);
}

// A hollow slope is flatter towards its foot: the whole of it is method 2, a quarter less than a
// half.
TEST(ReposeOptions, Method3IsOfTheShareOfTheBaseThatIsAsked) {
  const Side hollow = Bent(120, 100, 0.6);
  const GrayImage heap =
      Silhouette([&](double x) { return std::abs(x) < 120 ? hollow.height(std::abs(x)) : 0; });
  const auto angle = [&](double share, std::size_t method) {
    return MeasureRepose(heap, SmallFrame(), {.base_fraction = share})[method].mean.value / kDegree;
  };
  EXPECT_DOUBLE_EQ(angle(1, 2), angle(1, 1));
  EXPECT_DOUBLE_EQ(angle(0.25, 1), angle(1, 1));
  // Half a pixel of a binary outline at random in 30 columns: 0.5°.
  EXPECT_NEAR(angle(0.5, 2), RegressionAngle(hollow, 0.5), 0.5);
  EXPECT_NEAR(angle(0.25, 2), RegressionAngle(hollow, 0.25), 1);
  EXPECT_LT(angle(0.25, 2), angle(0.5, 2) - 2);
}

// A triangle of 39.8°, 100 px high, and a disc of 3 px on the plate at its right: one grain made
// the right side's angles 30.8°, 33.6° and 17.6°. On a table the scale is another, the heap the
// same.
TEST(LooseGrain, BesideTheHeapChangesNoAngle) {
  const GrayImage heap = Silhouette([](double x) { return 100 * (1 - std::abs(x) / 120); });
  GrayImage grain = heap;
  for (int y = 270; y < 280; ++y) {
    for (int x = 330; x < 345; ++x) {
      if (std::hypot(x + 0.5 - 337, y + 0.5 - 277) < 3) grain.at(x, y) = 0;
    }
  }
  for (const bool table : {false, true}) {
    Frame frame = SmallFrame();
    frame.table = table;
    const ReposeAngles alone = MeasureRepose(heap, frame);
    const ReposeAngles beside = MeasureRepose(grain, frame);
    for (std::size_t method = 0; method < alone.size(); ++method) {
      EXPECT_NEAR(alone[method].right.value / kDegree, 39.8, 0.3);
      EXPECT_EQ(beside[method].left.value, alone[method].left.value);
      EXPECT_EQ(beside[method].right.value, alone[method].right.value);
    }
  }
}

// A fifth of the views have powder that hangs over the left slope: a side of which a tenth and more
// do has no angle.
TEST(Repose, AnOverhangInATenthOfTheViewsLeavesItsSideWithoutAngle) {
  GrayImage heap = Silhouette([](double x) { return 80 - std::abs(x); });
  constexpr std::uint8_t kAFifth = 204;
  const Frame frame = SmallFrame();
  for (int up = 40; up < 60; ++up) {
    for (int left = 1; left < 110; ++left) {
      std::uint8_t& pixel = heap.at(static_cast<int>(frame.center_x) - left,
                                    static_cast<int>(frame.baseline) - 1 - up);
      pixel = std::min(pixel, kAFifth);
    }
  }
  const ReposeAngles angles = MeasureRepose(heap, frame);
  EXPECT_FALSE(angles[1].left.defined());
  EXPECT_TRUE(angles[1].right.defined());
}

// Three views of 29°, 30°, 31°: their scatter is 1°, its standard error 1/√3.
TEST(StandardError, IsTheScatterOfThePartsOverRootN) {
  std::vector<GrayImage> views;
  for (const double degrees : {29.0, 30.0, 31.0}) {
    const double slope = std::tan(degrees * kDegree);
    views.push_back(Silhouette([=](double x) { return slope * (150 - std::abs(x)); }));
  }
  const Profile profile{.image = views[1], .frame = SmallFrame()};
  const ReposeAngles angles = MeasureRepose(profile, views);
  // Binary outlines are off by up to half a pixel at random: 0.05° in a regression over 150
  // columns.
  EXPECT_NEAR(angles[1].mean.value / kDegree, 30, 0.1);
  EXPECT_NEAR(angles[1].mean.standard_error / kDegree, 1 / std::sqrt(3), 0.05);
  EXPECT_TRUE(std::isnan(MeasureRepose(profile, {})[1].mean.standard_error));
}

}  // namespace repose_angle_test
}  // namespace talus::imaging
