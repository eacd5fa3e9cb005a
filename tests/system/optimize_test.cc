// Runs `talus optimize` as a user does, on a command of somebody else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>

#include "base/files/file.h"

namespace talus {
namespace optimize_test {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// Without looking for the packages of the site: some hundreds of starts.
const std::string kCommand = "python3 -S -E " TALUS_SOURCE_DIR "/tests/system/optimize_command.py ";

constexpr const char* kUnitSquare = R"([
  {"name": "a", "low": 0, "high": 1}, {"name": "b", "low": 0, "high": 1},
  {"name": "c", "fixed": 7}])";

class Optimize : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("optimize_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }

  // A search of the unit square with these keys.
  void WriteProblem(const std::string& keys) {
    Write("problem.json", "{" + keys + ", \"parameters\": " + std::string(kUnitSquare) + "}");
  }

  // Exit status of a command in the test's folder; what it prints is in out_ and errors_.
  int Run(const std::string& command) {
    const std::string all =
        "cd " + folder_.string() + " && { " + command + "; } > out.txt 2> errors.txt";
    const int status = std::system(all.c_str());
    out_ = base::ReadFile(folder_ / "out.txt");
    errors_ = base::ReadFile(folder_ / "errors.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int Talus(const std::string& arguments) {
    return Run(TALUS_BINARY_DIR "/talus optimize " + arguments);
  }

  // Whether the process whose number is in this file is gone, or will be: the guard needs a moment.
  bool Ends(const std::string& file) {
    std::string pid;
    std::ifstream(folder_ / file) >> pid;
    for (int look = 0; look < 1000; ++look) {
      std::ifstream process("/proc/" + pid + "/stat");
      std::string stat;
      std::getline(process, stat);
      const std::size_t state = stat.rfind(") ");
      if (state == std::string::npos || stat[state + 2] == 'Z') return !pid.empty();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  fs::path folder_;
  std::string out_;
  std::string errors_;
};

TEST_F(Optimize, FindsTheMinimumOfACommandThatReturnsValuesAndSometimesFails) {
  Write("problem.json", R"({"parameters": [
      {"name": "a", "low": 0, "high": 1},
      {"name": "b", "low": 1e-6, "high": 1e-2, "scale": "log"}],
    "evaluations": 25, "workers": 2})");
  ASSERT_EQ(Talus("problem.json --out search --quiet -- " + kCommand + "value"), 0) << errors_;
  const json result = json::parse(base::ReadFile(folder_ / "search/result.json"));
  // The function is a bowl of width 1 in a and of a decade in b; 25 evaluations without noise.
  EXPECT_NEAR(result["recommended"]["a"], 0.3, 0.02);
  EXPECT_NEAR(std::log10(result["recommended"]["b"].get<double>()), -4, 0.05);
  EXPECT_LE(result["ranges_90"]["a"]["low"], result["recommended"]["a"]);
  EXPECT_GE(result["ranges_90"]["a"]["high"], result["recommended"]["a"]);
  EXPECT_FALSE(result["stopped"].get<std::string>().empty());
  EXPECT_EQ(errors_, "");
  std::ifstream log(folder_ / "search/evaluations.jsonl");
  std::set<int> numbers;  // two run at a time: either may end first
  for (std::string line; std::getline(log, line);) {
    const json evaluation = json::parse(line);
    numbers.insert(evaluation["evaluation"].get<int>());
    const bool failed = evaluation["parameters"]["a"] > 0.9;
    EXPECT_EQ(evaluation.contains("failed"), failed);
    if (!failed) continue;
    EXPECT_THAT(evaluation["failed"].get<std::string>(), HasSubstr("no heap formed"));
  }
  EXPECT_EQ(numbers.size(), result["evaluations"]);
  EXPECT_EQ(*numbers.begin(), 1);
  EXPECT_EQ(*numbers.rbegin(), result["evaluations"]);
}

TEST_F(Optimize, MeetsATargetImageGivenAsNumbersOrAsAFileTheSameWayTwice) {
  ASSERT_EQ(Run("echo '{\"a\": 0.62, \"b\": 0.35}' | " + kCommand + "field"), 0);
  const std::string target = out_;
  ASSERT_EQ(Run("echo '{\"a\": 0.62, \"b\": 0.35, \"seed\": 0}' | " + kCommand + "profile"), 0);
  const std::string rest =
      ", \"evaluations\": 14, \"parameters\": " + std::string(kUnitSquare) + "}";
  Write("field.json", "{\"target\": " + target + rest);
  Write("profile.json", R"({"target": {"profile": "heap_0.png"})" + rest);
  for (const std::string kind : {"field", "profile"}) {
    ASSERT_EQ(Talus(kind + ".json --quiet -- " + kCommand + kind), 0) << errors_;
    const json result = json::parse(out_);
    EXPECT_NEAR(result["recommended"]["a"], 0.62, 0.02) << kind;
    EXPECT_NEAR(result["recommended"]["b"], 0.35, 0.04) << kind;
    EXPECT_EQ(result["recommended"]["c"], 7);
    EXPECT_THAT(result["model"].get<std::string>(), HasSubstr("column heights"));
  }
  const std::string first = out_;
  ASSERT_EQ(Talus("profile.json --quiet -- " + kCommand + "profile"), 0) << errors_;
  EXPECT_EQ(out_, first);
}

TEST_F(Optimize, ReportsBadInputWithItsPlaceAndWritesNothing) {
  Write("bad.json", R"({"parameters": [{"name": "seed", "low": 2, "high": 1}],
  "strategy": {"kind": "grit"}, "evaluation": 3, "target": {"profile": "x.png", "field": [[0, 2]]}})");
  EXPECT_EQ(Talus("bad.json --out search -- true"), 2);
  for (const char* part :
       {"bad.json:1:", "parameters[0].high", "must not be \"seed\"", "strategy.kind",
        "did you mean \"evaluations\"?", "target.profile", "field[0]: is 2"}) {
    EXPECT_THAT(errors_, HasSubstr(part));
  }
  EXPECT_FALSE(fs::exists(folder_ / "search"));
  EXPECT_EQ(Talus("missing.json -- true"), 2);
  EXPECT_THAT(errors_, HasSubstr("missing.json"));
}

TEST_F(Optimize, ACommandThatNeverMakesSenseEndsItWithAReason) {
  Write("problem.json", "{\"parameters\": " + std::string(kUnitSquare) + "}");
  EXPECT_EQ(Talus("problem.json --out search -- no_such_command"), 2);
  EXPECT_THAT(errors_, HasSubstr("\"no_such_command\" is not found"));
  EXPECT_FALSE(fs::exists(folder_ / "search"));
  EXPECT_EQ(Talus("problem.json --quiet -- " + kCommand + "nonsense"), 1);
  EXPECT_THAT(errors_, HasSubstr("it wrote: 0.25"));
  EXPECT_EQ(Talus("problem.json --quiet -- " + kCommand + "field"), 1);
  EXPECT_THAT(errors_, HasSubstr("no \"target\""));
  EXPECT_EQ(Talus("problem.json --quiet -- " + kCommand + "crash"), 1);
  EXPECT_THAT(errors_, HasSubstr("have all failed, the last: exit status 1"));
}

// What had failed while the command was broken walled the search off from its minimum.
TEST_F(Optimize, AMendedCommandIsAskedAgainWhereAllHadFailed) {
  Write("problem.json", "{\"evaluations\": 24, \"parameters\": " + std::string(kUnitSquare) + "}");
  Write("ask.sh", "test -e mended && exec " + kCommand + "value; exit 3\n");
  const std::string arguments = "problem.json --out search --quiet -- sh ask.sh";
  ASSERT_EQ(Talus(arguments), 1);
  EXPECT_THAT(errors_, HasSubstr("the first 8 evaluations have all failed"));
  ASSERT_EQ(Talus(arguments), 1);
  EXPECT_THAT(errors_, HasSubstr("the first 8 evaluations have all failed"));
  Write("mended", "");
  ASSERT_EQ(Talus(arguments), 0) << errors_;
  const json mended = json::parse(base::ReadFile(folder_ / "search/result.json"));
  ASSERT_EQ(Talus("problem.json --out anew --quiet -- sh ask.sh"), 0) << errors_;
  const json anew = json::parse(base::ReadFile(folder_ / "anew/result.json"));
  EXPECT_EQ(mended["recommended"], anew["recommended"]);
}

// Once the mended command had succeeded the failures of the broken one, still in the log, counted.
TEST_F(Optimize, AMendedCommandThatIsInterruptedDoesNotBringTheFailuresBack) {
  Write("problem.json", "{\"evaluations\": 24, \"parameters\": " + std::string(kUnitSquare) + "}");
  Write("ask.sh",
        "test -e mended || exit 3; if [ -e slow ]; then touch started; sleep 1; fi; exec " +
            kCommand + "value\n");
  const std::string arguments = "problem.json --out search --quiet -- sh ask.sh";
  ASSERT_EQ(Talus(arguments), 1);
  Write("mended", "");
  Write("slow", "");
  ASSERT_EQ(Run(TALUS_BINARY_DIR "/talus optimize " + arguments +
                " & pid=$!; until [ -e started ]; do sleep 0.01; done; kill -INT $pid; wait $pid"),
            130);
  fs::remove(folder_ / "slow");
  ASSERT_EQ(Talus(arguments), 0) << errors_;
  EXPECT_THAT(base::ReadFile(folder_ / "search/evaluations.jsonl"),
              testing::Not(HasSubstr("exit status 3")));
}

// Every sixth evaluation prints a stray line, nothing, NaN, 1e400 or null.
TEST_F(Optimize, SenselessAnswersAreFailedEvaluations) {
  WriteProblem(R"("evaluations": 30, "strategy": {"stop_multiple": 0})");
  ASSERT_EQ(Talus("problem.json --out search --quiet -- " + kCommand + "moody"), 0) << errors_;
  const json result = json::parse(base::ReadFile(folder_ / "search/result.json"));
  EXPECT_EQ(result["evaluations"], 30);
  EXPECT_EQ(result["failed"], 5);
  EXPECT_THAT(base::ReadFile(folder_ / "search/evaluations.jsonl"),
              HasSubstr("must be one JSON object and nothing else"));
  // The bowl of the values; a fifth of the range would be missed if a failure counted as a value.
  EXPECT_NEAR(result["recommended"]["a"], 0.3, 0.05);
}

// Killed in the middle of an evaluation and run again, a search of images ends like one that was
// left alone; so does one whose last line was cut off.
TEST_F(Optimize, ResumesAfterAKillWithTheSameResult) {
  ASSERT_EQ(Run("echo '{\"a\": 0.62, \"b\": 0.35}' | " + kCommand + "csv"), 0);
  Write("problem.json", "{\"target\": " + out_ + ", \"evaluations\": 12, \"workers\": 2" +
                            ", \"parameters\": " + std::string(kUnitSquare) + "}");
  ASSERT_EQ(Talus("problem.json --out whole --quiet -- " + kCommand + "csv"), 0) << errors_;
  ASSERT_EQ(
      Run("KILL_AT=8 " TALUS_BINARY_DIR "/talus optimize problem.json --out killed --quiet -- " +
          kCommand + "csv"),
      128 + 9);
  EXPECT_FALSE(fs::exists(folder_ / "killed/result.json"));
  ASSERT_EQ(Talus("problem.json --out killed -- " + kCommand + "csv"), 0) << errors_;
  EXPECT_THAT(errors_, HasSubstr("goes on after"));
  EXPECT_EQ(base::ReadFile(folder_ / "killed/result.json"),
            base::ReadFile(folder_ / "whole/result.json"));
  const fs::path log = folder_ / "killed/evaluations.jsonl";
  fs::resize_file(log, fs::file_size(log) - 20);
  ASSERT_EQ(Talus("problem.json --out killed --quiet -- " + kCommand + "csv"), 0) << errors_;
  EXPECT_EQ(base::ReadFile(folder_ / "killed/result.json"),
            base::ReadFile(folder_ / "whole/result.json"));
}

TEST_F(Optimize, AReportOfItsFolderShowsTheAnswer) {
  Write("problem.json", "{\"evaluations\": 12, \"parameters\": " + std::string(kUnitSquare) + "}");
  ASSERT_EQ(Talus("problem.json --out search --quiet -- " + kCommand + "value"), 0) << errors_;
  ASSERT_EQ(Run(TALUS_BINARY_DIR "/talus report search"), 0) << errors_;
  const std::string page = base::ReadFile(folder_ / "search/report/report.html");
  EXPECT_THAT(page, HasSubstr("12 of at most 12 evaluations"));
  EXPECT_THAT(page, HasSubstr("<td>a</td>"));
  EXPECT_EQ(Run(TALUS_BINARY_DIR "/talus report search --watch"), 2);
  EXPECT_THAT(errors_, HasSubstr("--watch"));
}

// A flipped digit was another evaluation.
TEST_F(Optimize, ADamagedEvaluationIsNamed) {
  Write("problem.json", "{\"evaluations\": 3, \"parameters\": " + std::string(kUnitSquare) + "}");
  ASSERT_EQ(Talus("problem.json --out search --quiet -- " + kCommand + "bowl"), 0) << errors_;
  std::string log = base::ReadFile(folder_ / "search/evaluations.jsonl");
  const std::size_t digit = log.rfind("\"value\":") + 10;
  log[digit] = log[digit] == '7' ? '8' : '7';
  Write("search/evaluations.jsonl", log);
  EXPECT_EQ(Talus("problem.json --out search --quiet -- " + kCommand + "bowl"), 2);
  EXPECT_THAT(errors_, HasSubstr("evaluations.jsonl:3: is damaged"));
}

TEST_F(Optimize, ADamagedImageOfAnEvaluationIsNamedWithItsLine) {
  ASSERT_EQ(Run("echo '{\"a\": 0.62, \"b\": 0.35}' | " + kCommand + "csv"), 0);
  Write("problem.json", "{\"target\": " + out_ + ", \"evaluations\": 3, \"parameters\": " +
                            std::string(kUnitSquare) + "}");
  const std::string search = "problem.json --out search --quiet -- " + kCommand + "csv";
  ASSERT_EQ(Talus(search), 0) << errors_;
  std::string image = base::ReadFile(folder_ / "search/images/0002.csv");
  image[image.find('.') + 1] ^= 1;
  Write("search/images/0002.csv", image);
  EXPECT_EQ(Talus(search), 2);
  EXPECT_THAT(errors_, HasSubstr("0002.csv: is damaged or gone; take line 2 of "));
  std::string log = base::ReadFile(folder_ / "search/evaluations.jsonl");
  const std::string result = base::ReadFile(folder_ / "search/result.json");
  log.erase(log.find('\n') + 1, log.find('\n', log.find('\n') + 1) - log.find('\n'));
  Write("search/evaluations.jsonl", log);
  EXPECT_EQ(Talus(search), 0) << errors_;
  EXPECT_EQ(base::ReadFile(folder_ / "search/result.json"), result);
}

// The command ran on, and so did what it had started in a session of its own.
TEST_F(Optimize, WhatTheCommandHasStartedEndsWithIt) {
  Write("problem.json", "{\"evaluations\": 2, \"parameters\": " + std::string(kUnitSquare) + "}");
  Write("evaluate.sh",
        "setsid sh -c 'echo $$ >session.new; mv session.new session; exec sleep 300' >&- 2>&- &\n"
        "until [ -e session ]; do sleep 0.01; done\n"
        "echo $$ >leader\n"
        "[ $1 = end ] || { kill -KILL $PPID; exec sleep 300; }\n"
        "echo '{\"value\": 1}'\n");
  ASSERT_EQ(Talus("problem.json --quiet -- sh evaluate.sh end"), 0) << errors_;
  EXPECT_TRUE(Ends("session"));
  fs::remove(folder_ / "session");
  ASSERT_EQ(Talus("problem.json --quiet -- sh evaluate.sh kill"), 128 + 9);
  EXPECT_TRUE(Ends("session"));
  EXPECT_TRUE(Ends("leader"));
}

TEST_F(Optimize, AFolderOfAnotherProblemIsLeftAlone) {
  Write("one.json", "{\"evaluations\": 3, \"parameters\": " + std::string(kUnitSquare) + "}");
  Write("two.json",
        "{\"evaluations\": 3, \"seed\": 2, \"parameters\": " + std::string(kUnitSquare) + "}");
  ASSERT_EQ(Talus("one.json --out search --quiet -- " + kCommand + "bowl"), 0) << errors_;
  const std::string before = base::ReadFile(folder_ / "search/evaluations.jsonl");
  EXPECT_EQ(Talus("two.json --out search --quiet -- " + kCommand + "bowl"), 2);
  EXPECT_THAT(errors_, HasSubstr("holds a search of another problem"));
  EXPECT_EQ(base::ReadFile(folder_ / "search/evaluations.jsonl"), before);
}

// The values are of the command, the target and the table that they were made with.
TEST_F(Optimize, OtherInputsThanAFolderWasMadeWithAreNoticed) {
  const std::string rest =
      ", \"evaluations\": 3, \"parameters\": " + std::string(kUnitSquare) + "}";
  ASSERT_EQ(Run("echo '{\"a\": 0.6, \"b\": 0.3, \"seed\": 0}' | " + kCommand + "profile"), 0);
  Write("problem.json", R"({"target": {"profile": "heap_0.png"})" + rest);
  const std::string search = "--out search --quiet -- " + kCommand + "profile";
  ASSERT_EQ(Talus("problem.json " + search), 0) << errors_;
  EXPECT_EQ(Talus("./problem.json " + search), 0) << errors_;  // by another name
  EXPECT_EQ(Talus("problem.json --out search --quiet -- " + kCommand + "field"), 2);
  EXPECT_THAT(errors_, HasSubstr("holds what another command has answered"));
  ASSERT_EQ(Run("echo '{\"a\": 0.2, \"b\": 0.3, \"seed\": 0}' | " + kCommand + "profile"), 0);
  EXPECT_EQ(Talus("problem.json " + search), 2);
  EXPECT_THAT(errors_, HasSubstr("holds a search of another problem"));
  Write("search/problem.json", "{}");
  EXPECT_EQ(Talus("problem.json " + search), 2);
  EXPECT_THAT(errors_, HasSubstr("problem.json: is damaged"));
}

// Ctrl-C lets the evaluations end that run, SIGTERM does not; neither counts them as failed.
TEST_F(Optimize, AnInterruptionIsSaidAndEndsWith130) {
  Write("problem.json", "{\"evaluations\": 50, \"parameters\": " + std::string(kUnitSquare) + "}");
  Write("slow.sh", "touch started; sleep 1; echo '{\"value\": 1}'\n");
  Write("endless.sh", "touch started; sleep 300\n");
  const auto interrupted = [&](const std::string& script, const std::string& signal) {
    fs::remove(folder_ / "started");
    return Run(TALUS_BINARY_DIR "/talus optimize problem.json --out " + script + ".out -- sh " +
               script + " & pid=$!; until [ -e started ]; do sleep 0.01; done; kill -" + signal +
               " $pid; wait $pid");
  };
  EXPECT_EQ(interrupted("slow.sh", "INT"), 130);
  EXPECT_THAT(errors_, HasSubstr("press Ctrl-C again to drop them"));
  EXPECT_THAT(base::ReadFile(folder_ / "slow.sh.out/result.json"), HasSubstr("\"interrupted\""));
  EXPECT_EQ(interrupted("endless.sh", "TERM"), 130);
  EXPECT_EQ(base::ReadFile(folder_ / "endless.sh.out/evaluations.jsonl"), "");
}

// A missing program in a script is a failed evaluation; what says why stands at the end.
TEST_F(Optimize, AFailureSaysWhatTheCommandSaidLast) {
  Write("problem.json", "{\"evaluations\": 9, \"parameters\": " + std::string(kUnitSquare) + "}");
  Write(
      "fails.sh",
      "[ -e first ] || { touch first; echo '{\"value\": 1}'; exit; }\n"
      "for i in $(seq 50); do echo Traceback line $i >&2; done; echo KeyError: mu >&2; exit 127\n");
  ASSERT_EQ(Talus("problem.json --out search --quiet -- sh fails.sh"), 0) << errors_;
  EXPECT_THAT(base::ReadFile(folder_ / "search/evaluations.jsonl"),
              HasSubstr("Traceback line 50\\nKeyError: mu"));
  Write("crash.sh", "kill -SEGV $$\n");
  EXPECT_EQ(Talus("problem.json --quiet -- sh crash.sh"), 1);
  EXPECT_THAT(errors_, HasSubstr("was ended by signal 11"));
}

// Five failures were kept as facts about the parameters, since only eight end a longer search.
TEST_F(Optimize, AMendedCommandIsAskedAgainWhereAllOfAFewHadFailed) {
  WriteProblem(R"("evaluations": 5)");
  Write("ask.sh", "test -e mended && exec " + kCommand + "bowl; exit 3\n");
  const std::string arguments = "problem.json --out search --quiet -- sh ask.sh";
  ASSERT_EQ(Talus(arguments), 1);
  EXPECT_THAT(errors_, HasSubstr("the first 5 evaluations have all failed"));
  WriteProblem(R"("evaluations": 20)");  // more than it had given up after
  Write("mended", "");
  ASSERT_EQ(Talus(arguments), 0) << errors_;
  EXPECT_EQ(json::parse(base::ReadFile(folder_ / "search/result.json"))["failed"], 0);
}

// The last evaluations of an incomplete batch were made again, since others were asked for.
TEST_F(Optimize, OtherWorkersGoOnFromTheEvaluationsThereAre) {
  const std::string search = "problem.json --out search --quiet -- " + kCommand + "bowl";
  WriteProblem(R"("evaluations": 11, "workers": 1)");
  ASSERT_EQ(Talus(search), 0) << errors_;
  WriteProblem(R"("evaluations": 16, "workers": 4)");
  ASSERT_EQ(Talus(search), 0) << errors_;
  std::ifstream log(folder_ / "search/evaluations.jsonl");
  int count = 0;
  for (std::string line; std::getline(log, line);) {
    const json evaluation = json::parse(line);
    const int number = evaluation["evaluation"].get<int>();
    ++count;
    EXPECT_EQ(evaluation["asked_after"], number <= 11 ? number - 1 : number <= 15 ? 11 : 15);
  }
  EXPECT_EQ(count, 16);
}

// 60 of its 512 points are all at a = 0, which was then said to lie on a's bound.
TEST_F(Optimize, AGridBeyondItsEvaluationsIsRefusedAndABoundNeverLeftIsNoNews) {
  const std::string grid = R"(, "strategy": {"kind": "grid", "levels": [1, 3], "refine_best": 0})";
  WriteProblem(R"("evaluations": 2)" + grid);
  EXPECT_EQ(Talus("problem.json --quiet -- " + kCommand + "bowl"), 2);
  EXPECT_THAT(errors_, HasSubstr("strategy.levels: make a grid of 3 points for 2 evaluations"));
  WriteProblem(R"("evaluations": 3)" + grid);
  ASSERT_EQ(Talus("problem.json --quiet -- " + kCommand + "bowl"), 0) << errors_;
  const json result = json::parse(out_);
  EXPECT_TRUE(result["correlation"].is_null());  // no model knows of any
  EXPECT_TRUE(result["tied"].is_null());
}

}  // namespace optimize_test
}  // namespace talus
