// What a simulation tells: lines on standard output and in log.txt, and a line that is drawn over
// and over on a terminal.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/run/run.h"

namespace talus::trials {

class RunLog {
 public:
  // Appends to `folder`/log.txt, unless standard output goes there already.
  RunLog(const std::filesystem::path& folder, bool quiet);
  ~RunLog();

  void Line(const std::string& text);

  // Shows progress if enough time has passed since the last: phase, simulated time, particles,
  // speed, time left. On a terminal the line replaces itself.
  void Progress(const engine::RunProgress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  void EraseProgress();

  bool quiet_;
  bool terminal_;
  bool progress_shown_ = false;
  std::ofstream file_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = Clock::now();
  double start_time_ = -1;  // simulated, when progress was first asked for [s]
  double shown_steps_ = 0;  // particle steps at the last look
};

}  // namespace talus::trials
