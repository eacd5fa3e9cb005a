// The plate's top from its corners, wherever on the plate the heap begins.
#include "imaging/photos/plate/plate_corner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "imaging/photos/plate/plate_edges.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace plate_corner_test {

PlateEdges EdgesOf(const GrayImage& photo) {
  return FindPlateEdges(FlattenPhoto(photo, {}, "drawn"), "drawn");
}

double Below(const Scene& scene, const EdgePoint& point) {
  return (point.y - scene.baseline) * std::cos(scene.tilt) -
         (point.x - scene.center_x) * std::sin(scene.tilt);
}

struct Foot {
  double shelf;  // of the plate's top beside it [px]
  double slope;  // [-]
};

class PlateCornerAtFoot : public testing::TestWithParam<Foot> {};

// The slope's line meets the side by shelf times slope below the plate's top, and was taken for it:
// 2.1 px at a shelf of 3 px and 35°. Noise and the drawing's quarters of a pixel leave 0.2 px; a
// shelf of 1 px is too short to be seen in this blur and noise.
TEST_P(PlateCornerAtFoot, IsAtThePlatesTop) {
  const Foot foot = GetParam();
  Scene scene = SmallScene();
  scene.tilt = 0.01;
  scene.baseline += 0.3;
  const PlateEdges edges = EdgesOf(PhotographOf(scene, [&](double along) {
    return std::min(50.0, foot.slope * (150 - foot.shelf - std::abs(along)));
  }));
  EXPECT_TRUE(edges.top_left.sharp);
  EXPECT_TRUE(edges.top_right.sharp);
  EXPECT_NEAR(Below(scene, edges.top_left.point), 0, 0.3);
  EXPECT_NEAR(Below(scene, edges.top_right.point), 0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(FromRimToBareTop, PlateCornerAtFoot,
                         testing::Values(Foot{0, 0.3}, Foot{0, 0.7}, Foot{0, 1.4}, Foot{1.5, 0.7},
                                         Foot{2, 0.4}, Foot{2, 1.4}, Foot{3, 0.7}, Foot{4, 1},
                                         Foot{10, 0.5}, Foot{60, 0.7}));

// Its pixels' squares are no Gaussian blur.
TEST(PlateCorner, IsFoundInASharpPhotograph) {
  Scene scene = SmallScene();
  scene.blur = 0;
  const PlateEdges edges = EdgesOf(Triangle(scene));
  EXPECT_TRUE(edges.top_left.sharp);
  EXPECT_TRUE(edges.top_right.sharp);
  EXPECT_NEAR(Below(scene, edges.top_left.point), 0, 0.2);
  EXPECT_NEAR(Below(scene, edges.top_right.point), 0, 0.2);
}

// A wall of powder over the rim hides the plate's top: no line through its slope is that.
TEST(PlateCorner, IsVagueUnderPowderThatHangsOverTheRim) {
  const Scene scene = SmallScene();
  const PlateEdges edges = EdgesOf(Expose(scene, Cover(scene, [](double along, double up) {
                                            const double in = 152 - std::abs(along);
                                            return up > -4 && in > 0 && up < 4 + 0.6 * in;
                                          })));
  EXPECT_FALSE(edges.top_left.sharp);
  EXPECT_FALSE(edges.top_right.sharp);
}

// Light passes below the powder in a slit of a quarter of a pixel. Powder that is 4 to 20 grey
// levels brighter than the plate was taken for light as well: a seam 3 px and more above the top.
TEST(PlateSeam, IsAtThePlatesTopOrNowhereHoweverBrightThePowder) {
  const Scene scene = SmallScene();
  for (const double powder : {1.0, 0.98, 0.95, 0.9}) {
    std::vector<double> cover = Cover(scene, [](double along, double up) {
      return up > (std::abs(along) < 60 ? 0.25 : 0) && up < 0.6 * (152 - std::abs(along));
    });
    const auto above = static_cast<std::ptrdiff_t>(scene.width * scene.baseline);
    for (double& share : std::span(cover.begin(), cover.begin() + above)) share *= powder;
    const PlateEdges edges = EdgesOf(Expose(scene, cover));
    EXPECT_TRUE(edges.seam || powder < 1);
    if (edges.seam) {
      EXPECT_NEAR(Below(scene, *edges.seam), 0, 0.5) << powder;
    }
  }
}

}  // namespace plate_corner_test
}  // namespace talus::imaging
