#include "experiments/analysis/export/paraview.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/text/number_text.h"
#include "engine/run/state_file.h"
#include "experiments/analysis/export/wall_mesh.h"
#include "experiments/campaign/answer/standing_answer.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/engines/command_result.h"
#include "experiments/trials/engines/tube_numbers.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

// How far a trial's numbers are off what was measured, in squared standard errors; farther than any
// where it has not all of them.
double MisfitOfNumbers(const journal::ExperimentRecord& experiment,
                       const journal::TrialRecord& trial) {
  double sum = 0;
  for (const journal::ScalarRecord& measured : experiment.scalars) {
    const std::optional<double> value = trial.Metric(measured.name);
    if (!value) return std::numeric_limits<double>::max();
    const double error = measured.standard_error > 0 ? measured.standard_error : 1;
    sum += std::pow((*value - measured.value) / error, 2);
  }
  return sum;
}

// The first trial that confirms the recommended set, else the best of the first experiment.
std::int64_t TrialToShow(const fs::path& campaign) {
  const std::optional<campaign::Answer> answer = campaign::StandingAnswer(campaign);
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(campaign));
  const journal::CampaignRecord record = journal.Campaign();
  const campaign::CampaignSpec spec = campaign::ParseSpecText(record.spec_json);
  const std::vector<campaign::Reference> references = campaign::ReferencesOf(record, spec);
  std::optional<std::int64_t> best;
  double least = 0;
  for (const journal::TrialRecord& trial : journal.Trials()) {
    if (trial.status != journal::TrialStatus::kOk || trial.experiment != 0) continue;
    const bool confirms = trial.kind == journal::TrialKind::kConfirm;
    if (confirms && answer && IsRecommended(*answer, trial.native)) return trial.id;
    if (trial.scale_factor != spec.coarse_graining.scale_factor) continue;
    const campaign::Reference& reference = references[static_cast<std::size_t>(trial.experiment)];
    const double value =
        reference.has_image()
            ? reference.Value(trial).value_or(std::numeric_limits<double>::infinity())
            : MisfitOfNumbers(record.experiments.front(), trial);
    if (!std::isfinite(value)) continue;  // an angle that is not defined, say
    if (best && value >= least) continue;
    best = trial.id;
    least = value;
  }
  if (!best) throw base::Error(campaign.string() + ": no trial has succeeded yet");
  return *best;
}

// Walls where the grains came to rest: a tube was lifted off by then, and gates were opened. What
// else moves stands where it began.
std::vector<engine::Wall> WallsOf(const rigs::Case& rig_case, double top) {
  const rigs::RigEntry& entry = rigs::EntryOf(rig_case);
  std::vector<engine::Wall> walls =
      entry.walls(rig_case, rigs::FilledHeight(rig_case, entry.vessel(rig_case)));
  std::erase_if(walls, rigs::IsGate);
  if (rig_case.rig.kind != rigs::RigKind::kLiftedTube) return walls;
  for (engine::Wall& wall : walls) {
    if (auto* tube = std::get_if<engine::OpenCylinder>(&wall.shape)) tube->base.z = top;
  }
  return walls;
}

std::string Quoted(const std::string& text) { return base::JsonText(nlohmann::json(text)); }

// The text of a state in ParaView's Python; docs/notebooks.md says how to open it.
std::string StateText(const fs::path& folder, const std::vector<engine::Wall>& walls, double top) {
  std::string text =
      "# Opens a heap with what it stands on in ParaView: paraview --state=state.py, or File, "
      "Load State.\n"
      "from paraview.simple import *\n\n"
      "FOLDER = " +
      Quoted(fs::absolute(folder).string()) +
      "\n"
      "view = GetActiveViewOrCreate(\"RenderView\")\n"
      "heap = XMLPolyDataReader(registrationName=\"heap\", FileName=[FOLDER + \"/heap.vtp\"])\n"
      "height = Elevation(registrationName=\"height\", Input=heap)\n"
      "height.LowPoint = [0.0, 0.0, 0.0]\n"
      "height.HighPoint = [0.0, 0.0, " +
      base::ExactNumber(top) +
      "]\n"
      "height.ScalarRange = [0.0, " +
      base::ExactNumber(1e3 * top) +
      "]  # mm\n"
      "grains = Glyph(registrationName=\"grains\", Input=height, GlyphType=\"Sphere\")\n"
      "grains.ScaleArray = [\"POINTS\", \"diameter_m\"]\n"
      "grains.ScaleFactor = 1.0\n"
      "grains.GlyphMode = \"All Points\"\n"
      "shown = Show(grains, view)\n"
      "ColorBy(shown, (\"POINTS\", \"Elevation\"))\n"
      "colors = GetColorTransferFunction(\"Elevation\")\n"
      "colors.ApplyPreset(\"Viridis (matplotlib)\", True)\n"
      "bar = GetScalarBar(colors, view)\n"
      "bar.Title = \"height in mm\"\n"
      "bar.ComponentTitle = \"\"\n"
      "bar.TitleFontSize = bar.LabelFontSize = 10\n"
      "bar.ScalarBarLength = 0.25\n"
      "bar.AutomaticLabelFormat = 0\n"
      "bar.LabelFormat = bar.RangeLabelFormat = \"%.1f\"\n"
      "shown.SetScalarBarVisibility(view, True)\n\n"
      "for name, color, opacity in (\n";
  for (const engine::Wall& wall : walls) {
    text += "    (" + Quoted(wall.name) +
            (wall.material == rigs::kFloor ? ", [0.35, 0.38, 0.42], 1.0),\n"
                                           : ", [0.55, 0.70, 0.85], 0.25),\n");
  }
  return text +
         "):\n"
         "    wall = XMLPolyDataReader(registrationName=name, FileName=[FOLDER + \"/\" + name + "
         "\".vtp\"])\n"
         "    drawn = Show(wall, view)\n"
         "    drawn.DiffuseColor = color\n"
         "    drawn.Opacity = opacity\n\n"
         "view.CameraPosition = [0.0, -1.0, 0.4]\n"
         "view.CameraFocalPoint = [0.0, 0.0, 0.0]\n"
         "view.CameraViewUp = [0.0, 0.0, 1.0]\n"
         "ResetCamera(view)\n"
         "Render(view)\n";
}

bool HasHeaps(const fs::path& campaign) {
  const campaign::CampaignFolder folder{campaign};
  std::error_code absent;
  for (const auto& trial : fs::directory_iterator(folder.trial(1).parent_path(), absent)) {
    if (fs::exists(trial.path() / rigs::kHeapFile)) return true;
  }
  return false;
}

}  // namespace

fs::path ExportVtk(const VtkExport& request) {
  const std::int64_t id = request.trial ? *request.trial : TrialToShow(request.campaign);
  const fs::path trial = campaign::CampaignFolder{request.campaign}.trial(id);
  const fs::path heap = trial / rigs::kHeapFile;
  if (!fs::exists(heap)) {
    throw base::ConfigError(heap.string() + ": is not there; " +
                            (HasHeaps(request.campaign)
                                 ? "--trial names another trial (`talus export` lists them)"
                                 : "no trial here has left spheres, as of a deck that leaves "
                                   "numbers or images alone"));
  }
  const rigs::Case rig_case = trials::LoadAnyCase(trial / rigs::kCaseFile);
  const std::vector<base::Sphere> grains = trials::HeapOfTrial(trial);
  double top = 0;
  for (const base::Sphere& grain : grains) top = std::max(top, grain.position.z + grain.radius);
  base::ClaimOutputFolder(request.out, "export");
  const auto engine = trials::EngineOfCase(trial / rigs::kCaseFile);
  const bool is_ours = !engine || !trials::HasLeftHeapVtp(*engine, trial);
  base::WriteFileAtomically(
      request.out / rigs::kHeapFile,
      is_ours ? base::ReadFile(heap) : engine::VtpOf(trials::ParticlesOf(grains), 0));
  std::vector<engine::Wall> walls = WallsOf(rig_case, top);
  std::erase_if(walls, [](const engine::Wall& w) { return MeshOf(w.shape).polygons.empty(); });
  for (const engine::Wall& wall : walls) {
    WallMesh mesh = MeshOf(wall.shape);
    for (base::Vec3& point : mesh.points) point.z -= rigs::HeapBase(rig_case);
    base::WriteFileAtomically(request.out / (wall.name + ".vtp"), VtpOf(mesh));
  }
  const fs::path state = request.out / "state.py";
  base::WriteFileAtomically(state, StateText(request.out, walls, top));
  return state;
}

}  // namespace talus::analysis
