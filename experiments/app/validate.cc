// talus validate
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "experiments/app/commands.h"
#include "experiments/campaign/console.h"
#include "experiments/campaign/estimate.h"
#include "experiments/campaign/start.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"

namespace talus::experiments {
namespace {

void PrintExperiment(const ExperimentRecord& e, const CampaignRecord& record) {
  std::cout << "  experiment        " << (record.experiments.size() > 1 ? e.name + ": " : "")
            << "NEBP " << NumberText4(e.nebp_px) << " px";
  if (e.noise_mm2) std::cout << ", noise floor " << NumberText4(*e.noise_mm2) << " mm²";
  for (const ScalarRecord& s : e.scalars) {
    std::cout << ", " << s.name << " " << NumberText4(s.value) << " ± "
              << NumberText4(s.standard_error);
  }
  std::cout << '\n';
}

// Where a warning holds, in campaigns with several of such places.
std::string At(const CampaignSpec& spec, const std::string& experiment, double scale_factor) {
  if (!spec.IsJoint()) return "";
  return experiment + " at scale factor " + NumberText4(scale_factor) + ": ";
}

void Validate(const std::string& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  const CampaignSpec spec = ReadCampaignSpec(file);
  const CampaignRecord record = MakeRecord(spec, file);
  std::cout << path << ": is in order\n  searched         ";
  for (const ParameterRecord& p : record.parameters) {
    std::cout << ' ' << p.name << " in " << NumberText4(p.low) << " … " << NumberText4(p.high)
              << (p.unit.empty() ? "" : " " + p.unit) << ';';
  }
  std::cout << " minimising " << record.objective << '\n';
  for (const ExperimentRecord& e : record.experiments) PrintExperiment(e, record);
  std::cout << std::flush;
  if (spec.engine.kind == EngineKind::kTalus) {
    std::cout << EstimateText(spec, EstimateCampaign(spec));
  }
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    for (const double factor : spec.coarse_graining.Levels()) {
      for (const std::string& warning :
           HeapWarnings(TypicalCase(spec, static_cast<int>(e), factor))) {
        std::cout << "  warning: " << At(spec, record.experiments[e].name, factor) << warning
                  << '\n';
      }
    }
  }
}

}  // namespace

void AddValidateCommand(CLI::App& app) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "validate", "Every problem of a campaign's spec at once, or what the campaign will cost");
  command->add_option("SPEC", *path, "the campaign as a JSON file")->required();
  command->callback([path] { Validate(*path); });
}

}  // namespace talus::experiments
