#include "experiments/analysis/report/data/report_data.h"

#include <algorithm>
#include <cmath>

#include "base/not_known.h"
#include "experiments/analysis/report/data/profile_views.h"
#include "experiments/analysis/report/views/answer_words.h"

namespace talus::analysis {
namespace {

// Where the slices pass: the recommended set, before there is one the model's own.
Eigen::VectorXd SliceCentre(const Evidence& evidence) {
  Eigen::VectorXd point = evidence.model->point;
  if (!evidence.answer) return point;
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double value = evidence.answer->parameters[i].value;
    point(k) = std::clamp(evidence.parameters[i].range.ToUnit(value), 0.0, 1.0);
  }
  return point;
}

// One model only: the one that answers.
void AddModelViews(ReportData& data) {
  const Evidence& evidence = data.evidence;
  if (!evidence.model) return;
  if (evidence.model->predict) data.slices = SliceModel(evidence, SliceCentre(evidence));
  data.marginals = Marginals(evidence);
  data.pairs = PosteriorPairs(evidence);
}

// The region's share of the searched plane.
double InsideShare(const PairMap& pair) {
  const auto inside = std::ranges::count_if(
      pair.value, [](double level) { return level < optimizer::kRegionLevel; });
  return pair.plane * static_cast<double>(inside) / static_cast<double>(pair.value.size());
}

// What differs from one experiment of a campaign to the other.
ReportData ExperimentData(Evidence evidence) {
  ReportData data;
  data.evidence = std::move(evidence);
  data.findings = CompareTrials(data.evidence);
  data.objective = OwnCriterion(data.evidence, CriteriaOf(data.evidence));
  AddProfileViews(data);
  return data;
}

}  // namespace

ReportData MakeReportData(Evidence evidence, std::vector<Evidence> others) {
  ReportData data = ExperimentData(std::move(evidence));
  LeftOut& left_out = data.left_out;
  for (Evidence& other : others) {
    const ReportData& made = data.others.emplace_back(ExperimentData(std::move(other)));
    left_out.insert(left_out.end(), made.left_out.begin(), made.left_out.end());
  }
  AddModelViews(data);
  data.next_table = ReadExtra(left_out, [&] { return ReadNextTable(data.evidence, left_out); });
  data.predictions = ReadPredictions(data.evidence, left_out);
  data.sensitivity = ReadExtra(left_out, [&] { return ReadSensitivity(data.evidence); });
  data.widths = WidthViews(data.evidence, data.pairs);
  data.next_steps = NextSteps(data.evidence, data.next_table);
  return data;
}

std::optional<std::size_t> ClosestPair(const ReportData& data) {
  if (data.pairs.empty()) return std::nullopt;
  const auto at = [&](auto pair) { return static_cast<std::size_t>(pair - data.pairs.begin()); };
  if (const auto& answer = data.evidence.answer) {
    const auto traded = TradedPair(*answer);
    const auto is_traded = [&](const PairMap& map) { return traded == std::pair{map.i, map.j}; };
    const auto found = std::ranges::find_if(data.pairs, is_traded);
    if (found != data.pairs.end()) return at(found);
  }
  return at(std::ranges::min_element(data.pairs, {}, InsideShare));
}

double RegionShare(const ReportData& data) {
  if (data.pairs.empty()) return base::kNotKnown;
  return InsideShare(*std::ranges::min_element(data.pairs, {}, InsideShare));
}

void Follow(const ReportData& data, std::vector<RegionPoint>& history) {
  const auto has_ended = [](const TrialEvidence* trial) {
    return trial->state != journal::TrialStatus::kRunning;
  };
  const RegionPoint now{.num_trials = std::ranges::count_if(data.evidence.AllTrials(), has_ended),
                        .share = RegionShare(data)};
  if (std::isnan(now.share)) return;
  if (!history.empty() && history.back().num_trials == now.num_trials) return;
  history.push_back(now);
}

}  // namespace talus::analysis
