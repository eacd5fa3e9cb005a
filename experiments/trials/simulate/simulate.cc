#include "experiments/trials/simulate/simulate.h"

#include <utility>

#include "base/error.h"
#include "engine/run/scene_run.h"
#include "engine/scene/scene_json.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_run.h"
#include "experiments/trials/engines/command_engine.h"

namespace talus::trials {
namespace {

void SimulateScene(base::JsonFile input, const RunFolderOptions& options) {
  const std::filesystem::path source = input.path;
  const engine::LoadedScene loaded = engine::LoadScene(std::move(input));
  const RunJob job{
      .kind = "scene",
      .input_hash = engine::SceneHash(loaded.spec),
      .source = source,
      .input_name = "scene.json",
      .input = engine::SceneText(loaded.spec),
      .checkpoint_interval = loaded.spec.checkpoint_interval,
      .start =
          [&] {
            return std::make_unique<engine::SceneRun>(loaded.spec, loaded.scene, options.folder);
          },
      .go_on =
          [&](const engine::RunCheckpoint& checkpoint) {
            return std::make_unique<engine::SceneRun>(loaded.spec, options.folder, checkpoint);
          }};
  DriveRun(job, options);
}

void SimulateTest(base::JsonFile input, const RunFolderOptions& options) {
  const rigs::Case rig_case = rigs::LoadCase(input);
  const RunJob job{
      .kind = std::string(base::NameOf(rig_case.rig.kind)),
      .input_hash = rigs::CaseHash(rig_case),
      .source = input.path,
      .input_name = "case.json",
      .input = rigs::CaseText(rig_case),
      .checkpoint_interval = rig_case.checkpoint_interval,
      .start = [&] { return std::make_unique<rigs::RigRun>(rig_case, options.folder); },
      .go_on =
          [&](const engine::RunCheckpoint& checkpoint) {
            return std::make_unique<rigs::RigRun>(rig_case, options.folder, checkpoint);
          }};
  DriveRun(job, options);
}

void SimulateCommand(base::JsonFile input, const RunFolderOptions& options) {
  SimulateCommandCase(LoadCommandCase(input), options.folder, options.fresh);
}

constexpr InputKind kKinds[] = {
    {"engine", "a case of another engine", &SimulateCommand},  // has "powder" too
    {"powder", "a case of a bulk test", &SimulateTest},
    {"materials", "a scene", &SimulateScene},
};

}  // namespace

void Simulate(const std::filesystem::path& input, const RunFolderOptions& options) {
  base::JsonFile file = base::ReadJsonFile(input);
  std::string known;
  for (const InputKind& kind : kKinds) {
    if (file.root.is_object() && file.root.contains(kind.key)) {
      return kind.run(std::move(file), options);
    }
    known += std::string(known.empty() ? "" : "; ") + kind.what + " has \"" + kind.key + "\"";
  }
  throw base::ConfigError(input.string() + ": is nothing that can be simulated: " + known);
}

}  // namespace talus::trials
