#include "experiments/campaign/answer/describe_posterior.h"

#include <cmath>

#include "base/text/csv.h"

namespace talus::campaign {
namespace {

constexpr double kAlarm = 3;  // implausibility above which no set fits

}  // namespace

std::vector<double> FreeValues(const optimizer::ParameterSpace& space,
                               const Eigen::VectorXd& point) {
  std::vector<double> values;
  const std::vector<double> all = space.ToNative(point);
  for (const int i : space.Free()) values.push_back(all[static_cast<std::size_t>(i)]);
  return values;
}

std::vector<ResultStanding> StandingsOf(const std::vector<optimizer::ExperimentStanding>& list) {
  std::vector<ResultStanding> standings;
  for (const optimizer::ExperimentStanding& s : list) {
    standings.push_back({.name = s.name,
                         .predicted = s.predicted_objective,
                         .predicted_sd = s.predicted_sd,
                         .implausibility = s.implausibility});
    for (const optimizer::NumberStanding& n : s.numbers) {
      standings.back().numbers.push_back(
          {.predicted = n.predicted, .predicted_sd = n.predicted_sd});
    }
  }
  return standings;
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
                            .experiments = StandingsOf(summary.experiments)};
  for (const optimizer::PosteriorBranch& branch : summary.branches) {
    posterior.branches.push_back({.share = branch.share,
                                  .values = FreeValues(space, branch.point),
                                  .low = FreeValues(space, branch.low),
                                  .high = FreeValues(space, branch.high)});
  }
  return posterior;
}

std::vector<ResultWarning> PosteriorWarnings(const ResultPosterior& posterior) {
  std::vector<ResultWarning> warnings;
  for (const ResultStanding& e : posterior.experiments) {
    if (!(e.implausibility > kAlarm)) continue;
    warnings.push_back(Worded(
        {.kind = WarningKind::kImplausible, .experiment = e.name, .value = e.implausibility}));
  }
  if (posterior.is_extrapolated) {
    warnings.push_back(Worded(
        {.kind = WarningKind::kExtrapolated, .scale_factor = posterior.target_scale_factor}));
  }
  for (const double level : posterior.unlearnt_scale_factors) {
    warnings.push_back(Worded({.kind = WarningKind::kUnlearntScaleFactor, .scale_factor = level}));
  }
  // Of several experiments the regions are small, and the errors of their surrogates weigh more:
  // bench/twins/dem_twins.py.
  constexpr int kEnough = 12;
  if (posterior.experiments.size() > 1 && !posterior.is_extrapolated &&
      posterior.unlearnt_scale_factors.empty() && posterior.fewest_at_finest > 0 &&
      posterior.fewest_at_finest < kEnough) {
    warnings.push_back(
        Worded({.kind = WarningKind::kFewSimulations, .value = 1.0 * posterior.fewest_at_finest}));
  }
  return warnings;
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

}  // namespace talus::campaign
