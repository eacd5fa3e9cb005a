// The batches of a campaign that were written down, by this process or an earlier one: DIR/slurm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "experiments/runners/runner.h"
#include "experiments/runners/slurm_batch.h"

namespace talus::runners {

// Where a job was submitted last.
struct Submission {
  const Batch& batch;
  int index = 0;            // its task
  int num_submissions = 0;  // so far, that are not forgotten
};

class SlurmRecords {
 public:
  explicit SlurmRecords(std::filesystem::path folder);

  std::int64_t last_batch() const { return batches_.empty() ? 0 : batches_.rbegin()->first; }
  // "batch-000012" and an ending.
  std::filesystem::path File(std::int64_t batch, const std::string& ending) const;

  void Add(const Batch& batch) { batches_[batch.number] = batch; }
  void Remove(std::int64_t batch) { batches_.erase(batch); }

  // An earlier process may have run the job more often than this one knows of: the last one counts.
  std::optional<Submission> Last(const Job& job) const;

  // All jobs that are not forgotten.
  std::vector<Job> Known() const;

  // What was submitted of the job so far is not found again, by later processes either.
  void Forget(const Job& job) const;

 private:
  std::filesystem::path ForgottenMark(std::int64_t batch, int index) const;

  std::filesystem::path folder_;
  std::map<std::int64_t, Batch> batches_;  // by number
};

}  // namespace talus::runners
