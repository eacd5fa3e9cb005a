#include "tests/experiments/synthetic_journal.h"

#include <algorithm>

#include "base/json/json_writer.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/journal/journal.h"
#include "imaging/formats/images/image_file.h"

namespace talus::test {
namespace {

std::vector<journal::MetricRecord> RecordsOf(const analysis::Evidence& evidence,
                                             const std::vector<double>& values) {
  std::vector<journal::MetricRecord> records;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const analysis::MetricInfo& info = evidence.metrics[k];
    const bool defined = std::isfinite(values[k]);
    records.push_back({.name = info.name,
                       .value = values[k],
                       .unit = info.unit,
                       .undefined = defined ? "" : "the slope overhangs"});
  }
  return records;
}

// As a user would have written it; a model of numbers, which is quick.
nlohmann::ordered_json SpecOf(const analysis::Evidence& evidence) {
  nlohmann::ordered_json spec{
      {"name", evidence.name},
      {"experiment", {{"photos", "photos"}, {"plate_diameter", "10 mm"}}},
      {"powder",
       {{"material",
         {{"density", "4386 kg/m^3"},
          {"youngs_modulus", "26.25 MPa"},
          {"poisson_ratio", 0.342},
          {"restitution", 0.9}}},
        {"sizes", {{"kind", "mono"}, {"diameter", "0.2 mm"}}},
        {"mass", "1.6 g"}}},
      {"device",
       {{"tube_inner_diameter", "10 mm"},
        {"plate_diameter", "10 mm"},
        {"plate", "disc"},
        {"lift_velocity", "10 mm/s"}}},
      {"models",
       {{"adhesion", evidence.parameters.size() > 2 ? "jkr" : "none"}, {"rolling", "epsd"}}},
      {"objective", evidence.objective},
      {"budget", {{"simulations", evidence.max_simulations}}}};
  for (const analysis::ParameterInfo& p : evidence.parameters) {
    spec["parameters"][p.range.name] = {
        {"min", p.range.low}, {"max", p.range.high}, {"scale", base::NameOf(p.range.scale)}};
  }
  const bool coarse = std::ranges::any_of(
      evidence.trials, [](const analysis::TrialEvidence& t) { return t.scale_factor != 1; });
  if (coarse) {
    spec["coarse_graining"] = {{"scale_factors", {2, 1}}};
  } else {
    spec["strategy"] = {{"kind", evidence.trials.size() > 1000 ? "lhs" : "gp"}};
  }
  return spec;
}

journal::CampaignRecord CampaignOf(const analysis::Evidence& evidence) {
  journal::CampaignRecord record;
  record.name = evidence.name;
  record.spec_path = "/somewhere/spec.json";
  record.spec_text = evidence.spec;
  record.spec_json = SpecOf(evidence).dump();
  record.spec_hash = "0123456789abcdef";
  record.talus_version = "0.1.0";
  record.created_utc = "2026-01-31T12:00:00Z";
  record.objective = evidence.objective;
  for (const analysis::ParameterInfo& p : evidence.parameters) {
    record.parameters.push_back({.name = p.range.name,
                                 .low = p.range.low,
                                 .high = p.range.high,
                                 .scale = std::string(base::NameOf(p.range.scale)),
                                 .unit = p.unit == "J/m²" ? "J/m^2" : p.unit});
  }
  journal::ExperimentRecord experiment;
  experiment.name = "heap";
  experiment.reference = RecordsOf(evidence, evidence.reference.metrics);
  experiment.aehp_png = imaging::EncodePng(evidence.reference.aehp.image);
  experiment.frame_json = base::ToJson(evidence.reference.aehp.frame).dump();
  experiment.noise_mm2 = evidence.reference.noise_floor;
  record.experiments.push_back(experiment);
  return record;
}

}  // namespace

void WriteSyntheticJournal(const analysis::Evidence& evidence,
                           const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  journal::Journal journal =
      journal::Journal::Create(journal::JournalPath(folder), CampaignOf(evidence));
  for (const analysis::TrialEvidence& t : evidence.trials) {
    journal::TrialRecord record;
    record.id = t.id;
    record.kind = t.kind;
    record.kind_index = t.id;
    record.set = t.id;
    record.unit.assign(t.point.data(), t.point.data() + t.point.size());
    record.native = t.values;
    record.seed = t.seed;
    record.scale_factor = t.scale_factor;
    record.finish_order = t.id;
    record.started_utc = "2026-01-31T12:00:00Z";
    journal.Start({&record, 1}, base::Outlives::kProgram);
    record.status = t.state;
    record.reason = t.reason;
    record.duration_s = t.seconds;
    record.cpu_s = t.cpu_seconds;
    record.finished_utc = "2026-01-31T12:01:00Z";
    const bool done = t.state == journal::TrialStatus::kOk;
    if (done) record.metrics = RecordsOf(evidence, t.metrics);
    journal.Finish(record, done ? imaging::EncodePng(evidence.profile(t.id)->image) : "");
  }
  journal.SetProgress(
      {.state = evidence.state,
       .stop_reason = evidence.stop_reason,
       .elapsed_s = 1900,
       .result_json = evidence.answer ? campaign::AnswerJson(*evidence.answer) : std::string()});
}

}  // namespace talus::test
