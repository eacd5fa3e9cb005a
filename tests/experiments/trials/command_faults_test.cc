// What another engine's command leaves and ought not to, and a trial that is run somewhere else.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <fstream>

#include "base/error.h"
#include "base/json/json_file.h"
#include "base/text/number_text.h"
#include "engine/run/state_file.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/engines/command_measure.h"
#include "experiments/trials/engines/command_result.h"
#include "experiments/trials/engines/command_scalars.h"
#include "experiments/trials/simulate/run_lock.h"
#include "tests/experiments/command_fixture.h"

namespace talus::trials {
namespace command_faults_test {

using ::testing::AllOf;
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

// All of the folder went, the user's input among it.
TEST_F(CommandFaultsTest, AnotherCaseInTheFolderReplacesWhatTalusHasWrittenAlone) {
  Deck("run.sh", "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  Run();
  std::ofstream(root_ / "trial/notes.txt") << "mine";
  fs::create_directories(root_ / "trial/photos");
  rigs::Case other = SmallCase();
  other.seed = 7;
  const auto simulate = [&](const fs::path& source) {
    SimulateCommandCase(
        {.heap = other, .engine = options_},
        {.folder = root_ / "trial", .fresh = true, .quiet = true, .source = source});
  };
  const std::string before = Text("trial/case.json");
  EXPECT_THAT(FailureOf([&] { simulate(root_ / "trial/case.json"); }),
              HasSubstr("lies in the folder of the run"));
  EXPECT_EQ(Text("trial/case.json"), before);
  options_.result = "heap.csv";  // so that heap.vtp is not a former result by its name
  const auto spheres = fs::last_write_time(root_ / "trial/heap.vtp");
  simulate(root_ / "new.json");
  EXPECT_NE(Text("trial/case.json"), before);
  EXPECT_NE(fs::last_write_time(root_ / "trial/heap.vtp"), spheres);
  EXPECT_EQ(Text("trial/notes.txt"), "mine");
  EXPECT_TRUE(fs::exists(root_ / "trial/photos"));
}

TEST_F(CommandFaultsTest, AFileIsNotReplacedByTheFolderOfARun) {
  Deck("run.sh", "true\n");
  std::ofstream(root_ / "trial") << "";
  EXPECT_THAT(FailureOf(), HasSubstr("is a file; name a folder with --out"));
  fs::remove(root_ / "trial");
  fs::create_symlink(root_ / "absent", root_ / "trial");
  EXPECT_THAT(FailureOf(), HasSubstr("is a link that leads nowhere"));
  EXPECT_TRUE(fs::is_symlink(root_ / "trial"));
}

// The second killed the first's command, and a campaign's too.
TEST_F(CommandFaultsTest, AFolderInWhichAnotherProcessSimulatesIsLeftToIt) {
  Deck("run.sh", "touch ../../begun; printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  const fs::path folder = root_ / "trials/0001";
  const auto simulate = [&] {
    SimulateCommandCase({.heap = SmallCase(), .engine = options_},
                        {.folder = folder, .quiet = true});
  };
  fs::create_directories(folder);
  {
    const RunLock lock(folder);
    EXPECT_THAT(FailureOf(simulate), HasSubstr("another process simulates there"));
  }
  std::ofstream(root_ / kCampaignLock) << "";
  {
    const int file = ::open((root_ / kCampaignLock).c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(::flock(file, LOCK_EX | LOCK_NB), 0);
    EXPECT_THAT(FailureOf(simulate), HasSubstr("another process works on the campaign"));
    ::close(file);
  }
  EXPECT_FALSE(fs::exists(root_ / "begun"));
  simulate();
  EXPECT_TRUE(fs::exists(root_ / "begun"));
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

// Status 127 of the shell ends a campaign, which one set with a broken branch in the deck must not.
TEST_F(CommandFaultsTest, OnlyACommandThatIsNotThereEndsWithThatStatus) {
  const auto status_of = [&](const std::string& command) {
    options_.command = {"sh", "run.sh"};
    Deck("run.sh", command);
    return FailureOf();
  };
  EXPECT_THAT(
      status_of("no_such_solver -in deck\n"),
      AllOf(HasSubstr("exit status 1; its log ends with: "), HasSubstr("status 127: something")));
  fs::remove_all(root_ / "trial");
  EXPECT_THAT(status_of("exit 5\n"), HasSubstr("exit status 5"));
}

// Sizes of one shape are another scale factor, but a deck may have taken the factor itself.
TEST_F(CommandFaultsTest, ATrialIsTakenOverOnlyWhereTheDeckHasTheSameValues) {
  const std::string result = "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n";
  const auto why_not = [&](const std::string& line) {
    fs::remove_all(root_ / "trial");
    Deck("run.sh", line + result);
    Run();
    rigs::Case finer = SmallCase();
    finer.powder.sizes.diameter = 0.5e-3;
    finer.coarse_graining.scale_factor = 2;
    return CommandEngine(options_).WhyNotTaken(finer, root_ / "trial").value_or("taken");
  };
  EXPECT_EQ(why_not("echo {{ mean_diameter }} {{ num_grains }}\n"), "taken");
  EXPECT_EQ(why_not("echo {{ scale_factor }}\n"), "{{ scale_factor }} was 1 there and is 2 here");
}

// As the engine left it: in another unit, turned, beside its plate.
TEST_F(CommandFaultsTest, AHeapThatTheEngineLeftAsVtpIsReadOntoOurPlate) {
  options_.result = "heap.vtp";
  options_.length_unit = 1e-3;
  options_.up = UpAxis::kY;
  options_.plate_center = {0, 0.01, 0};
  std::vector<engine::Particle> left(1);
  left[0].position = {0, 10.5, 0};
  left[0].radius = 0.5;
  std::string vtp = engine::VtpOf(left, 0);  // whose own name says that it is in metres
  vtp.replace(vtp.find("Name=\"diameter_m\""), 17, "Name=\"Diameter\"");
  std::ofstream(root_ / "left.vtp", std::ios::binary) << vtp;
  Deck("run.sh", "cp ../left.vtp heap.vtp\n");
  Run();
  const auto heap = HeapOfTrial(root_ / "trial");
  ASSERT_EQ(heap.size(), 1u);
  EXPECT_NEAR(heap[0].radius, 0.5e-3, 1e-9);
  EXPECT_NEAR(heap[0].position.z, 0.5e-3, 1e-9);
  options_.result = "heap.csv";  // beside which ours is as its image shows it
  fs::remove_all(root_ / "trial");
  Deck("run.sh", "printf 'x,y,z,r\\n0,10.5,0,0.5\\n' >heap.csv\n");
  Run();
  EXPECT_NEAR(HeapOfTrial(root_ / "trial").at(0).position.z, 0.5e-3, 1e-9);
}

// A code's own "no value" was taken for one.
TEST_F(CommandFaultsTest, ANumberThatCannotBeFailsTheTrial) {
  const auto fault_of = [&](const std::string& number) {
    std::ofstream(root_ / "scalars.json") << "{" << number << "}";
    return FailureOf([&] { ReadScalars(root_); });
  };
  EXPECT_THAT(fault_of(R"("angle_deg": -999)"),
              HasSubstr("\"angle_deg\" -999, which cannot be below -90; write null for no value"));
  EXPECT_THAT(fault_of(R"("angle_deg": 1e300)"), HasSubstr("which cannot be above 90"));
  EXPECT_THAT(fault_of(R"("packing_fraction": 1.01)"), HasSubstr("which cannot be above 1"));
  EXPECT_EQ(fault_of(R"("packing_fraction": 1, "angle_deg": 90)"), "");
  EXPECT_EQ(fault_of(R"("cohesion_pa": -1e9, "their own": 1e300)"), "");
}

// What follows from a parameter is as good as itself; nothing was asked of a powder's bulk.
TEST_F(CommandFaultsTest, ASearchedParameterReachesTheDeckByWhateverFollowsFromIt) {
  Deck("run.sh",
       "echo {{ powder_pair_sliding_friction }} {{ time_step }} {{ plate_restitution }}\n");
  EXPECT_EQ(CheckErrors({Searched("sliding_friction")}), "");
  EXPECT_THAT(CheckErrors({Searched("youngs_modulus")}), HasSubstr("{{ youngs_modulus }}"));
  EXPECT_THAT(CheckErrors({Searched("restitution")}), HasSubstr("{{ restitution }}, nor another"));
  SearchedParameter mass{.name = "mass", .low = SmallCase(), .high = SmallCase()};
  mass.high.powder.mass *= 2;
  SearchedParameter size{.name = "particle_size", .low = SmallCase(), .high = SmallCase()};
  size.high.powder.sizes.diameter = 2 * *size.low.powder.sizes.diameter;
  EXPECT_THAT(CheckErrors({mass}), HasSubstr("so that searching mass would change nothing"));
  EXPECT_THAT(CheckErrors({size}), HasSubstr("so that searching particle_size would change"));
  Deck("run.sh", "echo {{ num_grains }}\n");
  EXPECT_EQ(CheckErrors({mass, size}), "");
  Deck("run.sh", "{{# grains }}{{ x }}{{/ grains }}\n");
  EXPECT_EQ(CheckErrors({mass, size}), "");
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

// The end of the command alone counted: a mended program was never asked again.
TEST_F(CommandFaultsTest, ACommandWhoseResultWasRefusedIsRunAgain) {
  Deck("run.sh", "echo run >>../runs; sh ../program\n");
  std::ofstream(root_ / "program") << "touch heap.csv\n";
  EXPECT_THAT(FailureOf(), HasSubstr("heap.csv: is empty"));
  EXPECT_FALSE(CommandEngine(options_).IsComplete(root_ / "trial"));
  std::ofstream(root_ / "program") << "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n";
  EXPECT_EQ(FailureOf(), "");
  EXPECT_EQ(FailureOf(), "");
  EXPECT_EQ(Text("runs"), "run\nrun\n");
}

// Where a file of ours cannot be written, what the command has left may be good.
TEST_F(CommandFaultsTest, ACommandWhoseProfileCannotBeWrittenIsNotRunAgain) {
  Deck("run.sh",
       "echo run >>../runs; mkdir profile.png; printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  CommandEngine engine(options_);
  EXPECT_THAT(FailureOf(), HasSubstr("cannot be written"));
  EXPECT_TRUE(engine.IsComplete(root_ / "trial"));
  fs::remove(root_ / "trial/profile.png");
  EXPECT_EQ(FailureOf(), "");
  EXPECT_EQ(Text("runs"), "run\n");
}

// "./" before it switched off both what no result may be called and the check of the templates.
TEST_F(CommandFaultsTest, AResultIsTheSameByWhateverPath) {
  Deck("run.sh", "cp old.csv heap.csv\n");
  Deck("heap.csv", "x,y,z,r\n0,0,1e-3,1e-3\n");
  options_.result = "./heap.*";
  EXPECT_THAT(CheckErrors(), HasSubstr("fits \"./heap.*\", so that it would be taken"));
  fs::rename(root_ / "deck/heap.csv", root_ / "deck/old.csv");
  EXPECT_EQ(CheckErrors(), "");
  EXPECT_EQ(FailureOf(), "");
  options_.result = "./case.json";
  base::Problems problems("spec.json", {});
  options_.Validate(problems);
  EXPECT_THAT(problems.Text(), HasSubstr("fits case.json, which talus itself writes there"));
}

// Both were taken for the result, of which the last by name is the numbers.
TEST_F(CommandFaultsTest, TheFileOfTheNumbersIsNoResult) {
  Deck("run.sh",
       "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv; echo 'mass_fallen_kg,7e-6' >scalars.csv\n");
  options_.result = "*.csv";
  EXPECT_EQ(FailureOf(), "");
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("\"mass_fallen_kg\": 7e-06"));
}

// A campaign with numbers only writes such a case for each of its trials.
TEST_F(CommandFaultsTest, ALiftedTubeNeedsNoFrameForItsNumbers) {
  Deck("run.sh", "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  rigs::Case rig_case = SmallCase();
  rig_case.frame.reset();
  std::ofstream(root_ / "case.json") << CaseText({.heap = rig_case, .engine = options_});
  const CommandCase loaded = LoadCommandCase(base::ReadJsonFile(root_ / "case.json"));
  SimulateCommandCase(loaded, {.folder = root_ / "trial", .quiet = true});
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("\"height_m\": 0.002"));
}

// Only the list of them was, so that a damaged or a former part went unnoticed.
TEST_F(CommandFaultsTest, PartsOfAResultAreMeasuredWithIt) {
  const std::string part =
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><PointData><DataArray "
      "type=\"Float64\" Name=\"radius\" format=\"ascii\">1e-3</DataArray></PointData><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 1e-3</DataArray>"
      "</Points></Piece></PolyData></VTKFile>";
  Deck("part", part);
  Deck("list",
       "<VTKFile type=\"PPolyData\"><PPolyData><Piece "
       "Source=\"heap.0.vtp\"/></PPolyData></VTKFile>");
  options_.result = "heap.p*";
  const std::string run = "cp list heap.pvtp; cp part heap.0.vtp\n";
  Deck("run.sh", run + "touch -d 2001-01-01 heap.0.vtp\n");
  EXPECT_THAT(FailureOf(), HasSubstr("left heap.pvtp, whose part heap.0.vtp is older"));
  fs::remove_all(root_ / "trial");
  Deck("run.sh", run);
  EXPECT_EQ(FailureOf(), "");
  const fs::path folder = root_ / "trial";
  CommandEngine engine(options_);
  EXPECT_TRUE(engine.IsComplete(folder));
  std::ofstream(folder / "heap.0.vtp") << part << "\n";
  EXPECT_FALSE(engine.IsComplete(folder));
  options_.result = "heap.*";  // the list stays the result among its parts
  EXPECT_EQ(ResultOf(options_, folder).filename(), "heap.pvtp");
  RemoveResults(options_, folder);
  EXPECT_FALSE(fs::exists(folder / "heap.0.vtp"));
}

}  // namespace command_faults_test
}  // namespace talus::trials
