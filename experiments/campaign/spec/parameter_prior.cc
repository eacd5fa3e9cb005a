#include "experiments/campaign/spec/parameter_prior.h"

#include <cmath>

#include "base/text/number_text.h"

namespace talus::campaign {

template <base::Dimension kDimension>
std::optional<optimizer::NormalPrior> ParameterPrior<kDimension>::Normal() const {
  if (mean) return optimizer::NormalPrior{.mean = *mean, .sd = *sd};
  if (median) {
    return optimizer::NormalPrior{
        .mean = std::log(*median), .sd = std::log(*factor), .of_logarithm = true};
  }
  return std::nullopt;
}

template <base::Dimension kDimension>
std::string ParameterPrior<kDimension>::Text() const {
  if (mean) return base::ShortNumber(*mean) + " ± " + base::ShortNumber(*sd);
  if (median)
    return base::ShortNumber(*median) + " within a factor of " + base::ShortNumber(*factor);
  return "the posterior of " + from.value_or("").string();
}

template <base::Dimension kDimension>
void ParameterPrior<kDimension>::ValidateIn(double min, double max,
                                            base::Problems& problems) const {
  const bool normal = mean || sd;
  const bool log_normal = median || factor;
  const bool whole = (!normal || (mean && sd)) && (!log_normal || (median && factor));
  if (!whole || int{normal} + int{log_normal} + int{from.has_value()} != 1) {
    problems.Add("", "must be mean and sd, or median and factor, or from: one of the three");
    return;
  }
  problems.Require(!sd || (*sd > 0 && std::isfinite(*sd)), "sd", sd.value_or(0),
                   "must be positive; a value that is known exactly is \"fixed\"");
  problems.Require(!factor || (*factor > 1 && std::isfinite(*factor)), "factor", factor.value_or(0),
                   "must be above 1; a value that is known exactly is \"fixed\"");
  problems.Require(!log_normal || min > 0, "median", median.value_or(0),
                   "is of a log-normal prior, which needs a range with min > 0");
  const double centre = mean.value_or(median.value_or(min));
  problems.Require(centre >= min && centre <= max, mean ? "mean" : "median", centre,
                   "must lie between min and max");
}

template struct ParameterPrior<base::Dimension::kNone>;
template struct ParameterPrior<base::Dimension::kSurfaceEnergy>;
template struct ParameterPrior<base::Dimension::kPressure>;
template struct ParameterPrior<base::Dimension::kEnergy>;
template struct ParameterPrior<base::Dimension::kDensity>;
template struct ParameterPrior<base::Dimension::kMass>;

}  // namespace talus::campaign
