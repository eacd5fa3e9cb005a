#include "experiments/analysis/compare/knowledge.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/not_known.h"
#include "base/student_factor.h"
#include "base/text/plain_number.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/observable.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::analysis {
namespace {

constexpr int kGroups = 4;  // of trials, each left out once (delete-a-group jackknife)

// One objective alone: what it is to meet, and what the trials of the search that define it show of
// it.
struct Sole {
  std::string title;
  optimizer::ExperimentTarget target;
  std::vector<optimizer::Observation> told{};  // in the order of finish
};

optimizer::Observation Bare(const journal::TrialRecord& trial) {
  return {.point = campaign::PointOf(trial),
          .scale_factor = trial.scale_factor,
          .failed = trial.status != journal::TrialStatus::kOk};
}

// The heap without its numbers; nothing where it has no image.
std::optional<Sole> WholeHeap(const campaign::JointView& view, int experiment) {
  const auto e = static_cast<std::size_t>(experiment);
  if (!view.references[e].has_image()) return std::nullopt;
  Sole sole{.title = "whole heap (SAD, RMSE)",
            .target = campaign::TargetsOf(view.spec, view.record, view.references)[e]};
  sole.target.scalars.clear();
  sole.target.weight = 1;
  for (optimizer::Observation observation : view.observations) {
    if (observation.experiment != experiment) continue;
    observation.experiment = 0;
    observation.scalars.clear();
    sole.told.push_back(std::move(observation));
  }
  return sole;
}

Sole SoleNumber(const campaign::JointView& view, int experiment,
                const optimizer::ScalarTarget& measured) {
  Sole sole{.title = MetricTitle(measured.name), .target = {.name = measured.name}};
  sole.target.scalars = {measured};
  for (const journal::TrialRecord& trial : campaign::InOrderOfFinish(view.trials)) {
    if (trial.experiment != experiment || !trial.IsOfSearch()) continue;
    const double value = trial.Metric(measured.name).value_or(base::kNotKnown);
    optimizer::Observation observation = Bare(trial);
    if (!observation.failed && std::isnan(value)) continue;  // a column has no angle of repose
    observation.scalars = {value};
    sole.told.push_back(std::move(observation));
  }
  return sole;
}

// What the experiment's own angle is known to: by its runs, or as a careful laboratory does.
double ErrorOf(const journal::MetricRecord& angle, int num_runs) {
  const rigs::UsualError& usual = rigs::InfoOf(rigs::Observable::kReposeAngle1).usual_error;
  return angle.standard_error > 0 ? base::NormalError(angle.standard_error, num_runs - 1)
                                  : usual.absolute;
}

std::vector<Sole> ObjectivesOf(const campaign::JointView& view, int experiment) {
  const journal::ExperimentRecord& record =
      view.record.experiments[static_cast<std::size_t>(experiment)];
  std::vector<Sole> all;
  if (auto heap = WholeHeap(view, experiment)) all.push_back(std::move(*heap));
  for (const journal::ObjectiveInfo& objective : journal::kObjectives) {
    if (!objective.is_angle) continue;
    const auto angle =
        std::ranges::find(record.reference, objective.metric, &journal::MetricRecord::name);
    if (angle == record.reference.end() || !std::isfinite(angle->value)) continue;
    all.push_back(SoleNumber(view, experiment,
                             {.name = angle->name,
                              .value = angle->value,
                              .standard_error = ErrorOf(*angle, record.num_heaps)}));
  }
  for (const journal::ScalarRecord& number : record.scalars) {
    all.push_back(SoleNumber(
        view, experiment,
        {.name = number.name, .value = number.value, .standard_error = number.NormalError()}));
  }
  return all;
}

// The strategy told all but a group of the trials; group -1: all of them.
std::unique_ptr<optimizer::PosteriorStrategy> Told(const campaign::JointView& view,
                                                   const Sole& sole, int without) {
  auto strategy = campaign::MakePosteriorStrategyFor(view.spec, {sole.target});
  for (std::size_t i = 0; i < sole.told.size(); ++i) {
    if (static_cast<int>(i % kGroups) != without) strategy->Tell(sole.told[i]);
  }
  return strategy;
}

bool Holds(double level) { return level <= optimizer::kRegionLevel; }

// The region's share is known to a factor: how it changes with the trials that it is made of.
void AddUncertainty(const campaign::JointView& view, const Sole& sole,
                    const Eigen::VectorXd& recommended, ObjectiveKnowledge& knowledge) {
  std::vector<double> logs;
  for (int group = 0; group < kGroups; ++group) {
    const auto strategy = Told(view, sole, group);
    if (!strategy->CanModel()) return;
    logs.push_back(std::log(strategy->AskedSample().RegionVolume()));
    knowledge.num_holding += Holds((*strategy->CredibleLevels(recommended.transpose()))[0]);
  }
  knowledge.num_refits = kGroups;
  double mean = 0, squares = 0;
  for (const double log : logs) mean += log / kGroups;
  for (const double log : logs) squares += (log - mean) * (log - mean);
  const double sd = std::sqrt((kGroups - 1.0) / kGroups * squares);
  knowledge.region_low = knowledge.region * std::exp(-base::kNormal90 * sd);
  knowledge.region_high = std::min(1.0, knowledge.region * std::exp(base::kNormal90 * sd));
}

ObjectiveKnowledge KnowledgeOfOne(const campaign::JointView& view, const Sole& sole,
                                  const Eigen::VectorXd& recommended) {
  ObjectiveKnowledge knowledge{.title = sole.title};
  const auto strategy = Told(view, sole, -1);
  if (!strategy->CanModel()) {
    knowledge.absent = "too few trials have a value of it";
    return knowledge;
  }
  knowledge.region = strategy->AskedSample().RegionVolume();
  knowledge.level = (*strategy->CredibleLevels(recommended.transpose()))[0];
  AddUncertainty(view, sole, recommended, knowledge);
  return knowledge;
}

}  // namespace

std::vector<ObjectiveKnowledge> KnowledgeOf(const campaign::JointView& view, int experiment,
                                            const Eigen::VectorXd& recommended) {
  std::vector<ObjectiveKnowledge> all;
  for (const Sole& sole : ObjectivesOf(view, experiment)) {
    all.push_back(KnowledgeOfOne(view, sole, recommended));
  }
  return all;
}

std::string RegionText(const ObjectiveKnowledge& knowledge) {
  if (!knowledge.absent.empty()) return "-";
  std::string text = base::InPercent(knowledge.region) + " %";
  if (std::isnan(knowledge.region_low)) return text;
  return text + " (" + base::InPercent(knowledge.region_low) + " to " +
         base::InPercent(knowledge.region_high) + " %)";
}

std::string KnowledgeSentence(const std::vector<ObjectiveKnowledge>& all) {
  std::vector<const ObjectiveKnowledge*> known;
  for (const ObjectiveKnowledge& one : all) {
    if (one.absent.empty()) known.push_back(&one);
  }
  if (known.size() < 2) return "";
  std::ranges::stable_sort(known, {}, [](const ObjectiveKnowledge* k) { return k->region; });
  const ObjectiveKnowledge& least = *known.front();
  const ObjectiveKnowledge& most = *known.back();
  const double ratio = most.region / least.region;
  if (std::isnan(least.region_high) || std::isnan(most.region_low)) return "";
  // Regions whose uncertain shares overlap do not differ for people.
  if (!(least.region_high < most.region_low)) {
    return "From the same trials " + least.title + " and " + most.title +
           " leave regions whose sizes do not differ by more than their uncertainty.";
  }
  return "From the same trials " + most.title + " leaves a region " + base::PlainNumber(ratio, 2) +
         " times as large as " + least.title + ": by itself it lets that many more sets pass.";
}

}  // namespace talus::analysis
