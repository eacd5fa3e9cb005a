#include "experiments/analysis/compare/strategy_runs.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text/csv.h"
#include "base/text/number_text.h"
#include "experiments/analysis/compare/aligned.h"
#include "experiments/analysis/compare/criterion.h"

namespace talus::analysis {
namespace {

std::string Number(double x) { return std::isnan(x) ? "-" : base::ShortNumber(x); }

void RequireSameTask(const Evidence& first, const Evidence& other, const std::string& name) {
  if (!(first.reference.aehp.frame == other.reference.aehp.frame) ||
      !(first.reference.aehp.image == other.reference.aehp.image)) {
    throw base::ConfigError(name +
                            ": is about another experiment; strategies can be compared on "
                            "one experiment only");
  }
  const auto same = [](const ParameterInfo& a, const ParameterInfo& b) {
    return a.range.name == b.range.name && a.range.low == b.range.low &&
           a.range.high == b.range.high && a.range.scale == b.range.scale;
  };
  if (!std::equal(first.parameters.begin(), first.parameters.end(), other.parameters.begin(),
                  other.parameters.end(), same)) {
    throw base::ConfigError(name + ": searches other parameters or ranges");
  }
}

StrategyRun RunOf(const std::string& name, const Evidence& evidence, const Criterion& info) {
  StrategyRun run{.campaign = name, .strategy = evidence.strategy, .best = {}};
  const auto column = MetricColumn(evidence, info.metric);
  double best = kUndefined;
  for (const TrialEvidence& trial : evidence.trials) {
    if (trial.state == journal::TrialStatus::kRunning || trial.purpose == "confirm") continue;
    if (trial.state == journal::TrialStatus::kOk && column) {
      const double value = info.Value(trial.metrics[*column], evidence.reference.metrics[*column]);
      best = std::isnan(value) ? best : std::fmin(best, value);
    }
    run.best.push_back(best);
    if (std::isfinite(trial.cpu_seconds)) run.core_hours += trial.cpu_seconds / 3600;
  }
  return run;
}

// Simulations until the best was at most `limit`; "-" when it never was.
std::string SimulationsTo(const StrategyRun& run, double limit) {
  const auto found =
      std::find_if(run.best.begin(), run.best.end(), [&](double best) { return best <= limit; });
  return found == run.best.end() ? "-" : std::to_string(found - run.best.begin() + 1);
}

}  // namespace

std::vector<StrategyRun> CompareStrategies(const std::vector<std::string>& campaigns,
                                           const std::vector<Evidence>& evidence) {
  const std::vector<Criterion> criteria = CriteriaOf(evidence.front());
  const Criterion& info = criteria.at(OwnCriterion(evidence.front(), criteria));
  std::vector<StrategyRun> runs;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    RequireSameTask(evidence.front(), evidence[i], campaigns[i]);
    runs.push_back(RunOf(campaigns[i], evidence[i], info));
  }
  return runs;
}

std::string StrategiesText(const std::vector<StrategyRun>& runs, double margin) {
  double least = kUndefined;
  std::size_t longest = 0;
  for (const StrategyRun& run : runs) {
    longest = std::max(longest, run.best.size());
    if (!run.best.empty()) least = std::fmin(least, run.best.back());
  }
  TextRow head{"best after simulations"};
  std::vector<std::size_t> counts;
  for (std::size_t count = 10; count < longest; count *= 2) counts.push_back(count);
  for (const std::size_t count : counts) head.push_back(std::to_string(count));
  head.insert(head.end(), {"all", "number", "within the scatter after", "core-hours"});
  std::vector<TextRow> rows{head};
  for (const StrategyRun& run : runs) {
    TextRow row{run.strategy + " (" + run.campaign + ")"};
    for (const std::size_t count : counts) {
      row.push_back(count <= run.best.size() ? Number(run.best[count - 1]) : "-");
    }
    row.push_back(run.best.empty() ? "-" : Number(run.best.back()));
    row.push_back(std::to_string(run.best.size()));
    row.push_back(SimulationsTo(run, least + margin));
    row.push_back(Number(run.core_hours));
    rows.push_back(row);
  }
  return Aligned(rows);
}

std::string StrategiesCsv(const std::vector<StrategyRun>& runs) {
  base::Csv csv;
  csv.Cell("campaign").Cell("strategy").Cell("simulations").Cell("best_objective").EndRow();
  for (const StrategyRun& run : runs) {
    for (std::size_t i = 0; i < run.best.size(); ++i) {
      csv.Cell(run.campaign).Cell(run.strategy).Cell(static_cast<double>(i + 1));
      csv.Cell(run.best[i]).EndRow();
    }
  }
  return csv.Take();
}

}  // namespace talus::analysis
