#include <cmath>

#include "experiments/analysis/report/labels.h"
#include "experiments/analysis/report/page/json_parts.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/rig.h"

namespace talus::analysis {
namespace {

PageValue RepresentativeJson(const ReportData& data, const RepresentativeView& view) {
  const auto column = MetricColumn(data.evidence, data.own().info.metric);
  const bool has_trial = view.trial != nullptr && column;
  const Criterion& own = data.own().info;
  const double objective =
      has_trial ? own.per_unit * own.Value(view.trial->metrics[*column], data.own().reference)
                : kUndefined;
  return {{"values", NumbersJson(view.values)},
          {"recommended", view.is_recommended},
          {"expected", NumberJson(view.expected)},
          {"expected_sd", NumberJson(view.expected_sd)},
          {"trial", has_trial ? PageValue(view.trial->id) : PageValue(nullptr)},
          {"trial_values", has_trial ? NumbersJson(view.trial->values) : PageValue(nullptr)},
          {"trial_objective", NumberJson(objective)},
          {"distance", NumberJson(view.distance)},
          {"uri", UriJson(view.heap)},
          {"width", view.heap.width},
          {"height", view.heap.height}};
}

PageValue StepJson(const NextStep& step) {
  return {{"what", step.what}, {"cost", step.cost}, {"leaves", step.leaves}};
}

PageValue FitJson(const FitRow& row) {
  const char* meets = row.meets == FitRow::Meets::kYes  ? "yes"
                      : row.meets == FitRow::Meets::kNo ? "no"
                                                        : "unknown";
  return {{"experiment", row.experiment}, {"what", row.what},
          {"measured", row.measured},     {"simulated", row.simulated},
          {"judgement", row.judgement},   {"meets", meets},
          {"held_out", row.held_out},     {"implausibility", NumberJson(row.implausibility)}};
}

PageValue BranchJson(const AnswerBranch& branch) {
  return {{"share", NumberJson(branch.share)},
          {"values", NumbersJson(branch.values)},
          {"low", NumbersJson(branch.low)},
          {"high", NumbersJson(branch.high)}};
}

// What the campaign minimised, whatever experiment is shown.
PageValue ObjectiveOf(const Conclusion& conclusion) {
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (info.key == conclusion.objective) return {{"title", info.title}, {"unit", info.unit}};
  }
  return {{"title", conclusion.objective}, {"unit", ""}};
}

PageValue ApartJson(const CandidateView::Number& number) {
  const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(number.metric));
  return {
      {"title", MetricTitle(number.metric)},
      {"unit", unit.text},
      {"values", ListJson(number.values, [&](double x) { return NumberJson(unit.per_unit * x); })}};
}

}  // namespace

PageValue NextTableJson(const NextTableView& table) {
  const auto candidate = [](const CandidateView& c) {
    return PageValue{{"name", c.name},
                     {"what", c.what},
                     {"bits", NumberJson(c.bits)},
                     {"width", NumbersJson(c.width)},
                     {"simulations", c.num_simulations},
                     {"core_time", NumberJson(c.core_time)},
                     {"apart", ListJson(c.apart, NumbersJson)},
                     {"apart_by", ListJson(c.apart_by, ApartJson)},
                     {"uri", UriJson(c.picture)},
                     {"picture_width", c.picture.width},
                     {"picture_height", c.picture.height}};
  };
  return {{"width", NumbersJson(table.width)},
          {"outdated", table.is_outdated},
          {"candidates", ListJson(table.candidates, candidate)}};
}

PageValue HeadlineJson(const ReportData& data) {
  const Conclusion& c = *data.evidence.conclusion;
  const PageValue objective = ObjectiveOf(c);
  return {{"values", ListJson(c.values,
                              [](const RecommendedValue& v) {
                                return PageValue{{"value", NumberJson(v.value)},
                                                 {"low", NumberJson(v.low)},
                                                 {"high", NumberJson(v.high)}};
                              })},
          {"verdict", c.verdict},
          {"verdict_kind", c.verdict_kind},
          {"trade_off", c.trade_off},
          {"traded", c.traded},
          {"unsettled", c.unsettled},
          {"use", c.use},
          {"posterior", c.has_posterior},
          {"branches", ListJson(c.branches, BranchJson)},
          {"representatives", ListJson(data.representative,
                                       [&](const RepresentativeView& view) {
                                         return RepresentativeJson(data, view);
                                       })},
          {"next", ListJson(data.next_steps, StepJson)},
          {"fit", ListJson(data.evidence.fit, FitJson)},
          {"fit_sentence", FitSentence(data.evidence.fit)},
          {"objective_title", objective["title"]},
          {"objective_unit", objective["unit"]},
          {"predicted", NumberJson(c.predicted)},
          {"predicted_sd", NumberJson(c.predicted_sd)},
          {"noise_sd", NumberJson(c.noise_sd)},
          {"tied_volume", NumberJson(c.tied_volume)},
          {"sobol_first", NumbersJson(c.sobol_first)},
          {"sobol_total", NumbersJson(c.sobol_total)},
          {"model", c.model}};
}

}  // namespace talus::analysis
