// What another engine's command leaves that nobody can have meant: it was measured without a word.
// Two files of which either may be meant are refused; the rest is doubted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/runners/exit_status.h"
#include "experiments/trials/engines/command_result.h"
#include "tests/experiments/command_fixture.h"

namespace talus::trials {
namespace command_doubts_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CommandDoubtsTest : public CommandFixture {
 protected:
  // What the deck's script is refused for; empty where it is taken.
  std::string RefusalOf(const std::string& script) {
    Deck("run.sh", script);
    fs::remove_all(root_ / "trial");
    return FailureOf();
  }
  // What is doubted of what it leaves; empty if nothing is.
  std::string DoubtOf(const std::string& script) {
    Deck("run.sh", script);
    fs::remove_all(root_ / "trial");
    Run();
    return CommandEngine(options_).Collect(SmallCase(), root_ / "trial").doubt;
  }
  std::string DoubtOfImage(const imaging::GrayImage& image) {
    imaging::WritePng(root_ / "deck/prepared.png", image);
    options_.result = "profile.png";
    return DoubtOf("cp prepared.png profile.png\n");
  }
};

constexpr const char* kGrain = "printf 'x,y,z,r\\n0,0,5e-4,5e-4\\n";

// A plate whose top lies below the origin: grains were cut off at it.
TEST_F(CommandDoubtsTest, GrainsInsideThePlate) {
  const std::string grain = kGrain;
  EXPECT_THAT(DoubtOf(grain + "' >heap.csv\n"), IsEmpty());
  EXPECT_THAT(DoubtOf(grain + "4e-4,0,-4e-4,5e-4\\n' >heap.csv\n"),
              AllOf(HasSubstr("1 sphere inside the plate, the lowest centre at z = -0.0004 m"),
                    HasSubstr("is engine.plate_center right")));
  // Beside the plate, whose radius is 5 mm, grains may hang from its rim.
  EXPECT_THAT(DoubtOf(grain + "5.2e-3,0,-1e-4,5e-4\\n4.9e-3,0,5e-4,5e-4\\n' >heap.csv\n"),
              IsEmpty());
}

TEST_F(CommandDoubtsTest, SeveralMomentsInOneTable) {
  EXPECT_THAT(DoubtOf(std::string(kGrain) + "0,1e-6,5e-4,5e-4\\n' >heap.csv\n"),
              AllOf(HasSubstr("1 grain of 2 inside another"), HasSubstr("several moments")));
}

// Each process of an MPI run writes its own file, and one was taken for the heap.
TEST_F(CommandDoubtsTest, PartsOfAMomentByProcess) {
  const std::string dump =
      "dump() { printf 'ITEM: TIMESTEP\\n%s\\nITEM: NUMBER OF ATOMS\\n1\\nITEM: BOX BOUNDS ff ff "
      "ff\\n-1 1\\n-1 1\\n-1 1\\nITEM: ATOMS id x y z radius\\n%s 0 0 5e-4 5e-4\\n' $1 $2 "
      ">heap.$3; }\n";
  EXPECT_THAT(RefusalOf(dump + "dump 10 1 10.dump; dump 20 1 20.dump\n"), IsEmpty());
  EXPECT_THAT(RefusalOf(dump + "dump 10 1 0.10.dump; dump 10 2 1.10.dump\n"),
              HasSubstr("left heap.0.10.dump and heap.1.10.dump, both of step 10"));
}

// 0.15 comes after 0.2 by whole numbers.
TEST_F(CommandDoubtsTest, TheLastByNameIsNotTheLast) {
  const std::string grain = kGrain;
  options_.result = "heap_*.csv";
  EXPECT_THAT(RefusalOf(grain + "' >heap_0.15.csv\n" + grain +
                        "' >heap_0.2.csv; touch -d '2 seconds' heap_0.2.csv\n"),
              HasSubstr("left heap_0.2.csv and heap_0.15.csv, the last by name but the older one"));
}

TEST_F(CommandDoubtsTest, WhatLiggghtsWritesBesideADumpIsNoResult) {
  Deck("run.sh", std::string(kGrain) + "' >heap_10.csv; echo box >heap_boundingBox_10.csv\n");
  options_.result = "heap_*.csv";
  Run();
  EXPECT_EQ(FindResult(options_, root_ / "trial", ".command.json").filename(), "heap_10.csv");
}

TEST_F(CommandDoubtsTest, NumbersBesideAResultInASubfolder) {
  options_.result = "post/heap.csv";
  EXPECT_THAT(RefusalOf("mkdir post; " + std::string(kGrain) +
                        "' >post/heap.csv; echo '{\"height_m\": 1e-3}' >post/scalars.json\n"),
              HasSubstr("left post/scalars.json, which is not read there"));
}

TEST_F(CommandDoubtsTest, SilhouettesOfNothingOrInverted) {
  imaging::GrayImage image{.width = 40, .height = 30, .pixels = {}};
  image.pixels.assign(1200, 255);
  EXPECT_THAT(DoubtOfImage(image), HasSubstr("shows no powder"));
  std::fill(image.pixels.begin(), image.pixels.begin() + 600, 0);
  EXPECT_THAT(DoubtOfImage(image), HasSubstr("has a dark sky; it must show the powder black"));
  std::reverse(image.pixels.begin(), image.pixels.end());
  EXPECT_THAT(DoubtOfImage(image), IsEmpty());
}

// Its banner is longer than what is quoted of a log.
TEST_F(CommandDoubtsTest, WhatOpenMpiSaysHidesNoError) {
  const std::string rule(74, '-');
  EXPECT_THAT(
      RefusalOf("cat <<'END'\nERROR: Unknown command: oops\n" + rule +
                "\nPrimary job  terminated normally, but 1 process returned\na non-zero exit "
                "code.\n" +
                rule + "\n" + rule +
                "\nmpirun detected that one or more processes exited with non-zero status\n\n"
                "  Process name: [[8963,1],1]\n  Exit code:    1\n" +
                rule + "\nEND\nexit 1\n"),
      HasSubstr("its log ends with: ERROR: Unknown command: oops"));
}

// A command that is killed from outside says nothing of its parameters, and is run again.
TEST_F(CommandDoubtsTest, ASignalThatEndsTheCommandIsTheTrials) {
  EXPECT_THAT(RefusalOf("kill -KILL $$\n"), HasSubstr("was ended by signal 9 (Killed)"));
  EXPECT_THAT(RefusalOf("kill -SEGV $$\n"), HasSubstr("was ended by signal 11"));
  EXPECT_THAT(RefusalOf("exit 255\n"), HasSubstr("exit status 255"));
  EXPECT_EQ(runners::SignalOf(137), 9);
  EXPECT_FALSE(runners::SignalOf(255).has_value());
  EXPECT_FALSE(runners::SignalOf(128).has_value());
}

}  // namespace command_doubts_test
}  // namespace talus::trials
