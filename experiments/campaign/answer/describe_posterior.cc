#include "experiments/campaign/answer/describe_posterior.h"

#include <map>

#include "base/text/csv.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "optimizer/posterior/credible_ranges.h"

namespace talus::campaign {

std::vector<double> FreeValues(const optimizer::ParameterSpace& space,
                               const Eigen::VectorXd& point) {
  std::vector<double> values;
  const std::vector<double> all = space.ToNative(point);
  for (const int i : space.Free()) values.push_back(all[static_cast<std::size_t>(i)]);
  return values;
}

std::string SetText(const std::vector<journal::ParameterRecord>& parameters,
                    const std::vector<double>& values) {
  return base::JoinedUpTo(values.size(), ", ", [&](std::size_t i) {
    return parameters[i].name + " " + base::WithUnit(values[i], parameters[i].unit);
  });
}

std::string BracketedSet(const std::vector<std::string>& names, const std::vector<double>& values) {
  const auto text = [&](std::size_t i) { return names[i] + " " + base::ShortNumber(values[i], 3); };
  return "(" + base::JoinedUpTo(values.size(), ", ", text) + ")";
}

FreeRanges CredibleValues(const optimizer::ParameterSpace& space, const optimizer::Answer& answer) {
  Eigen::VectorXd low(answer.point.size());
  Eigen::VectorXd high(answer.point.size());
  for (Eigen::Index i = 0; i < low.size(); ++i) {
    low[i] = answer.credible[static_cast<std::size_t>(i)].low;
    high[i] = answer.credible[static_cast<std::size_t>(i)].high;
  }
  return {.low = FreeValues(space, low), .high = FreeValues(space, high)};
}

std::string ProvisionalText(double surrogate_narrowing) {
  return "provisional, since the surrogate leaves more open than the measurements do: more "
         "simulations may move it, and narrow a range by up to " +
         base::InPercent(surrogate_narrowing) + " %";
}

ResultPosterior DescribePosterior(const optimizer::PosteriorSummary& summary,
                                  const optimizer::ParameterSpace& space) {
  ResultPosterior posterior{.target_scale_factor = summary.target_scale_factor,
                            .is_extrapolated = summary.is_extrapolated,
                            .region_volume = summary.region_volume,
                            .temper = summary.temper,
                            .raw_coverage = summary.raw_coverage,
                            .tempered_coverage = summary.tempered_coverage,
                            .num_left_out = summary.num_left_out,
                            .unlearnt_scale_factors = summary.unlearnt_scale_factors,
                            .fewest_at_finest = summary.fewest_at_finest,
                            .surrogate_narrowing = summary.surrogate_narrowing,
                            .experiments = summary.experiments};
  for (const optimizer::PosteriorBranch& branch : summary.branches) {
    posterior.branches.push_back({.share = branch.share,
                                  .values = FreeValues(space, branch.point),
                                  .low = FreeValues(space, branch.low),
                                  .high = FreeValues(space, branch.high)});
  }
  return posterior;
}

std::optional<ResultPrior> PriorOf(const optimizer::PosteriorSummary& summary,
                                   const optimizer::ParameterSpace& space, std::size_t i,
                                   const ParameterRanges& ranges) {
  const auto place = static_cast<std::size_t>(space.Free()[i]);
  const optimizer::Parameter& parameter = space.parameters[place];
  const std::map<std::string, std::string> texts = PriorTexts(ranges);
  const auto text = texts.find(parameter.name);
  if (text == texts.end() || summary.prior_draws.rows() == 0) return std::nullopt;
  const auto k = static_cast<Eigen::Index>(i);
  const optimizer::Range range = optimizer::AskedRanges(summary.prior_draws, space.Nuisances())[i];
  return ResultPrior{.text = text->second,
                     .low = parameter.ToNative(range.low),
                     .high = parameter.ToNative(range.high),
                     .offset = summary.prior_offset[k]};
}

std::string PosteriorCsv(const optimizer::PosteriorSummary& summary,
                         const optimizer::ParameterSpace& space,
                         const std::vector<journal::ParameterRecord>& parameters) {
  base::Csv csv;
  for (const journal::ParameterRecord& p : parameters) csv.Cell(journal::ColumnName(p));
  csv.EndRow();
  for (Eigen::Index i = 0; i < summary.draws.rows(); ++i) {
    csv.Cells(FreeValues(space, summary.draws.row(i))).EndRow();
  }
  return csv.Take();
}

std::string FirstAnswerText(const optimizer::Answer& answer, const optimizer::ParameterSpace& space,
                            const std::vector<journal::ParameterRecord>& parameters) {
  const std::vector<double> values = FreeValues(space, answer.point);
  const FreeRanges ranges = CredibleValues(space, answer);
  const auto one = [&](std::size_t i) {
    const std::string& unit = parameters[i].unit;
    return parameters[i].name + " " + base::ShortNumber(values[i]) + " (90 % in " +
           base::ShortNumber(ranges.low[i]) + " … " + base::ShortNumber(ranges.high[i]) + ")" +
           (unit.empty() ? "" : " ") + unit;
  };
  return "first answer, by what was reused: " + base::JoinedUpTo(values.size(), ", ", one) +
         "; the joint 90 % region fills " + base::InPercent(answer.posterior->region_volume) +
         " % of the searched ranges";
}

}  // namespace talus::campaign
