// Ends what this process has started, with all its descendants, however this process ends.
//
// A job's command may start others in process groups and sessions of their own (MPI does), and may
// be gone itself while they run: neither a group nor parentage finds them all. So each job carries
// a mark in its environment, which descendants inherit. A second process, the guard, waits for this
// one's end and then kills everything that carries its marks.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace talus::runners {

class ProcessGuard {
 public:
  ProcessGuard();
  ProcessGuard(const ProcessGuard&) = delete;
  ProcessGuard& operator=(const ProcessGuard&) = delete;
  ~ProcessGuard();  // ends what is left

  // Unique to the job on this machine: "1f0c…/7;".
  std::string MarkOf(std::int64_t job) const;

 private:
  std::string token_;
  int pipe_ = -1;  // closed by our end, whatever it is
  pid_t guard_ = -1;
};

// The variable a job's environment needs, as "NAME=value"; a mark that we carry ourselves, as a job
// of another talus, stays in it.
inline constexpr const char* kMarkVariable = "TALUS_JOBS";
std::string MarkEntry(const std::string& mark);

// Kills every process of ours whose environment holds `mark`, this one excepted, until there is
// none, for 10 s at most.
void KillMarked(const std::string& mark);

}  // namespace talus::runners
