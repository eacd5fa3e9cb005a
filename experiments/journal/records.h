// What a campaign's journal holds, as plain data. All quantities in SI.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "base/student_factor.h"

namespace talus::journal {

// Why a trial exists.
enum class TrialKind {
  kNoise,    // one of the replicates at one point that estimate the run-to-run scatter
  kDesign,   // proposed by the optimiser before it has a model
  kSearch,   // proposed by the optimiser
  kConfirm,  // a final candidate with a fresh seed; the optimiser is not told
  kReused    // made by a former campaign or a design; the optimiser is told before anything else
};
constexpr TrialKind LastOf(TrialKind) { return TrialKind::kReused; }

enum class TrialStatus { kRunning, kOk, kFailed };
constexpr TrialStatus LastOf(TrialStatus) { return TrialStatus::kFailed; }

// A calibrated parameter.
struct ParameterRecord {
  std::string name;  // "sliding_friction"
  double low = 0;
  double high = 0;
  std::string scale;  // "linear" or "log"
  std::string unit;   // of value, low and high; "" if none

  bool operator==(const ParameterRecord&) const = default;

  TALUS_FIELDS(name, low, high, scale, unit);
};

// "surface_energy_J_per_m2": its name in a table's head.
std::string ColumnName(const ParameterRecord& parameter);

// One number measured on a trial; `value` is NaN and `undefined` says why where it is not defined.
struct MetricRecord {
  std::string name;  // with the unit: "sad_mm2", "repose_angle_2_mean_deg"
  double value = base::kNotKnown;
  std::string unit;       // "mm2", "deg", "-"
  std::string undefined;  // empty when the value is
  // The value's, from run to run: known of an experiment of several runs only.
  double standard_error = base::kNotKnown;

  TALUS_FIELDS(name, value, unit, undefined, standard_error);
};

// The image of one of an experiment's runs.
struct RunRecord {
  std::string name;
  std::string png;  // mean of its views, in the experiment's frame

  TALUS_FIELDS(name);
};

// A number that an experiment has measured beside its images.
struct ScalarRecord {
  std::string name;  // of the metric that trials are measured by: "mass_fallen_kg"
  double value = 0;
  double standard_error = 0;  // of the value, > 0
  // Degrees of freedom that the error has, one fewer than the values it is of; 0: it is stated, and
  // counts as exact.
  int degrees = 0;

  static constexpr base::FieldKey kKeys[] = {{"degrees", "degrees_of_freedom"}};
  TALUS_FIELDS(name, value, standard_error, degrees);

  // The error that a normal value would have (base/student_factor.h).
  double NormalError() const { return base::NormalError(standard_error, degrees); }
};

// What is doubtful about an experiment's photographs.
struct PhotoWarningRecord {
  std::string kind;   // "front_lit", as measure.json calls it
  std::string photo;  // file; empty where it is of all
  double value = 0;   // as the kind says
  std::string text;   // for people

  TALUS_FIELDS(kind, photo, value, text);
};

// What trials are compared with: what was measured on the real powder by one test.
struct ExperimentRecord {
  std::string name;
  std::vector<MetricRecord> reference;  // metrics of the experiment itself
  std::string aehp_png;                 // its profile, bytes of a PNG
  std::string aehp_sd_png;          // its standard deviation image; empty for a map without runs
  std::string frame_json;           // the profile's frame, as imaging::Frame is written
  double nebp_px = 0;               // of the AEHP, equivalent black pixels
  int num_heaps = 1;                // that the AEHP is the mean of: runs, not views
  std::optional<double> noise_mm2;  // experimental noise floor, leave-one-run-out SAD [mm²]
  std::vector<RunRecord> runs;      // empty for a map
  std::vector<ScalarRecord> scalars;
  std::vector<PhotoWarningRecord> warnings{};

  // All but the images.
  static constexpr base::FieldKey kKeys[] = {{"noise_mm2", "experimental_noise_floor_mm2"}};
  TALUS_FIELDS(name, reference, frame_json, nebp_px, num_heaps, noise_mm2, runs, scalars, warnings);
};

// What holds for the campaign as a whole.
struct CampaignRecord {
  std::string name;
  std::string spec_path;      // absolute, where it was then
  std::string spec_text;      // as the user wrote it
  std::string spec_json;      // as it was understood, all defaults filled in
  std::string spec_hash;      // of spec_json when the campaign began
  std::string talus_version;  // of the program that started it
  std::string created_utc;    // 2026-01-31T12:00:00Z
  std::string objective;      // name of the metric that is minimised, or of the angle to be met
  std::vector<ParameterRecord> parameters;
  std::vector<ExperimentRecord> experiments;  // one at least

  // All but the images.
  TALUS_FIELDS(name, spec_path, spec_text, spec_json, spec_hash, talus_version, created_utc,
               objective, parameters, experiments);
};

// What changes while it runs.
enum class CampaignState { kRunning, kInterrupted, kFinished };
constexpr CampaignState LastOf(CampaignState) { return CampaignState::kFinished; }

struct ProgressRecord {
  CampaignState state = CampaignState::kRunning;
  std::string stop_reason{};  // in words, when it is not running
  double elapsed_s = 0;       // time worked on it, all sessions together
  std::string result_json{};  // result.json's text once there is one
  std::string stop_json{};    // of the rule that has ended the search, as result.json has it
};

// Origin of a trial of the design that `talus next` had simulated before its test was added.
inline constexpr const char* kOriginNext = "next";

struct TrialRecord {
  std::int64_t id = 0;  // from 1; the folder is trials/0001
  TrialKind kind = TrialKind::kSearch;
  // Its number within noise, within design and search, within confirm, within reused.
  std::int64_t kind_index = 0;
  std::int64_t set = 0;        // replicates of one proposal, and of one candidate, share a number
  std::string origin;          // of the proposal: design, repeat, model, search, or kOriginNext; of
                               // a reused one the folder it was made in; "" otherwise
  std::string objective;       // that the proposal was made for
  std::vector<double> unit;    // unit cube, in the order of the campaign's parameters
  std::vector<double> native;  // SI
  std::int64_t seed = 0;
  int experiment = 0;  // which of the campaign's is simulated, from 0
  double scale_factor = 1;
  TrialStatus status = TrialStatus::kRunning;
  std::string reason;             // why it failed, or how it ended
  int attempts = 1;               // 2 when it was tried again with a new seed
  std::int64_t finish_order = 0;  // from 1, in which trials were told; 0 while running
  double due = 0;  // when it is to be told: on the campaign's clock of expected costs [core s]
  std::string started_utc;
  std::string finished_utc;
  double duration_s = 0;  // wall-clock
  double cpu_s = 0;
  std::int64_t num_steps = 0;
  std::int64_t num_particles = 0;
  std::string host;
  std::string job;  // the runner's own name for it, such as a cluster's job number
  std::vector<MetricRecord> metrics;

  static constexpr base::FieldKey kKeys[] = {{"unit", "unit_point"}, {"native", "values"}};
  TALUS_FIELDS(id, kind, kind_index, set, origin, objective, unit, native, seed, experiment,
               scale_factor, status, reason, attempts, finish_order, due, started_utc, finished_utc,
               duration_s, cpu_s, num_steps, num_particles, host, job, metrics);

  // The value of a metric; nothing when the trial has none or it is not defined.
  std::optional<double> Metric(std::string_view name) const;

  // Whether a strategy is told of it: all but the confirming ones are.
  bool IsOfSearch() const { return kind != TrialKind::kConfirm; }

  // Whether it counts against the campaign's budget: what others have made cost them.
  bool IsPaidFor() const { return IsOfSearch() && kind != TrialKind::kReused; }
};

}  // namespace talus::journal
