// Anybody's engine: fills its templates, runs its command, reads the spheres or the image it
// leaves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/trials/engines/command_options.h"
#include "experiments/trials/engines/template_folder.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::trials {

// What Prepare makes of files that an attempt without an end, or another case, has left: in a
// folder of the user's some may be the user's own. To keep them it needs a folder that is there.
enum class FormerFiles { kRemove, kKeep };

class CommandEngine : public TrialEngine {
 public:
  // Throws ConfigError when the templates cannot be read or are not those of `options`' hash.
  explicit CommandEngine(const CommandOptions& options, FormerFiles former = FormerFiles::kRemove);

  void Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  bool IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::vector<std::string> Command(const std::filesystem::path& folder) override;
  // Whether a command has been prepared there.
  static bool HasPrepared(const std::filesystem::path& folder);
  bool IsComplete(const std::filesystem::path& folder) override;
  void Forget(const std::filesystem::path& folder) override;
  // What is refused is forgotten.
  TrialOutput Collect(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::optional<std::string> WhyNotTaken(const rigs::Case& rig_case,
                                         const std::filesystem::path& from) override;
  bool TakeOver(const rigs::Case& rig_case, const std::filesystem::path& from,
                const std::filesystem::path& to) override;

 private:
  CommandOptions options_;
  TemplateFolder templates_;
  FormerFiles former_;
};

// A parameter, and the cases at either end of its range.
struct SearchedParameter {
  std::string name;
  rigs::Case low;
  rigs::Case high;
};

// What can be known to be wrong before anything runs: unknown placeholders, a searched parameter
// that nothing uses, and, unless `elsewhere` (a cluster's nodes), a program that is not there.
struct CommandCheck {
  const rigs::Case& rig_case;  // any of the campaign
  std::vector<SearchedParameter> searched;
  bool elsewhere = false;
};
void CheckCommand(const CommandOptions& options, const CommandCheck& check,
                  base::Problems& problems);

}  // namespace talus::trials
