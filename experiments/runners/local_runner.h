// Jobs as processes of this machine, each in a process group of its own.
//
// A job dies with the program that started it, even by `kill -9`: the kernel sends the command a
// SIGKILL when its parent goes (PR_SET_PDEATHSIG), and the guard ends what the command itself has
// started (process_guard.h). Where the guard was killed as well, that is done before the folder is
// used again, by the process group and the mark that are noted in it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "experiments/runners/process_guard.h"
#include "experiments/runners/runner.h"

namespace talus::runners {

struct LocalRunnerOptions {
  int workers = 0;          // at the same time, >= 0; 0: as many as cores
  int threads_per_job = 1;  // of a foreign engine that uses OpenMP, >= 1
  std::uintmax_t largest_log = std::uintmax_t{1} << 30;  // [bytes] that a job may print
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
    std::string why{};               // in words
    std::filesystem::path folder;
  };

  void StartProcess(const Job& job);
  void StopOverdue(Clock::time_point now);
  void Stop(Process& process, JobEnd end, std::string why);
  bool WaitForOne(double seconds) const;
  void CollectEnded();
  FinishedJob Reap(std::int64_t id, Process& process);

  int workers_;
  int threads_per_job_;
  std::uintmax_t largest_log_;
  std::string host_;
  ProcessGuard guard_;
  std::map<std::int64_t, Process> running_;
  std::vector<FinishedJob> finished_;
};

}  // namespace talus::runners
