#include "imaging/heap/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.h"
#include "imaging/heap/difference_map.h"
#include "tests/error_in.h"

namespace talus::imaging {
namespace metrics_test {

constexpr double kDegree = std::numbers::pi / 180;

Frame SmallFrame() {
  return {.width = 200,
          .height = 100,
          .pixel_size = 1e-4,
          .center_x = 100,
          .baseline = 90,
          .plate_diameter = 0.016};
}

// The mean of many binary views of a heap of height h(x) that is shifted by `shift` px: each
// pixel's grey is the share of its column that is powder.
Profile Drawn(const std::function<double(double)>& height, double shift = 0) {
  const Frame frame = SmallFrame();
  Profile profile{.image = {.width = 200, .height = 100, .pixels = {}}, .frame = frame};
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double h = height(x + 0.5 - frame.center_x - shift);
      const double share = y < 90 ? std::clamp(h - (frame.baseline - y - 1), 0.0, 1.0) : 0.0;
      profile.image.pixels.push_back(static_cast<std::uint8_t>(255 * (1 - share) + 0.5));
    }
  }
  return profile;
}

double Cone(double x) { return std::max(0.0, 0.5 * (80 - std::abs(x))); }
double Dome(double x) { return std::max(0.0, 36 * (1 - x * x / 6400)); }

double Value(const std::vector<Metric>& metrics, const std::string& name) {
  return FindMetric(metrics, name).value.value;
}

TEST(Metrics, ComparedWithItselfNothingDiffers) {
  const HeapImages heap{.profile = Drawn(Cone), .parts = {}};
  const auto metrics = CompareProfiles(heap, heap);
  for (const char* name : {"sad_mm2", "sad_relative", "sad_px", "rmse_gray"}) {
    EXPECT_EQ(Value(metrics, name), 0) << name;
  }
  EXPECT_EQ(Value(metrics, "iou"), 1);
  for (const Metric& metric : metrics) {
    EXPECT_EQ(metric.value.value, metric.reference.value) << metric.name;
  }
}

TEST(Metrics, SadIsSymmetric) {
  const Profile a = Drawn(Cone);
  const Profile b = Drawn(Dome);
  EXPECT_EQ(Sad(a.image, b.image), Sad(b.image, a.image));
  double between = 0;  // the outlines
  for (int x = -100; x < 100; ++x) between += std::abs(Cone(x + 0.5) - Dome(x + 0.5));
  EXPECT_NEAR(Sad(a.image, b.image), between, 0.01 * between);
}

// A block of 20 × 10 px against one of 20 × 15: 100 px more, of 0.01 mm² each.
TEST(Metrics, NumbersOfTwoBlocks) {
  const auto block = [](double h) { return [h](double x) { return std::abs(x) < 10 ? h : 0.0; }; };
  const HeapImages low{.profile = Drawn(block(10)), .parts = {}};
  const HeapImages high{.profile = Drawn(block(15)), .parts = {}};
  MetricOptions options;
  auto metrics = CompareProfiles(high, low, options);
  EXPECT_DOUBLE_EQ(Value(metrics, "sad_px"), 100);
  EXPECT_DOUBLE_EQ(Value(metrics, "sad_mm2"), 1);
  EXPECT_DOUBLE_EQ(Value(metrics, "sad_relative"), 0.5);
  EXPECT_DOUBLE_EQ(Value(metrics, "iou"), 200.0 / 300);
  EXPECT_DOUBLE_EQ(Value(metrics, "rmse_gray"), 255 * std::sqrt(100.0 / 20000));
  EXPECT_DOUBLE_EQ(Value(metrics, "nebp_px"), 300);
  EXPECT_DOUBLE_EQ(Value(metrics, "nebp_mm2"), 3);
  EXPECT_DOUBLE_EQ(FindMetric(metrics, "nebp_px").reference.value, 200);
  options.rmse_region = Region{.left = 90, .top = 75, .width = 20, .height = 5};  // the difference
  EXPECT_DOUBLE_EQ(Value(CompareProfiles(high, low, options), "rmse_gray"), 255);
  options.rmse_region = Region{.left = 190, .top = 0, .width = 20, .height = 5};
  EXPECT_FALSE(FindMetric(CompareProfiles(high, low, options), "rmse_gray").value.defined());
}

// The second picture was left out where a region is given.
TEST(Metrics, ARegionIsThatOfEveryPictureOfAFilm) {
  Frame frame = SmallFrame();
  frame.width = 400;
  frame.pictures = 2;
  const GrayImage white{
      .width = 400, .height = 100, .pixels = std::vector<std::uint8_t>(40000, 255)};
  GrayImage later = white;
  later.at(200 + 90, 75) = 0;
  MetricOptions options;
  options.rmse_region = Region{.left = 90, .top = 75, .width = 20, .height = 5};
  const auto metrics =
      CompareProfiles({.profile = {.image = later, .frame = frame}, .parts = {}},
                      {.profile = {.image = white, .frame = frame}, .parts = {}}, options);
  EXPECT_DOUBLE_EQ(Value(metrics, "rmse_gray"), 255 / std::sqrt(2 * 100.0));
}

// Slopes of 29, 30 and 31 degrees on both sides: a standard error of 1/√3 each.
TEST(Metrics, StandardErrorsOfAnglesAreInDegrees) {
  HeapImages heap{.profile = Drawn(Cone), .parts = {}};
  for (const double angle : {29.0, 30.0, 31.0}) {
    const double slope = std::tan(angle * kDegree);
    heap.parts.push_back(
        Drawn([=](double x) { return std::max(0.0, slope * (80 - std::abs(x))); }).image);
  }
  const auto metrics = DescribeProfile(heap);
  const Measured& right = FindMetric(metrics, "repose_angle_1_right_deg").value;
  EXPECT_NEAR(right.standard_error, 1 / std::sqrt(3.0), 0.05);
}

// The triangle of the same area is the cone itself: 26.57°, and nothing deviates from it but the
// columns' steps of up to a quarter of a pixel on 20 px of mean height.
TEST(Metrics, ConeIsItsOwnTriangle) {
  const auto metrics = DescribeProfile({.profile = Drawn(Cone), .parts = {}});
  EXPECT_NEAR(Value(metrics, "triangle_angle_deg"), std::atan(0.5) / kDegree, 0.05);
  EXPECT_LT(Value(metrics, "static_cohesive_index"), 0.02);
  // A parabola of height h over a base of 2 is h (1 − x²), its triangle 4 h (1 − x) / 3: they
  // differ by 4/27 of its area.
  EXPECT_NEAR(
      Value(DescribeProfile({.profile = Drawn(Dome), .parts = {}}), "static_cohesive_index"),
      4.0 / 27, 0.002);
}

// A shift by s moves both outlines: |dh/dx| s a column, 0.5 × 0.3 × 160 = 24 px of 3200.
TEST(Metrics, SadGrowsWithAShiftAsTheSlopesSay) {
  const Profile still = Drawn(Cone);
  EXPECT_NEAR(Sad(still.image, Drawn(Cone, 0.3).image), 24, 2);
}

TEST(Metrics, EmptyHeapHasReasonsInsteadOfNumbers) {
  const HeapImages empty{.profile = Drawn([](double) { return 0.0; }), .parts = {}};
  const auto metrics = CompareProfiles(empty, empty);
  for (const char* name : {"sad_relative", "iou", "triangle_angle_deg", "static_cohesive_index",
                           "repose_angle_2_mean_deg"}) {
    EXPECT_FALSE(FindMetric(metrics, name).value.defined()) << name;
    EXPECT_TRUE(std::isnan(FindMetric(metrics, name).value.value)) << name;
  }
}

TEST(Metrics, NamesAreThoseOfEveryComparison) {
  const HeapImages heap{.profile = Drawn(Cone), .parts = {}};
  const auto metrics = CompareProfiles(heap, heap);
  const auto names = MetricNames();
  ASSERT_EQ(names.size(), metrics.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(names[i], metrics[i].name);
}

TEST(Metrics, OtherFramesCannotBeCompared) {
  const HeapImages heap{.profile = Drawn(Cone), .parts = {}};
  HeapImages other = heap;
  other.profile.frame.baseline += 0.5;
  EXPECT_THROW(CompareProfiles(heap, other), base::ConfigError);
}

TEST(Metrics, ImagesOfOtherSizesCannotBeCompared) {
  const GrayImage two{.width = 2, .height = 1, .pixels = {0, 255}};
  const GrayImage three{.width = 3, .height = 1, .pixels = {0, 255, 255}};
  EXPECT_THROW(Sad(three, two), base::ConfigError);
  EXPECT_THROW(Sad(two, three), base::ConfigError);
}

TEST(Metrics, AFrameThatIsNotFilledInIsRefused) {
  const auto error_of = [](const HeapImages& heap) {
    return ErrorIn([&] { CompareProfiles(heap, heap); });
  };
  HeapImages heap{.profile = Drawn(Cone), .parts = {}};
  heap.profile.frame.pixel_size = 0;
  EXPECT_NE(error_of(heap).find("heap.frame.pixel_size: is 0"), std::string::npos);
  heap.profile.frame = SmallFrame();
  heap.profile.image.pixels.pop_back();
  EXPECT_NE(error_of(heap).find("heap.image: has 200 x 100 px"), std::string::npos);
}

TEST(Metrics, ANameThatIsNoneIsAnError) {
  const auto metrics = DescribeProfile({.profile = Drawn(Cone), .parts = {}});
  EXPECT_THROW(FindMetric(metrics, "angle"), base::ConfigError);
}

// ANHP − AEHP: white without powder in the simulation where the experiment has it is +255, blue.
TEST(DifferenceMap, BlueWhereTheSimulationHasTooLittle) {
  const Profile experiment = Drawn(Cone);
  const Profile simulation = Drawn([](double x) { return x < 0 ? 0.0 : Cone(x - 20); });
  const ColorImage map = DifferenceImage(simulation, experiment);
  const auto at = [&](int x, int y) { return map.pixels[static_cast<std::size_t>(y * 200 + x)]; };
  EXPECT_EQ(at(60, 80), (Color{0, 0, 255}));
  EXPECT_EQ(at(150, 74), (Color{255, 0, 0}));
  EXPECT_EQ(at(10, 10), (Color{255, 255, 255}));
  const ColorImage drawn = DrawDifferenceMap(simulation, experiment);
  EXPECT_GT(drawn.width, 500);  // enlarged, with its axes
}

}  // namespace metrics_test
}  // namespace talus::imaging
