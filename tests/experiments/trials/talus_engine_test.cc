#include "experiments/trials/engines/talus_engine.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/rig_run.h"

namespace talus::trials {
namespace talus_engine_test {

namespace fs = std::filesystem;

// A result.json that a flipped bit had changed was another answer, where the journal did not have
// the trial yet.
TEST(TalusEngine, ATrialWithADamagedResultIsNotComplete) {
  const fs::path folder =
      fs::temp_directory_path() / ("talus_engine_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fs::path file = folder / "result.json";
  TalusEngine engine("talus");
  EXPECT_FALSE(engine.IsComplete(folder));
  const std::string whole = base::WithChecksum("{\n  \"status\": \"ok\",\n  \"num_steps\": 7\n}\n");
  base::WriteFileAtomically(file, whole, base::Outlives::kProgram);
  EXPECT_TRUE(engine.IsComplete(folder));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    base::WriteFileAtomically(file, damaged, base::Outlives::kProgram);
    EXPECT_FALSE(engine.IsComplete(folder)) << "byte " << i;
  }
  fs::remove_all(folder);
}

rigs::Case SmallHeap(const imaging::Frame& frame) {
  rigs::Case c;
  c.powder.material = {.density = 2500, .youngs_modulus = 1e6, .sliding_friction = 0.5};
  c.powder.sizes.diameter = 1.5e-3;
  c.powder.mass = 0.4e-3;
  c.frame = frame;
  return c;
}

void Simulate(const rigs::Case& c, const fs::path& folder) {
  fs::create_directories(folder);
  base::WriteFileAtomically(folder / "case.json", rigs::CaseText(c));
  rigs::RigRun run(c, folder);
  while (run.Advance()) {
  }
  run.WriteResults({});
}

TEST(TalusEngine, ARunIsTakenOverWithTheImageThatItsOwnFrameWouldHaveGiven) {
  const fs::path root = fs::temp_directory_path() / ("talus_taken_" + std::to_string(::getpid()));
  const rigs::Case seen = SmallHeap({.width = 60,
                                     .height = 40,
                                     .pixel_size = 3e-4,
                                     .center_x = 30,
                                     .baseline = 36,
                                     .plate_diameter = 0.01});
  const rigs::Case asked = SmallHeap({.width = 90,
                                      .height = 50,
                                      .pixel_size = 2e-4,
                                      .center_x = 41,
                                      .baseline = 45,
                                      .plate_diameter = 0.01});
  Simulate(seen, root / "seen");
  Simulate(asked, root / "asked");
  TalusEngine engine("talus");
  ASSERT_TRUE(engine.TakeOver(asked, root / "seen", root / "taken"));
  EXPECT_TRUE(engine.IsComplete(root / "taken"));
  EXPECT_EQ(engine.Collect(asked, root / "taken").profile.pixels,
            engine.Collect(asked, root / "asked").profile.pixels);
  EXPECT_EQ(base::ReadFile(root / "taken/case.json"), base::ReadFile(root / "asked/case.json"));
  rigs::Case other = asked;
  other.powder.material.sliding_friction = 0.4;
  EXPECT_FALSE(engine.TakeOver(other, root / "seen", root / "other"));
  EXPECT_EQ(engine.WhyNotTaken(asked, root / "seen"), std::nullopt);
  EXPECT_EQ(engine.WhyNotTaken(other, root / "seen"),
            "powder.material.sliding_friction is 0.5 there and 0.4 here");
  EXPECT_FALSE(fs::exists(root / "other"));
  fs::remove_all(root);
}

// What has been simulated on one core need not be simulated again on two.
TEST(TalusEngine, ThreadsMakeNoOtherRun) {
  const fs::path root = fs::temp_directory_path() / ("talus_threads_" + std::to_string(::getpid()));
  rigs::Case c = SmallHeap({.width = 60,
                            .height = 40,
                            .pixel_size = 3e-4,
                            .center_x = 30,
                            .baseline = 36,
                            .plate_diameter = 0.01});
  TalusEngine engine("talus");
  engine.Prepare(c, root);
  base::WriteFileAtomically(root / "checkpoint.bin", "half of it");
  c.threads = 2;
  EXPECT_TRUE(engine.IsPrepared(c, root));
  engine.Prepare(c, root);
  EXPECT_TRUE(fs::exists(root / "checkpoint.bin"));
  EXPECT_EQ(base::ReadFile(root / "case.json"), rigs::CaseText(c));
  c.seed += 1;
  EXPECT_FALSE(engine.IsPrepared(c, root));
  engine.Prepare(c, root);
  EXPECT_FALSE(fs::exists(root / "checkpoint.bin"));
  fs::remove_all(root);
}

// The grains that are simulated are the same; those that they stand for are eight times as many.
TEST(TalusEngine, ARunOfOtherTrueGrainsIsTakenOverWithTheirNumber) {
  const fs::path root = fs::temp_directory_path() / ("talus_scaled_" + std::to_string(::getpid()));
  rigs::Case seen = SmallHeap({.width = 60,
                               .height = 40,
                               .pixel_size = 3e-4,
                               .center_x = 30,
                               .baseline = 36,
                               .plate_diameter = 0.01});
  seen.powder.material.sliding_friction = 0.2;
  Simulate(seen, root / "seen");
  rigs::Case finer = seen;
  finer.powder.sizes.diameter = 0.75e-3;
  finer.coarse_graining.scale_factor = 2;
  TalusEngine engine("talus");
  ASSERT_EQ(engine.WhyNotTaken(finer, root / "seen"), std::nullopt);
  ASSERT_TRUE(engine.TakeOver(finer, root / "seen", root / "taken"));
  const auto fallen = [&](const char* folder) -> double {
    const std::string text = base::ReadFile(root / folder / "result.json");
    return nlohmann::json::parse(*base::IfWhole(text))["observables"]["num_fallen"];
  };
  ASSERT_GT(fallen("seen"), 0);
  EXPECT_EQ(fallen("taken"), 8 * fallen("seen"));
  fs::remove_all(root);
}

// What a camera saw is in no file of grains, so that another frame needs another run.
TEST(TalusEngine, AFilmedRunIsTakenOverInItsOwnFrameOnly) {
  const fs::path root = fs::temp_directory_path() / ("talus_filmed_" + std::to_string(::getpid()));
  rigs::Case seen = SmallHeap({.width = 60,
                               .height = 60,
                               .pixel_size = 3e-4,
                               .center_x = 30,
                               .baseline = 55,
                               .plate_diameter = 0.016});
  seen.rig.kind = rigs::RigKind::kDrum;
  seen.rig.drum = {.diameter = 0.016, .width = 0.006, .speed = 10, .start_turns = 0, .turns = 0.1};
  seen.rig.camera = {.frames = 3, .interval = 0.01};
  Simulate(seen, root / "seen");
  TalusEngine engine("talus");
  rigs::Case other = seen;
  other.frame->center_x = 31;
  EXPECT_FALSE(engine.TakeOver(other, root / "seen", root / "other"));
  ASSERT_TRUE(engine.TakeOver(seen, root / "seen", root / "taken"));
  for (const char* file : {"profile.png", "profile_sd.png"}) {
    EXPECT_EQ(base::ReadFile(root / "taken" / file), base::ReadFile(root / "seen" / file));
  }
  fs::remove_all(root);
}

}  // namespace talus_engine_test
}  // namespace talus::trials
