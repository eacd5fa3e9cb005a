#include "experiments/trials/simulate/run_log.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "base/text/duration_text.h"
#include "base/text/printable.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::trials {
namespace {

constexpr double kTerminalPeriod = 0.25;  // [s]
constexpr double kPlainPeriod = 60;       // [s]

bool IsStandardOutput(const std::filesystem::path& path) {
  struct stat file {};
  struct stat out {};
  return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &out) == 0 &&
         file.st_dev == out.st_dev && file.st_ino == out.st_ino;
}

double Seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

RunLog::RunLog(const std::filesystem::path& folder, bool quiet)
    : quiet_(quiet), terminal_(::isatty(STDOUT_FILENO) == 1) {
  const std::filesystem::path path = folder / rigs::kLogFile;
  if (!IsStandardOutput(path)) file_.open(path, std::ios::app);
}

RunLog::~RunLog() { EraseProgress(); }

void RunLog::EraseProgress() {
  if (progress_shown_) {
    std::cout << std::flush;
    base::EraseTerminalLine(STDOUT_FILENO);
  }
  progress_shown_ = false;
}

void RunLog::Line(const std::string& text) {
  if (file_.is_open()) file_ << text << std::endl;
  if (quiet_) return;
  EraseProgress();
  std::cout << text << std::endl;
}

void RunLog::Progress(const engine::RunProgress& p) {
  const auto now = Clock::now();
  if (start_time_ < 0) {
    start_time_ = p.time;
    shown_steps_ = p.particle_steps;
  }
  const double since_shown = Seconds(now - shown_);
  if (quiet_ || since_shown < (terminal_ ? kTerminalPeriod : kPlainPeriod)) return;
  const double speed = (p.particle_steps - shown_steps_) / since_shown / 1e6;
  std::string left;
  if (p.end_time > p.time && p.time > start_time_) {
    const double pace = Seconds(now - start_) / (p.time - start_time_);
    left = ", about " + base::DurationText(pace * (p.end_time - p.time)) + " left";
  }
  char text[200];
  std::snprintf(text, sizeof text, "%s: %.4f s simulated, %lld particles, %.1f Mps/s%s",
                p.phase.c_str(), p.time, static_cast<long long>(p.num_particles), speed,
                left.c_str());
  shown_ = now;
  shown_steps_ = p.particle_steps;
  if (!terminal_) return Line(text);
  EraseProgress();
  std::cout << text << std::flush;
  progress_shown_ = true;
}

}  // namespace talus::trials
