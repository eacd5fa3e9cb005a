#include "experiments/analysis/next/judge_test.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/files/output_folder.h"
#include "base/not_known.h"
#include "base/sample.h"
#include "base/text/counted.h"
#include "experiments/analysis/compare/heap_pair.h"
#include "experiments/analysis/next/unknown_discount.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/observables/shown_number.h"
#include "imaging/spheres/projection.h"

namespace talus::analysis {
namespace {

constexpr std::size_t kFewest = 6;  // simulations that a model can stand on

imaging::Profile MeanProfile(const TestDesign& design) {
  std::vector<imaging::GrayImage> profiles;
  for (const DesignTrial& trial : design.trials) profiles.push_back(trial.profile);
  return {.image = imaging::MeanImage(profiles), .frame = *design.frame};
}

double ScalarOf(const DesignTrial& trial, std::string_view name) {
  for (const journal::MetricRecord& metric : trial.scalars) {
    if (metric.name == name) return metric.value;
  }
  return base::kNotKnown;
}

// The test as if it had measured what the design shows on average.
struct Hypothetical {
  campaign::Reference reference;
  optimizer::ExperimentTarget target;
};

// A number that is undefined too often, or the same everywhere, tells nothing.
std::optional<optimizer::ScalarTarget> TargetOf(const ExpectedNumber& number,
                                                const TestDesign& design) {
  std::vector<double> values;
  for (const DesignTrial& trial : design.trials) {
    const double value = ScalarOf(trial, number.metric);
    if (std::isfinite(value)) values.push_back(value);
  }
  if (values.size() < kFewest) return std::nullopt;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) return std::nullopt;
  const double mean = base::SampleOf(values).mean;
  const rigs::Bounds possible = rigs::BoundsOf(number.metric);
  return optimizer::ScalarTarget{
      .name = number.metric,
      .value = mean,
      .standard_error = std::max(number.standard_error, number.relative_error * std::abs(mean)),
      .low = possible.low,
      .high = possible.high};
}

Hypothetical Imagine(const Ground& ground, const TestCandidate& test, const TestDesign& design) {
  std::optional<imaging::Profile> profile;
  if (design.frame) profile = MeanProfile(design);
  campaign::Reference reference(std::move(profile), {.num_heaps = test.runs});
  optimizer::ExperimentTarget target{.name = test.name, .image = reference.MakeFieldObjective()};
  for (const ExpectedNumber& number : NumbersOf(ground.view, test)) {
    if (const auto scalar = TargetOf(number, design)) target.scalars.push_back(*scalar);
  }
  return {.reference = std::move(reference), .target = std::move(target)};
}

void TellDesign(const TestDesign& design, const Hypothetical& made,
                optimizer::PosteriorStrategy& strategy) {
  for (const DesignTrial& trial : design.trials) {
    optimizer::Observation observation{.point = trial.point, .scale_factor = design.scale_factor};
    if (design.frame) observation.field = made.reference.Field(trial.profile);
    for (const optimizer::ScalarTarget& scalar : made.target.scalars) {
      observation.scalars.push_back(ScalarOf(trial, scalar.name));
    }
    strategy.Tell(observation);
  }
}

// A number's own error besides the scatter of the test, and the surrogate's to come.
Eigen::VectorXd VarianceOf(const Ground& ground, const optimizer::OutputPredictions& at,
                           const TestCandidate& test, const TestDesign& design,
                           Eigen::Index num_scalars) {
  const double finer = ground.view.spec.coarse_graining.Target() / design.scale_factor;
  Eigen::VectorXd variance = MeasuredBy(ground, at, test.runs, std::pow(finer, 3));
  variance.tail(num_scalars) += at.measured.tail(num_scalars);
  return variance / (1 - ground.surrogate_share);
}

// Outputs of simulations of the test, one a row; NaN where a number is undefined.
Eigen::MatrixXd RowsOf(const std::vector<DesignTrial>& trials, const Hypothetical& made,
                       const optimizer::ExperimentModel& model) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(trials.size()), model.num_outputs());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    std::vector<float> field;
    if (model.has_image()) field = made.reference.Field(trials[i].profile);
    std::vector<double> scalars;
    for (const optimizer::ScalarTarget& scalar : made.target.scalars) {
      scalars.push_back(ScalarOf(trials[i], scalar.name));
    }
    rows.row(static_cast<Eigen::Index>(i)) = model.OutputsOf(field, scalars).transpose();
  }
  return rows;
}

UnknownRows UnknownRowsOf(const SimulatedTest& simulated, const Hypothetical& made,
                          const optimizer::ExperimentModel& model) {
  const auto num_scalars = static_cast<Eigen::Index>(made.target.scalars.size());
  UnknownRows rows{.base = RowsOf(simulated.unknown.base, made, model),
                   .moved = {},
                   .noise = model.NoiseAt(simulated.design.scale_factor),
                   .num_modes = model.num_outputs() - num_scalars};
  for (const MovedTest& moved : simulated.unknown.moved) {
    rows.moved.push_back(RowsOf(moved.trials, made, model));
  }
  return rows;
}

void TellApart(const Ground& ground, const TestCandidate& test, const Hypothetical& made,
               const optimizer::ExperimentModel& model, NextCandidate& candidate) {
  const std::vector<Eigen::Index> pair{candidate.learning->first, candidate.learning->second};
  const Eigen::MatrixXd sets = ground.draws(pair, Eigen::all);
  for (const auto& set : sets.rowwise()) {
    candidate.apart.push_back(campaign::FreeValues(ground.view.space, set.transpose()));
  }
  const std::vector<optimizer::Moments> scalars = model.Scalars(sets);
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    candidate.numbers.push_back(
        {.metric = made.target.scalars[s].name,
         .first = rigs::Possible(made.target.scalars[s].name, scalars[s].mean[0]),
         .second = rigs::Possible(made.target.scalars[s].name, scalars[s].mean[1])});
  }
  if (!model.has_image()) return;
  const auto heap = [&](Eigen::Index row) -> imaging::Profile {
    return {.image = made.reference.ImageOf(model.MeanImage(sets.row(row).transpose())),
            .frame = made.reference.frame().value()};
  };
  const std::filesystem::path folder = campaign::NextFolder(ground.view.folder.root);
  if (!base::MayWriteInto(folder)) return;  // somebody else's campaign
  candidate.picture = folder / (FileName(test) + ".png");
  WriteHeapDifference(candidate.picture, heap(0), heap(1));
}

}  // namespace

ListedTest ListTest(const campaign::JointView& view, const TestCandidate& test) {
  ListedTest listed{.candidate = {.kind = NextKind::kTest, .name = test.name}};
  const std::string why = WhyNot(view, test);
  listed.can_simulate = why.empty();
  listed.candidate.what = listed.can_simulate ? "carry it out in " + base::Counted(test.runs, "run")
                                              : "cannot be simulated: " + why;
  if (listed.can_simulate && view.spec.HasOwnProposer()) {
    listed.candidate.what += " in a new campaign (--reuse): one of \"" +
                             std::string(base::NameOf(view.spec.strategy.kind)) +
                             "\" takes no further test";
  }
  return listed;
}

void JudgeTest(const Ground& ground, const SimulatedTest& simulated, NextCandidate& candidate) {
  const auto& [test, design, unknown] = simulated;
  if (design.trials.size() < kFewest) {
    const int missing = design.size - design.num_simulations;
    candidate.what += missing > 0 ? "; of its " + base::Counted(design.size, "simulation") + " " +
                                        std::to_string(missing) + " are still to be made"
                                  : "; too few of its simulations succeeded";
    return;
  }
  const Hypothetical made = Imagine(ground, test, design);
  if (made.target.scalars.empty() && !design.frame) {
    candidate.what = "tells nothing: its simulations show no number that differs";
    return;
  }
  const auto strategy = ModelOf(ground.view, {design.scale_factor}, made.target);
  TellDesign(design, made, *strategy);
  if (!strategy->CanModel()) {
    candidate.what = "tells nothing: its simulations show nothing that differs";
    return;
  }
  const optimizer::ExperimentModel& model = strategy->Model().models().front();
  const optimizer::OutputPredictions at = model.Predict(ground.draws);
  candidate.predicted = {
      .mean = at.mean,
      .variance = VarianceOf(ground, at, test, design,
                             static_cast<Eigen::Index>(made.target.scalars.size()))};
  if (ground.supposed.rows() > 0) {
    candidate.predicted.supposed = model.Predict(ground.supposed).mean;
  }
  candidate.learning = ground.Learn(candidate.predicted);
  if (!unknown.base.empty()) {
    Discount(ground, unknown, UnknownRowsOf(simulated, made, model), candidate);
  }
  TellApart(ground, test, made, model, candidate);
}

}  // namespace talus::analysis
