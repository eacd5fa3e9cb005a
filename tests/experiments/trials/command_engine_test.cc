#include "experiments/trials/engines/command_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/runners/local_runner.h"
#include "experiments/trials/engines/command_result.h"
#include "experiments/trials/engines/command_scalars.h"
#include "experiments/trials/simulate/simulate_command.h"
#include "imaging/formats/images/image_file.h"
#include "tests/experiments/command_fixture.h"

namespace talus::trials {
namespace command_engine_test {

using ::testing::HasSubstr;

class CommandEngineTest : public CommandFixture {};

TEST_F(CommandEngineTest, TrialIsFilledRunAndMeasured) {
  Deck("run.sh", "echo 'x,y,z,r' >heap.csv; echo '0,0,{{ scale_factor }}e-3,1e-3' >>heap.csv\n");
  const TrialOutput output = Run();
  // A disc of 1 mm radius over pixels of 0.5 mm, its lowest point on the plate: rows 21 to 24 and
  // columns 18 to 21 about the centre, without their corners' farthest pixels or not, but white
  // above and beside.
  EXPECT_EQ(output.profile.at(20, 23), 0);
  EXPECT_EQ(output.profile.at(20, 19), 255);
  EXPECT_EQ(output.profile.at(24, 23), 255);
  EXPECT_TRUE(fs::exists(root_ / "trial/heap.vtp"));
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("\"status\": \"ok\""));
  EXPECT_THAT(Text("trial/case.json"), HasSubstr("\"command\""));
}

// Also of one that has ended before this process began: its folder says so.
TEST_F(CommandEngineTest, ProcessorTimeOfTheCommandIsKnown) {
  Deck("run.sh",
       "i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done\n"
       "echo 'x,y,z,r' >heap.csv; echo '0,0,1e-3,1e-3' >>heap.csv\n");
  Run();
  CommandEngine engine(options_);
  const TrialOutput output = engine.Collect(SmallCase(), root_ / "trial");
  EXPECT_GT(output.cpu_time, 0.01);  // no shell counts 2e7 a second
  EXPECT_LT(output.cpu_time, 60);
}

// The heap is what our own tube would leave: a cone of small spheres, 45° steep, whose silhouette
// is a triangle.
TEST_F(CommandEngineTest, AngleAndHeightOfAHeapFollowFromItsSpheres) {
  Deck("run.sh", R"sh(awk 'BEGIN { print "x,y,z,r"; s = 2.5e-4
    for (i = -20; i <= 20; ++i) for (j = -20; j <= 20; ++j) for (k = 0; k < 20; ++k)
      if (sqrt(i * i + j * j) + k <= 19) print i * s "," j * s "," (k + 0.5) * s "," s / 2 }' >heap.csv
)sh");
  rigs::Case heap = SmallCase();
  heap.powder.sizes.diameter = 2.5e-4;
  heap.frame.reset();
  SimulateCommandCase({.heap = heap, .engine = options_},
                      {.folder = root_ / "trial", .quiet = true});
  const auto numbers = nlohmann::json::parse(Text("trial/result.json"))["observables"];
  EXPECT_NEAR(numbers["angle_of_repose_triangle_deg"], 45, 2);  // a grain of twenty on either side
  EXPECT_NEAR(numbers["height_m"], 5e-3, 1e-9);
  EXPECT_TRUE(numbers.contains("angle_of_repose_1_deg"));
}

// The folder's own case tells which templates its result is of.
TEST_F(CommandEngineTest, ARunOfOtherTemplatesIsNotTakenForThisOne) {
  Deck("run.sh", "echo '{\"angle_deg\": 25}' >scalars.json");
  std::ofstream(root_ / "case.json") << R"({"powder": {"material": {"density": 2500},
    "sizes": {"kind": "mono", "diameter": "1 mm"}},
    "rig": {"kind": "drum", "diameter": "20 mm", "width": "10 mm", "speed": "2 rad/s", "fill": 0.3},
    "engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"]}})";
  const auto simulate = [&](bool fresh) {
    const CommandCase own = LoadCommandCase(base::ReadJsonFile(root_ / "case.json"));
    EXPECT_GT(own.heap.powder.mass, 0);  // by the drum's fill
    SimulateCommandCase(own, {.folder = root_ / "trial", .fresh = fresh, .quiet = true});
  };
  simulate(false);
  simulate(false);
  Deck("run.sh", "echo '{\"angle_deg\": 30}' >scalars.json");
  EXPECT_THAT(FailureOf([&] { simulate(false); }), HasSubstr("templates that have changed since"));
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("25"));
  simulate(true);
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("30"));
  // Who draws or exports the run needs no templates.
  fs::remove_all(root_ / "deck");
  EXPECT_EQ(LoadAnyCase(root_ / "trial/case.json").rig.kind, rigs::RigKind::kDrum);
}

TEST_F(CommandEngineTest, ACohesionMayBeBelowZeroAndNotANumberIsSaid) {
  std::ofstream(root_ / "scalars.json") << R"({"cohesion_pa": -20})";
  EXPECT_EQ(ReadScalars(root_).front().value, -20);
  std::ofstream(root_ / "scalars.json") << R"({"mass_fallen_kg": -20})";
  EXPECT_THAT(FailureOf([&] { ReadScalars(root_); }), HasSubstr("cannot be negative"));
  std::ofstream(root_ / "scalars.json") << R"({"cohesion_pa": NaN})";
  EXPECT_THAT(FailureOf([&] { ReadScalars(root_); }), HasSubstr("write null for no value"));
}

// Any rig will do: its keys are placeholders, its numbers stand in a file.
TEST_F(CommandEngineTest, NumbersOfAnyRigAreReadFromJsonOrCsv) {
  rigs::Case drum = SmallCase();
  drum.rig.kind = rigs::RigKind::kDrum;
  drum.rig.drum = {.diameter = 0.02, .width = 0.01, .speed = 2, .fill = 0.3};
  drum.frame.reset();
  const auto scalars_of = [&] {
    CommandEngine engine(options_);
    fs::remove_all(root_ / "trial");
    SimulateCommandCase({.heap = drum, .engine = options_},
                        {.folder = root_ / "trial", .quiet = true});
    return engine.Collect(drum, root_ / "trial").scalars;
  };
  drum.SetMassByFill();
  Deck("run.sh", R"(echo '{"angle_deg": {{ rig_speed }}5, "angle_sd_deg": null}' >scalars.json
    echo {{ rig_fill }} >../fill)");
  const auto json = scalars_of();
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0].value, 25);
  EXPECT_NEAR(std::stod(Text("fill")), 0.3, 1e-12);
  EXPECT_EQ(json[0].unit, "deg");
  EXPECT_THAT(json[1].undefined, HasSubstr("gives no value"));
  Deck("run.sh", "printf 'name,value\\nangle_deg, 31.5\\nnum_avalanches,4\\n' >scalars.csv");
  const auto csv = scalars_of();
  ASSERT_EQ(csv.size(), 2u);
  EXPECT_EQ(csv[0].value, 31.5);
  EXPECT_EQ(csv[1].unit, "-");
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("\"angle_deg\": 31.5"));
  Deck("run.sh", "echo 'angle_deg;3' >scalars.csv");
  EXPECT_THROW(scalars_of(), base::Error);
  Deck("run.sh", "true");  // neither numbers nor a result
  EXPECT_THROW(scalars_of(), base::Error);
  Deck("run.sh", "echo 'discharge_time_s,-3' >scalars.csv");
  EXPECT_THAT(FailureOf(scalars_of),
              HasSubstr("\"discharge_time_s\" -3, which cannot be negative"));
  Deck("run.sh", "echo 'angle_deg,-3' >scalars.csv");
  EXPECT_EQ(scalars_of().at(0).value, -3);
}

// The last value of a doubled name counted, and a mark before the first name made another of it.
TEST(CommandScalars, EachNameStandsOnce) {
  const auto marked = ParseCsvScalars(
      "\xef\xbb\xbf"
      "angle_deg,31.5\n\"runout_m\",\"0.03\"\n");
  ASSERT_EQ(marked.size(), 2u);
  EXPECT_EQ(marked[0].name, "angle_deg");
  EXPECT_EQ(marked[1].value, 0.03);
  EXPECT_THROW(ParseCsvScalars("angle_deg,31.5\nangle_deg,32\n"), base::Error);
  EXPECT_THROW(ParseCsvScalars("\"angle_deg,31.5\n"), base::Error);
  EXPECT_THROW(ParseJsonScalars(R"({"angle_deg": 31.5, "angle_deg": 32})"), base::Error);
  EXPECT_EQ(ParseJsonScalars(R"({"angle_deg": 31.5, "runout_m": null})").size(), 2u);
}

TEST_F(CommandEngineTest, ANumberThatTheCommandGivesCounts) {
  Deck("run.sh",
       "echo 'x,y,z,r' >heap.csv; echo '0,0,1e-3,1e-3' >>heap.csv;"
       "echo 'mass_fallen_kg,7e-6' >scalars.csv");
  Run();
  const TrialOutput output = CommandEngine(options_).Collect(SmallCase(), root_ / "trial");
  EXPECT_EQ(output.scalars.at(0).name, "mass_on_plate_kg");
  std::vector<double> fallen;
  for (const journal::MetricRecord& scalar : output.scalars) {
    if (scalar.name == "mass_fallen_kg") fallen.push_back(scalar.value);
  }
  EXPECT_EQ(fallen, std::vector{7e-6});
}

TEST_F(CommandEngineTest, OwnImageIsTakenAsTheProfile) {
  Deck("run.sh", "cp prepared.png profile.png\n");
  imaging::GrayImage image{.width = 40, .height = 30, .pixels = {}};
  image.pixels.assign(1200, 255);
  std::fill(image.pixels.begin() + 600, image.pixels.end(), 77);
  imaging::WritePng(root_ / "deck/prepared.png", image);
  options_.result = "profile.png";
  EXPECT_EQ(Run().profile, image);
  fs::remove_all(root_ / "trial");
  image.width = 30;
  image.height = 40;
  imaging::WritePng(root_ / "deck/prepared.png", image);
  EXPECT_THAT(FailureOf(), HasSubstr("of 30 x 40 px; the experiment's is 40 x 30"));
}

TEST_F(CommandEngineTest, FailuresOfTheCommandCarryTheEndOfItsLog) {
  Deck("run.sh", "echo 'ERROR: lost atoms'; exit 5\n");
  EXPECT_THAT(FailureOf(), HasSubstr("exit status 5; its log ends with: ERROR: lost atoms"));
  EXPECT_THAT(Text("trial/result.json"), HasSubstr("\"status\": \"failed\""));
  fs::remove_all(root_ / "trial");
  Deck("run.sh", "echo finished\n");
  EXPECT_THAT(FailureOf(), HasSubstr("left no file \"heap.*\"; its log ends with: finished"));
  fs::remove_all(root_ / "trial");
  Deck("run.sh", "echo 'x,y,z,r' >heap.csv; echo '1,2,oops,1' >>heap.csv\n");
  EXPECT_THAT(FailureOf(), HasSubstr("heap.csv: sphere 1 has a position"));
  fs::remove_all(root_ / "trial");
  Deck("run.sh", "echo 'x,y,z,r' >heap.csv; echo '1,2,3,1e-3' >>heap.csv\n");  // in millimetres
  EXPECT_THAT(FailureOf(), HasSubstr("left nothing on the plate, of 1 spheres in heap.csv; are "
                                     "length_unit, up and plate_center right?"));
  fs::remove_all(root_ / "trial");
  Deck("run.sh", "echo 'x,y,z,r' >heap.csv; echo '0,0,1,1' >>heap.csv\n");  // and on the axis
  EXPECT_THAT(FailureOf(), HasSubstr("with a sphere of 2 m, which is wider than the plate of"));
}

TEST_F(CommandEngineTest, MistakesAreFoundBeforeAnythingRuns) {
  Deck("run.sh", "{{ sliding_friction }} {{ sliding_frction }}\n");
  Deck("other", "\n{{# grain }}{{/ grain }}\n");
  options_.command = {"talus-no-such-program", "{{ sed }}"};
  const std::string errors =
      CheckErrors({Searched("sliding_friction"), Searched("rolling_friction")});
  EXPECT_THAT(errors, HasSubstr("run.sh:1: the placeholder \"sliding_frction\" is not known; did "
                                "you mean \"sliding_friction\"?"));
  EXPECT_THAT(errors, HasSubstr("other:2: the placeholder \"grain\" is not known; did you mean "
                                "\"grains\"?"));
  EXPECT_THAT(errors, HasSubstr("\"sed\" is not known"));
  EXPECT_THAT(errors, HasSubstr("no file has the placeholder {{ rolling_friction }}"));
  EXPECT_THAT(errors, Not(HasSubstr("placeholder {{ sliding_friction }}")));
  EXPECT_THAT(errors, HasSubstr("\"talus-no-such-program\" is not found"));
  EXPECT_FALSE(fs::exists(root_ / "trial"));
  options_.templates = root_ / "absent";
  EXPECT_THAT(CheckErrors(), HasSubstr("absent: is no folder; name that of"));
  options_.templates = root_ / "deck";
  Deck("case.json", "{}");
  EXPECT_THAT(CheckErrors(), HasSubstr("may not have the name of a trial's own file"));
}

// An old result among the templates was copied into every trial and taken for its own.
TEST_F(CommandEngineTest, OldResultsAreNoResults) {
  Deck("run.sh", "true\n");
  Deck("heap.csv", "x,y,z,r\n0,0,1e-3,1e-3\n");
  EXPECT_THAT(CheckErrors(), HasSubstr("heap.csv: fits \"heap.*\", so that it would be taken"));
  fs::rename(root_ / "deck/heap.csv", root_ / "deck/old.csv");
  for (const char* name : {"scalars.csv", "scalars.json"}) {
    Deck(name, "");
    EXPECT_THAT(CheckErrors(), HasSubstr("would be taken for every trial's numbers")) << name;
    fs::remove(root_ / "deck" / name);
  }
  Deck("run.sh", "cp -p old.csv heap.csv; touch -d 2001-01-01 heap.csv\n");
  EXPECT_EQ(CheckErrors(), "");
  EXPECT_THAT(FailureOf(), HasSubstr("left no file \"heap.*\" that is not older than the trial"));
}

// By the clock of the trial's start, which has gone back meanwhile, or is that of another machine.
TEST_F(CommandEngineTest, AResultThatAClockDatesBeforeTheTrialIsItsResult) {
  Deck("run.sh", "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  Run();
  const fs::path folder = root_ / "trial";
  for (const char* ours : {"result.json", "profile.png"}) fs::remove(folder / ours);
  fs::last_write_time(folder / ".command.json",
                      fs::last_write_time(folder / "heap.csv") + std::chrono::minutes(10));
  EXPECT_EQ(FindResult(options_, folder, ".command.json").filename(), "heap.csv");
}

// Through a link to a folder that all trials share: the command of the next one may have failed
// silently, and leaves that of the trial before.
TEST_F(CommandEngineTest, AResultElsewhereOfBeforeTheTrialIsNone) {
  fs::create_directories(root_ / "shared");
  Deck("run.sh", "ln -sfn ../shared post\n");
  base::WriteFileAtomically(root_ / "shared/heap.csv", "x,y,z,r\n0,0,1e-3,1e-3\n",
                            base::Outlives::kProgram);
  fs::last_write_time(root_ / "shared/heap.csv",
                      fs::file_time_type::clock::now() - std::chrono::seconds(2));
  options_.result = "post/heap.csv";
  EXPECT_THAT(FailureOf(), HasSubstr("that is not older than the trial"));
}

// What another program leaves has no checksum: a bit turned over in it was another answer, where
// the journal was made anew from the trials' folders.
TEST_F(CommandEngineTest, ATrialWhoseFilesHaveChangedSinceTheyWereMeasuredIsRunAgain) {
  Deck("run.sh",
       "echo 'x,y,z,r' >heap.csv; echo '0,0,1e-3,1e-3' >>heap.csv\n"
       "echo '{\"runout_m\": 0.25}' >scalars.json\n");
  CommandEngine engine(options_);
  const fs::path folder = root_ / "trial";
  for (const char* name : {"heap.csv", "scalars.json", "result.json"}) {
    Run();
    EXPECT_TRUE(engine.IsComplete(folder)) << name;
    const std::string whole = Text(std::string("trial/") + name);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ 2);
      base::WriteFileAtomically(folder / name, damaged, base::Outlives::kProgram);
      if (name != std::string("result.json")) {
        EXPECT_FALSE(engine.IsComplete(folder)) << name << " byte " << i;
      } else if (engine.IsComplete(folder)) {  // a flip in the key leaves what it is the sum of
        EXPECT_THAT(damaged, HasSubstr(whole.substr(0, whole.rfind(",\n")))) << "byte " << i;
      }
    }
    fs::remove(folder / name);
    EXPECT_EQ(engine.IsComplete(folder), name == std::string("result.json"));
    base::WriteFileAtomically(folder / name, "of another program\n", base::Outlives::kProgram);
    Run();
    EXPECT_EQ(Text(std::string("trial/") + name), whole);
  }
}

// A copied folder's files have the times of the copy, in any order.
TEST_F(CommandEngineTest, WhatWasMeasuredStaysTheResultWhateverTheTimesOfACopy) {
  Deck("run.sh", "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  CommandEngine engine(options_);
  const fs::path folder = root_ / "trial";
  Run();
  const TrialOutput before = engine.Collect(SmallCase(), folder);
  fs::last_write_time(folder / ".command.json",
                      fs::last_write_time(folder / "heap.csv") + std::chrono::seconds(5));
  EXPECT_EQ(engine.Collect(SmallCase(), folder).profile.pixels, before.profile.pixels);
}

TEST_F(CommandEngineTest, TemplatesArePlainFiles) {
  Deck("run.sh", "true\n");
  for (const char* name : {"pipe", "dangling", "folder"}) {
    const fs::path path = root_ / "deck" / name;
    if (name == std::string("pipe")) {
      ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    } else {
      fs::create_symlink(name == std::string("folder") ? root_ : root_ / "absent", path);
    }
    EXPECT_THAT(CheckErrors(), HasSubstr("a template is a plain file")) << name;
    fs::remove(path);
  }
  EXPECT_EQ(CheckErrors(), "");
  for (const char* own : {".command_done", "trial.json", "profile.png"}) {
    Deck(own, "");
    EXPECT_THAT(CheckErrors(), HasSubstr("may not have the name of a trial's own file")) << own;
    fs::remove(root_ / "deck" / own);
  }
}

TEST_F(CommandEngineTest, ProgramMayBeATemplateItself) {
  Deck("run", "#!/bin/sh\nprintf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  options_.command = {"./run"};
  EXPECT_THAT(CheckErrors(), HasSubstr("not executable"));
  fs::permissions(root_ / "deck/run", fs::perms::owner_all);
  EXPECT_EQ(CheckErrors(), "");
  Run();
}

TEST_F(CommandEngineTest, ChangedTemplatesAreRefused) {
  Deck("run.sh", "true\n");
  options_.templates_hash = TemplateFolder(*options_.templates).Hash();
  EXPECT_NO_THROW(CommandEngine{options_});
  Deck("run.sh", "false\n");
  EXPECT_THROW(CommandEngine{options_}, base::ConfigError);
}

TEST_F(CommandEngineTest, LastResultInNaturalOrderCounts) {
  Deck("run.sh",
       "mkdir post; for i in 8 9 10; do printf 'x,y,z,r\\n0,0,%se-4,1e-3\\n' $i >post/heap_$i.csv; "
       "done\n");
  options_.result = "post/heap_*.csv";
  Run();
  EXPECT_EQ(FindResult(options_, root_ / "trial", ".command.json").filename(), "heap_10.csv");
  EXPECT_TRUE(NaturalLess("heap_009", "heap_10"));
  EXPECT_FALSE(NaturalLess("heap_10", "heap_9"));
  EXPECT_TRUE(NaturalLess("heap", "heap1"));
}

// LIGGGHTS makes no folder for its dumps, and fails.
TEST_F(CommandEngineTest, EmptyFoldersOfTheTemplatesAreCopied) {
  fs::create_directories(root_ / "deck/post/restart");
  Deck("run.sh", "printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >post/restart/heap.csv\n");
  options_.result = "post/restart/heap.csv";
  Run();
}

TEST_F(CommandEngineTest, ResultIsTurnedAndMovedOntoThePlate) {
  options_.up = UpAxis::kY;
  options_.plate_center = {1, 2, 3};
  const auto spheres = OnOurPlate(options_, {{.position = {1, 2.5, 3.25}, .radius = 1}});
  EXPECT_EQ(spheres[0].position, (base::Vec3{0.25, 0, 0.5}));
}

// What was begun is not mistaken for what was finished: only the mark says so.
TEST_F(CommandEngineTest, CompleteTrialIsNotRunAgain) {
  Deck("run.sh", "echo run >>../runs; printf 'x,y,z,r\\n0,0,1e-3,1e-3\\n' >heap.csv\n");
  Run();
  Run();
  EXPECT_EQ(Text("runs"), "run\n");
  fs::remove(root_ / "trial/.command_done");
  Run();
  EXPECT_EQ(Text("runs"), "run\nrun\n");
}

TEST_F(CommandEngineTest, FolderWithOtherFilesIsLeftAlone) {
  Deck("run.sh", "true\n");
  fs::create_directories(root_ / "trial");
  std::ofstream(root_ / "trial/thesis.tex") << "x";
  EXPECT_THAT(FailureOf(), HasSubstr("holds other files"));
  EXPECT_TRUE(fs::exists(root_ / "trial/thesis.tex"));
}

// A result that was older than its command, by the order in which a folder was copied, was lost.
TEST_F(CommandEngineTest, ACopiedTrialKeepsTheTimesOfItsFiles) {
  const std::filesystem::path from = root_ / "from";
  std::filesystem::create_directories(from / "inner");
  std::ofstream(from / "inner" / "heap.csv") << "x";
  const auto written =
      std::filesystem::last_write_time(from / "inner" / "heap.csv") - std::chrono::hours(1);
  std::filesystem::last_write_time(from / "inner" / "heap.csv", written);
  CopyFolder(from, root_ / "to");
  EXPECT_EQ(std::filesystem::last_write_time(root_ / "to" / "inner" / "heap.csv"), written);
}

// A deck that mixes the pair itself simulates another case than the one that is asked for.
TEST_F(CommandEngineTest, StatedPairWithoutItsPlaceholderIsRefused) {
  Deck("run.sh", "echo {{ plate_sliding_friction }}\n");
  rigs::Case rig_case = SmallCase();
  rigs::PairWith(rig_case.pairs, rigs::kFloor).sliding_friction = 0.25;
  base::Problems problems;
  CheckCommand(options_, {.rig_case = rig_case, .searched = {}, .elsewhere = true}, problems);
  EXPECT_THAT(problems.Text(), HasSubstr("{{ plate_pair_sliding_friction }}"));
}

}  // namespace command_engine_test
}  // namespace talus::trials
