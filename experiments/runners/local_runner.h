// Jobs as processes of this machine, each in a process group of its own.
//
// A job dies with the program that started it, even by `kill -9`: the kernel sends the command a
// SIGKILL when its parent goes (PR_SET_PDEATHSIG). What the command itself has started may survive
// that; its process group is noted in the folder and ended before the folder is used again.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>

#include "experiments/runners/runner.h"

namespace talus::experiments {

struct LocalRunnerOptions {
  int workers = 0;          // at the same time, >= 0; 0: as many as cores
  int threads_per_job = 1;  // of a foreign engine that uses OpenMP, >= 1
};

class LocalRunner : public Runner {
 public:
  explicit LocalRunner(const LocalRunnerOptions& options);
  ~LocalRunner() override;

  int Capacity() const override { return workers_; }
  bool JobsOutliveUs() const override { return false; }
  std::vector<std::string> Submit(std::span<const Job> jobs) override;
  bool Adopt(const Job& job, const std::string& name) override;
  std::vector<FinishedJob> Wait(double seconds) override;
  void Cancel(std::int64_t id) override;

 private:
  using Clock = std::chrono::steady_clock;

  struct Process {
    pid_t pid = -1;
    int pid_file = -1;  // pidfd: readable when the process has ended
    Clock::time_point start;
    Clock::time_point deadline;
    JobEnd stopped = JobEnd::kExit;  // why we have killed it, if we have
    std::filesystem::path folder;
  };

  void StartProcess(const Job& job);
  void StopOverdue(Clock::time_point now);
  bool WaitForOne(double seconds) const;
  void CollectEnded();
  FinishedJob Reap(std::int64_t id, Process& process);

  int workers_;
  int threads_per_job_;
  std::string host_;
  std::map<std::int64_t, Process> running_;
  std::vector<FinishedJob> finished_;
};

}  // namespace talus::experiments
