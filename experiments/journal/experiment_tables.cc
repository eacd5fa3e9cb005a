#include "experiments/journal/experiment_tables.h"

#include <cmath>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/journal/record_json.h"

namespace talus::journal {
namespace {

// The record of a row whose first column is its experiment's position.
ExperimentRecord& OwnerOf(const Statement& row, std::vector<ExperimentRecord>& experiments) {
  const std::int64_t position = row.Integer(0);
  if (position < 0 || position >= static_cast<std::int64_t>(experiments.size())) {
    throw base::Error("the journal has numbers of an experiment that it does not have");
  }
  return experiments[static_cast<std::size_t>(position)];
}

void ReadMetrics(Database& database, std::vector<ExperimentRecord>& experiments) {
  Statement row = database.Prepare(
      "SELECT experiment, name, value, unit, undefined, standard_error FROM reference_metrics "
      "ORDER BY experiment, position");
  while (row.Step()) {
    MetricRecord& m = OwnerOf(row, experiments).reference.emplace_back();
    row.Read(1, m.name, m.value, m.unit, m.undefined, m.standard_error);
  }
}

void ReadRuns(Database& database, std::vector<ExperimentRecord>& experiments) {
  Statement row = database.Prepare(
      "SELECT experiment, name, png FROM experiment_runs ORDER BY experiment, position");
  while (row.Step()) {
    RunRecord& run = OwnerOf(row, experiments).runs.emplace_back();
    row.Read(1, run.name, run.png);
  }
}

void ReadScalars(Database& database, std::vector<ExperimentRecord>& experiments) {
  Statement row = database.Prepare(
      "SELECT experiment, name, value, standard_error, degrees_of_freedom FROM experiment_scalars "
      "ORDER BY experiment, position");
  while (row.Step()) {
    ScalarRecord& scalar = OwnerOf(row, experiments).scalars.emplace_back();
    row.Read(1, scalar.name, scalar.value, scalar.standard_error, scalar.degrees);
  }
}

void ReadWarnings(Database& database, std::vector<ExperimentRecord>& experiments) {
  Statement row = database.Prepare(
      "SELECT experiment, warning_json FROM experiment_warnings ORDER BY experiment, position");
  while (row.Step()) {
    OwnerOf(row, experiments)
        .warnings.push_back(ParseRecord<PhotoWarningRecord>(row.Text(1), "a photograph's warning"));
  }
}

}  // namespace

void InsertExperiment(Database& database, std::int64_t position, const ExperimentRecord& e) {
  database.Prepare("INSERT INTO experiments VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)")
      .Bind(position, e.name, Blob{e.aehp_png}, Blob{e.aehp_sd_png}, e.frame_json, e.nebp_px,
            e.num_heaps, e.noise_mm2.value_or(std::nan("")))
      .Finish();
  std::int64_t i = 0;
  for (const MetricRecord& m : e.reference) {
    database.Prepare("INSERT INTO reference_metrics VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)")
        .Bind(position, i++, m.name, m.value, m.unit, m.undefined, m.standard_error)
        .Finish();
  }
  i = 0;
  for (const RunRecord& run : e.runs) {
    database.Prepare("INSERT INTO experiment_runs VALUES (?1, ?2, ?3, ?4)")
        .Bind(position, i++, run.name, Blob{run.png})
        .Finish();
  }
  i = 0;
  for (const ScalarRecord& scalar : e.scalars) {
    database.Prepare("INSERT INTO experiment_scalars VALUES (?1, ?2, ?3, ?4, ?5, ?6)")
        .Bind(position, i++, scalar.name, scalar.value, scalar.standard_error, scalar.degrees)
        .Finish();
  }
  i = 0;
  for (const PhotoWarningRecord& warning : e.warnings) {
    database.Prepare("INSERT INTO experiment_warnings VALUES (?1, ?2, ?3)")
        .Bind(position, i++, base::JsonText(base::ToJson(warning)))
        .Finish();
  }
}

std::vector<ExperimentRecord> ReadExperiments(Database& database) {
  std::vector<ExperimentRecord> experiments;
  Statement row = database.Prepare(
      "SELECT name, aehp_png, aehp_sd_png, frame_json, aehp_nebp_px, num_heaps, "
      "experimental_noise_floor_mm2 FROM experiments ORDER BY position");
  while (row.Step()) {
    ExperimentRecord& e = experiments.emplace_back();
    row.Read(0, e.name, e.aehp_png, e.aehp_sd_png, e.frame_json, e.nebp_px, e.num_heaps,
             e.noise_mm2);
  }
  ReadMetrics(database, experiments);
  ReadRuns(database, experiments);
  ReadScalars(database, experiments);
  ReadWarnings(database, experiments);
  return experiments;
}

}  // namespace talus::journal
