#include "experiments/analysis/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/not_known.h"
#include "optimizer/outputs/levels.h"

namespace talus::analysis {
namespace {

constexpr int kVolumeSample = 4096;  // a share of 1 % is then known to ± 0.2 %

struct Measurement {
  const TrialEvidence* trial = nullptr;
  double quantity = 0;
};

std::vector<Measurement> MeasurementsOf(const Evidence& evidence, std::size_t column) {
  std::vector<Measurement> found;
  for (const TrialEvidence& trial : evidence.trials) {
    if (trial.state != journal::TrialStatus::kOk || std::isnan(trial.metrics[column])) continue;
    if (trial.scale_factor != evidence.scale_factor) continue;  // another simulation of the set
    found.push_back({&trial, trial.metrics[column]});
  }
  return found;
}

// Best first; sets that are equal stay in the order of their first trial.
std::vector<ComparedSet> RankedSets(const std::vector<Measurement>& measured, const Criterion& info,
                                    double reference) {
  std::map<std::vector<double>, std::size_t> index;
  std::vector<ComparedSet> sets;
  for (const Measurement& m : measured) {
    const auto [place, is_new] = index.try_emplace(m.trial->values, sets.size());
    if (is_new) sets.push_back({.trials = {}, .point = m.trial->point, .values = m.trial->values});
    ComparedSet& set = sets[place->second];
    set.trials.push_back(m.trial->id);
    set.quantity += m.quantity;
  }
  for (ComparedSet& set : sets) {
    set.quantity /= static_cast<double>(set.trials.size());
    set.objective = info.Value(set.quantity, reference);
  }
  std::stable_sort(sets.begin(), sets.end(), [](const ComparedSet& a, const ComparedSet& b) {
    return a.objective < b.objective;
  });
  return sets;
}

// The scatter between trials of one set, pooled over the sets.
struct Scatter {
  double sd = base::kNotKnown;  // not known without repeats
  double freedom = 0;           // degrees of it
};

Scatter PooledScatter(const std::vector<Measurement>& measured) {
  struct Sums {
    double count = 0, sum = 0, squares = 0;
  };
  std::map<std::vector<double>, Sums> groups;
  const double shift = measured.front().quantity;  // keeps the squares' cancellation harmless
  for (const Measurement& m : measured) {
    Sums& group = groups[m.trial->values];
    const double x = m.quantity - shift;
    group.count += 1;
    group.sum += x;
    group.squares += x * x;
  }
  double squares = 0, freedom = 0;
  for (const auto& [values, group] : groups) {
    squares += std::max(0.0, group.squares - group.sum * group.sum / group.count);
    freedom += group.count - 1;
  }
  if (!(freedom > 0)) return {};
  return {.sd = std::sqrt(squares / freedom), .freedom = freedom};
}

// Two heaps that happen to be alike, all that a campaign may have simulated again, leave next to no
// scatter.
bool AreFew(const Scatter& repeats) {
  constexpr double kFew = 4;  // degrees of freedom
  return repeats.freedom < kFew;
}

// Where repeats are few, the model's scatter has a say.
double ScatterWith(const Scatter& repeats, double of_model) {
  if (!AreFew(repeats) || std::isnan(of_model)) return repeats.sd;
  return repeats.freedom > 0 ? std::max(repeats.sd, of_model) : of_model;
}

// What the campaign's answer says of its own objective; NaN of others.
double ScatterOfAnswer(const Evidence& evidence, const Criterion& info) {
  if (!evidence.answer || info.key != evidence.objective) return base::kNotKnown;
  const auto& experiments = evidence.answer->experiments;
  if (evidence.experiment >= experiments.size()) return base::kNotKnown;
  // It is stated for the target.
  return experiments[evidence.experiment].noise_sd.value_or(base::kNotKnown) *
         optimizer::NoiseRatio(evidence.scale_factor, evidence.answer->conditions.scale_factor);
}

// The share of the cube whose nearest set ties: trials crowd where they are good, so their own
// share says nothing.
double NearestVolume(const std::vector<ComparedSet>& sets, std::size_t num_tied) {
  const Eigen::Index dimension = sets.front().point.size();
  Eigen::MatrixXd points(static_cast<Eigen::Index>(sets.size()), dimension);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = sets[i].point;
  }
  const Eigen::VectorXd half_squares = points.rowwise().squaredNorm() / 2;
  const Eigen::MatrixXd sample = EvenSample(kVolumeSample, dimension);
  int tied = 0;
  for (Eigen::Index i = 0; i < sample.rows(); ++i) {
    Eigen::Index nearest = 0;  // ½|p - s|² but for ½|s|²
    (half_squares - points * sample.row(i).transpose()).minCoeff(&nearest);
    if (nearest < static_cast<Eigen::Index>(num_tied)) ++tied;
  }
  return static_cast<double>(tied) / kVolumeSample;
}

TrialFinding FindFromTrials(std::vector<ComparedSet> sets, double margin) {
  TrialFinding finding;
  finding.num_sets = sets.size();
  const double limit = sets.front().objective + margin;
  finding.num_tied = static_cast<std::size_t>(std::count_if(
      sets.begin(), sets.end(), [&](const ComparedSet& set) { return set.objective <= limit; }));
  finding.tied_volume = NearestVolume(sets, finding.num_tied);
  sets.resize(std::min(sets.size(), kNumBest));
  finding.best = std::move(sets);
  return finding;
}

std::vector<double> ToValues(const Evidence& evidence, const Eigen::VectorXd& point) {
  std::vector<double> values;
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    values.push_back(evidence.parameters[static_cast<std::size_t>(k)].range.ToNative(point(k)));
  }
  return values;
}

// A set is named only where the process knows it from others: to the scatter of one simulation, and
// not one of a whole surface on which a number is met.
std::string WhyWithheld(const ModelFinding& finding, bool is_distance, double noise_sd) {
  constexpr double kMet = 0.05;  // of the scatter
  const double scatter = std::max(noise_sd, finding.model.noise_sd());
  if (finding.there.sd > scatter) return "its model is less sure there than one simulation";
  if (is_distance && finding.point.size() > 1 && finding.there.objective <= kMet * scatter) {
    return "a whole surface of sets meets it";
  }
  return "";
}

ModelFinding FindFromModel(const Evidence& evidence, ObjectiveModel model,
                           const Eigen::VectorXd& start, double margin) {
  ModelFinding finding{.model = std::move(model), .point = {}, .values = {}, .there = {}};
  finding.point = finding.model.Minimiser(start, evidence.feasible);
  finding.values = ToValues(evidence, finding.point);
  finding.there = finding.model.Predict(finding.point.transpose()).front();
  const auto sample = finding.model.Predict(EvenSample(kVolumeSample, start.size()));
  const double limit = finding.there.objective + margin;
  const auto tied = std::count_if(sample.begin(), sample.end(), [&](const ObjectivePrediction& p) {
    return p.objective <= limit;
  });
  finding.tied_volume = static_cast<double>(tied) / kVolumeSample;
  finding.there.objective = std::max(0.0, finding.there.objective);
  return finding;
}

// Why an objective cannot be judged; empty when it can.
std::string WhyAbsent(const Criterion& info, double reference, bool has_column,
                      bool has_measurement) {
  if (!has_column) return "the trials were not measured by it";
  if (info.is_distance && std::isnan(reference))
    return "it is not defined on the experiment's profile";
  if (!has_measurement) return "no trial has a value of it yet";
  return "";
}

ObjectiveFinding FindFor(const Evidence& evidence, const Criterion& info, bool with_model) {
  ObjectiveFinding finding{.info = info, .absent = {}, .from_trials = {}, .from_model = {}};
  const auto column = MetricColumn(evidence, info.metric);
  if (column && info.is_distance && *column < evidence.reference.metrics.size()) {
    finding.reference = evidence.reference.metrics[*column];
    if (*column < evidence.reference.errors.size()) {
      finding.reference_error = evidence.reference.errors[*column];
    }
  }
  const auto measured = column ? MeasurementsOf(evidence, *column) : std::vector<Measurement>{};
  finding.absent = WhyAbsent(info, finding.reference, column.has_value(), !measured.empty());
  if (!finding.absent.empty()) return finding;

  auto sets = RankedSets(measured, info, finding.reference);
  const Scatter repeats = PooledScatter(measured);
  double of_model = ScatterOfAnswer(evidence, info);
  const Eigen::VectorXd start = sets.front().point;
  std::optional<ObjectiveModel> model;
  const bool is_asked = with_model || (AreFew(repeats) && std::isnan(of_model));
  if (is_asked && sets.size() >= ObjectiveModel::kFewestPoints) {
    std::vector<ModelPoint> points;
    for (const Measurement& m : measured) points.push_back({m.trial->point, m.quantity});
    model = ObjectiveModel::Fit(points, start, info, finding.reference);
    if (std::isnan(of_model)) of_model = model->noise_sd();
  }
  finding.noise_sd = ScatterWith(repeats, of_model);
  finding.from_trials = FindFromTrials(std::move(sets), finding.margin());
  if (model && with_model) {
    finding.from_model = FindFromModel(evidence, *model, start, finding.margin());
    finding.from_model->withheld =
        WhyWithheld(*finding.from_model, info.is_distance, finding.noise_sd);
  }
  return finding;
}

std::vector<ObjectiveFinding> FindForAll(const Evidence& evidence, bool with_models) {
  std::vector<ObjectiveFinding> findings;
  for (const Criterion& info : CriteriaOf(evidence))
    findings.push_back(FindFor(evidence, info, with_models));
  return findings;
}

}  // namespace

std::optional<std::size_t> MetricColumn(const Evidence& evidence, std::string_view metric) {
  for (std::size_t i = 0; i < evidence.metrics.size(); ++i) {
    if (evidence.metrics[i].name == metric) return i;
  }
  return std::nullopt;
}

std::vector<ObjectiveFinding> CompareObjectives(const Evidence& evidence) {
  return FindForAll(evidence, true);
}

std::vector<ObjectiveFinding> CompareTrials(const Evidence& evidence) {
  return FindForAll(evidence, false);
}

}  // namespace talus::analysis
