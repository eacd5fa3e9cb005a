#include "experiments/trials/engines/command_case.h"

#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/rigs/load_case.h"
#include "experiments/trials/engines/command_engine.h"
#include "experiments/trials/engines/template_folder.h"

namespace talus::trials {

namespace {

namespace fs = std::filesystem;

bool HasHash(const fs::path& folder, const std::string& hash) {
  try {
    return TemplateFolder(folder).Hash() == hash;
  } catch (const base::ConfigError&) {
    return false;  // a folder of the same name that holds no templates at all
  }
}

// A trial's case has its templates by their absolute path. Where campaign and templates have been
// moved together, they still lie beside one of the folders that the case is in, and their hash
// tells that they are the same. Left as it is where they are not found.
void FollowMovedTemplates(const fs::path& case_file, CommandOptions& engine) {
  if (!engine.templates || engine.templates_hash.empty() || fs::is_directory(*engine.templates)) {
    return;
  }
  std::vector<fs::path> tails;  // "deck", "project/deck", …
  for (fs::path above = *engine.templates; above.has_relative_path(); above = above.parent_path()) {
    if (!above.has_filename()) continue;  // "deck/"
    tails.push_back(tails.empty() ? above.filename() : above.filename() / tails.back());
  }
  fs::path place = fs::absolute(case_file).lexically_normal().parent_path();
  for (; place.has_relative_path(); place = place.parent_path()) {
    for (const fs::path& tail : tails) {
      if (!fs::is_directory(place / tail) || !HasHash(place / tail, engine.templates_hash))
        continue;
      engine.templates = place / tail;
      return;
    }
  }
}

// A campaign's `engine` pasted into a case says its kind, of which a case has one only.
base::JsonFile WithoutKind(base::JsonFile file) {
  if (!file.root.is_object() || !file.root.contains("engine")) return file;
  auto& engine = file.root["engine"];
  if (engine.is_object() && engine.contains("kind") && engine["kind"] == "command") {
    engine.erase("kind");
  }
  return file;
}

}  // namespace

std::string CaseText(const CommandCase& command_case) {
  return base::JsonText(base::ToJson(command_case), 2) + "\n";
}

CommandCase LoadCommandCase(const base::JsonFile& file) {
  auto command_case = base::LoadOptions<CommandCase>(WithoutKind(file));
  rigs::Case& heap = command_case.heap;
  CommandOptions& engine = command_case.engine;
  FollowMovedTemplates(file.path, engine);
  rigs::CompleteCase(heap);
  base::Problems problems(file.path.string(), file.places);
  rigs::ValidateCase(heap, problems);
  problems.Within("engine", [&] {
    CheckCommand(engine, {.rig_case = heap, .searched = {}, .elsewhere = false}, problems);
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
  return rigs::Completed(base::LoadOptions<CommandCase>(WithoutKind(file)).heap, file);
}

std::optional<CommandOptions> EngineOfCase(const std::filesystem::path& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  if (!file.root.is_object() || !file.root.contains("engine")) return std::nullopt;
  return base::LoadOptions<CommandCase>(WithoutKind(file)).engine;
}

}  // namespace talus::trials
