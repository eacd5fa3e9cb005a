#include "experiments/campaign/answer/consider.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/nearest.h"
#include "base/not_known.h"
#include "base/problems.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {
namespace {

constexpr std::size_t kMostNear = 5;

std::vector<NearTrial> NearestTrials(const std::vector<journal::TrialRecord>& trials,
                                     const std::vector<Reference>& references,
                                     const Eigen::VectorXd& point) {
  std::vector<NearTrial> near;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.status == journal::TrialStatus::kRunning) continue;
    near.push_back(
        {.trial = trial,
         .distance = (PointOf(trial) - point).lpNorm<Eigen::Infinity>(),
         .objective = references[static_cast<std::size_t>(trial.experiment)].Value(trial)});
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const NearTrial& a, const NearTrial& b) { return a.distance < b.distance; });
  near.resize(std::min(near.size(), kMostNear));
  return near;
}

std::vector<ConsideredParameter> KnownOf(const JointView& view, const optimizer::Answer& answer) {
  std::vector<ConsideredParameter> known;
  const std::vector<int> free = view.space.Free();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const optimizer::Parameter& p = view.space.parameters[static_cast<std::size_t>(free[i])];
    known.push_back({.name = p.name,
                     .unit = UnitOf(p.name),
                     .prior = PriorOf(*answer.posterior, view.space, i, *view.spec.parameters),
                     .is_nuisance = p.is_nuisance,
                     .low = p.ToNative(answer.credible[i].low),
                     .high = p.ToNative(answer.credible[i].high)});
  }
  return known;
}

std::string KnownText(const ConsideredParameter& p) {
  const std::string unit = p.unit.empty() ? "" : " " + p.unit;
  const auto range = [&](double low, double high) {
    return "90 % in " + base::ShortNumber(low) + " … " + base::ShortNumber(high) + unit;
  };
  std::string text = "  " + p.name + (p.is_nuisance ? " (nuisance): " : ": ");
  if (p.prior) {
    text += "prior " + p.prior->text + ", " + range(p.prior->low, p.prior->high) + "; ";
  }
  text += "posterior " + range(p.low, p.high);
  if (p.prior)
    text += ", its mean " + base::PlainNumber(p.prior->offset, 2) + " sd off the prior's";
  return text + "\n";
}

// The experiment of that name; null where the campaign has none.
const journal::ExperimentRecord* RecordOf(const ConsideredSet& c, const std::string& name) {
  const auto record = std::ranges::find(c.records, name, &journal::ExperimentRecord::name);
  return record != c.records.end() ? &*record : nullptr;
}

// "    mass fallen 10.3 mg ± 0.5 predicted, 5.1 mg ± 0.7 measured"
std::string NumbersText(const ConsideredSet& c, const ResultStanding& standing) {
  const journal::ExperimentRecord* record = RecordOf(c, standing.name);
  std::string text;
  for (std::size_t i = 0; record != nullptr && i < standing.numbers.size(); ++i) {
    const journal::ScalarRecord& measured = record->scalars.at(i);
    const auto shown = [&](double value) { return rigs::ShownNumber(measured.name, value); };
    text += "    " + rigs::SpokenName(measured.name) + " " + shown(standing.numbers[i].predicted) +
            " ± " + shown(standing.numbers[i].predicted_sd) + " predicted, " +
            shown(measured.value) + " ± " + shown(measured.standard_error) + " measured\n";
  }
  return text;
}

// As ResultStanding's, and what was measured of each number.
nlohmann::ordered_json StandingJson(const ConsideredSet& c, const ResultStanding& standing) {
  nlohmann::ordered_json json = base::ToJson(standing);
  const journal::ExperimentRecord* record = RecordOf(c, standing.name);
  for (std::size_t i = 0; record != nullptr && i < standing.numbers.size(); ++i) {
    const journal::ScalarRecord& measured = record->scalars.at(i);
    json["numbers"][i].update({{"name", measured.name},
                               {"measured", measured.value},
                               {"measured_sd", measured.standard_error}});
  }
  return json;
}

std::string NearText(const ConsideredSet& c, const NearTrial& near) {
  std::string text = "    trial " + std::to_string(near.trial.id);
  if (c.records.size() > 1) {
    text += " of " + c.records.at(static_cast<std::size_t>(near.trial.experiment)).name;
  }
  text += " at " + SetText(c.parameters, near.trial.native) + ", scale factor " +
          base::ShortNumber(near.trial.scale_factor) + ": ";
  return text +
         (near.objective ? base::ShortNumber(*near.objective) + " " + c.objective_unit
                         : std::string(base::NameOf(near.trial.status))) +
         "\n";
}

// As given, not as the unit cube rounds them; of the nuisances that were not, the point's.
std::vector<double> ValuesOf(const JointView& view, const GivenSet& given,
                             const Eigen::VectorXd& point) {
  std::vector<double> values = FreeValues(view.space, point);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(given.values[i])) values[i] = given.values[i];
  }
  return values;
}

// With what is fixed; NaN where a value is not given.
std::vector<double> NativeOf(const optimizer::ParameterSpace& space, const GivenSet& given) {
  std::vector<double> native = space.ToNative(Eigen::VectorXd::Constant(given.point.size(), 0.5));
  const std::vector<int> free = space.Free();
  for (std::size_t i = 0; i < free.size(); ++i) {
    native[static_cast<std::size_t>(free[i])] = given.values[i];
  }
  return native;
}

}  // namespace

GivenSet ReadSet(const optimizer::ParameterSpace& space,
                 const std::map<std::string, std::string>& set, MayLack may_lack) {
  base::Problems problems;
  std::vector<std::string> names;
  const std::vector<int> free = space.Free();
  GivenSet read{
      .point = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(free.size()), base::kNotKnown),
      .values = std::vector<double>(free.size(), base::kNotKnown)};
  for (std::size_t i = 0; i < free.size(); ++i) {
    const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(free[i])];
    names.push_back(p.name);
    const auto given = set.find(p.name);
    problems.Require(given != set.end() || p.is_nuisance || may_lack == MayLack::kAny, p.name,
                     "is missing; give NAME=VALUE for every calibrated parameter");
    if (given == set.end()) continue;
    try {
      const double value = ParseProperty(p.name, given->second);
      problems.Require(value >= p.low && value <= p.high, p.name, value,
                       "must be in the searched range, " + base::ShortNumber(p.low) + " to " +
                           base::ShortNumber(p.high));
      read.point[static_cast<Eigen::Index>(i)] = p.ToUnit(value);
      read.values[i] = value;
    } catch (const base::ConfigError& error) {
      problems.Add(p.name, error.what());
    }
  }
  // Relative: an answer that lies on a constraint is typed with three digits.
  constexpr double kTyped = 5e-3;
  if (const auto broken = space.BrokenBy(NativeOf(space, read), kTyped)) {
    problems.Add("constraints", "the set breaks " + *broken);
  }
  for (const auto& [name, value] : set) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    problems.Add(name, "is no calibrated parameter of this campaign" +
                           base::DidYouMean(name, names) + "; there are " + base::Listed(names));
  }
  problems.ThrowIfAny();
  return read;
}

Eigen::VectorXd Filled(const GivenSet& given, optimizer::PosteriorStrategy& strategy) {
  const Eigen::VectorXd& point = given.point;
  if (!point.hasNaN()) return point;
  const auto is_open = point.array().isNaN();
  const Eigen::VectorXd middle = is_open.select(0.5, point);
  if (!strategy.CanModel()) return middle;
  return is_open.select(strategy.Asked().WithTypicalNuisances(middle), point);
}

ConsideredSet ConsiderSet(const std::filesystem::path& root,
                          const std::map<std::string, std::string>& set) {
  const JointView view = ReadJointView(root);
  const auto strategy = StrategyOf(view, view.Answered());
  const GivenSet given = ReadSet(view.space, set);
  const Eigen::VectorXd point = Filled(given, *strategy);
  ConsideredSet considered{
      .parameters = view.record.parameters,
      .values = ValuesOf(view, given, point),
      .target_scale_factor = view.spec.coarse_graining.Target(),
      .credible_level = {},
      .experiments = {},
      .nearest = NearestTrials(view.trials, view.references, point),
      .records = view.record.experiments,
      .objective_unit = std::string(journal::InfoOf(view.spec.objective).unit)};
  if (strategy->CanModel()) {
    const optimizer::Answer answer = strategy->Recommend();
    considered.known = KnownOf(view, answer);
    considered.surrogate_narrowing = answer.posterior->surrogate_narrowing;
  }
  if (const auto standing = strategy->Consider(point)) {
    considered.credible_level = standing->credible_level;
    considered.experiments = standing->experiments;
  }
  return considered;
}

std::string ConsideredText(const ConsideredSet& c) {
  std::string text = "  set               " + SetText(c.parameters, c.values) + "\n";
  if (!c.credible_level) {
    text += "  credible level    not known yet: too few trials\n";
  } else {
    const bool inside = *c.credible_level <= optimizer::kRegionLevel;
    text += "  credible level    " + base::ShortNumber(*c.credible_level) + ": " +
            (inside ? "inside" : "outside") + " the joint 90 % region\n";
    if (IsProvisional(c.surrogate_narrowing)) {
      text += "                    " + ProvisionalText(c.surrogate_narrowing) + "\n";
    }
  }
  for (const ConsideredParameter& p : c.known) text += KnownText(p);
  for (const ResultStanding& e : c.experiments) {
    text += "  " + e.name + ": ";
    if (std::isfinite(e.predicted)) {
      text += "predicted " + base::ShortNumber(e.predicted) + " " + c.objective_unit + " ± " +
              base::ShortNumber(e.predicted_sd) + " at scale factor " +
              base::ShortNumber(c.target_scale_factor) + ", ";
    }
    text += "implausibility " + ImplausibilityText(e) + "\n";
    text += NumbersText(c, e);
  }
  text += "  nearest trials\n";
  for (const NearTrial& near : c.nearest) text += NearText(c, near);
  return text;
}

std::string ConsideredJson(const ConsideredSet& c) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    json["values"][c.parameters[i].name] = c.values[i];
  }
  for (const ConsideredParameter& p : c.known) {
    nlohmann::ordered_json known{
        {"nuisance", p.is_nuisance}, {"credible_90_low", p.low}, {"credible_90_high", p.high}};
    if (p.prior) known["prior"] = base::ToJson(*p.prior);
    json["known"][p.name] = std::move(known);
  }
  json["target_scale_factor"] = c.target_scale_factor;
  json["credible_level"] =
      c.credible_level ? nlohmann::ordered_json(*c.credible_level) : nlohmann::ordered_json();
  json["surrogate_narrowing"] = c.surrogate_narrowing;
  json["objective_unit"] = c.objective_unit;
  json["experiments"] = nlohmann::ordered_json::array();
  for (const ResultStanding& standing : c.experiments) {
    json["experiments"].push_back(StandingJson(c, standing));
  }
  json["nearest_trials"] = nlohmann::ordered_json::array();
  for (const NearTrial& near : c.nearest) {
    const auto at = static_cast<std::size_t>(near.trial.experiment);
    nlohmann::ordered_json trial{{"id", near.trial.id},
                                 {"experiment", c.records.at(at).name},
                                 {"scale_factor", near.trial.scale_factor},
                                 {"distance", near.distance},
                                 {"values", near.trial.native}};
    trial["objective"] =
        near.objective ? nlohmann::ordered_json(*near.objective) : nlohmann::ordered_json();
    json["nearest_trials"].push_back(std::move(trial));
  }
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::campaign
