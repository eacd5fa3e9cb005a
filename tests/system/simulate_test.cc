// Runs `talus simulate` as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/files/file.h"

namespace talus {
namespace simulate_test {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A hundred-odd grains: the cap ends it, not the rest.
constexpr const char* kCase = R"({
  "powder": {
    "material": {"density": 2500, "youngs_modulus": "1 MPa", "sliding_friction": 0.5,
                 "rolling_friction": 0.2, "restitution": 0.5},
    "sizes": {"kind": "uniform", "min": "0.9 mm", "max": "1.1 mm"}, "mass": "0.2 g"},
  "device": {"lift_velocity": "5 cm/s"}, "outputs": {"times": ["10 ms", "60 ms"], "csv": true},
  "rules": {"heap": {"max_time": 0.6, "energy_fraction": 1e-200}},
  "frame": {"width_px": 120, "height_px": 60, "pixel_size": "0.1 mm", "center_x_px": 60,
            "baseline_px": 55, "plate_diameter": "10 mm"},
  "checkpoint_interval": 0.02
})";

// Ten times as long after the lifting, a hundred and fifty checkpoints: on a busy machine the shell
// that ends it is many times slower than a shell with a core of its own.
std::string LongCase() {
  std::string text = kCase;
  const std::string cap = "\"max_time\": 0.6";
  return text.replace(text.find(cap), cap.size(), "\"max_time\": 6");
}

class Simulate : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("simulate_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return name;
  }

  // Exit status of a command in the test's folder; what it prints is in output_.
  int Run(const std::string& command) {
    const std::string all = "cd " + folder_.string() + " && { " + command + "; } > output.txt 2>&1";
    const int status = std::system(all.c_str());
    output_ = base::ReadFile(folder_ / "output.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int Talus(const std::string& arguments) {
    return Run(TALUS_BINARY_DIR "/talus simulate " + arguments);
  }

  // The status of a run that gets SIGINT in the middle of its lifting.
  int Interrupted(const std::string& out, const std::string& options = "") {
    return Run(TALUS_BINARY_DIR "/talus simulate case.json --out " + out + options +
               " & pid=$!; until grep -q settling " + out +
               "/log.txt; do sleep 0.01; done; kill -INT $pid; wait $pid");
  }

  // The status of a run that is killed as soon as it has written a checkpoint: 137, or 0 when it
  // came to its end before.
  int Killed(const std::string& out) {
    const std::string checkpoint = out + "/checkpoint.bin";
    return Run(
        "touch started; " TALUS_BINARY_DIR "/talus simulate case.json --out " + out +
        " & pid=$!; until [ " + checkpoint +
        " -nt started ] || ! kill -0 $pid; do sleep 0.002; done; kill -KILL $pid; wait $pid");
  }

  std::string Read(const std::string& name) { return base::ReadFile(folder_ / name); }
  nlohmann::json Result(const std::string& out) {
    return nlohmann::json::parse(Read(out + "/result.json"));
  }
  void ExpectSameHeap(const std::string& a, const std::string& b) {
    for (const char* name :
         {"/heap.vtp", "/heap.csv", "/profile.png", "/state_0000.vtp", "/state_0001.vtp"}) {
      EXPECT_EQ(Read(a + name), Read(b + name)) << name;
    }
    EXPECT_EQ(Result(a)["phases"], Result(b)["phases"]);
    EXPECT_EQ(Result(a)["counts"], Result(b)["counts"]);
  }

  fs::path folder_;
  std::string output_;
};

TEST_F(Simulate, ACaseLeavesItsTrialFolder) {
  Write("case.json", kCase);
  ASSERT_EQ(Talus("case.json --out trial"), 0) << output_;
  const auto result = Result("trial");
  EXPECT_EQ(result["status"], "ok");
  const auto& counts = result["counts"];
  EXPECT_GT(counts["on_heap"], 20);
  EXPECT_EQ(counts["filled"].get<int>(),
            counts["on_heap"].get<int>() + counts["fallen"].get<int>() +
                counts["carried_by_tube"].get<int>() + counts["in_flight"].get<int>());
  std::vector<std::string> phases;
  for (const auto& phase : result["phases"]) {
    phases.push_back(phase["name"]);
    EXPECT_TRUE(phase["reason"].is_string()) << phase;
  }
  EXPECT_THAT(phases, ElementsAre("filling", "settling", "lifting", "coming to rest"));
  EXPECT_EQ(result["conditions"]["lift_velocity_m_per_s"], 0.05);
  EXPECT_TRUE(fs::exists(folder_ / "trial/profile.png"));
  EXPECT_FALSE(fs::exists(folder_ / "trial/checkpoint.bin"));
  EXPECT_THAT(Read("trial/log.txt"), HasSubstr("lifting ended at"));

  EXPECT_EQ(Talus("case.json --out trial"), 0);
  EXPECT_THAT(output_, HasSubstr("is done already"));
  // The complete case in the folder gives the same heap elsewhere, with other threads too.
  ASSERT_EQ(Run("cp trial/case.json complete.json && sed -i 's/\"threads\": 1/\"threads\": 2/' "
                "complete.json"),
            0);
  ASSERT_EQ(Talus("complete.json --out again --quiet"), 0) << output_;
  EXPECT_EQ(output_, "");
  ExpectSameHeap("trial", "again");
}

TEST_F(Simulate, ARunThatIsKilledAgainAndAgainEndsWithTheSameBits) {
  Write("case.json", LongCase());
  ASSERT_EQ(Talus("case.json --out whole"), 0) << output_;
  // A shell that gets no core for a while kills late, so a later life may come to its end first.
  ASSERT_EQ(Killed("killed"), 137) << output_;
  for (int life = 1; life < 3; ++life) EXPECT_THAT(Killed("killed"), AnyOf(137, 0)) << output_;
  ASSERT_EQ(Talus("case.json --out killed"), 0) << output_;
  EXPECT_THAT(Read("killed/log.txt"), HasSubstr("goes on from killed/checkpoint.bin"));
  ExpectSameHeap("whole", "killed");
}

TEST_F(Simulate, CtrlCSavesACheckpointAndEndsWith130) {
  Write("case.json", LongCase());
  ASSERT_EQ(Talus("case.json --out whole"), 0) << output_;
  EXPECT_EQ(Interrupted("stopped"), 130) << output_;
  EXPECT_THAT(output_, HasSubstr("the same command goes on from"));
  EXPECT_FALSE(fs::exists(folder_ / "stopped/result.json"));
  ASSERT_EQ(Talus("case.json --out stopped"), 0) << output_;
  ExpectSameHeap("whole", "stopped");
}

// Nothing of an earlier input stands beside a result.
TEST_F(Simulate, WhatAnEarlierInputHasLeftGoesWhenARunBeginsAnew) {
  Write("case.json", kCase);
  ASSERT_EQ(Talus("case.json --out out --quiet"), 0) << output_;
  std::ofstream(folder_ / "out/notes.txt") << "mine";
  std::ofstream(folder_ / "out/checkpoint.bin.tmp123") << "half";
  std::string other = kCase;
  const std::string outputs = R"("times": ["10 ms", "60 ms"], "csv": true)";
  other.replace(other.find(outputs), outputs.size(), R"("vtp": true)");
  Write("other.json", other);
  EXPECT_EQ(Talus("other.json --out out --quiet"), 2);
  EXPECT_THAT(output_, HasSubstr("of another input"));
  EXPECT_TRUE(fs::exists(folder_ / "out/heap.csv"));
  ASSERT_EQ(Talus("other.json --out out --fresh --quiet"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "out/heap.vtp"));
  EXPECT_TRUE(fs::exists(folder_ / "out/notes.txt"));
  for (const char* gone : {"heap.csv", "state_0000.vtp", "checkpoint.bin.tmp123"}) {
    EXPECT_FALSE(fs::exists(folder_ / "out" / gone)) << gone;
  }
}

// A campaign, a design or a prediction would have taken it for a failure of the parameters for
// ever.
TEST_F(Simulate, AFileThatCannotBeWrittenIsNoResultOfTheCase) {
  Write("case.json", kCase);
  ASSERT_EQ(Talus("case.json --out out --quiet"), 0) << output_;
  fs::remove(folder_ / "out/heap.vtp");
  fs::create_directories(folder_ / "out/heap.vtp/taken");
  EXPECT_EQ(Talus("case.json --out out --fresh --quiet"), 1);
  EXPECT_THAT(output_, HasSubstr("heap.vtp: cannot be written: "));
  EXPECT_FALSE(fs::exists(folder_ / "out/result.json"));
  fs::remove_all(folder_ / "out/heap.vtp");
  EXPECT_EQ(Talus("case.json --out out --quiet"), 0) << output_;
}

TEST_F(Simulate, TwoAtOnceDoNotMixInOneFolder) {
  Write("case.json", LongCase());
  Write("other.json", kCase);
  EXPECT_EQ(Run(TALUS_BINARY_DIR
                "/talus simulate case.json --out out --quiet & pid=$!; "
                "until [ -e out/log.txt ]; do sleep 0.01; done; kill -STOP $pid; " TALUS_BINARY_DIR
                "/talus simulate other.json --out out; echo status $?; kill -KILL $pid; wait $pid"),
            137);
  EXPECT_THAT(output_, AllOf(HasSubstr("another process simulates there"), HasSubstr("status 1")));
  EXPECT_FALSE(fs::exists(folder_ / "out/result.json"));
}

// The film stands there before the result says that all does, and what a checkpoint has not kept is
// said.
TEST_F(Simulate, AFilmThatACheckpointHasCutIsSaidToBe) {
  std::string filmed = LongCase();
  filmed.replace(filmed.find("\"csv\": true"), 11, "\"film\": true");
  Write("case.json", filmed);
  EXPECT_EQ(Interrupted("out"), 130) << output_;
  ASSERT_EQ(Talus("case.json --out out"), 0) << output_;
  EXPECT_THAT(Read("out/log.txt"), HasSubstr("the film begins there"));
  EXPECT_LE(fs::last_write_time(folder_ / "out/film.gif"),
            fs::last_write_time(folder_ / "out/result.json"));
}

// The checkpoint of hours went for a film that nobody had said would cost it, and a finished result
// with the film's first second.
TEST_F(Simulate, AFilmTakesNeitherCheckpointNorResultAway) {
  Write("case.json", LongCase());
  EXPECT_EQ(Interrupted("out", " --film heap.gif"), 130) << output_;
  EXPECT_THAT(output_, HasSubstr("without them it goes on from out/checkpoint.bin"));
  const std::string checkpoint = Read("out/checkpoint.bin");
  EXPECT_EQ(Talus("case.json --out out --film heap.gif"), 2) << output_;
  EXPECT_THAT(output_, HasSubstr("out/checkpoint.bin: would be lost"));
  EXPECT_TRUE(Read("out/checkpoint.bin") == checkpoint);
  ASSERT_EQ(Talus("case.json --out out"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("goes on from out/checkpoint.bin"));
  const auto result = Result("out");
  fs::remove(folder_ / "out/log.txt");
  EXPECT_EQ(Interrupted("out", " --film heap.gif"), 130) << output_;
  EXPECT_THAT(output_, HasSubstr("the folder keeps the result that it had"));
  EXPECT_EQ(Result("out"), result);
  for (const char* kept : {"out/heap.vtp", "out/profile.png"}) {
    EXPECT_TRUE(fs::exists(folder_ / kept)) << kept;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out/checkpoint.bin"));
  EXPECT_EQ(Talus("case.json --out out"), 0);
  EXPECT_THAT(output_, HasSubstr("is done already"));
  ASSERT_EQ(Talus("case.json --out out --film heap.gif"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "heap.gif"));
}

TEST_F(Simulate, ADamagedCheckpointIsSaidAndNotUsed) {
  Write("case.json", LongCase());
  EXPECT_EQ(Interrupted("out"), 130) << output_;
  ASSERT_TRUE(fs::exists(folder_ / "out/checkpoint.bin")) << output_;
  fs::resize_file(folder_ / "out/checkpoint.bin", 1000);
  ASSERT_EQ(Talus("case.json --out out"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("is damaged or cut off: its checksum does not fit; begins anew"));
  EXPECT_EQ(Result("out")["status"], "ok");
}

// A flipped digit was another result.
TEST_F(Simulate, ADamagedResultIsMadeAgain) {
  Write("pair.json", Read(TALUS_SOURCE_DIR "/examples/scenes/bouncing_pair.json"));
  ASSERT_EQ(Talus("pair.json"), 0) << output_;
  const int num_steps = Result("pair")["num_steps"];
  std::string damaged = Read("pair/result.json");
  const std::size_t digit = damaged.find("\"num_steps\": ") + 13;
  damaged[digit] = damaged[digit] == '1' ? '2' : '1';
  Write("pair/result.json", damaged);
  ASSERT_NE(Result("pair")["num_steps"], num_steps);
  ASSERT_EQ(Talus("pair.json"), 0) << output_;
  EXPECT_EQ(Result("pair")["num_steps"], num_steps);
}

TEST_F(Simulate, AFolderOfAnotherInputIsRefused) {
  Write("pair.json", Read(TALUS_SOURCE_DIR "/examples/scenes/bouncing_pair.json"));
  ASSERT_EQ(Talus("pair.json"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "pair/final.vtp"));
  EXPECT_TRUE(fs::exists(folder_ / "pair/state_0004.csv"));
  std::string other = Read("pair.json");
  other.replace(other.find("0.5 s"), 5, "0.1 s");
  Write("other.json", other);
  EXPECT_EQ(Talus("other.json --out pair"), 2);
  EXPECT_THAT(output_, HasSubstr("result of another input"));
  EXPECT_EQ(Talus("other.json --out pair --fresh"), 0) << output_;
  EXPECT_NEAR(Result("pair")["simulated_time_s"].get<double>(), 0.1, 1e-4);
}

TEST_F(Simulate, BadInputIsListedWithStatus2AndWritesNothing) {
  Write("bad.json", R"({
    "powder": {"material": {"density": -2500, "poisson_ratio": 0.7}, "mass": "2 m",
               "sizes": {"kind": "mono", "diameter": "-1 mm"}},
    "lift": 1})");
  EXPECT_EQ(Talus("bad.json --out out"), 2);
  EXPECT_THAT(output_, AllOf(HasSubstr("bad.json:2:40: powder.material.density: is -2500"),
                             HasSubstr("powder.material.poisson_ratio"), HasSubstr("powder.mass"),
                             HasSubstr("powder.sizes.diameter"), HasSubstr("lift: is not known")));
  Write("neither.json", "{}");
  EXPECT_EQ(Talus("neither.json --out out"), 2);
  EXPECT_THAT(output_, HasSubstr("is nothing that can be simulated"));
  EXPECT_EQ(Talus("missing.json --out out"), 2);
  EXPECT_THAT(output_, HasSubstr("missing.json"));
  Write("overlap.json", R"({
    "materials": [{"name": "a"}], "stop": {"steps": 10}, "time_step": 1,
    "spheres": [{"diameter": 1e-3, "position": [0, 0, 0]},
                {"diameter": 1e-3, "position": [0, 0, 1e-4]}]})");
  EXPECT_EQ(Talus("overlap.json --out out"), 2);
  EXPECT_THAT(output_, AllOf(HasSubstr("spheres[1]"), HasSubstr("time_step")));
  EXPECT_EQ(Talus("bad.json --ot out"), 2);  // a flag that does not exist
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Simulate, ARunThatGoesWrongSaysWhyWhenAndWhere) {
  // So soft that it sinks through the floor under its own weight.
  Write("soft.json", R"({
    "materials": [{"name": "jelly", "youngs_modulus": 5, "density": 2500}],
    "spheres": [{"diameter": "1 cm", "position": [0, 0, "5.5 mm"]}],
    "walls": [{"name": "floor", "shape": "plane"}], "stop": {"time": 2}})");
  EXPECT_EQ(Talus("soft.json --out out"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("step "), HasSubstr("sphere 0"), HasSubstr("floor")));
  EXPECT_EQ(Result("out")["status"], "failed");
  EXPECT_THAT(Result("out")["reason"].get<std::string>(), HasSubstr("sphere 0"));
}

}  // namespace simulate_test
}  // namespace talus
