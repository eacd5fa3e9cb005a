#include <cmath>

#include "base/not_known.h"
#include "experiments/analysis/compare/criterion.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/analysis/predict/prediction_text.h"
#include "experiments/analysis/report/page/json_parts.h"
#include "experiments/analysis/report/views/answer_words.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::analysis {
namespace {

PageValue RepresentativeJson(const ReportData& data, const RepresentativeView& view) {
  const auto column = MetricColumn(data.evidence, data.own().info.metric);
  const bool has_trial = view.trial != nullptr && column;
  const Criterion& own = data.own().info;
  const double objective =
      has_trial ? own.per_unit * own.Value(view.trial->metrics[*column], data.own().reference)
                : base::kNotKnown;
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
  const char* meets = row.meets == campaign::Meets::kYes  ? "yes"
                      : row.meets == campaign::Meets::kNo ? "no"
                                                          : "unknown";
  return {{"experiment", row.experiment}, {"what", row.what},
          {"measured", row.measured},     {"simulated", row.simulated},
          {"judgement", row.judgement},   {"meets", meets},
          {"held_out", row.held_out},     {"implausibility", NumberJson(row.implausibility)}};
}

PageValue BranchJson(const campaign::ResultBranch& branch) {
  return {{"share", NumberJson(branch.share)},
          {"values", NumbersJson(branch.values)},
          {"low", NumbersJson(branch.low)},
          {"high", NumbersJson(branch.high)}};
}

PageValue WidthJson(const WidthView& view) {
  return {{"title", view.title},
          {"means", view.means},
          {"low", NumbersJson(view.low)},
          {"high", NumbersJson(view.high)}};
}

// What the campaign minimised, whatever experiment is shown.
PageValue ObjectiveOf(const Evidence& evidence) {
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (info.key == evidence.objective) {
      return {{"title", ValueTitle(CriterionOf(info))}, {"unit", info.unit}};
    }
  }
  return {{"title", evidence.objective}, {"unit", ""}};
}

// The recommended value of a parameter and its range.
PageValue ValueJson(const campaign::ResultParameter& p) {
  return {{"value", NumberJson(p.value)},
          {"low", NumberJson(p.credible_low)},
          {"high", NumberJson(p.credible_high)},
          {"prior", p.prior ? p.prior->text : ""}};
}

// The indices of every parameter, or of none.
PageValue SobolJson(const campaign::Answer& answer, double campaign::ResultParameter::*index) {
  PageValue list = PageValue::array();
  for (const campaign::ResultParameter& p : answer.parameters) {
    if (std::isfinite(p.*index)) list.push_back(NumberJson(p.*index));
  }
  return list;
}

PageValue ApartJson(const CandidateView::Number& number) {
  const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(number.metric));
  return {
      {"title", MetricTitle(number.metric)},
      {"unit", unit.text},
      {"values", ListJson(number.values, [&](double x) { return NumberJson(unit.per_unit * x); })}};
}

PageValue PredictedNumberJson(const PredictedNumber& n) {
  const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(n.name));
  const auto shown = [&](double x) { return NumberJson(unit.per_unit * x); };
  PageValue json{{"title", MetricTitle(n.name)},
                 {"unit", unit.text},
                 {"usual", n.is_usual},
                 {"mean", shown(n.mean)},
                 {"low", shown(n.low)},
                 {"high", shown(n.high)},
                 {"parameters_sd", shown(n.parameters_sd)},
                 {"run_sd", shown(n.run_sd)},
                 {"parameters_share", NumberJson(n.parameters_share)},
                 {"silent", SilentText(n)}};
  json["surrogate"] = nullptr;
  if (n.surrogate) {
    json["surrogate"] = {{"used", n.surrogate->is_used},
                         {"scale_factor", NumberJson(n.surrogate->scale_factor)},
                         {"left_out", shown(n.surrogate->left_out_error)},
                         {"draws", shown(n.surrogate->draws_error)}};
  }
  json["measured"] = nullptr;
  if (n.measured) {
    json["measured"] = {{"value", shown(n.measured->value)},
                        {"error", shown(n.measured->standard_error)},
                        {"inside", n.measured->is_inside},
                        {"another_inside", n.measured->nearest_is_inside},
                        {"another_is_told", !std::isnan(n.run_sd)}};
  }
  return json;
}

}  // namespace

PageValue NextTableJson(const NextTableView& table) {
  const ShownUnit unit = ShownUnitOf(table.goal ? rigs::UnitOfObservable(table.goal->metric) : "-");
  const auto candidate = [&](const CandidateView& c) {
    return PageValue{{"name", c.name},
                     {"what", c.what},
                     {"remaining", NumberJson(c.remaining)},
                     {"bits", NumberJson(c.bits)},
                     {"needs_simulations", c.needs_simulations},
                     {"goal", NumberJson(unit.per_unit * c.goal)},
                     {"width", NumbersJson(c.width)},
                     {"simulations", c.num_simulations},
                     {"core_time", NumberJson(c.core_time)},
                     {"apart", ListJson(c.apart, NumbersJson)},
                     {"apart_by", ListJson(c.apart_by, ApartJson)},
                     {"uri", UriJson(c.picture)},
                     {"picture_width", c.picture.width},
                     {"picture_height", c.picture.height}};
  };
  PageValue goal = nullptr;
  if (table.goal) {
    goal = {{"process", table.goal->process},
            {"title", MetricTitle(table.goal->metric)},
            {"unit", unit.text},
            {"half_width", NumberJson(unit.per_unit * table.goal->half_width)}};
  }
  return {{"width", NumbersJson(table.width)},
          {"asked", table.asked},
          {"outdated", table.is_outdated},
          {"goal", goal},
          {"candidates", ListJson(table.candidates, candidate)}};
}

PageValue PredictionJson(const PredictionView& view) {
  const Prediction& p = view.prediction;
  const auto set = [&](int draw) {
    return NumbersJson(p.draws.at(static_cast<std::size_t>(draw)).values);
  };
  return {{"name", p.name},
          {"test", p.test},
          {"by", base::NameOf(p.by)},
          {"scale_factor", NumberJson(p.scale_factor)},
          {"draws", p.draws.size()},
          {"runs", p.num_runs},
          {"ended", p.num_ended},
          {"outdated", view.is_outdated},
          {"notes", p.notes},
          {"numbers", ListJson(p.numbers, PredictedNumberJson)},
          {"mean", UriJson(view.mean)},
          {"mean_size", {view.mean.width, view.mean.height}},
          {"different", UriJson(view.different)},
          {"different_size", {view.different.width, view.different.height}},
          {"different_sets", ListJson(p.different, set)}};
}

PageValue SensitivityJson(const SensitivityView& view) {
  const auto shift = [](const FixedMove& m, const AnswerShift& s) {
    return PageValue{{"to", NumberJson(s.to)},   {"error", NumberJson(s.standard_error)},
                     {"low", NumberJson(s.low)}, {"high", NumberJson(s.high)},
                     {"exceeds", m.Exceeds(s)},  {"told", m.IsTold(s)}};
  };
  const auto move = [&](const FixedMove& m) {
    return PageValue{
        {"name", m.name},
        {"from", m.from},
        {"to", m.to},
        {"why_not", m.why_not},
        {"fits_no_set", m.FitsNoSet() && !view.table.FitsNoSet()},
        {"moves_still", m.moves_still},
        {"answer", ListJson(m.answer, [&](const AnswerShift& s) { return shift(m, s); })}};
  };
  return {{"outdated", view.is_outdated},
          {"scale_factor", NumberJson(view.table.scale_factor)},
          {"alarms", SensitivityAlarms(view.table)},
          {"moves", ListJson(view.table.moves, move)}};
}

// The experiment whose misfit the Sobol indices are of: the first with images that the answer rests
// on. Empty where there is one experiment only.
std::string SobolExperiment(const campaign::Answer& a) {
  if (a.experiments.size() < 2) return "";
  for (const campaign::ResultExperiment& e : a.experiments) {
    if (e.has_image && !campaign::IsHeldOut(a, e.name)) return e.name;
  }
  return "";
}

PageValue HeadlineJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  const campaign::Answer& a = *e.answer;
  const PageValue objective = ObjectiveOf(e);
  const std::string& shown = e.experiments.at(e.experiment);
  const campaign::ResultStanding* standing = campaign::StandingOf(a, shown);
  const auto& noise_sd = a.experiments.at(e.experiment).noise_sd;
  return {
      {"values", ListJson(a.parameters, ValueJson)},
      {"sentences", HeadlineWords(e)},
      {"verdict_kind", a.verdict ? base::NameOf(a.verdict->kind) : ""},
      {"fits", !campaign::IsDoubtful(a)},
      {"has_card", a.conditions.command.empty()},  // of another engine nothing is converted
      {"trade_off", TradeOffWords(e)},
      {"unsettled", a.unsettled.has_value()},
      {"use", UseWords(a)},
      {"branches", a.posterior ? ListJson(a.posterior->branches, BranchJson) : PageValue::array()},
      {"representatives",
       ListJson(data.representative,
                [&](const RepresentativeView& view) { return RepresentativeJson(data, view); })},
      {"widths", ListJson(data.widths, WidthJson)},
      {"next", ListJson(data.next_steps, StepJson)},
      {"fit", ListJson(e.fit, FitJson)},
      {"fit_sentence", FitSentence(e.fit)},
      {"objective_title", objective["title"]},
      {"objective_unit", objective["unit"]},
      {"predicted", NumberJson(standing != nullptr ? standing->predicted : base::kNotKnown)},
      {"predicted_sd", NumberJson(standing != nullptr ? standing->predicted_sd : base::kNotKnown)},
      {"noise_sd", NumberJson(noise_sd.value_or(base::kNotKnown))},
      {"region_volume", NumberJson(a.posterior ? a.posterior->region_volume : base::kNotKnown)},
      {"sobol_of", SobolExperiment(a)},
      {"sobol_first", SobolJson(a, &campaign::ResultParameter::sobol_first)},
      {"sobol_total", SobolJson(a, &campaign::ResultParameter::sobol_total)},
      {"model", a.model}};
}

}  // namespace talus::analysis
