#include "optimizer/stop_reason.h"

#include <cmath>

#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "optimizer/words.h"

namespace talus::optimizer {
namespace {

std::string PercentText(double x) { return base::InPercent(x) + " %"; }

// "more than 4 %"; "as much as 0.01 %" where it is less than that.
std::string MostText(double share) {
  const std::string text = PercentText(share);
  const std::string less = "less than ";
  return text.starts_with(less) ? "as much as " + text.substr(less.size()) : "more than " + text;
}

std::string Count(double x) { return std::to_string(std::llround(x)); }

}  // namespace

std::string TextOf(const StopReason& r) {
  const std::string gain = "what is left to gain, at most " + Rounded(r.value) + ", is below ";
  switch (r.rule) {
    case StopRule::kGain:
      return gain + Rounded(r.limit) + " x the noise sd of one evaluation, " + Rounded(r.scale);
    case StopRule::kExactGain:
      return gain + Rounded(r.limit) +
             " x the lower quartile of the design's values less the lowest, " + Rounded(r.scale);
    case StopRule::kShare:
      return "more simulations would hardly narrow the answer (no number of them any range by " +
             MostText(r.value) + ", and " + PercentText(r.limit) + " would be worth it)";
    case StopRule::kConverged:
      return r.name + " has converged";
    case StopRule::kAllEvaluated:
      return "all " + Count(r.value) + " points of " + r.name + " are evaluated";
    case StopRule::kGoal:
      return r.name + " is known to ± " + Rounded(r.value) + " (90 %), and ± " + Rounded(r.limit) +
             " was asked for";
    case StopRule::kGoalOpen:
      return r.name + " is known to ± " + Rounded(r.value) +
             " (90 %), and more simulations would leave ± " + Rounded(r.scale) +
             ", which the measurements leave open; ± " + Rounded(r.limit) + " was asked for";
    case StopRule::kGridEvaluated:
      break;
  }
  return "all " + Count(r.value) + " points of the grid and " + Count(r.limit) +
         " half-step neighbours of its best are evaluated";
}

std::string TextOf(const StopShortfall& s, const std::vector<std::string>& names) {
  switch (s.lack) {
    case StopLack::kFirstTrials:
      return "not every test has its first trials at every scale factor yet";
    case StopLack::kDefined:
      return "only " + Count(s.num_defined) + " of " + Count(s.num_told) + " simulations " +
             (s.num_defined == 1 ? "has" : "have") + " " + s.number +
             ", too few for a model: search ranges where the test has it";
    case StopLack::kGain:
      return "a better set may still be found";
    case StopLack::kShare:
      break;
  }
  std::string ranges;
  for (std::size_t i = 0; i < s.narrowing.size(); ++i) {
    if (s.narrowing[i] < s.stop_share) continue;
    ranges += (ranges.empty() ? "" : ", ") + names.at(i) + " by " + PercentText(s.narrowing[i]);
  }
  std::string text;
  if (!ranges.empty()) {
    text = std::to_string(s.num_more) +
           " more simulations are expected to narrow the ranges: " + ranges;
  }
  if (s.temper > s.most_temper) {
    text += (text.empty() ? "" : "; ") + std::string("trials left out are missed by ") +
            base::ShortNumber(std::sqrt(s.temper), 2) +
            " times what the model expects, and the search stops at " +
            base::ShortNumber(std::sqrt(s.most_temper), 2);
  }
  return text;
}

}  // namespace talus::optimizer
