#include "experiments/runners/slurm_runner.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <utility>

#include "base/error.h"
#include "base/files/descriptor.h"
#include "base/files/file.h"
#include "base/files/file_lock.h"
#include "base/text/name.h"
#include "base/text/printable.h"
#include "base/trimmed.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/runners/slurm_end.h"
#include "experiments/runners/slurm_verdict.h"

namespace talus::runners {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxArray = 1000;  // Slurm's MaxArraySize is 1001 unless changed
// Between two looks at the folders, which a network file system has to answer.
constexpr auto kLookInterval = std::chrono::milliseconds(200);
constexpr auto kLookPerTask = std::chrono::milliseconds(2);

// Names this campaign's jobs in the queue. Only that no two campaigns share it matters, so that it
// may come from the system's chance: no result depends on it.
std::string CampaignId(const fs::path& folder) {
  const fs::path file = folder / "id";
  if (!fs::exists(file)) {
    std::random_device chance;
    const std::uint64_t id = (static_cast<std::uint64_t>(chance()) << 32) ^ chance();
    base::WriteFileAtomically(file, base::Hex(id));
  }
  return base::ReadFile(file);
}

// What squeue shows of a job by default is the first 8 letters of its name.
std::string NameOf(const fs::path& campaign) {
  constexpr std::size_t kMost = 40;
  std::string name = base::FileWord(base::FolderName(campaign)).substr(0, kMost);
  while (!base::IsUtf8(name)) name.pop_back();  // a letter that was cut
  return name;
}

// A lock that the commands started meanwhile inherit: as long as one of them runs, a later process
// waits for it, even if we were killed.
class InheritedLock {
 public:
  explicit InheritedLock(const fs::path& file)
      : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT, 0666)) {
    if (descriptor_.get() < 0) throw base::Error(file.string() + ": cannot be opened");
    // sbatch gives up after a minute (RunTool's cap); a file system without locks is not waited
    // for.
    base::LockWithin(descriptor_.get(), std::chrono::seconds(70), std::chrono::milliseconds(100));
  }

 private:
  base::Descriptor descriptor_;
};

// A network file system may show a new file late; listing the folder makes most of them look again.
void LookAgain(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) (void)entry;
}

std::optional<TaskEnd> EndOf(const Job& job, std::int64_t batch, int index) {
  const std::optional<TaskEnd> end = ReadTaskEnd(job.folder);
  const bool ours = end && end->batch == batch && end->task == index;
  return ours ? end : std::nullopt;
}

fs::path Made(const fs::path& folder) {
  fs::create_directories(folder);
  return folder;
}

}  // namespace

SlurmRunner::SlurmRunner(const SlurmOptions& options, const fs::path& campaign)
    : options_(options),
      folder_(fs::absolute(campaign) / "slurm"),
      name_(NameOf(folder_.parent_path())),
      records_(Made(folder_)),
      last_poll_(Clock::now()) {
  campaign_id_ = CampaignId(folder_);
}

fs::path SlurmRunner::CancelMark(const Task& task) const {
  return records_.File(task.batch, "-" + std::to_string(task.index) + ".cancelled");
}

std::vector<std::string> SlurmRunner::Submit(std::span<const Job> jobs) {
  std::vector<std::string> names;
  for (std::size_t first = 0; first < jobs.size(); first += kMaxArray) {
    std::vector<Task> tasks;
    for (const Job& job : jobs.subspan(first, std::min(kMaxArray, jobs.size() - first))) {
      tasks.push_back({.job = job});
    }
    SubmitBatch(std::move(tasks));
  }
  for (const Job& job : jobs) {
    const auto found = tasks_.find(job.id);
    names.push_back(found == tasks_.end() || found->second.array.empty() ? ""
                                                                         : found->second.Name());
  }
  return names;
}

void SlurmRunner::SubmitBatch(std::vector<Task> tasks) {
  Batch batch{.number = records_.last_batch() + 1, .job_name = {}, .jobs = {}};
  // A copy of the campaign has its number, too, but another place.
  batch.job_name = name_ + "-talus-" + campaign_id_ + "-" +
                   base::Hex(base::Checksum(folder_.string())).substr(0, 6) + "-" +
                   std::to_string(batch.number);
  for (Task& task : tasks) {
    task.batch = batch.number;
    task.index = static_cast<int>(batch.jobs.size());
    batch.jobs.push_back(task.job);
    std::error_code ignored;
    fs::remove(task.job.folder / rigs::kTaskEndFile, ignored);
  }
  base::WriteFileAtomically(records_.File(batch.number, ".sh"),
                            BatchScript(batch, options_, records_.File(batch.number, "")));
  records_.Add(batch);
  for (Task& task : tasks) tasks_[task.job.id] = std::move(task);
  SendBatch(batch.number);
}

void SlurmRunner::SendBatch(std::int64_t batch) {
  const InheritedLock lock(folder_ / "lock");
  const SubmitReply reply =
      queue_.Submit(records_.File(batch, ".sh"), records_.File(batch, ".job"));
  refusal_ = reply.try_again ? std::string(base::Trimmed(reply.error)) : "";
  std::vector<Task> refused;
  for (auto& [id, task] : tasks_) {
    if (task.batch != batch) continue;
    task.array = reply.job;
    if (reply.job.empty() && !reply.try_again) refused.push_back(task);
  }
  for (const Task& task : refused) {
    Report(task, Finished(task.job.id, JobEnd::kNotStarted,
                          "sbatch: " + std::string(base::Trimmed(reply.error))));
  }
  if (refused.empty()) return;
  fs::remove(records_.File(batch, ".sh"));
  records_.Remove(batch);
}

// The batches that Slurm did not take. It may have taken one after all and only not have answered.
void SlurmRunner::SendAgain() {
  std::map<std::int64_t, std::string> unsent;
  for (const auto& [id, task] : tasks_) {
    if (task.array.empty()) unsent[task.batch];
  }
  for (auto& [batch, array] : unsent) {
    const auto script = ParseBatch(base::ReadFile(records_.File(batch, ".sh")));
    try {
      array = queue_.Find(script.value().job_name);
    } catch (const base::Error&) {
      return;  // Slurm does not answer; the next poll asks again
    }
    if (array.empty()) SendBatch(batch);
    for (auto& [id, task] : tasks_) {
      if (task.batch == batch && !array.empty()) task.array = array;
    }
  }
}

// The array's number; "" when Slurm has never got the batch.
std::string SlurmRunner::ArrayOf(const Batch& batch) const {
  const InheritedLock lock(folder_ / "lock");  // waits for an sbatch that is still on its way
  const fs::path reply = records_.File(batch.number, ".job");
  if (fs::exists(reply)) {
    const std::string array = ParseSubmitted(base::ReadFile(reply));
    if (!array.empty()) return array;
  }
  return queue_.Find(batch.job_name);
}

bool SlurmRunner::Adopt(const Job& job, const std::string&) {
  const auto last = records_.Last(job);
  if (!last) return false;
  Task task{.job = job,
            .batch = last->batch.number,
            .index = last->index,
            .array = {},
            .requeues = last->num_submissions - 1};
  task.dropped = fs::exists(CancelMark(task));
  const auto end = EndOf(job, task.batch, task.index);
  if (end && NeverBegan(*end)) return false;  // whoever resumes has mended the set-up meanwhile
  if (!end || WasKilled(*end)) {
    task.array = ArrayOf(last->batch);
    if (task.array.empty()) return false;
  }
  tasks_[job.id] = std::move(task);
  return true;
}

std::vector<FinishedJob> SlurmRunner::Wait(double seconds) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  const auto poll_interval = std::chrono::duration<double>(options_.poll_interval);
  while (true) {
    CollectEndFiles();
    if (!tasks_.empty() && Clock::now() - last_poll_ >= poll_interval) {
      last_poll_ = Clock::now();
      SendAgain();
      Poll();
    }
    JudgeEnded();
    if (!finished_.empty() || Clock::now() >= end) break;
    const auto look = std::max(kLookInterval, kLookPerTask * static_cast<int>(tasks_.size()));
    const timespec pause{.tv_sec = look.count() / 1000, .tv_nsec = look.count() % 1000 * 1000000};
    if (::nanosleep(&pause, nullptr) != 0) break;  // a signal: the caller wants to know
  }
  return std::exchange(finished_, {});
}

void SlurmRunner::CollectEndFiles() {
  std::vector<std::pair<Task, TaskEnd>> ended;
  for (const auto& [id, task] : tasks_) {
    const auto end = EndOf(task.job, task.batch, task.index);
    if (end && !WasKilled(*end)) ended.emplace_back(task, *end);
  }
  for (const auto& [task, end] : ended) {
    FinishedJob finished = FinishedBy(task.job.id, end);
    if (end.in_set_up) finished.reason += SetUpText(LogOf(task), LogFileOf(task).string());
    Report(task, std::move(finished));
  }
}

void SlurmRunner::Poll() {
  std::set<std::pair<std::string, int>> asked;
  for (const auto& [id, task] : tasks_) {
    if (!task.array.empty()) asked.emplace(task.array, task.index);
  }
  const StatesReply reply = queue_.States(asked);
  silence_ = reply.error;
  if (!reply.states) return;  // Slurm does not answer; the jobs go on without us
  for (auto& [id, task] : tasks_) {
    if (task.array.empty()) continue;
    const SlurmState state = StateOf(*reply.states, task.array, task.index);
    if (!task.begun && state.name == kLost) {
      task.vanished = IsInQueue(*reply.states, task.array);
    }
    task.begun = !IsWaiting(state);
    if (IsUnfinished(state)) {
      task.vanished = false;
      task.ended.reset();
    } else if (!task.ended || task.ended->name != state.name) {
      task.ended = state;
      task.ended_since = Clock::now();
    }
  }
}

void SlurmRunner::JudgeEnded() {
  std::vector<std::int64_t> ended;
  for (const auto& [id, task] : tasks_) {
    if (task.ended) ended.push_back(id);
  }
  for (const std::int64_t id : ended) Judge(tasks_.at(id));
}

fs::path SlurmRunner::LogFileOf(const Task& task) const {
  return TaskLog(records_.File(task.batch, ""), std::to_string(task.index));
}

// What Slurm and the script's own set-up have said; Slurm's lines come last.
std::string SlurmRunner::LogOf(const Task& task) const {
  constexpr std::size_t kEndOfLog = 65536;
  return base::ReadTail(LogFileOf(task), kEndOfLog);
}

// `task` is gone from the list when it was reported.
void SlurmRunner::Judge(Task task) {
  const Verdict verdict = VerdictOf(*task.ended, LogOf(task));
  const auto end = EndOf(task.job, task.batch, task.index);
  const auto waited = std::chrono::duration<double>(Clock::now() - task.ended_since).count();
  if (end && verdict.await_result) {
    Report(task, FinishedBy(task.job.id, *end));
  } else if (verdict.await_result && waited < options_.result_delay) {
    LookAgain(task.job.folder);
  } else if (task.vanished && !fs::exists(LogFileOf(task))) {  // which Slurm makes when it begins
    Report(task, Finished(task.job.id, JobEnd::kCancelled,
                          "was cancelled in Slurm while it waited there"));
  } else if (verdict.requeue && !task.cancelled && task.requeues < options_.max_requeues &&
             !task.job.command.empty()) {  // empty for an adopted job: its owner must run it again
    Requeue(task, verdict.reason);
  } else {
    FinishedJob finished = Finished(task.job.id, verdict.end, verdict.reason);
    finished.duration = task.ended->elapsed;
    finished.cpu_time = CoresTime(task.ended->elapsed);  // as nobody measured it
    Report(task, std::move(finished));
  }
}

// Where Slurm has only lost sight of the job, it must not run beside its successor.
void SlurmRunner::Requeue(Task task, const std::string& reason) {
  queue_.Cancel(task.Name());
  Task again{.job = task.job,
             .batch = 0,
             .index = 0,
             .array = {},
             .requeues = task.requeues + 1,
             .requeue_reason = reason,
             .lost = task.lost + (task.ended ? task.ended->elapsed : 0)};
  SubmitBatch({std::move(again)});
}

double SlurmRunner::CoresTime(double seconds) const {
  return seconds * options_.cores * options_.ranks;
}

void SlurmRunner::Report(const Task& task, FinishedJob finished) {
  if (task.requeues > 0) {
    finished.reason += ", submitted again " + std::to_string(task.requeues) + " times" +
                       (task.requeue_reason.empty() ? "" : ": it " + task.requeue_reason);
  }
  finished.duration += task.lost;
  if (finished.cpu_time > 0) finished.cpu_time += CoresTime(task.lost);
  if (task.cancelled) {
    finished.end = JobEnd::kCancelled;
    finished.reason = "was cancelled";
  } else if (task.dropped && finished.end == JobEnd::kCancelled) {
    finished.end = JobEnd::kPreempted;
    finished.reason = "was dropped by an earlier process";
  } else if (finished.end == JobEnd::kNotStarted && task.job.command.empty()) {
    // Adopted: it waited in the queue with the set-up of then, which may have been mended.
    finished.end = JobEnd::kPreempted;
    finished.reason = "did not begin, by the set-up of an earlier process: " + finished.reason;
  }
  tasks_.erase(task.job.id);
  finished_.push_back(std::move(finished));
}

void SlurmRunner::Cancel(std::int64_t id) {
  const auto found = tasks_.find(id);
  if (found == tasks_.end()) return;
  found->second.cancelled = true;
  if (!found->second.array.empty()) {
    base::WriteFileAtomically(CancelMark(found->second), "");
    queue_.Cancel(found->second.Name());
    return;
  }
  const Task task = found->second;
  Report(task, Finished(id, JobEnd::kCancelled, "was cancelled"));
}

std::string SlurmRunner::Trouble() const {
  const bool any =
      std::ranges::any_of(tasks_, [](const auto& t) { return t.second.array.empty(); });
  if (any && !refusal_.empty()) return "sbatch: " + refusal_ + "; it is asked again and again";
  if (silence_.empty()) return "";
  return "squeue does not say how the jobs are: " + silence_ + "; it is asked again and again";
}

int SlurmRunner::NumWaiting() const {
  return static_cast<int>(
      std::ranges::count_if(tasks_, [](const auto& t) { return !t.second.begun; }));
}

int SlurmRunner::NumInQueue() {
  const auto may_run = [](const auto& task) {
    return !task.second.ended && !EndOf(task.second.job, task.second.batch, task.second.index);
  };
  if (std::ranges::none_of(tasks_, may_run)) return 0;
  Poll();
  if (!silence_.empty()) throw base::Error("squeue does not say how the jobs are: " + silence_);
  return static_cast<int>(std::ranges::count_if(tasks_, may_run));
}

std::vector<std::int64_t> SlurmRunner::TakeBackUnsent() {
  std::vector<std::int64_t> unsent;
  for (const auto& [id, task] : tasks_) {
    if (task.array.empty()) unsent.push_back(id);
  }
  for (const std::int64_t id : unsent) tasks_.erase(id);
  return unsent;
}

}  // namespace talus::runners
