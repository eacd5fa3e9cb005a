#include "imaging/spheres/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/parallel_for.h"
#include "base/random.h"

namespace talus::imaging {
namespace projection_test {

using base::Sphere;

constexpr double kPixel = 1e-4;  // [m]

Frame SmallFrame() {
  return {.width = 97,
          .height = 60,
          .pixel_size = kPixel,
          .center_x = 48.25,
          .baseline = 52.5,
          .plate_diameter = 8e-3};
}

// Some inside each other, some across every border of the image and below the baseline.
std::vector<Sphere> RandomSpheres(int count) {
  std::vector<Sphere> spheres;
  base::Random random(1, base::Stream("projection test"));
  for (int i = 0; i < count; ++i) {
    spheres.push_back({.position = {random.Uniform(-6e-3, 6e-3), random.Uniform(-6e-3, 6e-3),
                                    random.Uniform(-1e-3, 6e-3)},
                       .radius = random.Uniform(0.2e-4, 6e-4)});
  }
  return spheres;
}

// The header's definition, word by word.
bool InAnyDisc(const std::vector<Sphere>& spheres, const Frame& frame, double angle, int column,
               int row) {
  if (row + 0.5 > frame.baseline) return false;
  for (const Sphere& sphere : spheres) {
    const auto& p = sphere.position;
    const double across = p.x * std::cos(angle) + p.y * std::sin(angle);
    const double dx = column + 0.5 - frame.center_x - across / frame.pixel_size;
    const double dy = row + 0.5 - frame.baseline + p.z / frame.pixel_size;
    const double radius = sphere.radius / frame.pixel_size;
    if (dx * dx + dy * dy <= radius * radius) return true;
  }
  return false;
}

TEST(Projection, HasTheSameBitsForAnyNumberOfThreads) {
  const std::vector<Sphere> spheres = RandomSpheres(2000);
  base::SetMostLoopThreads(1);
  const std::vector<GrayImage> views = ProjectViews(spheres, SmallFrame(), 16);
  const Profile heap = ProjectHeap(spheres, SmallFrame(), 16);
  for (const int num_threads : {2, 3}) {
    base::SetMostLoopThreads(num_threads);
    const std::vector<GrayImage> again = ProjectViews(spheres, SmallFrame(), 16);
    for (std::size_t i = 0; i < views.size(); ++i) EXPECT_EQ(again[i].pixels, views[i].pixels);
    EXPECT_EQ(ProjectHeap(spheres, SmallFrame(), 16).image.pixels, heap.image.pixels);
  }
}

// Each pixel of each view against each sphere. Random centres leave no pixel so near a rim that the
// order of additions could decide; any rule other than "centre in the disc" moves whole columns.
TEST(Projection, EqualsTestingEveryPixelAgainstEverySphere) {
  const Frame frame = SmallFrame();
  const std::vector<Sphere> spheres = RandomSpheres(60);
  constexpr int kViews = 7;
  const std::vector<GrayImage> views = ProjectViews(spheres, frame, kViews);
  ASSERT_EQ(views.size(), static_cast<std::size_t>(kViews));
  int num_powder = 0;
  for (int view = 0; view < kViews; ++view) {
    const GrayImage& image = views[static_cast<std::size_t>(view)];
    const double angle = std::numbers::pi * view / kViews;
    for (int row = 0; row < frame.height; ++row) {
      for (int column = 0; column < frame.width; ++column) {
        const bool powder = InAnyDisc(spheres, frame, angle, column, row);
        num_powder += powder;
        ASSERT_EQ(image.at(column, row), powder ? 0 : 255) << view << " " << column << " " << row;
      }
    }
  }
  EXPECT_GT(num_powder, 1000);  // the comparison was not of empty images
}

TEST(Projection, ProfileIsTheRoundedMeanOfTheViews) {
  const std::vector<Sphere> spheres = RandomSpheres(20);
  const std::vector<GrayImage> views = ProjectViews(spheres, SmallFrame(), kDefaultViews);
  EXPECT_EQ(ProjectHeap(spheres, SmallFrame()).image, MeanImage(views));
}

// Pixel centres exactly on the rim belong to the disc: the square root must not decide otherwise.
TEST(Projection, RimCounts) {
  const Frame frame{.width = 21, .height = 21, .pixel_size = 0.5, .center_x = 10.5, .baseline = 21};
  const std::vector<Sphere> spheres{{.position = {0, 0, 5.25}, .radius = 2.5}};
  const GrayImage image = ProjectViews(spheres, frame, 1).front();
  for (const auto& [dx, dy] : {std::pair{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-4, -3}, {-5, 0}}) {
    EXPECT_EQ(image.at(10 + dx, 10 + dy), 0) << dx << " " << dy;
  }
  EXPECT_EQ(image.at(10 + 4, 10 + 4), 255);
}

// Half of a drum's radius is known: a grain at its axis shows whole, one at the rim not at all.
TEST(Projection, OutsideTheDiscNothingShows) {
  Frame frame = SmallFrame();
  frame.height = 90;
  frame.baseline = 85;
  frame.disc_diameter = 0.5 * frame.plate_diameter;
  const std::vector<Sphere> spheres{{.position = {0, 0, 4e-3}, .radius = 5e-4},
                                    {.position = {0, 0, 7.5e-3}, .radius = 5e-4}};
  Frame whole = frame;
  whole.disc_diameter.reset();
  const GrayImage known = ProjectViews(spheres, frame, 1).front();
  EXPECT_EQ(known.pixels, ProjectViews({spheres.data(), 1}, whole, 1).front().pixels);
  EXPECT_EQ(ProjectHeap(spheres, frame, 3).image.pixels,
            ProjectHeap({spheres.data(), 1}, whole, 3).image.pixels);
}

TEST(Projection, RejectsFramesAndViewsThatMeanNothing) {
  Frame frame = SmallFrame();
  EXPECT_THROW(ProjectHeap({}, frame, 0), base::ConfigError);
  frame.pixel_size = 0;
  EXPECT_THROW(ProjectHeap({}, frame, 1), base::ConfigError);
}

TEST(GrainsOnPlate, KeepsWhatHangsTogetherDownToThePlate) {
  constexpr double kRadius = 1e-4;
  const std::vector<Sphere> spheres{
      {.position = {0, 0, kRadius}, .radius = kRadius},             // on the plate
      {.position = {0, 0, 2.995 * kRadius}, .radius = kRadius},     // on the first
      {.position = {1e-3, 0, 1.2e-4}, .radius = kRadius},           // 0.2 radii above the plate
      {.position = {4.05e-3, 0, 0.8e-4}, .radius = kRadius},        // over the rim, touching it
      {.position = {4.5e-3, 0, 0.5e-4}, .radius = kRadius},         // beside the plate
      {.position = {0, 4.05e-3, -0.5e-4}, .radius = kRadius},       // touches the side only
      {.position = {0, 0, 5.05 * kRadius}, .radius = kRadius},      // 0.05 radii above the second
      {.position = {1.9e-4, 0, 3.3 * kRadius}, .radius = kRadius},  // leans on the second
  };
  const std::vector<Sphere> heap = GrainsOnPlate(spheres, 8e-3);
  ASSERT_EQ(heap.size(), 4u);
  EXPECT_EQ(heap[0].position, spheres[0].position);
  EXPECT_EQ(heap[1].position, spheres[1].position);
  EXPECT_EQ(heap[2].position, spheres[3].position);
  EXPECT_EQ(heap[3].position, spheres[7].position);
}

TEST(GrainsOnPlate, AGapOfAHundredthOfARadiusIsAContact) {
  constexpr double kRadius = 1e-4;
  const auto count = [&](double gap) {
    return GrainsOnPlate(
               std::vector<Sphere>{{.position = {0, 0, kRadius}, .radius = kRadius},
                                   {.position = {0, 0, (3 + gap) * kRadius}, .radius = kRadius}},
               8e-3)
        .size();
  };
  EXPECT_EQ(count(0.008), 2u);
  EXPECT_EQ(count(0.012), 1u);
}

TEST(GrainsOnPlate, EmptyHeapIsEmpty) { EXPECT_TRUE(GrainsOnPlate({}, 8e-3).empty()); }

}  // namespace projection_test
}  // namespace talus::imaging
