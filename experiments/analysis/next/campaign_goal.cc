#include "experiments/analysis/next/campaign_goal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/not_known.h"
#include "base/random.h"
#include "base/student_factor.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/next/known.h"
#include "experiments/analysis/next/planned_view.h"
#include "experiments/analysis/predict/draws.h"
#include "experiments/analysis/predict/number_surrogate.h"
#include "experiments/analysis/predict/spread.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/folder/time_taken.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/observables/shown_number.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using campaign::DesignFolder;
using campaign::DesignRecord;
using campaign::GoalState;

constexpr int kFirstRuns = 8;                           // at the first look, each a set of its own
constexpr int kMoreRuns = 4;                            // at each later one
constexpr int kUsualRuns = kFirstRuns + 4 * kMoreRuns;  // that the scale factor is chosen for
constexpr double kUsualTime = 240;                      // of these [core s]
constexpr double kShare = 0.25;                         // or of the budget's core time

// Shares of the half-width: what must be left of it in vain, and what the surrogate may hide.
constexpr double kHardlyLess = 0.9;
constexpr double kClearly = 0.5;

double TimeFor(const campaign::CampaignSpec& spec) {
  return spec.budget.core_time ? std::min(kUsualTime, kShare * *spec.budget.core_time) : kUsualTime;
}

PredictedCase ReadProcess(const campaign::JointView& plan, base::Problems problems) {
  const campaign::GoalSpec& goal = *plan.spec.goal;
  PredictedCase process = ReadPredictedCase(plan, goal.file, {}, kUsualRuns, TimeFor(plan.spec));
  if (!process.scene_text.empty()) {
    throw base::ConfigError(goal.file.string() +
                            ": is a scene; a goal is a number of a bulk test (docs/rigs.md)");
  }
  const auto known = rigs::EntryOf(process.rig_case).observables;
  const auto metric = [](const rigs::RigObservable& o) { return rigs::MetricName(o.observable); };
  const auto key = [](const rigs::RigObservable& o) { return rigs::InfoOf(o.observable).key; };
  problems.Require(std::ranges::find(known, goal.metric(), metric) != known.end(),
                   "goal.observable",
                   "is \"" + goal.observable + "\", which " + goal.file.string() +
                       " does not measure; it measures " + base::Joined(known, ", ", key));
  problems.ThrowIfAny();
  return process;
}

// "tapped density of taps, in kg/m³,"
std::string GoalName(const campaign::GoalSpec& goal) {
  const std::string unit = rigs::PrettyUnit(rigs::UnitOfObservable(goal.metric()));
  return rigs::SpokenName(goal.metric()) + " of " + goal.file.stem().string() +
         (unit.empty() ? "" : ", in " + unit + ",");
}

// Widths, and whether they are a reason to end the search.
void Judge(const campaign::CampaignSpec& spec, const NumberSurrogate& surrogate,
           optimizer::PosteriorStrategy& strategy, Ground& ground, GoalState& state) {
  const surrogate::Predictions at = surrogate.At(ground.draws);
  ground.goal = at.mean;
  state.parameters_half_width = optimizer::HalfWidth90(at.mean);
  state.surrogate_half_width = base::kNormal90 * kOverconfidence * std::sqrt(at.variance.mean());
  state.half_width = std::hypot(state.parameters_half_width, state.surrogate_half_width);
  const double least =
      LearnWithoutSurrogate(ground, KnownExperiments(ground, strategy.Model())).goal_half_width;
  state.least_half_width = std::hypot(least, state.surrogate_half_width);
  const double asked = spec.goal->half_width_in_results();
  optimizer::StopReason reason{.value = state.half_width,
                               .limit = asked,
                               .scale = state.least_half_width,
                               .name = GoalName(*spec.goal)};
  const bool is_open = state.surrogate_half_width <= kClearly * state.parameters_half_width &&
                       least >= kHardlyLess * state.parameters_half_width;
  if (state.half_width <= asked) {
    reason.rule = optimizer::StopRule::kGoal;
    state.reason = reason;
  } else if (is_open && state.least_half_width > asked) {
    reason.rule = optimizer::StopRule::kGoalOpen;
    state.reason = reason;
  }
}

}  // namespace

void CheckGoal(const campaign::CampaignSpec& spec, const base::JsonFile& file) {
  if (spec.goal) ReadProcess(PlannedView(spec, {}), {file.path.string(), file.places});
}

CampaignGoal::CampaignGoal(const campaign::CampaignSpec& spec, const fs::path& campaign,
                           campaign::CampaignParts parts)
    : plan_(PlannedView(spec, campaign)),
      process_(ReadProcess(plan_, {})),
      parts_(std::move(parts)) {}

rigs::Case CampaignGoal::CaseAt(const fs::path& look, const DesignRecord& design,
                                std::size_t index) const {
  // Every run has a seed of its own.
  const std::uint64_t number = std::stoull(look.filename().string()) * kFirstRuns + index;
  base::Random random(plan_.spec.seed, base::Stream("run of a goal"), number);
  return CaseWith(plan_, process_, plan_.space.ToNative(PointOf(design, index)),
                  1 + random.Below(rigs::kMostSeeds));
}

bool CampaignGoal::IsOurs(const DesignRecord& design) const {
  return design.test == rigs::RunText(process_.rig_case) &&
         std::ranges::all_of(design.points, [&](const std::vector<double>& point) {
           return point.size() == plan_.space.Free().size();
         });
}

DesignRecord CampaignGoal::DesignOf(const campaign::JointView& view, const Eigen::MatrixXd& draws,
                                    const DesignFolder& look, bool is_first) const {
  DesignRecord wanted{.test = rigs::RunText(process_.rig_case),
                      .scale_factor = process_.rig_case.coarse_graining.scale_factor};
  if (const auto stored = look.Read(); stored && IsOurs(*stored)) return *stored;
  wanted.points = ChooseDraws(draws, is_first ? kFirstRuns : kMoreRuns, view.spec.seed).points;
  const double taken = campaign::LookCoreTime(look.root);  // by runs that say nothing now
  look.Make(wanted);
  if (taken > 0) campaign::KeepTimeTaken(look.root, taken);
  return wanted;
}

Prediction CampaignGoal::Collect(double& core_time) const {
  const double scale_factor = process_.rig_case.coarse_graining.scale_factor;
  Prediction runs{.name = process_.name, .scale_factor = scale_factor, .target = scale_factor};
  PredictedNumber number{.name = plan_.spec.goal->metric()};
  core_time = campaign::GoalCoreTime(plan_.folder.root);
  for (const fs::path& folder : campaign::GoalLooks(plan_.folder.root)) {
    const DesignFolder look{folder};
    const auto design = look.Read();
    if (!design || !IsOurs(*design)) continue;
    for (std::size_t i = 0; i < design->points.size(); ++i) {
      const campaign::CaseOutcome outcome = campaign::OutcomeOf(
          {.folder = look.trial(i), .rig_case = CaseAt(folder, *design, i)}, *parts_.engine);
      // An engine that goes on from a checkpoint may know of more.
      core_time += outcome.core_time - campaign::TimeTaken(look.trial(i));
      if (!outcome.output) continue;
      const auto& scalars = outcome.output->scalars;
      const auto found = std::ranges::find(scalars, number.name, &journal::MetricRecord::name);
      runs.runs.push_back(
          {.draw = static_cast<int>(runs.draws.size()), .scale_factor = scale_factor});
      runs.draws.push_back(
          {.weight = 1, .values = campaign::FreeValues(plan_.space, PointOf(*design, i))});
      number.by_run.push_back(found != scalars.end() ? found->value : base::kNotKnown);
    }
  }
  runs.num_runs = static_cast<int>(runs.draws.size());
  runs.numbers.push_back(std::move(number));
  return runs;
}

std::string CampaignGoal::FailureOf(const fs::path& look) const {
  const std::string log = trials::LastLogLines(DesignFolder{look}.trial(0));
  return "none has ended well" + (log.empty() ? "" : " (" + log + ")") +
         ", and no more are made before `talus resume DIR`";
}

std::optional<GoalState> CampaignGoal::Look(std::int64_t num_ended,
                                            const base::InterruptGuard& interrupt) {
  constexpr int kDraws = 1000;
  const campaign::JointView view = campaign::ReadJointView(plan_.folder.root);
  GoalState state = campaign::NewGoalState(plan_.spec, num_ended);
  const fs::path folder = campaign::GoalFolder(plan_.folder.root) / base::FileNumber(num_ended);
  const auto strategy = campaign::StrategyOf(view, view.Answered());
  if (!strategy->CanModel()) {  // by the next look it can
    state.num_runs = Collect(state.core_time).num_runs;
    fs::create_directories(folder);
    campaign::KeepGoal(folder, state);
    return state;
  }
  Ground ground{.view = view,
                .temper = strategy->Model().temper(),
                .draws = strategy->Sample().Draws(kDraws, view.spec.seed),
                .model_error = view.spec.posterior.model_error};
  const bool is_first = Collect(state.core_time).num_runs == 0;
  const DesignRecord design = DesignOf(view, ground.draws, {folder}, is_first);
  const campaign::CaseRuns runs{
      .spec = view.spec, .count = design.points.size(), .at = [&](std::size_t i) {
        return campaign::FolderCase{.folder = DesignFolder{folder}.trial(i),
                                    .rig_case = CaseAt(folder, design, i)};
      }};
  if (!campaign::RunCases(runs, parts_, interrupt)) return std::nullopt;
  const Prediction all = Collect(state.core_time);
  state.num_runs = all.num_runs;
  if (all.num_runs == 0) state.failure = FailureOf(folder);
  const auto surrogate = NumberSurrogate::Fit(all, all.numbers.front(), plan_.space);
  if (surrogate) Judge(plan_.spec, *surrogate, *strategy, ground, state);  // else too few have it
  campaign::KeepGoal(folder, state);
  return state;
}

}  // namespace talus::analysis
