#include "base/text/csv.h"
#include "base/text/joined.h"
#include "experiments/analysis/compare/compare_tables.h"

namespace talus::analysis {
namespace {

void ParameterHeads(base::Csv& csv, const Evidence& evidence) {
  for (const ParameterInfo& parameter : evidence.parameters) csv.Cell(parameter.column);
}

// As `trials.csv` has it in its heads.
std::string MetricUnit(const Evidence& evidence, const Criterion& criterion) {
  const auto column = MetricColumn(evidence, criterion.metric);
  return column ? evidence.metrics[*column].unit : "";
}

}  // namespace

std::string ObjectivesCsv(const ComparedCampaign& compared) {
  base::Csv csv;
  csv.Heads({"objective", "from", "metric", "unit", "quantity", "reference", "objective_value",
             "noise_sd"});
  ParameterHeads(csv, compared.evidence);
  csv.Cell("tied_sets").Cell("sets").Cell("tied_volume_fraction").EndRow();
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.absent.empty()) continue;
    const ComparedSet& best = f.from_trials.best.front();
    const std::string unit = MetricUnit(compared.evidence, f.info);
    csv.Cell(f.info.key).Cell("trials").Cell(f.info.metric).Cell(unit).Cell(best.quantity);
    csv.Cell(f.reference).Cell(best.objective).Cell(f.noise_sd).Cells(best.values);
    csv.Cell(static_cast<double>(f.from_trials.num_tied));
    csv.Cell(static_cast<double>(f.from_trials.num_sets));
    csv.Cell(f.from_trials.tied_volume).EndRow();
    if (!f.from_model) continue;
    const ModelFinding& model = *f.from_model;
    csv.Cell(f.info.key).Cell("model").Cell(f.info.metric).Cell(unit).Cell(model.there.quantity);
    csv.Cell(f.reference).Cell(model.there.objective).Cell(f.noise_sd).Cells(model.values);
    csv.Cell("").Cell("").Cell(model.tied_volume).EndRow();
  }
  return csv.Take();
}

std::string TenBestCsv(const ComparedCampaign& compared) {
  base::Csv csv;
  csv.Cell("objective").Cell("rank").Cell("unit").Cell("quantity").Cell("objective_value");
  ParameterHeads(csv, compared.evidence);
  csv.Cell("trials").EndRow();
  for (const ObjectiveFinding& f : compared.findings) {
    double rank = 0;
    for (const ComparedSet& set : f.from_trials.best) {
      const auto text = [](int id) { return std::to_string(id); };
      csv.Cell(f.info.key).Cell(++rank).Cell(MetricUnit(compared.evidence, f.info));
      csv.Cell(set.quantity).Cell(set.objective);
      csv.Cells(set.values).Cell(base::Joined(set.trials, " ", text)).EndRow();
    }
  }
  return csv.Take();
}

}  // namespace talus::analysis
