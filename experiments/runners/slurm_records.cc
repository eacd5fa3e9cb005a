#include "experiments/runners/slurm_records.h"

#include <string>
#include <utility>

#include "base/files/file.h"

namespace talus::runners {
namespace {

// By whatever names: through a link, with "./" before it.
bool IsSameFolder(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code absent;
  return a == b || std::filesystem::equivalent(a, b, absent);
}

bool IsSameJob(const Job& recorded, const Job& job) {
  return recorded.id == job.id && IsSameFolder(recorded.folder, job.folder);
}

}  // namespace

SlurmRecords::SlurmRecords(std::filesystem::path folder) : folder_(std::move(folder)) {
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() != ".sh") continue;
    if (const auto batch = ParseBatch(base::ReadFile(entry.path()))) Add(*batch);
  }
}

std::filesystem::path SlurmRecords::File(std::int64_t batch, const std::string& ending) const {
  std::string number = std::to_string(batch);
  number.insert(0, number.size() < 6 ? 6 - number.size() : 0, '0');
  return folder_ / ("batch-" + number + ending);
}

std::filesystem::path SlurmRecords::ForgottenMark(std::int64_t batch, int index) const {
  return File(batch, "-" + std::to_string(index) + ".forgotten");
}

std::optional<Submission> SlurmRecords::Last(const Job& job) const {
  const Batch* last = nullptr;
  int last_index = 0, count = 0;
  for (const auto& [number, batch] : batches_) {
    for (int index = 0; index < static_cast<int>(batch.jobs.size()); ++index) {
      const Job& recorded = batch.jobs[static_cast<std::size_t>(index)];
      if (recorded.attempt < job.attempt || !IsSameJob(recorded, job)) continue;
      if (std::filesystem::exists(ForgottenMark(number, index))) continue;
      last = &batch;
      last_index = index;
      ++count;
    }
  }
  if (last == nullptr) return std::nullopt;
  return Submission{.batch = *last, .index = last_index, .num_submissions = count};
}

std::vector<Job> SlurmRecords::Known() const {
  std::vector<Job> known;
  for (const auto& [number, batch] : batches_) {
    for (int index = 0; index < static_cast<int>(batch.jobs.size()); ++index) {
      if (std::filesystem::exists(ForgottenMark(number, index))) continue;
      known.push_back(batch.jobs[static_cast<std::size_t>(index)]);
    }
  }
  return known;
}

void SlurmRecords::Forget(const Job& job) const {
  for (const auto& [number, batch] : batches_) {
    for (int index = 0; index < static_cast<int>(batch.jobs.size()); ++index) {
      if (!IsSameJob(batch.jobs[static_cast<std::size_t>(index)], job)) continue;
      base::WriteFileAtomically(ForgottenMark(number, index), "");
    }
  }
}

}  // namespace talus::runners
