// Pictures of a rig while its powder moves.
#include "experiments/rigs/phased/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/rigs/filling/vessel.h"
#include "experiments/rigs/phased/spheres.h"
#include "imaging/heap/film_strip.h"
#include "imaging/spheres/projection.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace camera_test {

using ::testing::HasSubstr;

// The pictures of another run of the same case, stopped at the times of the camera.
TEST(Camera, TheProfileIsTheMeanOfSilhouettesWhileThePowderMoves) {
  const Case c = Filmed();
  const auto filmed = Ran(c);
  Case still = c;
  still.rig.camera.reset();
  const auto run = Ran(still);
  ASSERT_EQ(filmed->simulation().step(), run->simulation().step());
  for (std::size_t i = 0; i < run->Grains().size(); ++i) {  // who looks on changes nothing
    EXPECT_EQ(filmed->Grains()[i].position.x, run->Grains()[i].position.x);
  }
  const auto again = MakeRig(still);
  std::vector<imaging::GrayImage> views;
  for (int frame = 0; frame < 4; ++frame) {
    const double at = run->RecordOf("turning").start_time + 0.005 + 0.01 * frame;
    while (again->simulation().time() + again->simulation().time_step() / 2 < at) {
      again->Advance(at);
    }
    views.push_back(imaging::ProjectViews(SpheresOf(again->Grains()), *c.frame, 1).front());
  }
  EXPECT_NE(views.front().pixels, views.back().pixels);
  const Pictures pictures = PicturesOf(filmed->state().camera, *c.frame, *c.rig.camera);
  EXPECT_EQ(pictures.profile.pixels, imaging::MeanImage(views).pixels);
  EXPECT_GT(Value(c, *filmed, "cohesive_index_m"), 0);
}

// Its index was of a drum of the frame's width.
TEST(Camera, AFrameOfAnotherDrumIsRefused) {
  Case c = Filmed();
  base::Problems problems;
  ValidateCase(c, problems);
  EXPECT_TRUE(problems.empty());
  c.frame->plate_diameter *= 0.5;
  ValidateCase(c, problems);
  EXPECT_THAT(ErrorIn([&] { problems.ThrowIfAny(); }), HasSubstr("frame.plate_diameter: is 0.0"));
}

// What the camera has seen where the run is interrupted after the second frame and goes on.
CameraMemory SeenWithABreak(const Case& c) {
  auto first = MakeRig(c);
  while (first->state().camera.num_frames < 2) first->Advance();
  auto second = RestoreRig(c, first->StateLine(),
                           engine::Simulation::Restore(first->simulation().Checkpoint()));
  while (second->Advance()) {
  }
  return second->state().camera;
}

TEST(Camera, ASeriesGoesOnFromACheckpoint) {
  const CameraMemory seen = SeenWithABreak(Filmed());
  EXPECT_EQ(seen.num_frames, 4);
  EXPECT_EQ(seen.runs, Ran(Filmed())->state().camera.runs);
}

// In four frames the six pixels of a row showed powder in none, one, two, four, four and four.
TEST(Camera, MeanAndStandardDeviationAreThoseOfEachPixel) {
  const imaging::Frame frame{.width = 6, .height = 1, .pixel_size = 1e-3, .plate_diameter = 0.01};
  const CameraMemory memory{.num_frames = 4, .runs = {0, 1, 1, 1, 2, 1, 4, 3}};
  const Pictures pictures = PicturesOf(memory, frame, {});
  EXPECT_EQ(pictures.profile.pixels, (std::vector<std::uint8_t>{255, 191, 128, 0, 0, 0}));
  EXPECT_EQ(pictures.standard_deviation.pixels,
            (std::vector<std::uint8_t>{0, 110, 128, 0, 0, 0}));  // 255 √(3/16), 255 / 2
  EXPECT_NEAR(CohesiveIndex(memory, frame, {}).value, (std::sqrt(3.0 / 16) + 0.5) * 1e-6 / 0.01,
              1e-15);
  EXPECT_THAT(CohesiveIndex({.num_frames = 1, .runs = {1, 6}}, frame, {}).undefined,
              HasSubstr("no standard deviation"));
}

// Two pixels that any frame shows stand two apart: a closing of three pixels fills the gap between
// them, one of a single pixel none; what lies at the picture's edge stays light.
TEST(Camera, AnyFrameThatShowsPowderCountsAndNarrowGapsAreFilled) {
  const imaging::Frame frame{.width = 7, .height = 1, .pixel_size = 1e-3, .plate_diameter = 0.01};
  const CameraMemory memory{.num_frames = 4, .runs = {0, 2, 1, 1, 0, 1, 4, 1, 0, 2}};
  const auto shown = [&](double closing) {
    return PicturesOf(memory, frame, {.shows = Shown::kAny, .closing = closing}).profile.pixels;
  };
  EXPECT_EQ(shown(0), (std::vector<std::uint8_t>{255, 255, 0, 255, 0, 255, 255}));
  EXPECT_EQ(shown(1e-3), shown(0));
  EXPECT_EQ(shown(3e-3), (std::vector<std::uint8_t>{255, 255, 0, 0, 0, 255, 255}));
}

// A column comes to rest long before a second.
TEST(Camera, PicturesAfterTheEndAreAFailure) {
  Case c = CaseOf(RigKind::kColumnCollapse, 0.5, 0.1, 0.1e-3);
  c.rig.column_collapse = {.length = 0.006, .width = 0.005};
  c.rig.camera = {.frames = 2, .interval = 5};
  c.rules.heap.max_time = 6;
  c.frame = Filmed().frame;
  try {
    Ran(c);
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("had taken 1 of 2 pictures when running out ended"));
  }
}

// 0.055 turns at 33 rpm take 0.1 s but for rounding: they were refused, with the advice to take
// 0.055.
TEST(Camera, ADrumThatEndsWithItsLastPictureIsFilmed) {
  Case c = Filmed();
  c.rig.drum.speed = 33 * 2 * std::numbers::pi / 60;
  c.rig.drum.turns = 0.055;
  c.rig.camera = {.frames = 11, .interval = 0.01};
  EXPECT_FALSE(std::isnan(Value(c, *Ran(c), "angle_deg")));
}

// A bed in the upper box of a draw-down, 14 mm deep and 30 mm above the floor of a box of 20 mm:
// its top was cut off.
TEST(Camera, TheUsualPictureHoldsTheFilledPowder) {
  nlohmann::json text = nlohmann::json::parse(
      base::ReadFile(TALUS_SOURCE_DIR "/examples/rigs/draw_down.json"), nullptr, true, true);
  text["rig"]["camera"] = {{"frames", 2}, {"interval", 0.01}};
  text["rig"]["length"] = 0.02;
  text["rig"]["height"] = 0.03;
  const Case c = LoadCase(base::ParseJson(text.dump(), "case.json"));
  ASSERT_TRUE(c.frame);
  const double top = 0.03 + FilledHeight(c, EntryOf(c).vessel(c));
  EXPECT_GT(c.frame->pixel_size * c.frame->baseline, top);
}

// Each picture of a film is what a camera sees that begins at its time.
TEST(Camera, AFilmsPicturesAreThoseOfItsTimes) {
  Case c = Filmed();
  c.rig.camera = {.frames = 2, .interval = 0.005, .times = std::vector<double>{0.005, 0.02, 0.045}};
  const auto film = Ran(c);
  const Pictures strip = PicturesOf(film->state().camera, *c.frame, *c.rig.camera);
  EXPECT_EQ(film->state().camera.num_frames, 6);
  double cohesive = 0;
  for (int i = 0; i < 3; ++i) {
    Case still = c;
    still.rig.camera = {.frames = 2, .interval = 0.005, .start = c.rig.camera->BeginOf(i)};
    const auto run = Ran(still);
    const Pictures pictures = PicturesOf(run->state().camera, *c.frame, *still.rig.camera);
    const auto picture_of = [&](const imaging::GrayImage& image) {
      return imaging::PictureOf({.image = image, .frame = ProfileFrameOf(c)}, i).image;
    };
    EXPECT_EQ(picture_of(strip.profile), pictures.profile);
    EXPECT_EQ(picture_of(strip.standard_deviation), pictures.standard_deviation);
    cohesive += Value(still, *run, "cohesive_index_m") / 3;
  }
  EXPECT_NEAR(Value(c, *film, "cohesive_index_m"), cohesive, 1e-12);  // rounding
}

// One time is no film: the same bits as of a camera that starts then.
TEST(Camera, OneTimeIsTheOnePicture) {
  Case c = Filmed();
  c.rig.camera = {.times = std::vector<double>{0.02}};
  Case still = c;
  still.rig.camera = {.start = 0.02};
  const auto film = Ran(c);
  const auto run = Ran(still);
  EXPECT_EQ(film->state().camera.runs, run->state().camera.runs);
  EXPECT_EQ(ProfileFrameOf(c), *c.frame);
  EXPECT_EQ(film->StateLine(), run->StateLine());
}

TEST(Camera, AFilmGoesOnFromACheckpoint) {
  Case c = Filmed();
  c.rig.camera = {.times = std::vector<double>{0.005, 0.02, 0.045}};
  EXPECT_EQ(SeenWithABreak(c).runs, Ran(c)->state().camera.runs);
}

// Beside the edge of its picture powder has the picture's end for a neighbour, which a closing
// fills up to, and not the light of the next picture.
TEST(Camera, PicturesOfAFilmAreClosedOneByOne) {
  const imaging::Frame frame{.width = 4, .height = 1, .pixel_size = 1e-3, .plate_diameter = 0.01};
  CameraOptions camera{.shows = Shown::kAny, .closing = 3e-3};
  const auto shown = [&](const CameraMemory& memory) {
    return PicturesOf(memory, frame, camera).profile.pixels;
  };
  EXPECT_EQ(shown({.num_frames = 1, .runs = {0, 2, 1, 1, 0, 1}}),
            (std::vector<std::uint8_t>{255, 255, 0, 0}));
  camera.times = std::vector<double>{0, 1};
  EXPECT_EQ(shown({.num_frames = 2, .runs = {0, 2, 1, 1, 0, 5}}),
            (std::vector<std::uint8_t>{255, 255, 0, 0, 255, 255, 255, 255}));
}

}  // namespace camera_test
}  // namespace talus::rigs
