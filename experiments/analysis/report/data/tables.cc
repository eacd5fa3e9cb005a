#include "experiments/analysis/report/data/tables.h"

#include "base/text/csv.h"
#include "experiments/analysis/compare/compare_tables.h"

namespace talus::analysis {
namespace {

std::string Trials(const Evidence& evidence) {
  base::Csv csv;
  csv.Cell("trial").Cell("state").Cell("purpose").Cell("seed").Cell("scale_factor");
  for (const ParameterInfo& parameter : evidence.parameters) csv.Cell(parameter.column);
  for (const MetricInfo& metric : evidence.metrics) csv.Cell(metric.name);
  csv.Cell("duration_s").Cell("cpu_s").Cell("reason").EndRow();
  for (const TrialEvidence& t : evidence.trials) {
    csv.Cell(t.id)
        .Cell(base::NameOf(t.state))
        .Cell(base::NameOf(t.kind))
        .Cell(std::to_string(t.seed));
    csv.Cell(t.scale_factor).Cells(t.values).Cells(t.metrics);
    csv.Cell(t.seconds).Cell(t.cpu_seconds).Cell(t.reason).EndRow();
  }
  return csv.Take();
}

std::string Measures(const ReportData& data) {
  base::Csv csv;
  csv.Cell("profile").Cell("why");
  for (const MetricInfo& metric : data.evidence.metrics) csv.Cell(metric.name);
  csv.EndRow();
  for (const MeasuredProfile& m : data.measures) {
    csv.Cell(m.title).Cell(m.note).Cells(m.metrics).EndRow();
  }
  return csv.Take();
}

std::string Outlines(const ReportData& data) {
  base::Csv csv;
  csv.Cell("profile").Cell("x_m").Cell("height_m").EndRow();
  for (const OutlineCurve& outline : data.outlines) {
    for (std::size_t i = 0; i < outline.x.size(); ++i) {
      csv.Cell(outline.title).Cell(outline.x[i]).Cell(outline.height[i]).EndRow();
    }
  }
  return csv.Take();
}

}  // namespace

std::vector<NamedText> ReportTables(const ReportData& data) {
  return {{"trials", Trials(data.evidence)},
          {"objectives", ObjectivesCsv({data.evidence, data.findings})},
          {"ten_best", TenBestCsv({data.evidence, data.findings})},
          {"measures", Measures(data)},
          {"outlines", Outlines(data)}};
}

}  // namespace talus::analysis
