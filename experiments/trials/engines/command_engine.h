// Anybody's engine: fills its templates, runs its command, reads the spheres or the image it
// leaves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json/json_file.h"
#include "experiments/trials/engines/command_options.h"
#include "experiments/trials/engines/template_folder.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::trials {

class CommandEngine : public TrialEngine {
 public:
  // Throws ConfigError when the templates cannot be read or are not those of `options`' hash.
  explicit CommandEngine(const CommandOptions& options);

  void Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::vector<std::string> Command(const std::filesystem::path& folder) override;
  bool IsComplete(const std::filesystem::path& folder) override;
  TrialOutput Collect(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::optional<std::string> WhyNotTaken(const rigs::Case& rig_case,
                                         const std::filesystem::path& from) override;
  bool TakeOver(const rigs::Case& rig_case, const std::filesystem::path& from,
                const std::filesystem::path& to) override;

 private:
  CommandOptions options_;
  TemplateFolder templates_;
};

// What can be known to be wrong before anything runs: unknown placeholders, ones of `calibrated`
// that nothing uses, and, unless `elsewhere` (a cluster's nodes), a program that is not there.
struct CommandCheck {
  const rigs::Case& rig_case;  // any of the campaign
  std::vector<std::string> calibrated;
  bool elsewhere = false;
};
void CheckCommand(const CommandOptions& options, const CommandCheck& check,
                  base::Problems& problems);

// A case.json of such an engine: that of a heap test with one more key, `engine`.
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

CommandCase LoadCommandCase(const base::JsonFile& file);

// `talus simulate` for a file of this kind: the whole trial in `folder`, which is new, empty or the
// same case's; `fresh` runs it again where it is complete. Throws base::Error with the reason when
// it fails.
void SimulateCommandCase(const CommandCase& command_case, const std::filesystem::path& folder,
                         bool fresh);

}  // namespace talus::trials
