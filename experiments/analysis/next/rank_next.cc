#include "experiments/analysis/next/rank_next.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/sample.h"
#include "base/student_factor.h"
#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/next/ground.h"
#include "experiments/analysis/next/judge_test.h"
#include "experiments/analysis/next/known.h"
#include "experiments/analysis/next/test_design.h"
#include "experiments/analysis/next/unknown_moves.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/trials/simulate/work_text.h"

namespace talus::analysis {
namespace {

using campaign::JointView;
using optimizer::OutputPredictions;

constexpr int kDraws = 1000;

// What the simulations of a campaign have taken, for what more of them will.
class Cost {
 public:
  explicit Cost(const JointView& view) : core_time_(view.spec) { core_time_.Of(view.trials); }

  double OfOne(int experiment, double factor) { return core_time_.OfOne(experiment, factor); }

 private:
  campaign::CoreTime core_time_;
};

int CountAt(const JointView& view, int experiment, double factor) {
  return static_cast<int>(std::count_if(
      view.observations.begin(), view.observations.end(), [&](const optimizer::Observation& o) {
        return o.experiment == experiment && o.scale_factor == factor;
      }));
}

// As many simulations as there are at the smallest scale factor, and a few where there are fewer.
int AsManyAgain(const JointView& view, int experiment) {
  constexpr int kFew = 3;
  return std::max(kFew, CountAt(view, experiment, view.spec.coarse_graining.Levels().back()));
}

NextCandidate MoreRuns(const Ground& ground, const Known& known) {
  const auto e = static_cast<std::size_t>(known.experiment);
  const int num_heaps = ground.view.record.experiments[e].num_heaps;
  const bool has_image = ground.view.references[e].has_image();
  return {.kind = NextKind::kMoreRuns,
          .name = "more runs of " + ground.view.NameOf(known.experiment),
          .what = has_image ? "photograph " + base::Counted(num_heaps, "more run")
                            : "measure its numbers as often again",
          .learning = LearnWhenLess(ground, known, 0.5 * known.at.measured)};
}

NextCandidate MoreSimulations(const Ground& ground, const Known& known, Cost& cost) {
  const double finest = ground.view.spec.coarse_graining.Levels().back();
  const int count = AsManyAgain(ground.view, known.experiment);
  return {.kind = NextKind::kMoreSimulations,
          .name = "more simulations of " + ground.view.NameOf(known.experiment),
          .what = std::to_string(count) + " more at the smallest scale factor",
          .learning = LearnWhenLess(ground, known, 0.5 * known.surrogate),
          .num_simulations = count,
          .core_time = count * cost.OfOne(known.experiment, finest)};
}

// Heaps of finer grains scatter less, and what no simulation can match, stated in this scatter,
// shrinks with it.
void AddFinerGrains(const Ground& ground, const Known& known, Cost& cost,
                    std::vector<NextCandidate>& all) {
  constexpr double kStep = std::numbers::sqrt2;  // four times the core time, which goes with f⁻⁴
  const double finest = ground.view.spec.coarse_graining.Levels().back();
  if (finest <= 1) return;
  const double finer = std::max(1.0, finest / kStep);
  const int count = AsManyAgain(ground.view, known.experiment);
  const double share = std::pow(finer / ground.view.spec.coarse_graining.Target(), 3);
  if (share >= 1) return;  // the answer is for finer grains already
  all.push_back(
      {.kind = NextKind::kFinerGrains,
       .name = "finer grains in " + ground.view.NameOf(known.experiment),
       .what = base::Counted(count, "simulation") + " at scale factor " + base::ShortNumber(finer),
       .learning = LearnWhenLess(ground, known, (1 - share) * known.at.model),
       .num_simulations = count,
       .core_time = count * cost.OfOne(known.experiment, finest) * std::pow(finest / finer, 4)});
}

void AddMoreOfTheSame(const Ground& ground, const std::vector<Known>& experiments, Cost& cost,
                      std::vector<NextCandidate>& all) {
  for (const Known& known : experiments) {
    all.push_back(MoreRuns(ground, known));
    all.push_back(MoreSimulations(ground, known, cost));
    AddFinerGrains(ground, known, cost, all);
  }
}

// The model error of a test that was not made.
double UsualModelError(const optimizer::Posterior& posterior) {
  double squares = 0;
  for (const optimizer::ExperimentModel& model : posterior.models()) {
    squares += std::pow(model.model_error().value, 2);
  }
  return std::sqrt(squares / static_cast<double>(posterior.models().size()));
}

// The balance, where trials know what falls and the experiment has not weighed it.
void AddNumbers(const Ground& ground, const optimizer::Posterior& posterior,
                std::vector<NextCandidate>& all) {
  const JointView& view = ground.view;
  const std::vector<int> answered = view.Answered();
  for (std::size_t k = 0; k < answered.size(); ++k) {
    const int e = answered[k];
    const journal::ExperimentRecord& record = view.record.experiments[static_cast<std::size_t>(e)];
    if (!record.scalars.empty()) continue;
    const std::string fallen = rigs::MetricName(rigs::Observable::kMassFallen);
    std::vector<double> values;
    std::vector<optimizer::Observation> told;
    for (const journal::TrialRecord& trial : campaign::InOrderOfFinish(view.trials)) {
      const auto value = trial.Metric(fallen);
      if (trial.experiment != e || !trial.IsOfSearch() || !value) continue;
      values.push_back(*value);
      told.push_back({.point = campaign::PointOf(trial),
                      .scale_factor = trial.scale_factor,
                      .scalars = {*value}});
    }
    if (values.empty() || *std::max_element(values.begin(), values.end()) <= 0) continue;
    optimizer::ExperimentTarget target{.name = record.name};
    target.scalars = {{.name = fallen, .value = base::SampleOf(values).mean, .standard_error = 0}};
    const auto& grains = view.spec.coarse_graining;
    const auto model = ModelOf(view, grains.Levels(), std::move(target), grains.Target());
    for (const optimizer::Observation& observation : told) model->Tell(observation);
    if (!model->CanModel()) continue;
    const OutputPredictions at = model->Model().models().front().Predict(ground.draws);
    const int runs = std::max(1, record.num_heaps);
    Ground own = ground;
    own.model_error = posterior.models()[k].model_error().value;
    all.push_back(
        {.kind = NextKind::kNumber,
         .name = "mass on the plate of " + record.name,
         .what = "weigh what stays on the plate, or what falls off it, in " +
                 base::Counted(runs, "run"),
         .learning = ground.Learn(
             {.mean = at.mean, .variance = MeasuredBy(own, at, runs, 1) + SurrogateVariance(at)})});
  }
}

// Each parameter that an instrument tells by itself.
void AddDirect(const Ground& ground, std::vector<NextCandidate>& all) {
  constexpr double kWidth = 0.05;  // of the searched range, that holds 90 %
  const std::vector<journal::ParameterRecord>& parameters = ground.view.record.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!campaign::CanBeMeasuredDirectly(parameters[k].name)) continue;
    const double sd = kWidth / (2 * base::kNormal90);  // a measurement has no temper
    all.push_back({.kind = NextKind::kDirect,
                   .name = parameters[k].name + " by itself",
                   .what = "measure it on a tilted plate to ± " + base::ShortNumber(50 * kWidth) +
                           " % of its searched range and set it in the spec",
                   .learning = ground.Learn(
                       {.mean = ground.draws.col(static_cast<Eigen::Index>(k)),
                        .variance = Eigen::VectorXd::Constant(1, sd * sd / ground.temper)})});
  }
}

// Grain steps of a test's simulation over those of the first experiment's.
double RelativeCost(const JointView& view, const TestCandidate& test, double factor) {
  return campaign::GrainStepsOf(SpecOf(view, test), 0, factor) /
         campaign::GrainStepsOf(view.spec, 0, factor);
}

// As many simulations as the first experiment took, each as much dearer as its grains go on.
void EstimateCost(const JointView& view, const TestCandidate& test, Cost& cost,
                  NextCandidate& candidate) {
  for (const double factor : view.spec.coarse_graining.Levels()) {
    const int count = CountAt(view, 0, factor);
    candidate.num_simulations += count;
    candidate.core_time += count * cost.OfOne(0, factor) * RelativeCost(view, test, factor);
  }
}

// Cost of a design's simulations that are still to be made [core seconds].
double DesignCost(const JointView& view, const TestCandidate& test, int num_made, Cost& cost) {
  const double factor = view.spec.coarse_graining.Levels().front();
  return (kDesignSize - num_made) * cost.OfOne(0, factor) * RelativeCost(view, test, factor);
}

// A test that can be simulated, with what is known of it.
struct Design {
  std::size_t candidate = 0;  // by its place among the tests
  std::optional<TestDesign> stored;
  double cost = 0;  // of what is to be simulated [core seconds]
};

NextCandidate CandidateOf(const JointView& view, const TestCandidate& test, Cost& cost) {
  ListedTest listed = ListTest(view, test);
  if (listed.can_simulate) EstimateCost(view, test, cost, listed.candidate);
  return listed.candidate;
}

// The cheapest first.
std::vector<Design> DesignsOf(const JointView& view, const NextOptions& options,
                              const std::vector<NextCandidate>& candidates, Cost& cost) {
  std::vector<Design> designs;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].num_simulations == 0) continue;
    Design design{.candidate = i,
                  .stored = StoredDesign(view, options.tests[i], *options.parts.engine)};
    const int made = design.stored ? design.stored->num_simulations : 0;
    design.cost = DesignCost(view, options.tests[i], made, cost);
    designs.push_back(std::move(design));
  }
  std::ranges::stable_sort(designs, {}, &Design::cost);
  return designs;
}

// Simulates the designs that the core time allows, the cheapest first; takes away what that took.
void SimulateDesigns(const Ground& ground, const NextOptions& options, std::vector<Design>& designs,
                     double& left) {
  for (Design& design : designs) {
    if (!options.simulate || !(design.cost > 0) || design.cost > left) continue;
    const TestCandidate& test = options.tests[design.candidate];
    const int made = design.stored ? design.stored->num_simulations : 0;
    options.say(test.name + ": " + trials::WorkText(kDesignSize - made, "simulation", design.cost));
    const double before = design.stored ? design.stored->core_time : 0;
    design.stored = SimulateDesign(ground.view, test, {.draws = ground.draws}, options.parts);
    left -= design.stored->core_time - before;
  }
}

std::string NamesOf(const std::vector<Move>& moves) {
  return base::Joined(moves, ", ", &Move::name);
}

// A test's simulations with what is unknown moved, made where the core time left allows it; without
// all of them none count, and the candidate says so.
UnknownTrials UnknownsOf(const JointView& view, const NextOptions& options, const Design& design,
                         Cost& cost, double& left, NextCandidate& candidate) {
  const TestCandidate& test = options.tests[design.candidate];
  const std::vector<Move> moves = UnknownMoves(view, test, *design.stored);
  const MovedDesign moved{.test = test, .design = *design.stored, .moves = moves};
  UnknownTrials trials = StoredUnknowns(view, moved, *options.parts.engine);
  if (trials.num_missing == 0) return trials;
  const double factor = design.stored->scale_factor;
  const double needed =
      trials.num_missing * cost.OfOne(0, factor) * RelativeCost(view, test, factor);
  const std::string text = trials::WorkText(trials.num_missing, "simulation", needed);
  if (!options.simulate || needed > left) {
    candidate.what += "; what it owes to " + NamesOf(moves) + " is judged by " + text;
    return {};
  }
  options.say(test.name + ", with " + NamesOf(moves) + " moved: " + text);
  const double before = trials.core_time;
  trials = SimulateUnknowns(view, moved, options.parts);
  left -= trials.core_time - before;
  return trials;
}

// Core time of the designs so far, and of the runs beside them with what is unknown moved [s].
double TimeOfStored(const JointView& view, const NextOptions& options,
                    const std::vector<Design>& designs) {
  double sum = 0;
  for (const Design& design : designs) {
    if (!design.stored) continue;
    const TestCandidate& test = options.tests[design.candidate];
    const MovedDesign moved{
        .test = test, .design = *design.stored, .moves = UnknownMoves(view, test, *design.stored)};
    sum += design.stored->core_time + StoredUnknowns(view, moved, *options.parts.engine).core_time;
  }
  return sum;
}

// Simulates what the core time allows, and judges every test that has a design.
std::vector<NextCandidate> JudgeTests(const Ground& ground, const NextOptions& options,
                                      Cost& cost) {
  const JointView& view = ground.view;
  std::vector<NextCandidate> candidates;
  for (const TestCandidate& test : options.tests) {
    candidates.push_back(CandidateOf(view, test, cost));
  }
  double left = options.core_time;
  std::vector<Design> designs = DesignsOf(view, options, candidates, cost);
  if (options.is_in_all) left -= TimeOfStored(view, options, designs);
  SimulateDesigns(ground, options, designs, left);
  for (const Design& design : designs) {
    const TestCandidate& test = options.tests[design.candidate];
    NextCandidate& candidate = candidates[design.candidate];
    if (!design.stored) {
      candidate.core_time_to_judge = design.cost;
      candidate.what += ", judged by " + base::Counted(kDesignSize, "coarse simulation") + " of " +
                        base::DurationText(design.cost) + " of core time together";
      continue;
    }
    candidate.num_made = design.stored->num_simulations;
    candidate.num_failed = design.stored->NumFailed();
    candidate.num_simulations = std::max(candidate.num_simulations, candidate.num_made);
    candidate.core_time_made = design.stored->core_time;
    const UnknownTrials unknown = UnknownsOf(view, options, design, cost, left, candidate);
    JudgeTest(ground, {.test = test, .design = *design.stored, .unknown = unknown}, candidate);
  }
  return candidates;
}

NextGoal GoalOf(const Goal& goal, const Eigen::VectorXd& at_draws) {
  return {.process = goal.process,
          .number = goal.number,
          .half_width = optimizer::HalfWidth90(at_draws),
          .left_out_error = goal.surrogate.left_out_error(),
          .scale_factor = goal.scale_factor,
          .num_draws = goal.num_draws,
          .num_runs = goal.num_runs,
          .core_time = goal.core_time};
}

}  // namespace

NextTable RankNext(const JointView& view, const NextOptions& options) {
  const auto strategy = campaign::AnsweringStrategy(view);
  Ground ground{.view = view,
                .temper = strategy->Model().temper(),
                .draws = strategy->Sample().Draws(kDraws, view.spec.seed),
                .model_error = UsualModelError(strategy->Model())};
  const std::vector<Known> experiments = KnownExperiments(ground, strategy->Model());
  ground.surrogate_share = SurrogateShare(experiments);
  NextTable table{.parameters = view.record.parameters, .nuisances = view.space.Nuisances()};
  if (options.goal) {
    ground.goal = options.goal->surrogate.At(ground.draws).mean;
    table.goal = GoalOf(*options.goal, ground.goal);
  }
  for (const int i : view.space.Free()) {
    table.scales.push_back(view.space.parameters[static_cast<std::size_t>(i)].scale);
  }
  table.last_trial = view.LastEnded();
  table.width = ground.Learn({.mean = Eigen::MatrixXd(kDraws, 0), .variance = {}}).width;
  Cost cost(view);
  AddMoreOfTheSame(ground, experiments, cost, table.candidates);
  AddNumbers(ground, strategy->Model(), table.candidates);
  AddDirect(ground, table.candidates);
  const std::vector<NextCandidate> tests = JudgeTests(ground, options, cost);
  table.candidates.insert(table.candidates.end(), tests.begin(), tests.end());
  Rank(table);
  return table;
}

}  // namespace talus::analysis
