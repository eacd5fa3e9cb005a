// A film as what trials are compared with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/record/trial_end.h"
#include "imaging/heap/film_strip.h"

namespace talus::campaign {
namespace film_reference_test {

using ::testing::HasSubstr;

constexpr int kWidth = 80;
constexpr int kHeight = 60;

imaging::Frame FrameOfOne() {
  return {.width = kWidth,
          .height = kHeight,
          .pixel_size = 2e-4,
          .center_x = 40,
          .baseline = 50,
          .plate_diameter = 0.008};
}

// A step down to the right, `height` px high at the left.
imaging::GrayImage Step(int height) {
  imaging::GrayImage image{.width = kWidth,
                           .height = kHeight,
                           .pixels = std::vector<std::uint8_t>(kWidth * kHeight, 255)};
  for (int x = 20; x < 60; ++x) {
    for (int y = 50 - height + (x - 20) / 4; y < 50; ++y) image.at(x, y) = 0;
  }
  return image;
}

imaging::Profile Film(std::vector<imaging::GrayImage> pictures) {
  return {.image = imaging::SideBySide(pictures),
          .frame = imaging::StripOf(FrameOfOne(), static_cast<int>(pictures.size()))};
}

// The field of the film has those of its pictures as columns, in their order, so that each column
// is one of a heap, as column heights take it to be.
TEST(FilmReference, AFieldIsTheFieldsOfThePicturesSideBySide) {
  const Reference one(imaging::Profile{Step(30), FrameOfOne()}, {});
  const Reference film(Film({Step(30), Step(30), Step(30)}), {});
  const auto single = one.MakeFieldObjective();
  const auto all = film.MakeFieldObjective();
  ASSERT_EQ(all.width, 3 * single.width);
  ASSERT_EQ(all.height, single.height);
  const std::vector<float> fields[] = {one.Field(Step(30)), one.Field(Step(20)),
                                       one.Field(Step(12))};
  const std::vector<float> joined = film.Field(Film({Step(30), Step(20), Step(12)}).image);
  for (int y = 0; y < all.height; ++y) {
    for (int x = 0; x < all.width; ++x) {
      ASSERT_EQ(joined[y * all.width + x],
                fields[x / single.width][y * single.width + x % single.width]);
    }
  }
}

// A deck's number took the place of the image's own in the journal, and not in memory.
TEST(TrialEnd, ANumberNamedAsAnImagesMetricIsRefused) {
  const Reference reference(imaging::Profile{Step(30), FrameOfOne()}, {});
  journal::TrialRecord trial;
  trials::TrialOutput output;
  output.profile = Step(20);
  journal::MetricRecord number;
  number.name = "mass_on_plate_kg";
  output.scalars = {number};
  TakeOutput(output, reference, trial);
  const auto metrics = trial.metrics.size();
  // As the journal gives them back, so that a resumed campaign compares the same.
  EXPECT_TRUE(std::ranges::is_sorted(trial.metrics, {}, &journal::MetricRecord::name));
  number.name = "sad_mm2";
  output.scalars.push_back(number);
  EXPECT_THAT([&] { TakeOutput(output, reference, trial); },
              ::testing::ThrowsMessage<base::Error>(HasSubstr("\"sad_mm2\"")));
  EXPECT_EQ(trial.metrics.size(), metrics);
}

// Heaps that lie within the margins round the experiment's powder lose nothing.
TEST(FilmReference, AnImageComesBackFromItsField) {
  const Reference film(Film({Step(30), Step(25)}), {});
  const imaging::GrayImage image = Film({Step(28), Step(12)}).image;
  EXPECT_EQ(film.ImageOf(film.Field(image)), image);
}

// 40 columns are higher by 4 and by 6 px, 0.04 mm² each.
TEST(FilmReference, TheObjectiveIsTheSumOverThePictures) {
  const Reference film(Film({Step(30), Step(20)}), {});
  const imaging::GrayImage image = Film({Step(34), Step(26)}).image;
  EXPECT_NEAR(film.MakeFieldObjective().Value(film.Field(image)), 40 * (4 + 6) * 0.04, 1e-4);
}

TEST(FilmReference, AnAngleIsNoObjectiveOfAFilm) {
  try {
    const Reference film(Film({Step(30), Step(20)}), {.objective = journal::Objective::kAor1});
    ADD_FAILURE();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a film shows another heap in each picture"));
    EXPECT_THAT(error.what(), HasSubstr("use \"sad\""));
  }
}

}  // namespace film_reference_test
}  // namespace talus::campaign
