#include "experiments/analysis/next/rank_next.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "experiments/analysis/next/heap_pair.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/core_time.h"
#include "imaging/spheres/projection.h"
#include "optimizer/answer/credible_ranges.h"

namespace talus::analysis {
namespace {

using campaign::JointView;
using optimizer::ExperimentModel;
using optimizer::OutputPredictions;

constexpr int kDraws = 1000;
constexpr const char* kFallen = "mass_fallen_kg";

// What the posterior needs to judge a further measurement.
struct Ground {
  const JointView& view;
  const optimizer::Posterior& posterior;
  Eigen::MatrixXd draws;
  double model_error = 1;

  optimizer::ExpectedLearning Learn(const Eigen::MatrixXd& mean,
                                    const Eigen::VectorXd& variance) const {
    return optimizer::Learn(draws, {.mean = mean, .variance = posterior.temper() * variance},
                            view.spec.seed);
  }
};

int CountAt(const JointView& view, int experiment, double factor) {
  return static_cast<int>(std::count_if(
      view.observations.begin(), view.observations.end(), [&](const optimizer::Observation& o) {
        return o.experiment == experiment && o.scale_factor == factor;
      }));
}

// Of one simulation of an experiment [core seconds]: as its trials took, or as estimated.
double CoreTimeOf(const JointView& view, int experiment, double factor) {
  double sum = 0;
  int count = 0;
  for (const journal::TrialRecord& trial : view.trials) {
    if (trial.experiment != experiment || trial.scale_factor != factor || !(trial.cpu_s > 0)) {
      continue;
    }
    sum += trial.cpu_s;
    ++count;
  }
  if (count > 0) return sum / count;
  return campaign::GrainStepsOf(view.spec, experiment, factor) / campaign::kUsualSpeed;
}

// What is left of the variance `before` once it is `after` is what an independent measurement with
// the difference of their precisions would leave.
Eigen::VectorXd OfTheDifference(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  constexpr double kLeast = 1e-12;
  return (after.cwiseInverse() - before.cwiseInverse()).cwiseMax(kLeast).cwiseInverse();
}

void AddMoreOfTheSame(const Ground& ground, std::vector<NextCandidate>& all) {
  const JointView& view = ground.view;
  const double finest = view.spec.coarse_graining.Levels().back();
  for (const int e : view.All()) {
    const journal::ExperimentRecord& record = view.record.experiments[static_cast<std::size_t>(e)];
    const OutputPredictions at =
        ground.posterior.models()[static_cast<std::size_t>(e)].Predict(ground.draws);
    const Eigen::VectorXd surrogate = at.variance.colwise().mean().transpose();
    const Eigen::VectorXd now = surrogate + at.measured + at.model;
    all.push_back(
        {.kind = NextKind::kMoreRuns,
         .name = "more runs of " + record.name,
         .what = "photograph " + std::to_string(record.num_heaps) + " more runs",
         .learning = ground.Learn(at.mean, OfTheDifference(now, now - 0.5 * at.measured))});
    const int count = CountAt(view, e, finest);
    all.push_back({.kind = NextKind::kMoreSimulations,
                   .name = "more simulations of " + record.name,
                   .what = std::to_string(count) + " more at the smallest scale factor",
                   .learning = ground.Learn(at.mean, OfTheDifference(now, now - 0.5 * surrogate)),
                   .num_simulations = count,
                   .core_time = count * CoreTimeOf(view, e, finest)});
  }
}

// A model of a test that was not made: its target is what the design shows on average.
std::unique_ptr<optimizer::FidelityStrategy> ModelOf(const JointView& view,
                                                     const std::vector<double>& factors,
                                                     optimizer::ExperimentTarget target) {
  const optimizer::FidelityOptions options{
      .scale_factors = factors, .target = 0, .seed = view.spec.seed};
  return std::make_unique<optimizer::FidelityStrategy>(
      options, view.space.MakeDomain(),
      std::vector<optimizer::ExperimentTarget>{std::move(target)});
}

// Variance of each output as measured on so many runs, with the model's error; `to_target` is the
// noise variance at the target over that of the design.
Eigen::VectorXd MeasuredOn(const Ground& ground, const OutputPredictions& at, int runs,
                           double to_target) {
  const double share = 1.0 / runs + ground.model_error * ground.model_error;
  return share * to_target * at.single;
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// The mass that falls, where trials know it and the experiment has not measured it.
void AddNumbers(const Ground& ground, std::vector<NextCandidate>& all) {
  const JointView& view = ground.view;
  for (const int e : view.All()) {
    const journal::ExperimentRecord& record = view.record.experiments[static_cast<std::size_t>(e)];
    if (!record.scalars.empty()) continue;
    std::vector<double> values;
    std::vector<optimizer::Observation> told;
    for (const journal::TrialRecord& trial : campaign::InOrderOfFinish(view.trials)) {
      const auto value = trial.Metric(kFallen);
      if (trial.experiment != e || !campaign::IsOfSearch(trial) || !value) continue;
      values.push_back(*value);
      told.push_back({.point = campaign::PointOf(trial),
                      .scale_factor = trial.scale_factor,
                      .scalars = {*value}});
    }
    if (values.empty() || *std::max_element(values.begin(), values.end()) <= 0) continue;
    optimizer::ExperimentTarget target{.name = record.name};
    target.scalars = {{.name = kFallen, .value = MeanOf(values), .standard_error = 0}};
    const auto model = ModelOf(view, view.spec.coarse_graining.Levels(), std::move(target));
    for (const optimizer::Observation& observation : told) model->Tell(observation);
    if (!model->CanModel()) continue;
    const OutputPredictions at = model->Model().models().front().Predict(ground.draws);
    const int runs = std::max(1, record.num_heaps);
    all.push_back({.kind = NextKind::kNumber,
                   .name = "mass fallen of " + record.name,
                   .what = "weigh what falls off the plate in " + std::to_string(runs) + " runs",
                   .learning = ground.Learn(at.mean, MeasuredOn(ground, at, runs, 1))});
  }
}

imaging::Profile MeanProfile(const TestDesign& design) {
  std::vector<imaging::GrayImage> profiles;
  for (const DesignTrial& trial : design.trials) profiles.push_back(trial.profile);
  return {.image = imaging::MeanImage(profiles), .frame = design.frame};
}

std::optional<double> ScalarOf(const DesignTrial& trial, std::string_view name) {
  for (const journal::MetricRecord& metric : trial.scalars) {
    if (metric.name == name && std::isfinite(metric.value)) return metric.value;
  }
  return std::nullopt;
}

void Judge(const Ground& ground, const TestCandidate& test, const TestDesign& design,
           NextCandidate& candidate) {
  constexpr std::size_t kFewest = 6;
  if (design.trials.size() < kFewest) {
    candidate.what += "; too few of its simulations succeeded";
    return;
  }
  const campaign::Reference reference(MeanProfile(design), {.num_heaps = test.runs});
  std::vector<double> fallen;
  for (const DesignTrial& trial : design.trials) {
    if (const auto value = ScalarOf(trial, kFallen)) fallen.push_back(*value);
  }
  const bool weighed = fallen.size() == design.trials.size() && MeanOf(fallen) > 0;
  optimizer::ExperimentTarget target{.name = test.name, .image = reference.MakeFieldObjective()};
  if (weighed) {
    target.scalars = {{.name = kFallen, .value = MeanOf(fallen), .standard_error = 0}};
  }
  const auto strategy = ModelOf(ground.view, {design.scale_factor}, std::move(target));
  for (std::size_t i = 0; i < design.trials.size(); ++i) {
    const DesignTrial& trial = design.trials[i];
    optimizer::Observation observation{.point = trial.point,
                                       .scale_factor = design.scale_factor,
                                       .field = reference.Field(trial.profile)};
    if (weighed) observation.scalars = {fallen[i]};
    strategy->Tell(observation);
  }
  const ExperimentModel& model = strategy->Model().models().front();
  const OutputPredictions at = model.Predict(ground.draws);
  const double finer = ground.view.spec.coarse_graining.Target() / design.scale_factor;
  candidate.learning = ground.Learn(at.mean, MeasuredOn(ground, at, test.runs, std::pow(finer, 3)));
  const auto folder = ground.view.folder.root / "next";
  candidate.picture = folder / (FileName(test) + ".png");
  const auto image = [&](Eigen::Index draw) {
    return reference.ImageOf(model.MeanImage(ground.draws.row(draw)));
  };
  for (const Eigen::Index draw : {candidate.learning->first, candidate.learning->second}) {
    candidate.apart.push_back(
        campaign::FreeValues(ground.view.space, ground.draws.row(draw).transpose()));
  }
  WriteHeapPair(candidate.picture, image(candidate.learning->first),
                image(candidate.learning->second));
}

NextCandidate TestOf(const Ground& ground, const TestCandidate& test, const NextOptions& options) {
  const JointView& view = ground.view;
  NextCandidate candidate{.kind = NextKind::kTest, .name = test.name};
  candidate.what = "make it, " + std::to_string(test.runs) + " runs";
  // As many simulations as the first experiment took, each as much dearer as its grains go on.
  const campaign::CampaignSpec spec = SpecOf(view, test);
  for (const double factor : view.spec.coarse_graining.Levels()) {
    const int count = CountAt(view, 0, factor);
    candidate.num_simulations += count;
    candidate.core_time += count * CoreTimeOf(view, 0, factor) *
                           campaign::GrainStepsOf(spec, 0, factor) /
                           campaign::GrainStepsOf(view.spec, 0, factor);
  }
  const auto design = options.simulate ? SimulateDesign(view, test, ground.draws, options.parts)
                                       : StoredDesign(view, test, *options.parts.engine);
  if (design) Judge(ground, test, *design, candidate);
  return candidate;
}

}  // namespace

NextTable RankNext(const JointView& view, const NextOptions& options) {
  const auto strategy = campaign::StrategyOf(view, view.All());
  if (!strategy->CanModel()) {
    throw base::Error(view.folder.root.string() +
                      ": has too few trials of each experiment for a posterior; go on with "
                      "`talus resume`");
  }
  const Ground ground{
      .view = view,
      .posterior = strategy->Model(),
      .draws = strategy->Sample().Draws(kDraws, view.spec.seed),
      .model_error = view.spec.posterior.value_or(campaign::PosteriorOptions{}).model_error};
  NextTable table{.parameters = view.record.parameters};
  for (const int i : view.space.Free()) {
    table.scales.push_back(view.space.parameters[static_cast<std::size_t>(i)].scale);
  }
  for (const journal::TrialRecord& trial : view.trials) {
    if (trial.status != journal::TrialStatus::kRunning) table.last_trial = trial.id;
  }
  table.width = ground.Learn(Eigen::MatrixXd(kDraws, 0), {}).width;
  AddMoreOfTheSame(ground, table.candidates);
  AddNumbers(ground, table.candidates);
  for (const TestCandidate& test : options.tests) {
    table.candidates.push_back(TestOf(ground, test, options));
  }
  const auto bits = [](const NextCandidate& c) { return c.learning ? c.learning->bits : -1; };
  std::stable_sort(
      table.candidates.begin(), table.candidates.end(),
      [&](const NextCandidate& a, const NextCandidate& b) { return bits(a) > bits(b); });
  return table;
}

}  // namespace talus::analysis
