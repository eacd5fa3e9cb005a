// What another engine's command leaves and ought not to, and a trial that is run somewhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/json/json_file.h"
#include "base/text/number_text.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/engines/command_scalars.h"
#include "tests/experiments/command_fixture.h"

namespace talus::trials {
namespace command_faults_test {

using ::testing::HasSubstr;
using CommandFaultsTest = CommandFixture;

// Its case has the templates by the absolute path that they had.
TEST_F(CommandFaultsTest, ATrialIsSimulatedAgainWhereItWasMovedTogetherWithItsTemplates) {
  Deck("run.sh", "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  options_.templates_hash = TemplateFolder(*options_.templates).Hash();
  Run();
  const fs::path moved = root_ / "moved";
  fs::create_directories(moved / "run/trials");
  fs::rename(root_ / "trial", moved / "run/trials/0001");
  fs::rename(root_ / "deck", moved / "deck");
  const auto load = [&] {
    return LoadCommandCase(base::ReadJsonFile(moved / "run/trials/0001/case.json"));
  };
  EXPECT_EQ(load().engine.templates, moved / "deck");
  std::ofstream(moved / "deck/run.sh") << "true\n";  // another deck is not taken for it
  EXPECT_THROW(load(), base::ConfigError);
}

// `mkdir post` failed at the second attempt, and the trial was recorded as failed.
TEST_F(CommandFaultsTest, WhatAnInterruptedAttemptHasLeftIsGoneAtTheNext) {
  Deck("run.sh", "mkdir post; touch heap.csv\n");
  const fs::path folder = root_ / "trial";
  CommandEngine engine(options_);
  engine.Prepare(SmallCase(), folder);
  fs::create_directories(folder / "post");
  for (const char* name : {"post/0.dump", "log.lammps", "trial.json", ".process_group"}) {
    std::ofstream(folder / name) << "x";
  }
  engine.Prepare(SmallCase(), folder);
  for (const char* name : {"case.json", "trial.json", ".process_group", "run.sh"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  for (const char* name : {"post", "log.lammps"}) EXPECT_FALSE(fs::exists(folder / name)) << name;
}

// Such a trial succeeded, and its parameters were taken for those of the spec's powder.
TEST_F(CommandFaultsTest, GrainsThatAreNotTheSpecsAreSaidAndAUnitSlipFails) {
  const auto output_of = [&](double radius, int count) {
    std::string text = "x,y,z,r\n";
    for (int i = 0; i < count; ++i) {
      text +=
          "0,0," + base::ExactNumber(radius + 1e-3 * i) + "," + base::ExactNumber(radius) + "\n";
    }
    fs::remove_all(root_ / "trial");
    Deck("run.sh", "printf '" + text + "' >heap.csv\n");
    Run();
    return CommandEngine(options_).Collect(SmallCase(), root_ / "trial").doubt;
  };
  EXPECT_EQ(output_of(0.5e-3, 76), "");
  EXPECT_EQ(output_of(0.5e-3, 20), "");  // the others have left the box
  EXPECT_THAT(output_of(1e-3, 3), HasSubstr("2 times as large; does the deck take {{ mean"));
  EXPECT_THAT(output_of(0.5e-3, 100), HasSubstr("does the deck take {{ num_grains }}"));
  EXPECT_THAT(FailureOf([&] { output_of(0.5e-4, 3); }),
              HasSubstr("1/10 of that; is engine.length_unit right"));
}

// The first won, whatever the second said.
TEST_F(CommandFaultsTest, NumbersInTwoFilesAreRefused) {
  std::ofstream(root_ / "scalars.json") << R"({"runout_m": 0.25})";
  EXPECT_EQ(ReadScalars(root_).size(), 1u);
  std::ofstream(root_ / "scalars.csv") << "runout_m,0.5\n";
  EXPECT_THAT(FailureOf([&] { ReadScalars(root_); }), HasSubstr("left both"));
}

TEST_F(CommandFaultsTest, OfNumbersOnlyTheirFilesAreNamedWhereTheyAreMissing) {
  Deck("run.sh", "echo finished\n");
  rigs::Case rig_case = SmallCase();
  rig_case.rig.kind = rigs::RigKind::kTappedDensity;
  rig_case.frame.reset();
  const std::string failure = FailureOf([&] { Run(rig_case); });
  EXPECT_THAT(failure, HasSubstr("left neither scalars.json nor scalars.csv"));
  EXPECT_THAT(failure, HasSubstr("its log ends with: finished"));
}

}  // namespace command_faults_test
}  // namespace talus::trials
