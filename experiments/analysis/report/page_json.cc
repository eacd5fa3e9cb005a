#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/analysis/report/base64.h"
#include "experiments/analysis/report/labels.h"
#include "experiments/analysis/report/methods.h"
#include "experiments/analysis/report/page.h"

namespace talus::analysis {
namespace {

using Json = nlohmann::ordered_json;

// Six digits are more than a screen shows and keep a page of 10 000 trials small.
Json Number(double x) {
  if (!std::isfinite(x)) return nullptr;
  if (x == 0) return 0;
  const double unit = std::pow(10.0, 5 - std::floor(std::log10(std::abs(x))));
  return std::isfinite(unit) ? std::round(x * unit) / unit : x;
}

Json Numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double x : values) list.push_back(Number(x));
  return list;
}

template <class Range, class Function>
Json List(const Range& range, Function&& make) {
  Json list = Json::array();
  for (const auto& element : range) list.push_back(make(element));
  return list;
}

// "sliding_friction" → "sliding friction"
std::string Spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

Json ParametersJson(const Evidence& evidence) {
  return List(evidence.parameters, [](const ParameterInfo& p) {
    return Json{{"name", p.range.name},
                {"title", p.symbol == p.range.name ? "" : Spaced(p.range.name)},
                {"symbol", p.symbol},
                {"unit", p.unit},
                {"low", Number(p.range.low)},
                {"high", Number(p.range.high)},
                {"log", p.range.scale == optimizer::Scale::kLog}};
  });
}

// By column: half the size of a list of objects.
Json TrialsJson(const Evidence& evidence) {
  Json values = Json::array(), metrics = Json::array();
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    values.push_back(
        List(evidence.trials, [&](const TrialEvidence& t) { return Number(t.values[k]); }));
  }
  for (std::size_t k = 0; k < evidence.metrics.size(); ++k) {
    metrics.push_back(
        List(evidence.trials, [&](const TrialEvidence& t) { return Number(t.metrics[k]); }));
  }
  return {
      {"id", List(evidence.trials, [](const TrialEvidence& t) { return t.id; })},
      {"state",
       List(evidence.trials, [](const TrialEvidence& t) { return base::NameOf(t.state); })},
      {"purpose", List(evidence.trials, [](const TrialEvidence& t) { return t.purpose; })},
      {"reason", List(evidence.trials, [](const TrialEvidence& t) { return t.reason; })},
      {"seconds", List(evidence.trials, [](const TrialEvidence& t) { return Number(t.seconds); })},
      {"values", values},
      {"metrics", metrics}};
}

Json CampaignJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  double cpu = 0;
  for (const TrialEvidence& t : e.trials) cpu += std::isfinite(t.cpu_seconds) ? t.cpu_seconds : 0;
  const ObjectiveFinding& own = data.own();
  // The noise floor is a SAD: no other objective can be held against it.
  const double floor =
      own.info.objective == journal::Objective::kSad ? e.reference.noise_floor : kUndefined;
  return {{"name", e.name},
          {"state", e.state},
          {"stop_reason", e.stop_reason},
          {"budget", e.max_simulations},
          {"core_hours", cpu > 0 ? Number(cpu / 3600) : Json(nullptr)},
          {"objective",
           {{"key", own.info.key},
            {"metric", own.info.metric},
            {"title", own.info.title},
            {"unit", own.info.unit},
            {"is_angle", own.info.is_angle},
            {"reference", Number(own.reference)},
            {"noise_sd", Number(own.noise_sd)},
            {"noise_floor", Number(floor)}}}};
}

Json HeadlineJson(const Conclusion& c) {
  return {{"values", List(c.values,
                          [](const RecommendedValue& v) {
                            return Json{{"value", Number(v.value)},
                                        {"low", Number(v.low)},
                                        {"high", Number(v.high)}};
                          })},
          {"verdict", c.verdict},
          {"branches", List(c.branches,
                            [](const AnswerBranch& b) {
                              return Json{{"share", Number(b.share)},
                                          {"values", Numbers(b.values)},
                                          {"low", Numbers(b.low)},
                                          {"high", Numbers(b.high)}};
                            })},
          {"predicted", Number(c.predicted)},
          {"predicted_sd", Number(c.predicted_sd)},
          {"confirmed", Number(c.confirmed)},
          {"num_confirmed", c.num_confirmed},
          {"noise_sd", Number(c.noise_sd)},
          {"tied_volume", Number(c.tied_volume)},
          {"sobol_first", Numbers(c.sobol_first)},
          {"sobol_total", Numbers(c.sobol_total)},
          {"model", c.model}};
}

Json SetJson(const ComparedSet& set) {
  return {{"trials", set.trials},
          {"values", Numbers(set.values)},
          {"quantity", Number(set.quantity)},
          {"objective", Number(set.objective)}};
}

Json FindingJson(const ObjectiveFinding& f) {
  Json json{{"key", f.info.key},
            {"metric", f.info.metric},
            {"title", f.info.title},
            {"unit", f.info.unit},
            {"is_angle", f.info.is_angle},
            {"reference", Number(f.reference)},
            {"reference_error", Number(f.reference_error)},
            {"noise_sd", Number(f.noise_sd)},
            {"absent", f.absent},
            {"trials",
             {{"num_sets", f.from_trials.num_sets},
              {"num_tied", f.from_trials.num_tied},
              {"tied_volume", Number(f.from_trials.tied_volume)},
              {"best", List(f.from_trials.best, SetJson)}}},
            {"model", nullptr}};
  if (f.from_model) {
    json["model"] = {{"values", Numbers(f.from_model->values)},
                     {"quantity", Number(f.from_model->there.quantity)},
                     {"objective", Number(f.from_model->there.objective)},
                     {"sd", Number(f.from_model->there.sd)},
                     {"tied_volume", Number(f.from_model->tied_volume)}};
  }
  return json;
}

Json SliceJson(const ModelSlice& slice) {
  const auto column = [&](double ObjectivePrediction::*field) {
    return List(slice.predicted, [&](const ObjectivePrediction& p) { return Number(p.*field); });
  };
  return {{"parameter", slice.parameter},
          {"x", Numbers(slice.x)},
          {"mean", column(&ObjectivePrediction::objective)},
          {"low", column(&ObjectivePrediction::low)},
          {"high", column(&ObjectivePrediction::high)}};
}

Json PairJson(const PairChance& pair) {
  return {{"i", pair.i},
          {"j", pair.j},
          {"x", Numbers(pair.x_edges)},
          {"y", Numbers(pair.y_edges)},
          {"chance", Numbers(pair.chance)}};
}

Json OutlineJson(const OutlineCurve& outline) {
  Json points = Json::array();
  for (std::size_t i = 0; i < outline.x.size(); ++i) {
    points.push_back({Number(1e3 * outline.x[i]), Number(1e3 * outline.height[i])});
  }
  return {{"title", outline.title}, {"points", points}};
}

Json PictureJson(const Picture& picture) {
  return {{"title", picture.title},
          {"caption", picture.caption},
          {"width", picture.width},
          {"height", picture.height},
          {"uri", "data:image/png;base64," + Base64(picture.png)}};
}

}  // namespace

std::string PageJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  const Conclusion* conclusion = e.conclusion ? &*e.conclusion : nullptr;
  const Json metrics = List(e.metrics, [](const MetricInfo& m) {
    return Json{{"name", m.name}, {"title", MetricTitle(m.name)}, {"unit", PrettyUnit(m.unit)}};
  });
  const Json page{
      {"campaign", CampaignJson(data)},
      {"parameters", ParametersJson(e)},
      {"metrics", metrics},
      {"headline", conclusion ? HeadlineJson(*conclusion) : Json(nullptr)},
      {"warnings", conclusion ? Json(conclusion->warnings) : Json::array()},
      {"conditions", conclusion ? Json(conclusion->conditions) : Json::array()},
      {"trials", TrialsJson(e)},
      {"objectives", List(data.findings, FindingJson)},
      {"slices", List(data.slices, SliceJson)},
      {"pairs", List(data.pairs, PairJson)},
      {"plate_mm", Number(1e3 * e.reference.aehp.frame.plate_diameter)},
      {"outlines", List(data.outlines, OutlineJson)},
      {"pictures", List(data.pictures, PictureJson)},
      {"measures",
       List(data.measures,
            [](const MeasuredProfile& m) {
              return Json{{"title", m.title}, {"note", m.note}, {"values", Numbers(m.metrics)}};
            })},
      {"stages", List(e.stages,
                      [](const StageTime& s) {
                        return Json{{"name", s.name}, {"seconds", Number(s.seconds)}};
                      })},
      {"methods", MethodsText(data)},
      {"versions", List(e.versions,
                        [](const NamedText& v) {
                          return Json{{"name", v.name}, {"version", v.text}};
                        })},
      {"spec", e.spec}};
  // Text that is not UTF-8, as a log may hold, is shown with replacement characters.
  return page.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace talus::analysis
