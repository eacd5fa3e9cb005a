// A case.json of another engine: that of a bulk test with one more key, `engine`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/json/json_file.h"
#include "base/problems.h"
#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/command_options.h"

namespace talus::trials {

struct CommandCase {
  rigs::Case heap;
  CommandOptions engine;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    rigs::Case::Visit(self.heap, visit);
    visit("engine", self.engine,
          {.required = true, .doc = "another engine: its templates, command and result"});
  }
  void Validate(base::Problems& problems) const { heap.Validate(problems); }
};

// The case as a case.json that needs no other file but the templates.
std::string CaseText(const CommandCase& command_case);

// Reads, completes and validates a case with all that can be known of its command, and notes which
// templates it has, which may have been moved together with it; throws one ConfigError with
// everything that is wrong.
CommandCase LoadCommandCase(const base::JsonFile& file);

// The bulk test of a case.json, whatever simulates it: the engine is neither looked for nor
// checked. Throws as rigs::LoadCase does.
rigs::Case LoadAnyCase(const std::filesystem::path& path);

// The other engine of a case.json; nothing where it is ours.
std::optional<CommandOptions> EngineOfCase(const std::filesystem::path& path);

}  // namespace talus::trials
