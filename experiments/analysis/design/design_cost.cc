#include "experiments/analysis/design/design_cost.h"

#include <vector>

#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "experiments/analysis/design/rank_designs.h"
#include "experiments/campaign/plan/estimate.h"
#include "experiments/trials/simulate/run_log.h"

namespace talus::analysis {
namespace {

// What can be simulated, as the experiments of one campaign at the scale factor of the plan.
campaign::CampaignSpec SpecOfAll(const campaign::JointView& view,
                                 const std::vector<TestCandidate>& tests) {
  campaign::CampaignSpec all = view.spec;
  all.coarse_graining.scale_factors = {{all.coarse_graining.Levels().front()}};
  all.experiment.reset();
  std::vector<campaign::ExperimentSpec>& experiments = all.experiments.emplace();
  for (const TestCandidate& test : tests) {
    if (!WhyNot(view, test).empty()) continue;
    experiments.push_back(campaign::ExperimentsOf(SpecOf(view, test)).front());
  }
  return all;
}

}  // namespace

std::string DesignCostText(const DesignSpec& design) {
  const campaign::CampaignSpec all = SpecOfAll(ViewOf(design, {}), design.candidates);
  const std::vector<campaign::ExperimentSpec>& experiments = *all.experiments;
  std::string text = "  candidates        " + std::to_string(design.candidates.size()) + "\n";
  if (experiments.empty()) return text;
  double seconds = 0;
  for (const campaign::TrialEstimate& trial : campaign::EstimateTrials(all).trials) {
    seconds += kDesignSimulations * trial.core_seconds;
    text += "    " + experiments[static_cast<std::size_t>(trial.experiment)].name + ": " +
            std::to_string(trial.num_grains) + " grains of " +
            base::ShortNumber(1e3 * trial.mean_diameter) + " mm, " +
            trials::DurationText(trial.core_seconds) + " of a core\n";
  }
  return text + "  time              " + base::Counted(kDesignSimulations, "simulation") +
         " of each, about " + trials::DurationText(seconds) + " of core time in all\n";
}

}  // namespace talus::analysis
