#include "optimizer/search/stopping_rule.h"

#include <algorithm>
#include <cmath>

namespace talus::optimizer {
namespace {

constexpr double kExactShare = 1e-6;
constexpr double kMostTemper = 1.5;
constexpr double kFarthest = 20;  // times as many more: beyond, 1/n is no estimate

// 137 → 140: an estimate.
double TwoDigitsUp(double count) {
  const double unit = count < 100 ? 1 : std::pow(10.0, std::floor(std::log10(count)) - 1);
  return unit * std::ceil(count / unit - 1e-9);  // 100.0000001 is 100
}

}  // namespace

std::optional<StopReason> StopByGain(double gain, double noise, double stop_multiple) {
  if (!(gain < stop_multiple * noise)) return std::nullopt;
  return StopReason{.rule = StopRule::kGain,
                    .value = std::max(0.0, gain),
                    .limit = stop_multiple,
                    .scale = noise};
}

std::optional<StopReason> StopByExactGain(double gain, double typical) {
  if (!(gain <= kExactShare * typical)) return std::nullopt;
  return StopReason{.rule = StopRule::kExactGain,
                    .value = std::max(0.0, gain),
                    .limit = kExactShare,
                    .scale = typical};
}

std::optional<StopReason> StopByShare(const SurrogateShare& now, double stop_share) {
  if (!(now.share < stop_share) || now.temper > kMostTemper) return std::nullopt;
  return StopReason{.rule = StopRule::kShare, .value = now.share, .limit = stop_share};
}

std::optional<StopShortfall> ShortOfShare(const SurrogateShare& now, double stop_share,
                                          int num_told) {
  if (StopByShare(now, stop_share)) return std::nullopt;
  StopShortfall shortfall{.lack = StopLack::kShare,
                          .share = now.share,
                          .stop_share = stop_share,
                          .temper = now.temper,
                          .most_temper = kMostTemper};
  const double times_more = now.share / stop_share - 1;
  if (now.temper <= kMostTemper && times_more <= kFarthest) {
    shortfall.num_more = TwoDigitsUp(num_told * times_more);
  }
  return shortfall;
}

}  // namespace talus::optimizer
