#include "imaging/spheres/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::imaging {
namespace render_test {

constexpr Color kWhite{255, 255, 255};

Camera SideView() {
  return {.width = 100,
          .height = 80,
          .pixel_size = 1e-4,
          .center_x = 50,
          .baseline = 70,
          .plate_diameter = 6e-3};
}

bool IsPowder(const Color& c) { return c[0] > c[2] + 20; }  // sand, not white nor grey

// A sphere of 1 mm radius is a disc of 10 px radius, where the frame of a profile would have it.
TEST(RenderSpheres, SphereIsADiscWhereAProfileHasIt) {
  ColorImage image = RenderSpheres(std::vector<base::Sphere>{{{1e-3, 0, 2e-3}, 1e-3}}, SideView());
  int powder = 0;
  double column = 0, row = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!IsPowder(image.at(x, y))) continue;
      ++powder;
      column += x + 0.5;
      row += y + 0.5;
    }
  }
  EXPECT_NEAR(powder, std::numbers::pi * 100, 12);  // its rim crosses some 60 pixels
  EXPECT_NEAR(column / powder, 60, 0.1);
  EXPECT_NEAR(row / powder, 50, 0.1);
  EXPECT_EQ(image.at(5, 5), kWhite);
}

TEST(RenderSpheres, NearerSphereHidesTheOther) {
  // The camera looks along +y: the big sphere at y = -3 mm stands in front of the small one.
  const std::vector<base::Sphere> both{{{0, 2e-3, 2e-3}, 0.5e-3}, {{0, -3e-3, 2e-3}, 1e-3}};
  const std::vector<base::Sphere> front{both[1]};
  EXPECT_EQ(RenderSpheres(both, SideView()).pixels, RenderSpheres(front, SideView()).pixels);
  Camera turned = SideView();
  turned.azimuth = std::numbers::pi;  // from behind the small one is seen
  EXPECT_NE(RenderSpheres(both, turned).pixels, RenderSpheres(front, turned).pixels);
}

// The sphere at the back of a column stands higher in the picture than one on the axis.
TEST(WholeHeap, NothingOfPlateAndHeapIsCutOff) {
  const std::vector<base::Sphere> heap{
      {{0, 0, 4e-3}, 1e-3}, {{2.5e-3, 0, 0.5e-3}, 0.5e-3}, {{0, 2.5e-3, 4e-3}, 0.5e-3}};
  ColorImage image = RenderSpheres(heap, WholeHeap(heap, 6e-3, 200));
  for (int x = 0; x < image.width; ++x) EXPECT_EQ(image.at(x, 0), kWhite);
  for (int y = 0; y < image.height; ++y) {
    EXPECT_EQ(image.at(0, y), kWhite);
    EXPECT_EQ(image.at(image.width - 1, y), kWhite);
  }
}

// What lies to one side of the origin was cut off, and half of the picture empty.
TEST(FromTheFront, HoldsEverySphereAndLittleMore) {
  const std::vector<base::Sphere> spheres{
      {{-4e-3, 0, 1e-3}, 1e-3}, {{30e-3, 2e-3, 0.5e-3}, 0.5e-3}, {{2e-3, 0, 14e-3}, 1e-3}};
  for (const double most_height : {1.2, 0.3}) {
    const Camera camera = FromTheFront(spheres, 300, most_height);
    EXPECT_LE(camera.height, most_height * 300 + 1);
    ColorImage image = RenderSpheres(spheres, camera);
    int left = image.width, right = -1, top = image.height, bottom = -1;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (image.at(x, y) == kWhite) continue;
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
    }
    EXPECT_GT(left, 0);
    EXPECT_LT(right, image.width - 1);
    EXPECT_GT(top, 0);
    EXPECT_LT(bottom, image.height - 1);
    EXPECT_LT(top, 0.15 * image.height);
    EXPECT_GT(bottom, 0.85 * image.height);
    EXPECT_NEAR((bottom - top) / static_cast<double>(right - left), 15.0 / 35.5, 0.02);
  }
}

}  // namespace render_test
}  // namespace talus::imaging
