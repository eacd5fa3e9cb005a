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

void Validate(const std::string& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  const CampaignSpec spec = ReadCampaignSpec(file);
  const CampaignRecord record = MakeRecord(spec, file);
  std::cout << path << ": is in order\n  searched         ";
  for (const ParameterRecord& p : record.parameters) {
    std::cout << ' ' << p.name << " in " << NumberText4(p.low) << " … " << NumberText4(p.high)
              << (p.unit.empty() ? "" : " " + p.unit) << ';';
  }
  std::cout << " minimising " << record.objective << "\n  experiment        NEBP "
            << NumberText4(record.nebp_px) << " px";
  if (record.noise_mm2) std::cout << ", noise floor " << NumberText4(*record.noise_mm2) << " mm²";
  std::cout << std::endl;
  if (spec.engine.kind == EngineKind::kTalus) std::cout << EstimateText(EstimateCampaign(spec));
  for (const std::string& warning : HeapWarnings(TypicalCase(spec))) {
    std::cout << "  warning: " << warning << '\n';
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
