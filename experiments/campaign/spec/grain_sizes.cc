#include "experiments/campaign/spec/grain_sizes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "experiments/rigs/case/case.h"

namespace talus::campaign {

std::vector<double> GrainSizes::Levels() const {
  std::vector<double> levels = scale_factors.value_or(std::vector<double>{});
  if (levels.empty()) levels.push_back(scale_factor);
  std::sort(levels.begin(), levels.end(), std::greater<>());
  return levels;
}

double GrainSizes::Target() const { return target.value_or(Levels().back()); }

void GrainSizes::Validate(base::Problems& problems) const {
  rigs::CoarseGraining{scale_factor, surface_energy_exponent}.Validate(problems);
  if (scale_factors) {
    const std::vector<double>& list = *scale_factors;
    problems.Require(!list.empty(), "scale_factors", "is empty: give one or more, or leave it out");
    if (list.empty()) return;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string place = "scale_factors[" + std::to_string(i) + "]";
      problems.Require(list[i] >= 1 && std::isfinite(list[i]), place, list[i], "must be 1 or more");
      const auto before = list.begin() + static_cast<std::ptrdiff_t>(i);
      problems.Require(std::find(list.begin(), before, list[i]) == before, place, list[i],
                       "stands there twice: name each scale factor once");
    }
    const double least = *std::min_element(list.begin(), list.end());
    problems.Require(scale_factor == 1 || scale_factor == least, "scale_factor",
                     "stands beside scale_factors: give one of the two");
  }
  if (!target) return;
  problems.Require(*target >= 1, "target", *target, "must be 1 or more");
  problems.Require(!(*target > Levels().back()), "target", *target,
                   "must not be larger than the smallest scale factor: what is simulated finer "
                   "than the target is of no use to it");
}

}  // namespace talus::campaign
