#include "experiments/campaign/mended_engine.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/problems.h"
#include "base/text/counted.h"
#include "experiments/trials/engines/template_folder.h"

namespace talus::campaign {

bool HasTold(const journal::TrialRecord& trial) {
  return trial.status == journal::TrialStatus::kOk &&
         std::ranges::any_of(trial.metrics, [](const journal::MetricRecord& metric) {
           return metric.undefined.empty();
         });
}

bool TakeMendedTemplates(std::span<const journal::TrialRecord> trials, CampaignSpec& spec) {
  trials::CommandOptions& engine = spec.engine.command;
  if (spec.engine.kind != EngineKind::kCommand ||
      !std::filesystem::is_directory(engine.templates.value())) {
    return false;
  }
  const std::string hash = trials::TemplateFolder(*engine.templates).Hash();
  if (hash == engine.templates_hash) return false;
  const std::string templates = engine.templates->string();
  if (const auto count = std::ranges::count_if(trials, HasTold); count > 0) {
    throw base::ConfigError(templates + ": the templates are not those that " +
                            base::Counted(count, "trial") +
                            " of the campaign succeeded with; put them back, or begin another "
                            "campaign with these");
  }
  base::Problems problems(templates, {});
  CheckTemplates(spec, problems);
  problems.ThrowIfAny();
  engine.templates_hash = hash;
  return true;
}

bool AllowMendedEngine(std::span<const journal::TrialRecord> trials,
                       std::vector<base::JsonChange>& forbidden) {
  if (std::ranges::any_of(trials, HasTold)) return false;
  const auto num_mended = std::erase_if(forbidden, [](const base::JsonChange& change) {
    return change.path.starts_with("engine.") && change.path != "engine.kind";
  });
  return num_mended > 0;
}

}  // namespace talus::campaign
