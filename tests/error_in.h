// What an action refuses, as text.
#pragma once

#include <string>

#include "base/error.h"

namespace talus {

// The words of the error that it throws, "" where it throws none; one of another type is passed on.
template <class Failure = base::ConfigError, class Action>
std::string ErrorIn(const Action& action) {
  try {
    action();
  } catch (const Failure& error) {
    return error.what();
  }
  return "";
}

}  // namespace talus
