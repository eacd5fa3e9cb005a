// Stand-ins for Slurm's commands, so that what a cluster may answer can be chosen.
// tests/system/slurm_test.cc does the same with a real cluster.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "experiments/runners/slurm_runner.h"

namespace talus::runners {

namespace fs = std::filesystem;

// sbatch gives number 100 + n to the n-th batch, notes it, and runs its tasks at once unless there
// is a file `hold`; squeue prints the file `queue`; scancel notes what it is to cancel.
inline constexpr const char* kSbatch = R"(#!/bin/bash
[ -e hold_sbatch ] && { cat hold_sbatch >&2; exit 1; }
env | grep -E '^SBATCH_(JOB_NAME|TIMELIMIT|CLUSTERS|PARTITION)=' >environment
echo "$2" >>submitted
number=$((100 + $(wc -l <submitted)))
echo "$number"
[ -e hold ] && exit 0
last=$(sed -n 's/^#SBATCH --array=0-//p' "$2")
for task in $(seq 0 "$last"); do SLURM_ARRAY_TASK_ID=$task bash "$2" </dev/null >/dev/null 2>&1; done
exit 0
)";
inline constexpr const char* kSqueue = R"(#!/bin/bash
[ -e queue_is_down ] && { echo "Unable to contact slurm controller" >&2; exit 1; }
[[ "$*" = *--name=* ]] && { cat found 2>/dev/null; exit 0; }
echo asked >>squeue_calls
cat queue 2>/dev/null; exit 0
)";

class SlurmRunnerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() /
            ("talus slurm " + std::to_string(::getpid()) +  // a blank, as users' folders have
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(root_ / "bin");
    Program("sbatch", kSbatch);
    Program("squeue", kSqueue);
    // That of Debian 12 does not know --array.
    Program("sacct",
            "#!/bin/bash\n[[ \" $* \" != *' --array '* ]] || exit 1\n"
            "cat accounting 2>/dev/null || exit 1\n");
    Program("scancel", "#!/bin/bash\necho \"$1\" >>cancelled\n");
    old_path_ = std::getenv("PATH");
    ::setenv("PATH", ((root_ / "bin").string() + ":" + old_path_).c_str(), 1);
    old_folder_ = fs::current_path();
    fs::current_path(root_);  // where the stand-ins look for their files
    options_.poll_interval = 0.05;
    options_.result_delay = 0.3;
  }
  void TearDown() override {
    fs::current_path(old_folder_);
    ::setenv("PATH", old_path_.c_str(), 1);
    fs::remove_all(root_);
  }

  void Program(const std::string& name, const std::string& text) {
    Put("bin/" + name, text);
    fs::permissions(root_ / "bin" / name, fs::perms::owner_all);
  }
  void Put(const std::string& name, const std::string& text) {
    std::ofstream(root_ / name, std::ios::binary) << text;
  }
  std::string Text(const std::string& name) {
    return fs::exists(root_ / name) ? base::ReadFile(root_ / name) : "";
  }
  Job Shell(std::int64_t id, const std::string& script) {
    Job job;
    job.id = id;
    job.folder = root_ / "trials" / std::to_string(id);
    fs::create_directories(job.folder);
    job.command = {"sh", "-c", script};
    return job;
  }
  // All that finish within the time.
  std::vector<FinishedJob> Finish(SlurmRunner& runner, std::size_t count, double seconds = 10) {
    std::vector<FinishedJob> all;
    const auto start = std::chrono::steady_clock::now();
    while (all.size() < count &&
           std::chrono::steady_clock::now() - start < std::chrono::duration<double>(seconds)) {
      for (const FinishedJob& finished : runner.Wait(0.1)) all.push_back(finished);
    }
    std::sort(all.begin(), all.end(),
              [](const FinishedJob& a, const FinishedJob& b) { return a.id < b.id; });
    return all;
  }

  fs::path root_;
  fs::path old_folder_;
  std::string old_path_;
  SlurmOptions options_;
};

}  // namespace talus::runners
