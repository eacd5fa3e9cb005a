// What we ask of Slurm, through its own commands: sbatch, squeue, sacct, scancel.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace talus::runners {

// A job's state in Slurm's words: "PENDING", "NODE_FAIL".
struct SlurmState {
  std::string name;
  std::string reason;  // why it waits or ended: "Priority", "NonZeroExitCode"; may be empty
  double elapsed = 0;  // that it has run for [s]; 0 where Slurm does not say
};

// The state we give a job that neither squeue nor sacct knows.
inline constexpr const char* kLost = "LOST";

// Whether a job in this state may still run, perhaps again.
bool IsUnfinished(const SlurmState& state);

// Whether it waits to be begun, for the first time or again.
bool IsWaiting(const SlurmState& state);

// States by job: "1234_7" for task 7 of an array.
using SlurmStates = std::map<std::string, SlurmState, std::less<>>;

// The state of one task. Tasks that have never started share the array's own entry, "1234" or
// "1234_[7-9]". LOST when there is none.
SlurmState StateOf(const SlurmStates& states, const std::string& array, int task);

// Whether any task of the array may still run.
bool IsInQueue(const SlurmStates& states, const std::string& array);

// Lines of `squeue -o "%i|%T|%r|%M"` and of `sacct -o JobID,State,Elapsed`, where the last columns
// may be missing; other lines are left out.
SlurmStates ParseSqueue(std::string_view output);
SlurmStates ParseSacct(std::string_view output);

// Slurm's "1-02:03:04", "02:03:04" or "03:04" in seconds; 0 for anything else.
double ParseElapsed(std::string_view text);

struct SubmitReply {
  std::string job;         // the array's number; empty when it was refused
  std::string error;       // what sbatch says then
  bool try_again = false;  // the cluster did not answer, or is full for now
};

struct StatesReply {
  std::optional<SlurmStates> states;  // a job that Slurm does not know is not in it
  std::string error;                  // what squeue says where there are none
};

class SlurmQueue {
 public:
  // Submits a script; the job's number goes to `reply_file` even if this process ends meanwhile.
  SubmitReply Submit(const std::filesystem::path& script,
                     const std::filesystem::path& reply_file) const;

  // What squeue, and of tasks that it has forgotten sacct, say of `tasks`: an array's number and
  // the task's each. No states when Slurm does not answer.
  StatesReply States(const std::set<std::pair<std::string, int>>& tasks) const;

  // The array's number of a job name; "" when Slurm knows none. Throws base::Error when it does not
  // answer: then nobody can tell.
  std::string Find(const std::string& job_name) const;

  void Cancel(const std::string& job) const;

 private:
  // Whether this user has nothing queued or running; false where Slurm does not answer.
  bool HasNoJobs() const;
};

// The job's number in the answer of `sbatch --parsable`, "1234" or "1234;cluster"; "" if none.
std::string ParseSubmitted(std::string_view output);

}  // namespace talus::runners
