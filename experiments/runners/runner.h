// Where commands run: on this machine, or through a cluster's queue. A runner knows folders and
// commands; what they compute it does not know.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"

namespace talus::runners {

// A command to run once in its folder; what it prints goes to `log.txt` there.
struct Job {
  std::int64_t id = 0;           // the caller's, unique among its unfinished jobs
  int attempt = 1;               // the same id again after a failure has the next number
  std::filesystem::path folder;  // absolute; working directory of the command
  std::vector<std::string> command;
  double time_cap = 0;  // [s] of wall-clock from its start, 0: none
};

// How a job ended.
enum class JobEnd {
  kExit,         // by itself, with an exit status
  kSignal,       // crashed or was killed
  kTimeCap,      // was stopped after time_cap
  kOutOfMemory,  // was stopped for its memory
  kNodeFailure,  // the machine it ran on went away
  kPreempted,    // was ended by somebody else, and may be run again as it was
  kCancelled,    // by Cancel
  kNotStarted    // the command cannot be run, or the queue refused it
};
constexpr JobEnd LastOf(JobEnd) { return JobEnd::kNotStarted; }

struct FinishedJob {
  std::int64_t id = 0;
  JobEnd end = JobEnd::kExit;
  int exit_status = 0;  // for kExit
  std::string reason;   // in words: "exit status 1", "was killed by signal 11 (SIGSEGV)"
  double duration = 0;  // [s] wall-clock
  double cpu_time = 0;  // [s], 0 when not known
  std::string host;

  bool ok() const { return end == JobEnd::kExit && exit_status == 0; }
};

class Runner {
 public:
  // Jobs that are not finished are cancelled where they would be lost with this process (local),
  // and left where they go on without it (a queue).
  virtual ~Runner() = default;

  // Jobs that may be unfinished at the same time.
  virtual int Capacity() const = 0;

  // Whether jobs go on when this process or its machine ends.
  virtual bool JobsOutliveUs() const = 0;

  // Takes jobs on; those given together may be submitted together. A job that cannot be started is
  // reported by Wait, not thrown. Returns a name for each by which a later process can find it
  // again (a cluster's job number), or "" if that is not possible.
  virtual std::vector<std::string> Submit(std::span<const Job> jobs) = 0;

  // A job that an earlier process submitted under `name`: true if it is known, waiting, running or
  // ended; Wait then reports it as one of ours. False if it must be submitted again; nothing of it
  // is running then.
  virtual bool Adopt(const Job& job, const std::string& name) = 0;

  // What was submitted of a job so far, and has ended, is not to be adopted any more, by a later
  // process either: it is to be submitted again, or never.
  virtual void Forget(const Job&) {}

  // Jobs that have finished since the last call. Waits up to `seconds` for the first; returns
  // earlier, perhaps with none, when a signal arrives.
  virtual std::vector<FinishedJob> Wait(double seconds) = 0;

  // Stops a job with everything it has started; Wait reports it as cancelled.
  virtual void Cancel(std::int64_t id) = 0;

  // Why jobs that were taken on cannot be begun for now, in words; empty if nothing is the matter.
  virtual std::string Trouble() const { return ""; }

  // Jobs that a queue has taken and has not begun yet, as far as is known.
  virtual int NumWaiting() const { return 0; }

  // Takes back the jobs that a queue has not got yet, and returns their ids: Wait does not report
  // them.
  virtual std::vector<std::int64_t> TakeBackUnsent() { return {}; }
};

// What Open MPI must be told where several trials share a machine. It would bind the ranks of each
// to the machine's first cores, and the threads of a rank to one of them; and a rank that waits for
// another would keep its core busy, which two ranks on one core pay with forty times the time.
// Others bind nothing by themselves.
inline constexpr std::array kSharingRanks{
    std::pair{"OMPI_MCA_hwloc_base_binding_policy", "none"},     // up to version 4
    std::pair{"PRTE_MCA_hwloc_default_binding_policy", "none"},  // from version 5 on
    std::pair{"OMPI_MCA_mpi_yield_when_idle", "1"},
};

}  // namespace talus::runners
