#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "experiments/analysis/compare/compare_tables.h"

namespace talus::analysis {
namespace {

using Json = nlohmann::ordered_json;

Json Number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json ValuesJson(const Evidence& evidence, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t k = 0; k < values.size(); ++k) {
    json[evidence.parameters[k].column] = Number(values[k]);
  }
  return json;
}

Json SetJson(const Evidence& evidence, const ComparedSet& set) {
  return {{"trials", set.trials},
          {"values", ValuesJson(evidence, set.values)},
          {"quantity", Number(set.quantity)},
          {"objective", Number(set.objective)}};
}

Json TrialsJson(const Evidence& evidence, const TrialFinding& finding) {
  Json best = Json::array();
  for (const ComparedSet& set : finding.best) best.push_back(SetJson(evidence, set));
  return {{"num_sets", finding.num_sets},
          {"num_tied_sets", finding.num_tied},
          {"tied_volume_fraction", finding.tied_volume},
          {"best", best}};
}

Json ModelJson(const Evidence& evidence, const ModelFinding& finding) {
  const bool is_known = finding.withheld.empty();
  return {{"values", is_known ? ValuesJson(evidence, finding.values) : Json(nullptr)},
          {"withheld", is_known ? Json(nullptr) : Json(finding.withheld)},
          {"quantity", Number(finding.there.quantity)},
          {"quantity_sd", Number(finding.there.sd)},
          {"objective", Number(finding.there.objective)},
          {"tied_volume_fraction", finding.tied_volume}};
}

Json KnowledgeJson(const ObjectiveKnowledge& k) {
  if (!k.absent.empty()) return {{"title", k.title}, {"absent", k.absent}};
  return {{"title", k.title},
          {"region_90_volume_fraction", k.region},
          {"region_90_volume_fraction_low", Number(k.region_low)},
          {"region_90_volume_fraction_high", Number(k.region_high)},
          {"credible_level_of_recommended", k.level},
          {"num_refits", k.num_refits},
          {"num_refits_holding_recommended", k.num_holding}};
}

}  // namespace

std::string ComparisonJson(const ComparedCampaign& compared) {
  Json objectives = Json::array();
  for (const ObjectiveFinding& f : compared.findings) {
    Json json{{"objective", f.info.key}, {"metric", f.info.metric}};
    if (!f.absent.empty()) {
      json["absent"] = f.absent;
    } else {
      json["reference"] = Number(f.reference);
      json["reference_standard_error"] = Number(f.reference_error);
      json["noise_sd"] = Number(f.noise_sd);
      json["from_trials"] = TrialsJson(compared.evidence, f.from_trials);
      if (f.from_model) json["from_model"] = ModelJson(compared.evidence, *f.from_model);
    }
    objectives.push_back(json);
  }
  Json knowledge = Json::array();
  for (const ObjectiveKnowledge& k : compared.evidence.knowledge) {
    knowledge.push_back(KnowledgeJson(k));
  }
  const Json json{{"name", compared.evidence.name},
                  {"experiment", compared.evidence.experiments.at(compared.evidence.experiment)},
                  {"scale_factor", compared.evidence.scale_factor},
                  {"target_scale_factor", compared.evidence.target},
                  {"knowledge", knowledge},
                  {"tie_margin_in_noise_sd", kTieMargin},
                  {"objectives", objectives}};
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::analysis
