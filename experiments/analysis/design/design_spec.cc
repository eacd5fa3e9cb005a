#include "experiments/analysis/design/design_spec.h"

#include <utility>

#include "base/json/json_reader.h"
#include "base/text/name.h"
#include "experiments/analysis/next/planned_view.h"
#include "experiments/analysis/next/usual_tests.h"
#include "experiments/campaign/earlier_posterior.h"
#include "experiments/campaign/spec/ignored_keys.h"
#include "experiments/campaign/start.h"
#include "experiments/rigs/load_case.h"

namespace talus::analysis {
namespace {

// The device that the spec names, as a test that could be made.
constexpr const char* kOwnTest = "heap";

// Campaigns and tests are validated as what they become: an experiment without data.
void GiveExperiment(campaign::CampaignSpec& spec) {
  campaign::ExperimentSpec own;
  own.name = kOwnTest;
  spec.experiments = {std::move(own)};
}

void ValidateDesign(DesignSpec& design, base::Problems& problems) {
  base::TreeValidator(problems).Check(design);
  if (!problems.empty()) return;
  GiveExperiment(design.campaign);
  design.campaign.Validate(problems);
  if (!problems.empty()) return;
  campaign::SpaceOf(design.campaign).Validate(problems);
  for (const double factor : design.campaign.coarse_graining.Levels()) {
    if (problems.empty()) {
      rigs::ValidateCase(campaign::TypicalCase(design.campaign, 0, factor), problems);
    }
  }
}

}  // namespace

void DesignSpec::Validate(base::Problems& problems) const {
  const bool has_data = campaign.experiment || campaign.experiments;
  problems.Require(!has_data, campaign.experiment ? "experiment" : "experiments",
                   "is measured already: leave it out, or ask `talus next` what to add to it");
  problems.Require(!campaign.hold_out, "hold_out", "says nothing before there is data; remove it");
  ValidateNames(candidates, problems);
}

DesignSpec LoadDesignSpec(const std::filesystem::path& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  DesignSpec design;
  base::Problems problems(file.path.string(), file.places);
  base::ReadOptions(file.root, design,
                    {problems, std::filesystem::absolute(file.path).parent_path()});
  campaign::CampaignSpec& spec = design.campaign;
  if (spec.name.empty()) spec.name = base::OneLine(file.path.stem().string());
  if (!spec.parameters) spec.parameters = campaign::UsualRanges(spec.models.adhesion);
  campaign::RefuseIgnoredKeys(file, spec, problems);
  problems.ThrowIfAny();
  engine::ReadSizeFile(spec.powder.sizes);
  ValidateDesign(design, problems);
  problems.ThrowIfAny();
  campaign::TakePosteriors(spec, nullptr, problems);
  problems.ThrowIfAny();
  spec.coarse_graining.scale_factor = spec.coarse_graining.Levels().back();
  campaign::CompleteEngine(spec, problems);
  problems.ThrowIfAny();
  if (!design.candidates.empty()) return design;
  design.candidates = UsualTests(ViewOf(design, {}));
  design.candidates.insert(design.candidates.begin(), TestCandidate{.name = kOwnTest});
  return design;
}

campaign::JointView ViewOf(const DesignSpec& design, const std::filesystem::path& folder) {
  return PlannedView(design.campaign, folder);
}

}  // namespace talus::analysis
