// What a campaign tells while it runs: a line that changes in place on a terminal, plain lines
// elsewhere with the time left once a minute, and every line with its time in campaign.log. For
// scripts one JSON object a line.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "experiments/campaign/folder/progress.h"

namespace talus::campaign {

class Console {
 public:
  enum class Output {
    kStandardError,
    kQuiet,  // only campaign.log
    kJson  // on standard output: {"event": "trial" | "progress" | "message", "time_utc": …, …}
  };

  // `period`: between two lines of the campaign's status where it does not change in place.
  explicit Console(std::filesystem::path log, Output output = Output::kStandardError,
                   std::chrono::steady_clock::duration period = std::chrono::minutes(1));
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console();

  void Line(const std::string& text);
  // For campaign.log alone: what somebody else tells the user.
  void Note(const std::string& text) { Log(text); }
  void Trial(const TrialProgress& trial);
  // Shown on a terminal until the next line or status, elsewhere a line a minute; for scripts a
  // line after each change.
  void Status(const CampaignProgress& progress);

 private:
  void Log(const std::string& text);
  void ClearStatus();

  std::filesystem::path log_;
  Output output_;
  bool terminal_;
  std::chrono::steady_clock::duration period_;
  std::chrono::steady_clock::time_point said_;  // when the status was last a line of its own
  bool status_shown_ = false;
  std::string last_status_;  // for scripts
};

}  // namespace talus::campaign
