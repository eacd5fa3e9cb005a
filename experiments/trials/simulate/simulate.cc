#include "experiments/trials/simulate/simulate.h"

#include <optional>
#include <utility>

#include "base/error.h"
#include "engine/run/scene_run.h"
#include "engine/scene/scene_json.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_run.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/simulate/film.h"
#include "experiments/trials/simulate/simulate_command.h"

namespace talus::trials {
namespace {

void RefuseFilm(const base::JsonFile& input, const SimulateOptions& options) {
  if (options.film.empty()) return;
  throw base::ConfigError(input.path.string() +
                          ": --film is for the case of a bulk test simulated by this program; a "
                          "scene writes states (outputs.times), which ParaView plays");
}

void SimulateScene(base::JsonFile input, const SimulateOptions& all) {
  RefuseFilm(input, all);
  const RunFolderOptions& options = all.run;
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

void SimulateTest(base::JsonFile input, const SimulateOptions& all) {
  const RunFolderOptions& options = all.run;
  const rigs::Case rig_case = rigs::LoadCase(input);
  std::optional<Film> film;
  std::string lost;
  if (!all.film.empty()) {
    ClaimFilm(all.film);
    film.emplace(all.film, rig_case, FilmSize{});
  } else if (rig_case.outputs.film) {
    film.emplace(options.folder / kTrialFilmName, rig_case, kTrialFilm);
    lost = "the film begins there: what came before was not kept";
  }
  RunJob job{.kind = std::string(base::NameOf(rig_case.rig.kind)),
             .input_hash = rigs::CaseHash(rig_case),
             .source = input.path,
             .input_name = rigs::kCaseFile,
             .input = rigs::CaseText(rig_case),
             .checkpoint_interval = rig_case.checkpoint_interval,
             .start = [&] { return std::make_unique<rigs::RigRun>(rig_case, options.folder); },
             .go_on =
                 [&](const engine::RunCheckpoint& checkpoint) {
                   return std::make_unique<rigs::RigRun>(rig_case, options.folder, checkpoint);
                 }};
  job.from_start = !all.film.empty();  // a film begins with the filling
  if (film) {
    job.look = [&](const engine::Run& run) { film->Look(static_cast<const rigs::RigRun&>(run)); };
    job.write = [&] { film->Write(); };
    job.lost_at_checkpoint = lost;
  }
  DriveRun(job, options);
}

void SimulateCommand(base::JsonFile input, const SimulateOptions& options) {
  RefuseFilm(input, options);
  const auto& [folder, fresh, quiet] = options.run;
  SimulateCommandCase(LoadCommandCase(input),
                      {.folder = folder, .fresh = fresh, .quiet = quiet, .source = input.path});
}

constexpr InputKind kKinds[] = {
    {"engine", "a case of another engine", &SimulateCommand},  // has "powder" too
    {"powder", "a case of a bulk test", &SimulateTest},
    {"materials", "a scene", &SimulateScene},
};

}  // namespace

void Simulate(const std::filesystem::path& input, const SimulateOptions& options) {
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
