#include "experiments/trials/engines/command_options.h"

#include <fnmatch.h>

#include <algorithm>

#include "experiments/rigs/case/run_files.h"

namespace talus::trials {
namespace {

bool IsInside(const std::filesystem::path& path) {
  return !path.empty() && path.is_relative() && path.has_filename() &&
         std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
}

}  // namespace

std::filesystem::path CommandOptions::ResultPath() const {
  return std::filesystem::path(result).lexically_normal();
}

void CommandOptions::Validate(base::Problems& problems) const {
  problems.Require(templates.has_value(), "templates",
                   "is missing: the folder of the engine's input files");
  problems.Require(!command.empty() && !command.front().empty(), "command",
                   "must name a program and its arguments, such as [\"liggghts\", \"-in\", "
                   "\"in.heap\"]");
  problems.Require(IsInside(result) && IsInside(ResultPath()), "result",
                   "must be a file in the trial's folder, such as \"heap.*\"");
  const std::string pattern = ResultPath();
  for (const std::string_view own : rigs::kNeverAResult) {
    problems.Require(::fnmatch(pattern.c_str(), std::string(own).c_str(), FNM_PERIOD) != 0,
                     "result",
                     "fits " + std::string(own) +
                         ", which talus itself writes there; name the result more closely, such as "
                         "\"heap.*\"");
  }
  constexpr int kMostRanks = 10000;
  problems.RequireFromTo("ranks", ranks, 1, kMostRanks);
  problems.Require(!length_unit || *length_unit > 0, "length_unit", length_unit.value_or(0),
                   "must be positive");
}

}  // namespace talus::trials
