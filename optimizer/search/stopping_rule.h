// When a search ends by itself. Each rule answers with its reason, or with nothing while the search
// should go on. A campaign's budget ends it at the latest (campaign/plan/planner.h).
//
//   one objective, noisy      StopByGain: what is left to gain is small against the noise
//   one objective, exact      StopByExactGain: … against the values seen
//   several grain sizes       StopByShare: the surrogate knows the images better than the
//   or experiments            experiments do
#pragma once

#include <optional>

#include "optimizer/stop_reason.h"

namespace talus::optimizer {

// `gain`: what going on could improve the best value by, at most. `noise`: standard deviation of
// one evaluation, same unit.
std::optional<StopReason> StopByGain(double gain, double noise, double stop_multiple);

// `typical`: mean of the values less the lowest.
std::optional<StopReason> StopByExactGain(double gain, double typical);

// `share`: the surrogate's variance over the posterior, as a share of what the experiments' own
// errors leave open [-]. `temper`: by how much the variance had to be raised until the trials, each
// left out in turn, were covered; a model that needs much does not know how little it knows.
struct SurrogateShare {
  double share = 0;
  double temper = 1;
};
std::optional<StopReason> StopByShare(const SurrogateShare& now, double stop_share);

// Nothing where the rule is met. The variance of a mean of n falls as 1/n, so `num_told`
// evaluations become share/stop_share times as many: told up to 20 times more, of no temper.
std::optional<StopShortfall> ShortOfShare(const SurrogateShare& now, double stop_share,
                                          int num_told);

}  // namespace talus::optimizer
