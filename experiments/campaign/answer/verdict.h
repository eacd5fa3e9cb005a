// What kind of answer the measurements give, before any number: a point, a curve, a region or
// several separate sets. headline.h puts it in words.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"
#include "experiments/campaign/plan/candidates.h"

namespace talus::campaign {

enum class VerdictKind {
  kPoint,    // every 90 % range is narrow
  kCurve,    // two parameters are known together only
  kRegion,   // a range is wide, and no other parameter ties it
  kSeparate  // several unconnected regions
};
constexpr VerdictKind LastOf(VerdictKind) { return VerdictKind::kSeparate; }

struct ResultVerdict {
  VerdictKind kind = VerdictKind::kPoint;
  std::string text{};  // Headline, with the parameters' names

  TALUS_FIELDS(kind, text);
};

// Correlation from which on two parameters are known together only.
inline constexpr double kTied = 0.8;

// The two parameters that are correlated most strongly, where by `least` or more in size.
std::optional<std::pair<std::size_t, std::size_t>> TiedPair(
    const std::vector<std::vector<double>>& correlation, double least = kTied);

}  // namespace talus::campaign
