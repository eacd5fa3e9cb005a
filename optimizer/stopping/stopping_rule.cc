#include "optimizer/stopping/stopping_rule.h"

#include <algorithm>

#include "base/text/number_text.h"
#include "optimizer/answer/words.h"

namespace talus::optimizer {
namespace {

constexpr double kExactShare = 1e-6;
constexpr double kMostTemper = 1.5;

std::string LeftToGain(double gain) {
  return "what is left to gain, at most " + Rounded(std::max(0.0, gain)) + ", is below ";
}

}  // namespace

std::optional<std::string> StopByGain(double gain, double noise, double stop_multiple) {
  if (!(gain < stop_multiple * noise)) return std::nullopt;
  return LeftToGain(gain) + Rounded(stop_multiple) + " x the noise sd of one evaluation, " +
         Rounded(noise);
}

std::optional<std::string> StopByExactGain(double gain, double typical) {
  if (!(gain <= kExactShare * typical)) return std::nullopt;
  return LeftToGain(gain) + "a millionth of the mean value less the lowest, " + Rounded(typical);
}

std::optional<std::string> StopByShare(double share, double temper, double stop_share) {
  if (!(share < stop_share) || temper > kMostTemper) return std::nullopt;
  const auto percent = [](double x) { return base::ShortNumber(100 * x, 2) + " %"; };
  return "more simulations would hardly narrow the answer (over the posterior the surrogate's "
         "variance is " +
         percent(share) + " of what the measurements leave open, below " + percent(stop_share) +
         ")";
}

}  // namespace talus::optimizer
