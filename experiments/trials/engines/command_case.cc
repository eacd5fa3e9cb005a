#include "experiments/trials/engines/command_case.h"

#include <utility>

#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/rigs/load_case.h"
#include "experiments/trials/engines/command_engine.h"
#include "experiments/trials/engines/template_folder.h"

namespace talus::trials {

std::string CaseText(const CommandCase& command_case) {
  return base::JsonText(base::ToJson(command_case), 2) + "\n";
}

CommandCase LoadCommandCase(const base::JsonFile& file) {
  auto command_case = base::LoadOptions<CommandCase>(file);
  auto& [heap, engine] = command_case;
  rigs::CompleteCase(heap);
  base::Problems problems(file.path.string(), file.places);
  rigs::ValidateCase(heap, problems);
  problems.Require(heap.frame || heap.rig.kind != rigs::RigKind::kLiftedTube, "frame",
                   "is missing: the result is measured in it");
  problems.Within("engine", [&] {
    CheckCommand(engine, {.rig_case = heap, .calibrated = {}, .elsewhere = false}, problems);
  });
  problems.ThrowIfAny();
  if (engine.templates_hash.empty()) {
    engine.templates_hash = TemplateFolder(engine.templates.value()).Hash();
  }
  return command_case;
}

rigs::Case LoadAnyCase(const std::filesystem::path& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  if (!file.root.is_object() || !file.root.contains("engine")) return rigs::LoadCase(file);
  return rigs::Completed(base::LoadOptions<CommandCase>(file).heap, file);
}

std::optional<CommandOptions> EngineOfCase(const std::filesystem::path& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  if (!file.root.is_object() || !file.root.contains("engine")) return std::nullopt;
  return base::LoadOptions<CommandCase>(file).engine;
}

}  // namespace talus::trials
