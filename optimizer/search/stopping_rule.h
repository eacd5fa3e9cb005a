// When a search ends by itself. Each rule answers with its reason, or with nothing while the search
// should go on. A campaign's budget ends it at the latest (campaign/plan/planner.h).
//
//   one objective, noisy      StopByGain: what is left to gain is small against the noise
//   one objective, exact      StopByExactGain: … against the design's values
//   several grain sizes       StopByOutlook: no number of them would narrow the ranges much
//   or experiments
#pragma once

#include <optional>
#include <vector>

#include "optimizer/stop_reason.h"

namespace talus::optimizer {

// `gain`: what going on could improve the best value by, at most. `noise`: standard deviation of
// one evaluation, same unit.
std::optional<StopReason> StopByGain(double gain, double noise, double stop_multiple);

// `typical`: lower quartile of the design's values less the lowest of all.
std::optional<StopReason> StopByExactGain(double gain, double typical);

// What more evaluations can do to the ranges of what is asked for: the share of its width that each
// is expected to lose [-].
struct Outlook {
  std::vector<double> again{};  // to half as many evaluations again
  std::vector<double> all{};    // to any number of them
  // By how much the variance had to be raised until the trials, each left out in turn, were
  // covered; a model that needs much does not know how little it knows.
  double temper = 1;
};
// Where no number of them takes `stop_share` from a range.
std::optional<StopReason> StopByOutlook(const Outlook& outlook, double stop_share);
// Where half as many again would, or the temper is too high. `num_told`: evaluations so far.
std::optional<StopShortfall> ShortOfOutlook(const Outlook& outlook, double stop_share,
                                            int num_told);

}  // namespace talus::optimizer
