#include "optimizer/search/stopping_rule.h"

#include <algorithm>

#include "base/not_known.h"

namespace talus::optimizer {
namespace {

constexpr double kExactShare = 1e-6;
constexpr double kMostTemper = 1.5;

// NaN, which is below nothing, of no ranges.
double Most(const std::vector<double>& narrowing) {
  if (narrowing.empty()) return base::kNotKnown;
  return *std::ranges::max_element(narrowing);
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

std::optional<StopReason> StopByOutlook(const Outlook& outlook, double stop_share) {
  const double most = Most(outlook.all);
  if (!(most < stop_share) || outlook.temper > kMostTemper) return std::nullopt;
  return StopReason{.rule = StopRule::kShare, .value = most, .limit = stop_share};
}

std::optional<StopShortfall> ShortOfOutlook(const Outlook& outlook, double stop_share,
                                            int num_told) {
  if (Most(outlook.again) < stop_share && outlook.temper <= kMostTemper) return std::nullopt;
  return StopShortfall{.lack = StopLack::kShare,
                       .narrowing = outlook.again,
                       .stop_share = stop_share,
                       .temper = outlook.temper,
                       .most_temper = kMostTemper,
                       .num_more = (num_told + 1) / 2};
}

}  // namespace talus::optimizer
