#include "experiments/runners/exit_status.h"

#include <csignal>
#include <cstring>

namespace talus::runners {

std::optional<int> SignalOf(int status) {
  const int signal = status - 128;
  if (signal <= 0 || signal >= NSIG) return std::nullopt;
  return signal;
}

bool IsFromOutside(int signal) {
  return signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP;
}

std::string SignalText(int signal) {
  return "was ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

}  // namespace talus::runners
