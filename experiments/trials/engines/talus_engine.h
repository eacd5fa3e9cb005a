// Our own engine: `talus simulate case.json`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/trials/engines/trial_engine.h"

namespace talus::trials {

class TalusEngine : public TrialEngine {
 public:
  // `program` is the talus to run; this one itself by default.
  explicit TalusEngine(std::filesystem::path program = ThisProgram());

  void Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  bool IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::vector<std::string> Command(const std::filesystem::path& folder) override;
  bool IsComplete(const std::filesystem::path& folder) override;
  TrialOutput Collect(const rigs::Case& rig_case, const std::filesystem::path& folder) override;
  std::optional<std::string> WhyNotTaken(const rigs::Case& rig_case,
                                         const std::filesystem::path& from) override;
  bool TakeOver(const rigs::Case& rig_case, const std::filesystem::path& from,
                const std::filesystem::path& to) override;

  static std::filesystem::path ThisProgram();

 private:
  std::filesystem::path program_;
};

}  // namespace talus::trials
