#include "experiments/analysis/report/report_data.h"

#include <algorithm>

#include "experiments/analysis/report/profile_views.h"

namespace talus::analysis {
namespace {

std::size_t IndexOf(const std::vector<ObjectiveFinding>& findings, std::string_view key) {
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (findings[i].info.key == key) return i;
  }
  return 0;
}

// Where the slices pass: the recommended set, or without one the model's own best.
Eigen::VectorXd SliceCentre(const Evidence& evidence, const ModelFinding& finding) {
  if (!evidence.conclusion) return finding.point;
  Eigen::VectorXd point(finding.point.size());
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double value = evidence.conclusion->values[i].value;
    point(k) = std::clamp(evidence.parameters[i].range.ToUnit(value), 0.0, 1.0);
  }
  return point;
}

}  // namespace

ReportData MakeReportData(Evidence evidence) {
  ReportData data;
  data.evidence = std::move(evidence);
  data.findings = CompareObjectives(data.evidence);
  data.objective = IndexOf(data.findings, data.evidence.objective);
  const ObjectiveFinding& own = data.own();
  if (own.from_model) {
    data.slices =
        SliceModel(data.evidence, *own.from_model, SliceCentre(data.evidence, *own.from_model));
    data.pairs = PairChances(data.evidence, own);
  }
  AddProfileViews(data);
  return data;
}

}  // namespace talus::analysis
