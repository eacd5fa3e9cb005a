// What can go wrong, and which exit status the program then ends with.
#pragma once

#include <stdexcept>
#include <string>

namespace talus::base {

inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;         // the work was understood but failed
inline constexpr int kExitBadInput = 2;       // the user's input must be changed
inline constexpr int kExitInterrupted = 130;  // Ctrl-C or SIGTERM

// The work failed: a full disk, a simulation that blew up, a checksum that does not match.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The system refused to write a file, as the disk is full, over a quota, read-only or broken: no
// fault of the work, and the same succeeds when that is mended.
class Unwritten : public Error {
 public:
  using Error::Error;
};

// The input is wrong. The message names the file, the place and the remedy, one problem a line.
class ConfigError : public Error {
 public:
  using Error::Error;
};

// The user or the system asked the work to stop; what was done so far is kept.
class Interrupted : public Error {
 public:
  using Error::Error;
};

}  // namespace talus::base
