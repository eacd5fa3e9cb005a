#include "experiments/analysis/next/planned_view.h"

#include "experiments/campaign/start.h"

namespace talus::analysis {

campaign::JointView PlannedView(const campaign::CampaignSpec& spec,
                                const std::filesystem::path& folder) {
  campaign::JointView view{.folder = {folder},
                           .spec = spec,
                           .record = {},
                           .references = {},
                           .space = campaign::SpaceOf(spec),
                           .trials = {}};
  view.record.parameters = campaign::SearchedParameters(spec);
  return view;
}

}  // namespace talus::analysis
