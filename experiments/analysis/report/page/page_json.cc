#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/analysis/report/charts/colors.h"
#include "experiments/analysis/report/labels.h"
#include "experiments/analysis/report/methods.h"
#include "experiments/analysis/report/page/base64.h"
#include "experiments/analysis/report/page/page.h"

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
      {"scale",
       List(evidence.trials, [](const TrialEvidence& t) { return Number(t.scale_factor); })},
      {"seconds", List(evidence.trials, [](const TrialEvidence& t) { return Number(t.seconds); })},
      {"values", values},
      {"metrics", metrics}};
}

// Of all experiments.
Json CountsJson(const Evidence& e) {
  int searched = 0, confirming = 0, failed = 0, running = 0;
  for (const auto* trials : {&e.trials, &e.of_others}) {
    for (const TrialEvidence& t : *trials) {
      const bool ok = t.state == journal::TrialStatus::kOk;
      searched += ok && t.purpose != "confirm";
      confirming += ok && t.purpose == "confirm";
      failed += t.state == journal::TrialStatus::kFailed;
      running += t.state == journal::TrialStatus::kRunning;
    }
  }
  return {
      {"searched", searched}, {"confirming", confirming}, {"failed", failed}, {"running", running}};
}

double CoreSeconds(const Evidence& e) {
  double sum = 0;
  for (const auto* trials : {&e.trials, &e.of_others}) {
    for (const TrialEvidence& t : *trials) sum += std::isfinite(t.cpu_seconds) ? t.cpu_seconds : 0;
  }
  return sum;
}

Json CampaignJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  const double cpu = CoreSeconds(e);
  const ObjectiveFinding& own = data.own();
  // The noise floor is a SAD: no other objective can be held against it.
  const double floor =
      own.info.objective == journal::Objective::kSad ? e.reference.noise_floor : kUndefined;
  return {{"name", e.name},
          {"state", e.state},
          {"stop_reason", e.stop_reason},
          {"budget", e.max_simulations},
          {"counts", CountsJson(e)},
          {"scale_factor", Number(e.scale_factor)},
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

// The picture stands in the page itself; nothing where there is none.
Json UriOf(const Picture& picture) {
  if (picture.png.empty()) return nullptr;
  return "data:image/png;base64," + Base64(picture.png);
}

Json RepresentativeJson(const ReportData& data, const RepresentativeView& view) {
  const auto column = MetricColumn(data.evidence, data.own().info.metric);
  const bool has_trial = view.trial != nullptr && column;
  const double objective =
      has_trial ? data.own().info.Value(view.trial->metrics[*column], data.own().reference)
                : kUndefined;
  return {{"values", Numbers(view.values)},
          {"recommended", view.is_recommended},
          {"expected", Number(view.expected)},
          {"expected_sd", Number(view.expected_sd)},
          {"trial", has_trial ? Json(view.trial->id) : Json(nullptr)},
          {"trial_values", has_trial ? Numbers(view.trial->values) : Json(nullptr)},
          {"trial_objective", Number(objective)},
          {"distance", Number(view.distance)},
          {"uri", UriOf(view.heap)},
          {"width", view.heap.width},
          {"height", view.heap.height}};
}

Json StepJson(const NextStep& step) {
  return {{"what", step.what}, {"cost", step.cost}, {"leaves", step.leaves}};
}

Json NextTableJson(const NextTableView& table) {
  const auto candidate = [](const CandidateView& c) {
    return Json{{"name", c.name},
                {"what", c.what},
                {"bits", Number(c.bits)},
                {"width", Numbers(c.width)},
                {"simulations", c.num_simulations},
                {"core_time", Number(c.core_time)},
                {"apart", List(c.apart, Numbers)},
                {"uri", UriOf(c.picture)},
                {"picture_width", c.picture.width},
                {"picture_height", c.picture.height}};
  };
  return {{"width", Numbers(table.width)},
          {"outdated", table.is_outdated},
          {"candidates", List(table.candidates, candidate)}};
}

Json HeadlineJson(const ReportData& data) {
  const Conclusion& c = *data.evidence.conclusion;
  return {{"values", List(c.values,
                          [](const RecommendedValue& v) {
                            return Json{{"value", Number(v.value)},
                                        {"low", Number(v.low)},
                                        {"high", Number(v.high)}};
                          })},
          {"verdict", c.verdict},
          {"verdict_kind", c.verdict_kind},
          {"posterior", c.has_posterior},
          {"branches", List(c.branches,
                            [](const AnswerBranch& b) {
                              return Json{{"share", Number(b.share)},
                                          {"values", Numbers(b.values)},
                                          {"low", Numbers(b.low)},
                                          {"high", Numbers(b.high)}};
                            })},
          {"representatives",
           List(data.representative,
                [&](const RepresentativeView& view) { return RepresentativeJson(data, view); })},
          {"next", List(data.next_steps, StepJson)},
          {"predicted", Number(c.predicted)},
          {"predicted_sd", Number(c.predicted_sd)},
          {"confirmed", Number(c.confirmed)},
          {"confirmed_profile", Number(c.confirmed_profile)},
          {"confirmed_over_floor", Number(c.confirmed_over_floor)},
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
  return json;
}

// What the model that answers expects; null while none does.
Json ModelJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  if (!e.model) return nullptr;
  std::vector<double> values;
  for (std::size_t k = 0; k < e.parameters.size(); ++k) {
    values.push_back(e.parameters[k].range.ToNative(e.model->point[static_cast<Eigen::Index>(k)]));
  }
  return {{"values", Numbers(values)},
          {"expected", Number(e.model->expected)},
          {"expected_sd", Number(e.model->expected_sd)},
          {"posterior", data.has_posterior()}};
}

Json SliceJson(const ModelSlice& slice) {
  return {{"parameter", slice.parameter},
          {"x", Numbers(slice.x)},
          {"mean", Numbers(slice.mean)},
          {"low", Numbers(slice.low)},
          {"high", Numbers(slice.high)}};
}

Json MarginalJson(const Marginal& marginal) {
  return {{"parameter", marginal.parameter},
          {"x", Numbers(marginal.x)},
          {"density", Numbers(marginal.density)}};
}

// Three decimals are finer than any shade.
Json PairJson(const PairMap& pair) {
  return {{"i", pair.i},
          {"j", pair.j},
          {"x", Numbers(pair.x_edges)},
          {"y", Numbers(pair.y_edges)},
          {"value", List(pair.value, [](double x) { return std::round(1e3 * x) / 1e3; })}};
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
          {"uri", UriOf(picture)}};
}

Json OverlayJson(const ReportData& data) {
  const PhotoOverlay& overlay = data.overlay;
  if (overlay.photographs.empty()) return nullptr;
  return {{"photographs", List(overlay.photographs, PictureJson)},
          {"simulated", PictureJson(overlay.simulated)},
          {"pixel_mm", Number(overlay.pixel_mm)},
          {"center_x", Number(overlay.center_x)},
          {"baseline", Number(overlay.baseline)},
          {"outlines", List(data.overlay_outlines, OutlineJson)}};
}

Json ColorsJson() {
  return {{"palette", kPalette},
          {"chance", kChance},
          {"regions", {kRegion50, kRegion90}},
          {"scatter_band", kScatterBand},
          {"light_ink", kInk}};
}

}  // namespace

std::string PageJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  const Conclusion* conclusion = e.conclusion ? &*e.conclusion : nullptr;
  const Json metrics = List(e.metrics, [](const MetricInfo& m) {
    return Json{{"name", m.name}, {"title", MetricTitle(m.name)}, {"unit", PrettyUnit(m.unit)}};
  });
  const Json page{
      {"colors", ColorsJson()},
      {"campaign", CampaignJson(data)},
      {"parameters", ParametersJson(e)},
      {"metrics", metrics},
      {"headline", conclusion ? HeadlineJson(data) : Json(nullptr)},
      {"next", data.next_table ? NextTableJson(*data.next_table) : Json(nullptr)},
      {"warnings", conclusion ? Json(conclusion->warnings) : Json::array()},
      {"held_out", conclusion ? Json(conclusion->held_out) : Json::array()},
      {"conditions", conclusion ? Json(conclusion->conditions) : Json::array()},
      {"trials", TrialsJson(e)},
      {"objectives", List(data.findings, FindingJson)},
      {"slices", List(data.slices, SliceJson)},
      {"marginals", List(data.marginals, MarginalJson)},
      {"pairs", List(data.pairs, PairJson)},
      {"model", ModelJson(data)},
      {"region_share", Number(RegionShare(data))},
      {"region_history", List(data.region_history,
                              [](const RegionPoint& point) {
                                return Json{point.num_trials, Number(point.share)};
                              })},
      {"model_absent", e.model_absent},
      {"plate_mm", Number(1e3 * e.reference.aehp.frame.plate_diameter)},
      {"outlines", List(data.outlines, OutlineJson)},
      {"pictures", List(data.pictures, PictureJson)},
      {"overlay", OverlayJson(data)},
      {"overlay_absent", data.overlay_absent},
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
