// Jobs as tasks of Slurm's job arrays, from a login node, with no daemon of ours.
//
// What was submitted is written down before it is submitted (slurm_batch.h), and each job array has
// a name of its own, so that a later process finds every job again, and none is submitted twice,
// wherever this one was killed. That a job has ended is seen from the file it leaves in its folder,
// looked at often; Slurm is asked only how those without one are, at most once in `poll_interval`.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runners/runner.h"
#include "experiments/runners/slurm_batch.h"
#include "experiments/runners/slurm_options.h"
#include "experiments/runners/slurm_queue.h"
#include "experiments/runners/slurm_records.h"

namespace talus::runners {

class SlurmRunner : public Runner {
 public:
  // `campaign` is a folder that the compute nodes see under the same path.
  SlurmRunner(const SlurmOptions& options, const std::filesystem::path& campaign);

  int Capacity() const override { return options_.max_jobs; }
  bool JobsOutliveUs() const override { return true; }
  std::vector<std::string> Submit(std::span<const Job> jobs) override;
  bool Adopt(const Job& job, const std::string& name) override;
  void Forget(const Job& job) override { records_.Forget(job); }
  std::vector<FinishedJob> Wait(double seconds) override;
  void Cancel(std::int64_t id) override;
  std::string Trouble() const override;
  int NumWaiting() const override;
  std::vector<std::int64_t> TakeBackUnsent() override;

  // Unfinished jobs that wait or run in the queue, as it says now. Throws base::Error when it does
  // not answer.
  int NumInQueue();

  // What this or an earlier process has submitted here and not forgotten, without commands.
  std::vector<Job> Known() const { return records_.Known(); }

 private:
  using Clock = std::chrono::steady_clock;

  // One of our jobs in the queue.
  struct Task {
    Job job;
    std::int64_t batch = 0;
    int index = 0;
    std::string array{};  // its array's number; empty while it waits to be submitted
    int requeues = 0;     // by us
    std::string requeue_reason{};
    double lost = 0;  // that earlier attempts have run for [s]
    bool cancelled = false;
    bool begun = false;     // as Slurm says
    bool vanished = false;  // Slurm forgot it while it waited, and not the rest of its array
    bool dropped = false;   // cancelled by an earlier process, not for any fault of the job
    std::optional<SlurmState> ended{};  // what Slurm says, once it is final
    Clock::time_point ended_since{};

    std::string Name() const { return array + "_" + std::to_string(index); }
  };

  std::filesystem::path CancelMark(const Task& task) const;
  std::string ArrayOf(const Batch& batch) const;

  void SubmitBatch(std::vector<Task> tasks);
  void SendBatch(std::int64_t batch);
  void SendAgain();
  void CollectEndFiles();
  void Poll();
  void JudgeEnded();
  void Judge(Task task);
  std::filesystem::path LogFileOf(const Task& task) const;
  std::string LogOf(const Task& task) const;
  void Requeue(Task task, const std::string& reason);
  void Report(const Task& task, FinishedJob finished);
  double CoresTime(double seconds) const;  // of all cores that a job has [s]

  SlurmOptions options_;
  std::filesystem::path folder_;  // DIR/slurm
  std::string name_;              // of the campaign's folder, first in the names of its jobs
  std::string campaign_id_;
  SlurmQueue queue_;
  SlurmRecords records_;
  std::map<std::int64_t, Task> tasks_;  // unfinished, by job id
  std::string refusal_;                 // what sbatch said when it took the last one not yet
  std::string silence_;                 // what squeue said when it did not answer last
  Clock::time_point last_poll_;
  std::vector<FinishedJob> finished_;
};

}  // namespace talus::runners
