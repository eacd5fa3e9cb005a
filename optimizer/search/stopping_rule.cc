#include "optimizer/search/stopping_rule.h"

#include <algorithm>
#include <cmath>

#include "base/text/number_text.h"
#include "optimizer/words.h"

namespace talus::optimizer {
namespace {

constexpr double kExactShare = 1e-6;
constexpr double kMostTemper = 1.5;
constexpr double kFarthest = 20;  // times as many more: beyond, 1/n is no estimate

std::string PercentText(double x) { return base::ShortNumber(100 * x, 2) + " %"; }

// 137 → 140: an estimate.
double TwoDigitsUp(double count) {
  const double unit = count < 100 ? 1 : std::pow(10.0, std::floor(std::log10(count)) - 1);
  return unit * std::ceil(count / unit - 1e-9);  // 100.0000001 is 100
}

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

std::optional<std::string> StopByShare(const SurrogateShare& now, double stop_share) {
  if (!(now.share < stop_share) || now.temper > kMostTemper) return std::nullopt;
  return "more simulations would hardly narrow the answer (over the posterior the surrogate's "
         "variance is " +
         PercentText(now.share) + " of what the measurements leave open, below " +
         PercentText(stop_share) + ")";
}

std::optional<StopShortfall> ShortOfShare(const SurrogateShare& now, double stop_share,
                                          int num_told) {
  if (StopByShare(now, stop_share)) return std::nullopt;
  StopShortfall shortfall{.text = {}, .share = now.share};
  if (!(now.share < stop_share)) {
    shortfall.text = "the surrogate's variance is " + PercentText(now.share) +
                     " of what the measurements leave open, and the search stops below " +
                     PercentText(stop_share);
  }
  if (now.temper > kMostTemper) {
    shortfall.text += (shortfall.text.empty() ? "" : "; ") +
                      std::string("trials left out are missed by ") +
                      base::ShortNumber(std::sqrt(now.temper), 2) +
                      " times what the model expects, and the search stops at " +
                      base::ShortNumber(std::sqrt(kMostTemper), 2);
    return shortfall;
  }
  const double times_more = now.share / stop_share - 1;
  if (times_more <= kFarthest) shortfall.num_more = TwoDigitsUp(num_told * times_more);
  return shortfall;
}

}  // namespace talus::optimizer
