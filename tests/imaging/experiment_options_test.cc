// What an experiment's keys may be, and which go together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/problems.h"
#include "imaging/photos/experiment.h"

namespace talus::imaging {
namespace experiment_options_test {

using ::testing::HasSubstr;

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

// A film whose every picture is a map counted as one heap, whatever its maps averaged.
TEST(ExperimentOptionsTest, AFilmOfMapsKnowsItsHeaps) {
  ExperimentOptions options;
  FilmedPicture map;
  map.map = "0.png";
  FilmedPicture photographed;
  photographed.photos = "photos";
  options.film = {map, map};
  options.plate_diameter = 0.01;
  options.map_heaps = 4;
  const auto count = [&] {
    base::Problems problems;
    options.Validate(problems);
    return problems.size();
  };
  EXPECT_EQ(count(), 0u);
  options.allow_missing_views = true;
  EXPECT_EQ(count(), 1u);
  options.allow_missing_views = false;
  options.film = {map, photographed};
  EXPECT_EQ(count(), 1u);
}

// 0.5 was taken for half a degree, and turned the photographs by 28.6.
TEST(ExperimentOptionsTest, ATiltInRadThatIsMeantInDegreesIsRefused) {
  ExperimentOptions options;
  options.photos = "photos";
  options.frame = Frame{.pixel_size = 1e-5};
  options.plate_diameter = options.frame->plate_diameter;
  const auto problems_of = [&](double tilt) {
    options.tilt = tilt;
    base::Problems problems;
    options.Validate(problems);
    return problems.list();
  };
  EXPECT_THAT(problems_of(-0.17), testing::IsEmpty());  // 9.7 degrees
  const std::vector<base::Problem> list = problems_of(0.5);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].path, "tilt");
  EXPECT_THAT(list[0].Text(), HasSubstr("is 0.5, in rad, which is 28.65 degrees"));
  EXPECT_THAT(list[0].message, HasSubstr("if 0.5 degrees are meant, write \"0.5 deg\""));
}

}  // namespace experiment_options_test
}  // namespace talus::imaging
