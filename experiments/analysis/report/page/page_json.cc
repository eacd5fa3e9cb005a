#include <cmath>

#include "base/json/json_text.h"
#include "base/text/base64.h"
#include "experiments/analysis/compare/knowledge.h"
#include "experiments/analysis/report/charts/colors.h"
#include "experiments/analysis/report/data/methods.h"
#include "experiments/analysis/report/page/json_parts.h"
#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/views/answer_words.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {

PageValue NumberJson(double x) {
  if (!std::isfinite(x)) return nullptr;
  if (x == 0) return 0;
  const double unit = std::pow(10.0, 5 - std::floor(std::log10(std::abs(x))));
  return std::isfinite(unit) ? std::round(x * unit) / unit : x;
}

PageValue NumbersJson(const std::vector<double>& values) {
  PageValue list = PageValue::array();
  for (const double x : values) list.push_back(NumberJson(x));
  return list;
}

std::string ValueTitle(const Criterion& criterion) {
  return criterion.is_distance ? criterion.title + ", off by" : criterion.title;
}

PageValue UriJson(const Picture& picture) {
  if (picture.png.empty()) return nullptr;
  return "data:image/png;base64," + base::Base64(picture.png);
}

namespace {

// In the unit that people read it in.
PageValue FindingJson(const ObjectiveFinding& f) {
  const auto shown = [&](double value) { return NumberJson(f.info.per_unit * value); };
  const auto set = [&](const ComparedSet& s) {
    return PageValue{{"trials", s.trials},
                     {"values", NumbersJson(s.values)},
                     {"quantity", shown(s.quantity)},
                     {"objective", shown(s.objective)}};
  };
  return {{"key", f.info.key},
          {"metric", rigs::ShownName(f.info.metric)},
          {"title", f.info.title},
          {"value_title", ValueTitle(f.info)},
          {"unit", f.info.unit},
          {"is_distance", f.info.is_distance},
          {"reference", shown(f.reference)},
          {"reference_error", shown(f.reference_error)},
          {"noise_sd", shown(f.noise_sd)},
          {"absent", f.absent},
          {"trials",
           {{"num_sets", f.from_trials.num_sets},
            {"num_tied", f.from_trials.num_tied},
            {"tied_volume", NumberJson(f.from_trials.tied_volume)},
            {"best", ListJson(f.from_trials.best, set)}}}};
}

PageValue KnowledgeJson(const ObjectiveKnowledge& k) {
  return {{"title", k.title},
          {"absent", k.absent},
          {"region", NumberJson(k.region)},
          {"low", NumberJson(k.region_low)},
          {"high", NumberJson(k.region_high)},
          {"holds", k.Holds()},
          {"num_holding", k.num_holding},
          {"num_refits", k.num_refits}};
}

// What the model that answers expects; null while none does.
PageValue ModelJson(const ReportData& data) {
  const Evidence& e = data.evidence;
  if (!e.model) return nullptr;
  std::vector<double> values;
  for (std::size_t k = 0; k < e.parameters.size(); ++k) {
    values.push_back(e.parameters[k].range.ToNative(e.model->point[static_cast<Eigen::Index>(k)]));
  }
  return {{"values", NumbersJson(values)},
          {"expected", NumberJson(e.model->expected)},
          {"expected_sd", NumberJson(e.model->expected_sd)}};
}

PageValue SliceJson(const ModelSlice& slice) {
  return {{"parameter", slice.parameter},
          {"x", NumbersJson(slice.x)},
          {"mean", NumbersJson(slice.mean)},
          {"low", NumbersJson(slice.low)},
          {"high", NumbersJson(slice.high)}};
}

PageValue MarginalJson(const Marginal& marginal) {
  return {{"parameter", marginal.parameter},
          {"x", NumbersJson(marginal.x)},
          {"density", NumbersJson(marginal.density)},
          {"prior", NumbersJson(marginal.prior)}};
}

// Three decimals are finer than any shade.
PageValue PairJson(const PairMap& pair) {
  return {{"i", pair.i},
          {"j", pair.j},
          {"x", NumbersJson(pair.x_edges)},
          {"y", NumbersJson(pair.y_edges)},
          {"value", ListJson(pair.value, [](double x) { return std::round(1e3 * x) / 1e3; })}};
}

PageValue OutlineJson(const OutlineCurve& outline) {
  PageValue points = PageValue::array();
  for (std::size_t i = 0; i < outline.x.size(); ++i) {
    points.push_back({NumberJson(1e3 * outline.x[i]), NumberJson(1e3 * outline.height[i])});
  }
  return {{"title", outline.title}, {"experiment", outline.is_experiment}, {"points", points}};
}

PageValue PictureJson(const Picture& picture) {
  return {{"title", picture.title},
          {"caption", picture.caption},
          {"width", picture.width},
          {"height", picture.height},
          {"uri", UriJson(picture)}};
}

PageValue OverlayJson(const ReportData& data) {
  const PhotoOverlay& overlay = data.overlay;
  if (overlay.photographs.empty()) return nullptr;
  return {{"photographs", ListJson(overlay.photographs, PictureJson)},
          {"simulated", PictureJson(overlay.simulated)},
          {"pixel_mm", NumberJson(overlay.pixel_mm)},
          {"center_x", NumberJson(overlay.center_x)},
          {"baseline", NumberJson(overlay.baseline)},
          {"outlines", ListJson(data.overlay_outlines, OutlineJson)}};
}

PageValue FilmJson(const std::optional<FilmView>& film) {
  if (!film) return nullptr;
  return {{"title", "trial " + std::to_string(film->trial)},
          {"uri", "data:image/gif;base64," + base::Base64(film->gif)}};
}

PageValue ColorsJson() {
  return {{"palette", kPalette},
          {"regions", {kRegion50, kRegion90}},
          {"scatter_band", kScatterBand},
          {"light_ink", kInk}};
}

PageValue MeasureJson(const Evidence& evidence, const MeasuredProfile& measure) {
  PageValue values = PageValue::array();
  for (std::size_t k = 0; k < measure.metrics.size(); ++k) {
    values.push_back(
        NumberJson(rigs::ShownUnitOf(evidence.metrics[k].unit).per_unit * measure.metrics[k]));
  }
  return {{"title", measure.title}, {"note", measure.note}, {"values", values}};
}

// What the profiles look like and measure.
void AddProfiles(const ReportData& data, PageValue& page) {
  const Evidence& e = data.evidence;
  page["plate_mm"] = NumberJson(1e3 * e.reference.aehp.frame.plate_diameter);
  page["outlines"] = ListJson(data.outlines, OutlineJson);
  page["pictures"] = ListJson(data.pictures, PictureJson);
  page["overlay"] = OverlayJson(data);
  page["overlay_absent"] = data.overlay.absent;
  page["film"] = FilmJson(data.film);
  page["measures"] =
      ListJson(data.measures, [&](const MeasuredProfile& m) { return MeasureJson(e, m); });
}

void AddModel(const ReportData& data, PageValue& page) {
  page["slices"] = ListJson(data.slices, SliceJson);
  page["marginals"] = ListJson(data.marginals, MarginalJson);
  page["pairs"] = ListJson(data.pairs, PairJson);
  const auto closest = ClosestPair(data);
  page["closest_pair"] = closest ? PageValue(*closest) : PageValue(nullptr);
  page["model"] = ModelJson(data);
  page["model_absent"] = data.evidence.model_absent;
  page["region_share"] = NumberJson(RegionShare(data));
  page["region_history"] = ListJson(data.region_history, [](const RegionPoint& point) {
    return PageValue{point.num_trials, NumberJson(point.share)};
  });
}

void AddAnswer(const ReportData& data, PageValue& page) {
  const auto& answer = data.evidence.answer;
  page["next"] = data.next_table ? NextTableJson(*data.next_table) : PageValue(nullptr);
  page["predictions"] = ListJson(data.predictions, PredictionJson);
  page["sensitivity"] = data.sensitivity ? SensitivityJson(*data.sensitivity) : PageValue(nullptr);
  page["warnings"] = answer ? PageValue(AlarmWords(data.evidence)) : PageValue::array();
  page["held_out"] = answer ? PageValue(HeldOutWords(*answer)) : PageValue::array();
  page["conditions"] = answer ? PageValue(ConditionWords(answer->conditions)) : PageValue::array();
}

// What differs from one experiment to the other.
PageValue ExperimentJson(const ReportData& data) {
  PageValue page{{"campaign", CampaignJson(data)},
                 {"metrics", MetricsJson(data.evidence)},
                 {"trials", TrialsJson(data.evidence)},
                 {"objectives", ListJson(data.findings, FindingJson)},
                 {"knowledge", ListJson(data.evidence.knowledge, KnowledgeJson)},
                 {"knowledge_sentence", KnowledgeSentence(data.evidence.knowledge)},
                 {"headline", data.evidence.answer ? HeadlineJson(data) : PageValue(nullptr)}};
  AddProfiles(data, page);
  return page;
}

void AddProvenance(const ReportData& data, PageValue& page) {
  const Evidence& e = data.evidence;
  page["stages"] = ListJson(e.stages, [](const StageTime& s) {
    return PageValue{{"name", s.name}, {"seconds", NumberJson(s.seconds)}};
  });
  page["methods"] = MethodsText(data);
  page["versions"] = ListJson(e.versions, [](const NamedText& v) {
    return PageValue{{"name", v.name}, {"version", v.text}};
  });
  page["spec"] = e.spec;
}

}  // namespace

std::string PageJson(const ReportData& data) {
  PageValue page = ExperimentJson(data);
  page["colors"] = ColorsJson();
  page["parameters"] = ParametersJson(data.evidence);
  page["left_out"] = data.left_out;
  AddAnswer(data, page);
  AddModel(data, page);
  page["others"] = ListJson(data.others, ExperimentJson);
  AddProvenance(data, page);
  return base::JsonText(page);
}

}  // namespace talus::analysis
