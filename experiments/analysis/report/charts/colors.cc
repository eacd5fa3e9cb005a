#include "experiments/analysis/report/charts/colors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace talus::analysis {
namespace {

int Channel(const char* color, int channel) {
  return std::stoi(std::string(color).substr(static_cast<std::size_t>(1 + 2 * channel), 2), nullptr,
                   16);
}

}  // namespace

std::string ChanceShade(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kChance.size());
  const auto upper = static_cast<std::size_t>(std::ceil(place));  // kChance[upper - 1]
  if (upper == 0) return "#ffffff";
  const char* const from = upper == 1 ? "#ffffff" : kChance[upper - 2];
  const double weight = place - static_cast<double>(upper - 1);
  const auto mixed = [&](int channel) {
    const int low = Channel(from, channel);
    return static_cast<int>(
        std::lround(low + weight * (Channel(kChance[upper - 1], channel) - low)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", mixed(0) & 255, mixed(1) & 255, mixed(2) & 255);
  return text;
}

std::string ColorProperties() {
  return std::string(":root { --ink: ") + kInk + "; --soft: " + kSoft + "; --star: " + kStar +
         "; --accent-pale: " + kAccentPale + "; }\n";
}

}  // namespace talus::analysis
