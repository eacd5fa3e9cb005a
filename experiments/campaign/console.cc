#include "experiments/campaign/console.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <utility>

#include "experiments/journal/journal.h"

namespace talus::experiments {

Console::Console(std::filesystem::path log, Output output)
    : log_(std::move(log)),
      output_(output),
      terminal_(output == Output::kStandardError && ::isatty(STDERR_FILENO) == 1) {}

Console::~Console() { ClearStatus(); }

void Console::ClearStatus() {
  if (std::exchange(status_shown_, false)) std::cerr << "\r\033[K" << std::flush;
}

// A log that cannot be written is no reason to end: what matters is in the journal.
void Console::Line(const std::string& text) {
  ClearStatus();
  if (output_ == Output::kStandardError) std::cerr << text << std::endl;
  std::ofstream(log_, std::ios::app) << UtcNow() << ' ' << text << '\n';
}

void Console::Status(const std::string& text) {
  if (!terminal_) return;
  std::cerr << "\r\033[K" << text << std::flush;
  status_shown_ = true;
}

std::string NumberText4(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace talus::experiments
