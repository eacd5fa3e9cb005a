// What a campaign tells while it runs: a line that changes in place on a terminal, plain lines
// elsewhere, and every line with its time in campaign.log. For scripts one JSON object a line.
#pragma once

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

  explicit Console(std::filesystem::path log, Output output = Output::kStandardError);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console();

  void Line(const std::string& text);
  void Trial(const TrialProgress& trial);
  // Shown on a terminal until the next line or status; a line for scripts after each change.
  void Status(const CampaignProgress& progress);

 private:
  void Log(const std::string& text);
  void ClearStatus();

  std::filesystem::path log_;
  Output output_;
  bool terminal_;
  bool status_shown_ = false;
  std::string last_status_;  // for scripts
};

}  // namespace talus::campaign
