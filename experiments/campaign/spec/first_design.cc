#include "experiments/campaign/spec/first_design.h"

#include "optimizer/designs/posterior_design.h"

namespace talus::campaign {

int DesignSets(const CampaignSpec& spec) {
  if (spec.HasOwnProposer()) return 0;
  return optimizer::PosteriorDesignSize(SpaceOf(spec).MakeDomain(), spec.strategy.num_initial);
}

int FirstSimulations(const CampaignSpec& spec) {
  if (spec.HasOwnProposer()) return spec.noise.replicates;
  const auto finer = static_cast<int>(spec.coarse_graining.Levels().size()) - 1;
  const int sets = DesignSets(spec) + optimizer::kFewestFinerSets * finer;
  return spec.noise.replicates +
         static_cast<int>(ExperimentsOf(spec).size()) * sets * spec.replicates;
}

}  // namespace talus::campaign
