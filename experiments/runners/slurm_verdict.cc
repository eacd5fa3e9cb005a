#include "experiments/runners/slurm_verdict.h"

#include "base/text/printable.h"

namespace talus::runners {
namespace {

bool SaysOutOfMemory(const std::string& log) {
  return log.find("oom-kill") != std::string::npos || log.find("oom_kill") != std::string::npos ||
         log.find("memory limit") != std::string::npos;
}

bool SaysOutOfTime(const std::string& log) {
  return log.find("DUE TO TIME LIMIT") != std::string::npos;
}

std::string LastLine(std::string text) {
  text.erase(text.find_last_not_of(" \n\r") + 1);
  return base::Printable(text.substr(text.rfind('\n') + 1));  // npos + 1 = 0
}

}  // namespace

Verdict VerdictOf(const SlurmState& state, const std::string& log) {
  const auto is = [&](const char* name) { return state.name == name; };
  const std::string detail =
      state.reason.empty() || state.reason == "None" ? std::string() : " (" + state.reason + ")";
  // The log is the only witness of a job that Slurm has forgotten.
  const bool by_log = is("FAILED") || is(kLost);
  if (is("OUT_OF_MEMORY") || (by_log && SaysOutOfMemory(log))) {
    return {.end = JobEnd::kOutOfMemory,
            .reason = "was stopped for using more memory than it had asked Slurm for",
            .requeue = false,
            .await_result = false};
  }
  if (is("COMPLETED") || is("FAILED")) {
    return {.end = JobEnd::kSignal,
            .reason = "ended in Slurm as " + state.name + detail + " without a result" +
                      (log.empty() ? "" : ": " + LastLine(log)),
            .requeue = false,
            .await_result = true};
  }
  if (is("TIMEOUT") || is("DEADLINE") || (is(kLost) && SaysOutOfTime(log))) {
    return {.end = JobEnd::kTimeCap,
            .reason = "was stopped at its time limit in Slurm",
            .requeue = false,
            .await_result = false};
  }
  if (is("PREEMPTED")) {
    return {.end = JobEnd::kPreempted,
            .reason = "was preempted",
            .requeue = true,
            .await_result = false};
  }
  if (is("CANCELLED")) {
    return {.end = JobEnd::kCancelled,
            .reason = "was cancelled in Slurm" + detail,
            .requeue = false,
            .await_result = false};
  }
  if (is(kLost)) {
    return {.end = JobEnd::kNodeFailure,
            .reason = "is no longer known to Slurm and left no result",
            .requeue = true,
            .await_result = true};
  }
  // NODE_FAIL, BOOT_FAIL, REVOKED and the like.
  return {.end = JobEnd::kNodeFailure,
          .reason = "lost its node (" + state.name + ")",
          .requeue = true,
          .await_result = false};
}

}  // namespace talus::runners
