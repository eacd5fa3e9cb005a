// What a campaign tells while it runs: a line that changes in place on a terminal, plain lines
// elsewhere, and every line with its time in campaign.log.
#pragma once

#include <filesystem>
#include <string>

namespace talus::experiments {

class Console {
 public:
  enum class Output { kStandardError, kQuiet };

  explicit Console(std::filesystem::path log, Output output = Output::kStandardError);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console();

  void Line(const std::string& text);
  // Shown on a terminal until the next line or status.
  void Status(const std::string& text);

 private:
  void ClearStatus();

  std::filesystem::path log_;
  Output output_;
  bool terminal_;
  bool status_shown_ = false;
};

// Four significant digits: more than a calibration knows.
std::string NumberText4(double value);

}  // namespace talus::experiments
