// Why a search ends by itself, and what a search that its budget ended still lacks: data, put in
// words in one place.
#pragma once

#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"

namespace talus::optimizer {

enum class StopRule {
  kGain,           // `value`, the most that going on could gain, is below `limit` × `scale`, the
                   // noise sd of one evaluation
  kExactGain,      // … is below `limit` × `scale`, the lower quartile of the design's values
                   // less the lowest
  kShare,          // `value`, the largest share of its width that any number of evaluations would
                   // take from a range, is below `limit`
  kConverged,      // the search `name` has converged
  kAllEvaluated,   // all `value` points of `name` are evaluated
  kGridEvaluated,  // … of the grid, and `limit` half-step neighbours of its best
  kGoal,           // `value`, the half-width of the 90 % of `name`, is `limit` at most, as asked
  kGoalOpen,       // … is not, but would still be `scale` if every set had been simulated
};
constexpr StopRule LastOf(StopRule) { return StopRule::kGoalOpen; }

struct StopReason {
  StopRule rule = StopRule::kConverged;
  double value = 0;
  double limit = 0;
  double scale = 0;
  std::string name{};  // for people: "DIRECT-L", "the Latin hypercube"

  TALUS_FIELDS(rule, value, limit, scale, name);
};

// "what is left to gain, at most 0.012, is below 0.7 x the noise sd of one evaluation, 0.021"
std::string TextOf(const StopReason& reason);

enum class StopLack {
  kFirstTrials,  // the first trials at each scale factor
  kDefined,      // trials that have the number `number`: `num_defined` of `num_told` do
  kGain,         // a better set may still be found
  kShare,  // more would narrow a range by too large a share, or the model misses its own trials
};
constexpr StopLack LastOf(StopLack) { return StopLack::kShare; }

struct StopShortfall {
  StopLack lack = StopLack::kGain;
  // Numbers of kShare only; NaN: not known.
  std::vector<double> narrowing{};      // Outlook::again, of each parameter asked for [-]
  double stop_share = base::kNotKnown;  // as in StopRule::kShare [-]
  double temper = 1;                    // of the posterior, >= 1 (posterior/joint_misfit.h)
  double most_temper = 1;               // the search stops at this or less
  int num_more = 0;                     // evaluations that `narrowing` is of
  std::string number{};                 // of kDefined, as are the next two
  int num_defined = 0;
  int num_told = 0;
};

// Without a full stop. `names` of the parameters asked for.
std::string TextOf(const StopShortfall& shortfall, const std::vector<std::string>& names);

}  // namespace talus::optimizer
