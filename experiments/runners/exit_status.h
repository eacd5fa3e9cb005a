// What an exit status says of how a command ended, as shells write it.
#pragma once

#include <optional>
#include <string>

namespace talus::runners {

inline constexpr int kNoCommand = 127;  // of a command that is not there

// The signal that ended the command: 128 and its number. 255, which `exit(-1)` leaves, is none.
std::optional<int> SignalOf(int status);

// Signals that others send; a program that goes wrong by itself gets one of the rest.
bool IsFromOutside(int signal);

// "was ended by signal 9 (Killed)".
std::string SignalText(int signal);

}  // namespace talus::runners
