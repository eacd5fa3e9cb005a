#include "experiments/rigs/case/pairs.h"

#include <algorithm>

#include "experiments/rigs/case/materials.h"

namespace talus::rigs {
namespace {

std::optional<int> BodyOf(const std::string& name) {
  const auto found = std::ranges::find(kBodyNames, name);
  if (found == std::end(kBodyNames)) return std::nullopt;
  return static_cast<int>(found - std::begin(kBodyNames));
}

void ValidateNames(const engine::PairSpec& pair, base::Problems& problems) {
  for (std::size_t k = 0; k < pair.between.size(); ++k) {
    problems.Require(BodyOf(pair.between[k]).has_value(), "between[" + std::to_string(k) + "]",
                     "\"" + pair.between[k] +
                         "\" is no body of a test; name \"powder\", \"plate\" (the floor of other "
                         "rigs) or \"tube\" (their walls)");
  }
}

}  // namespace

std::optional<int> PartnerOf(const engine::PairSpec& pair) {
  if (pair.between.size() != 2) return std::nullopt;
  const std::optional<int> a = BodyOf(pair.between[0]);
  const std::optional<int> b = BodyOf(pair.between[1]);
  if (!a || !b || (*a != kPowder && *b != kPowder)) return std::nullopt;
  return std::max(*a, *b);
}

void ValidatePairs(const std::vector<engine::PairSpec>& pairs, base::Problems& problems) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    problems.Within("pairs[" + std::to_string(i) + "]", [&] {
      const std::size_t before = problems.size();
      ValidateNames(pairs[i], problems);
      if (pairs[i].between.size() != 2 || problems.size() > before) return;
      const std::optional<int> partner = PartnerOf(pairs[i]);
      problems.Require(partner.has_value(), "between",
                       "never touch: one of the two must be \"powder\"");
      const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(i);
      const bool is_new = std::none_of(pairs.begin(), end, [&](const engine::PairSpec& earlier) {
        return partner && PartnerOf(earlier) == partner;
      });
      problems.Require(is_new, "between", "is a pair that stands before; keep one of them");
    });
  }
}

engine::PairProperties StatedWith(const std::vector<engine::PairSpec>& pairs, int body) {
  for (const engine::PairSpec& pair : pairs) {
    if (PartnerOf(pair) == body) return pair.stated;
  }
  return {};
}

engine::PairProperties& PairWith(std::vector<engine::PairSpec>& pairs, int body) {
  const auto found = std::ranges::find_if(
      pairs, [&](const engine::PairSpec& pair) { return PartnerOf(pair) == body; });
  if (found != pairs.end()) return found->stated;
  pairs.push_back({.between = {kBodyNames[kPowder], kBodyNames[body]}, .stated = {}});
  return pairs.back().stated;
}

std::vector<engine::MaterialPair> PairsOf(const Case& c) {
  std::vector<engine::MaterialPair> pairs;
  for (const engine::PairSpec& pair : c.pairs) {
    pairs.push_back({.first = kPowder, .second = PartnerOf(pair).value(), .stated = pair.stated});
    auto& surface_energy = pairs.back().stated.surface_energy;
    if (surface_energy) *surface_energy *= SurfaceEnergyFactor(c);
  }
  return pairs;
}

}  // namespace talus::rigs
