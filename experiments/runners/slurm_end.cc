#include "experiments/runners/slurm_end.h"

#include <optional>
#include <sstream>
#include <utility>

#include "experiments/runners/exit_status.h"

namespace talus::runners {
namespace {

std::string StatusText(const TaskEnd& end) {
  const std::string status = "exit status " + std::to_string(end.status);
  if (end.in_set_up) return "its set-up ended with " + status + " before its command began";
  const std::optional<int> signal = SignalOf(end.status);
  return signal ? SignalText(*signal) : status;
}

}  // namespace

FinishedJob Finished(std::int64_t id, JobEnd end, std::string reason) {
  FinishedJob finished;
  finished.id = id;
  finished.end = end;
  finished.reason = std::move(reason);
  return finished;
}

bool NeverBegan(const TaskEnd& end) { return end.in_set_up || end.status == kNoCommand; }

bool WasKilled(const TaskEnd& end) { return SignalOf(end.status).has_value(); }

FinishedJob FinishedBy(std::int64_t id, const TaskEnd& end) {
  FinishedJob finished = Finished(id, JobEnd::kExit, StatusText(end));
  finished.exit_status = end.status;
  finished.duration = end.duration;
  finished.cpu_time = end.cpu_time;
  finished.host = end.host;
  if (NeverBegan(end)) {
    finished.end = JobEnd::kNotStarted;
  } else if (WasKilled(end)) {
    finished.end = IsFromOutside(*SignalOf(end.status)) ? JobEnd::kPreempted : JobEnd::kSignal;
  }
  if (end.restarts > 0) {
    finished.reason += ", after Slurm had requeued it " + std::to_string(end.restarts) + " times";
  }
  return finished;
}

std::string SetUpText(const std::string& log, const std::string& log_file) {
  constexpr std::size_t kMostQuoted = 200;
  std::string last;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last = line;
  }
  if (last.empty()) return "; it has printed nothing (" + log_file + ")";
  return ": " + last.substr(0, kMostQuoted) + " (" + log_file + ")";
}

}  // namespace talus::runners
