// What a campaign knows so far, as plain data: comparison and report are functions of it, and only
// gather_evidence.cc knows how a campaign keeps it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/analysis/compare/experiment_fit.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/journal/records.h"
#include "imaging/heap/profile.h"
#include "optimizer/search/objective_model.h"
#include "optimizer/space/parameter_space.h"

namespace talus::analysis {

struct ParameterInfo {
  optimizer::Parameter range;  // name, low, high, scale
  std::string symbol;          // for axes: "μᵣ"
  std::string unit;            // SI: "J/m²"; empty for a pure number
  std::string column;          // name with unit, for tables: "surface_energy_J_per_m2"
};

struct MetricInfo {
  std::string name;  // with its unit: "sad_mm2"
  std::string unit;  // "mm2", "deg", "-"
};

struct TrialEvidence {
  int id = 0;
  journal::TrialStatus state = journal::TrialStatus::kOk;
  journal::TrialKind kind = journal::TrialKind::kSearch;
  Eigen::VectorXd point;       // unit cube
  std::vector<double> values;  // in the order of Evidence::parameters, SI
  std::int64_t seed = 0;
  double scale_factor = 1;
  std::vector<double> metrics;           // in the order of Evidence::metrics; NaN where it has none
  std::string reason;                    // why it failed
  double seconds = base::kNotKnown;      // wall time of its simulation [s]
  double cpu_seconds = base::kNotKnown;  // [s]
};

// The experiment that the trials are compared with.
struct ReferenceEvidence {
  imaging::Profile aehp;                         // empty where the experiment has numbers only
  std::vector<journal::ScalarRecord> numbers{};  // measured beside the images, or without any
  std::vector<double> metrics;           // of the AEHP itself, in the order of Evidence::metrics
  std::vector<double> errors;            // standard errors of these, from run to run
  double noise_floor = base::kNotKnown;  // leave-one-run-out SAD [mm²]; NaN for a lone map
  int num_heaps = 1;                     // runs that the AEHP is the mean of

  bool has_image() const { return !aehp.image.pixels.empty(); }
};

// The model that the campaign answers with, asked again. Points are of the unit cube.
struct ModelEvidence {
  Eigen::VectorXd point;              // that it recommends
  double expected = base::kNotKnown;  // the objective there, of the experiment that is shown; >= 0
  double expected_sd = base::kNotKnown;
  double noise_sd = base::kNotKnown;  // scatter of one evaluation there
  Eigen::MatrixXd draws;              // of the posterior, one a row
  Eigen::MatrixXd prior_draws{};      // of the prior; no rows where it is uniform
  // Share of the posterior that is denser than at a point, one a row.
  std::function<Eigen::VectorXd(const Eigen::MatrixXd&)> credible_levels{};
  // The objective, >= 0, one point a row; empty where the experiment that is shown has no image.
  std::function<optimizer::Moments(const Eigen::MatrixXd&)> predict;
};

// What one objective knows by itself (knowledge.h).
struct ObjectiveKnowledge {
  std::string title;                     // "whole heap (SAD, RMSE)", "AOR 1"
  std::string absent{};                  // why nothing is known
  double region = base::kNotKnown;       // its joint 90 % region, share of the searched ranges
  double region_low = base::kNotKnown;   // … known to lie between these, 90 %
  double region_high = base::kNotKnown;  // NaN: not known
  double level = base::kNotKnown;        // credible level of the campaign's recommended set
  int num_holding = 0;                   // refits without some trials whose region holds that set
  int num_refits = 0;                    // … of so many

  bool Holds() const { return level <= optimizer::kRegionLevel; }
};

struct NamedText {
  std::string name;
  std::string text;
};

struct StageTime {
  std::string name;
  double seconds = 0;
};

struct Evidence {
  std::string name;
  std::filesystem::path folder;  // of the campaign
  journal::CampaignState state = journal::CampaignState::kRunning;
  bool ended_silently = false;  // kRunning, but no process works on it
  std::string stop_reason;      // empty while running
  std::size_t experiment = 0;   // whose trials these are, of the campaign's
  double scale_factor = 1;      // of the trials that tell: the finest of the search
  double target = 1;            // the scale factor that the answer is for
  std::string objective;        // key of one of kObjectives: the latest search's
  std::string strategy;         // its kind
  int max_simulations = 0;      // the budget; 0: none
  double seconds_left =
      base::kNotKnown;  // at most, while it runs; undefined before a trial has ended
  std::vector<ParameterInfo> parameters;
  std::vector<MetricInfo> metrics;
  std::vector<TrialEvidence> trials;
  std::vector<TrialEvidence> of_others;  // trials of the other experiments, without metrics
  ReferenceEvidence reference;
  std::optional<campaign::Answer> answer;     // none before there is one
  std::vector<FitRow> fit;                    // of it, to every experiment
  std::vector<std::string> experiments;       // all of the campaign's, by name
  std::optional<ModelEvidence> model;         // none where no model answers
  std::string model_absent;                   // why, where there is none
  std::vector<ObjectiveKnowledge> knowledge;  // none before the campaign has ended
  std::vector<StageTime> stages;              // where the time went
  double core_hours = 0;                      // of the trials so far, or as the answer says it
  std::vector<NamedText> versions;            // of talus and what it stands on
  std::string spec;                           // the text of the spec's file
  std::string spec_json;                      // as it was understood
  std::function<std::optional<imaging::Profile>(int)> profile;  // ANHP of a trial by its id
  std::function<bool(const Eigen::VectorXd&)> feasible;         // of the unit cube; none: all of it

  // No parameter is a nuisance.
  bool all_asked_for() const {
    return std::ranges::none_of(parameters, [](const auto& p) { return p.range.is_nuisance; });
  }
  bool IsRunning() const { return state == journal::CampaignState::kRunning && !ended_silently; }

  // Those of all experiments; they live as long as this.
  std::vector<const TrialEvidence*> AllTrials() const {
    std::vector<const TrialEvidence*> all;
    for (const TrialEvidence& trial : trials) all.push_back(&trial);
    for (const TrialEvidence& trial : of_others) all.push_back(&trial);
    return all;
  }
};

// Whether a trial of any experiment has ended since that with this id: what was made of those up to
// it is older than the campaign.
inline bool HaveTrialsEndedSince(const Evidence& evidence, std::int64_t id) {
  return std::ranges::any_of(evidence.AllTrials(), [&](const TrialEvidence* trial) {
    return trial->id > id && trial->state != journal::TrialStatus::kRunning;
  });
}

// Column of a metric; nothing when no trial has it.
std::optional<std::size_t> MetricColumn(const Evidence& evidence, std::string_view metric);

}  // namespace talus::analysis
