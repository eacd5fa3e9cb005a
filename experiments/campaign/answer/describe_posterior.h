// An optimiser's posterior in a campaign's own words: SI values and names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/answer/result_posterior.h"
#include "experiments/campaign/answer/result_prior.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/journal/records.h"
#include "optimizer/answer.h"
#include "optimizer/posterior_summary.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

// Values of the free parameters at a point of the unit cube, SI.
std::vector<double> FreeValues(const optimizer::ParameterSpace& space,
                               const Eigen::VectorXd& point);

// "sliding_friction 0.3, surface_energy 2e-06 J/m^2": values in the order of the parameters.
std::string SetText(const std::vector<journal::ParameterRecord>& parameters,
                    const std::vector<double>& values);

// "(sliding_friction 0.31, rolling_friction 0.12)": for sentences, three digits without units.
std::string BracketedSet(const std::vector<std::string>& names, const std::vector<double>& values);

// The joint 90 % ranges of the free parameters, SI.
struct FreeRanges {
  std::vector<double> low, high;
};
FreeRanges CredibleValues(const optimizer::ParameterSpace& space, const optimizer::Answer& answer);

ResultPosterior DescribePosterior(const optimizer::PosteriorSummary& summary,
                                  const optimizer::ParameterSpace& space);

// The prior of the i-th free parameter, its range as the answer's are: those of what is asked for
// hold 90 % all together. Nothing where its spec gives it none.
std::optional<ResultPrior> PriorOf(const optimizer::PosteriorSummary& summary,
                                   const optimizer::ParameterSpace& space, std::size_t i,
                                   const ParameterRanges& ranges);

// Its draws, one a line, SI with the units in the head.
std::string PosteriorCsv(const optimizer::PosteriorSummary& summary,
                         const optimizer::ParameterSpace& space,
                         const std::vector<journal::ParameterRecord>& parameters);

// "first answer, by what was reused: sliding_friction 0.45 (90 % in 0.4 … 0.5), …". Wants a
// posterior.
std::string FirstAnswerText(const optimizer::Answer& answer, const optimizer::ParameterSpace& space,
                            const std::vector<journal::ParameterRecord>& parameters);

}  // namespace talus::campaign
