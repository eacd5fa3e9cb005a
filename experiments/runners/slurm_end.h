// How a task's end, as its own script has left it, is told to the campaign.
#pragma once

#include <cstdint>
#include <string>

#include "experiments/runners/runner.h"
#include "experiments/runners/slurm_batch.h"

namespace talus::runners {

FinishedJob Finished(std::int64_t id, JobEnd end, std::string reason);

// Whether the trial's command has never begun: the set-up has failed, or there is no such command.
bool NeverBegan(const TaskEnd& end);

// Whether a signal has ended it: Slurm has to say whose, for its memory, for its time, or nobody's.
bool WasKilled(const TaskEnd& end);

FinishedJob FinishedBy(std::int64_t id, const TaskEnd& end);

// What to add to the reason of a set-up that has failed: the last line that it has printed, and the
// file that the rest of it stands in.
std::string SetUpText(const std::string& log, const std::string& log_file);

}  // namespace talus::runners
