#include <cmath>

#include "base/not_known.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/analysis/report/page/json_parts.h"
#include "experiments/campaign/status.h"

namespace talus::analysis {
namespace {

// Trials of all experiments.
PageValue CountsJson(const Evidence& e) {
  int searched = 0, reused = 0, confirming = 0, failed = 0, running = 0;
  for (const TrialEvidence* t : e.AllTrials()) {
    const bool ok = t->state == journal::TrialStatus::kOk;
    searched +=
        ok && t->kind != journal::TrialKind::kConfirm && t->kind != journal::TrialKind::kReused;
    reused += ok && t->kind == journal::TrialKind::kReused;
    confirming += ok && t->kind == journal::TrialKind::kConfirm;
    failed += t->state == journal::TrialStatus::kFailed;
    running += t->state == journal::TrialStatus::kRunning;
  }
  return {{"searched", searched},
          {"reused", reused},
          {"confirming", confirming},
          {"failed", failed},
          {"running", running}};
}

// The campaign's own, of the experiment that is shown.
PageValue ObjectiveJson(const ReportData& data) {
  const ObjectiveFinding& own = data.own();
  // The noise floor is a SAD: no other objective can be held against it.
  const double floor = own.info.is_sad ? data.evidence.reference.noise_floor : base::kNotKnown;
  const auto shown = [&](double value) { return NumberJson(own.info.per_unit * value); };
  return {{"key", own.info.key},
          {"metric", ShownName(own.info.metric)},
          {"title", own.info.title},
          {"value_title", ValueTitle(own.info)},
          {"unit", own.info.unit},
          {"is_distance", own.info.is_distance},
          {"is_sad", own.info.is_sad},
          {"reference", shown(own.reference)},
          {"noise_sd", shown(own.noise_sd)},
          {"noise_floor", NumberJson(floor)}};
}

}  // namespace

PageValue CampaignJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  return {
      {"name", e.name},
      {"state", std::string(e.ended_silently ? campaign::kEndedSilently : base::NameOf(e.state))},
      {"ended_silently", e.ended_silently},
      {"stop_reason", e.stop_reason},
      {"folder", base::ShellWord(e.folder.string())},
      {"budget", e.max_simulations},
      {"seconds_left", NumberJson(e.seconds_left)},
      {"counts", CountsJson(e)},
      {"reused_from",
       e.answer ? ListJson(e.answer->reused, campaign::ReusedText) : PageValue::array()},
      {"scale_factor", NumberJson(e.scale_factor)},
      {"core_hours", e.core_hours > 0 ? NumberJson(e.core_hours) : PageValue(nullptr)},
      {"experiment", e.experiment < e.experiments.size() ? e.experiments[e.experiment] : ""},
      {"num_experiments", e.experiments.size()},
      {"has_image", e.reference.has_image()},
      {"objective", ObjectiveJson(data)}};
}

PageValue ParametersJson(const Evidence& evidence) {
  return ListJson(evidence.parameters, [](const ParameterInfo& p) {
    return PageValue{{"name", p.range.name},
                     {"title", WordsOf(p.range.name)},
                     {"symbol", p.symbol},
                     {"unit", p.unit},
                     {"nuisance", p.range.is_nuisance},
                     {"low", NumberJson(p.range.low)},
                     {"high", NumberJson(p.range.high)},
                     {"log", p.range.scale == optimizer::Scale::kLog}};
  });
}

// What a rig reads off its grains, drawn finely, stands beside what the image in the photographs'
// frame gives under the same title.
std::string TitleBesideImages(const Evidence& evidence, const std::string& metric) {
  const bool is_twice = metric.starts_with("angle_of_repose_") || metric == "heap_cohesive_index";
  return MetricTitle(metric) +
         (is_twice && evidence.reference.has_image() ? ", by the grains" : "");
}

PageValue MetricsJson(const Evidence& evidence) {
  return ListJson(evidence.metrics, [&](const MetricInfo& m) {
    return PageValue{{"name", ShownName(m.name)},
                     {"title", TitleBesideImages(evidence, m.name)},
                     {"unit", ShownUnitOf(m.unit).text}};
  });
}

PageValue TrialsJson(const Evidence& evidence) {
  const auto column = [&](auto&& value) { return ListJson(evidence.trials, value); };
  PageValue values = PageValue::array(), metrics = PageValue::array();
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    values.push_back(column([&](const TrialEvidence& t) { return NumberJson(t.values[k]); }));
  }
  for (std::size_t k = 0; k < evidence.metrics.size(); ++k) {
    const double per_unit = ShownUnitOf(evidence.metrics[k].unit).per_unit;
    metrics.push_back(
        column([&](const TrialEvidence& t) { return NumberJson(per_unit * t.metrics[k]); }));
  }
  return {{"id", column([](const TrialEvidence& t) { return t.id; })},
          {"state", column([](const TrialEvidence& t) { return base::NameOf(t.state); })},
          {"purpose", column([](const TrialEvidence& t) { return base::NameOf(t.kind); })},
          {"reason", column([](const TrialEvidence& t) { return t.reason; })},
          {"scale", column([](const TrialEvidence& t) { return NumberJson(t.scale_factor); })},
          {"seconds", column([](const TrialEvidence& t) { return NumberJson(t.seconds); })},
          {"values", values},
          {"metrics", metrics}};
}

}  // namespace talus::analysis
