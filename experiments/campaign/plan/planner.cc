#include "experiments/campaign/plan/planner.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "base/random.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/record/stored.h"
#include "optimizer/designs/design.h"

namespace talus::campaign {
namespace {

constexpr int kMostAsked = 8;  // the strategies' limit

const char* NameOfOrigin(optimizer::Origin origin) {
  switch (origin) {
    case optimizer::Origin::kDesign:
      return "design";
    case optimizer::Origin::kRepeat:
      return "repeat";
    case optimizer::Origin::kModel:
      return "model";
    case optimizer::Origin::kSearch:
      return "search";
  }
  return "";
}

std::uint64_t StreamOf(journal::TrialKind kind) {
  switch (kind) {
    case journal::TrialKind::kNoise:
      return base::Stream("trial of noise");
    case journal::TrialKind::kConfirm:
      return base::Stream("trial of confirmation");
    default:
      return base::Stream("trial of search");
  }
}

}  // namespace

Planner::Planner(const CampaignSpec& spec, const journal::CampaignRecord& record,
                 std::vector<Reference> references)
    : spec_(spec),
      references_(std::move(references)),
      space_(SpaceOf(spec)),
      domain_(space_.MakeDomain()),
      posterior_(MakePosteriorStrategy(spec_, record, references_)),
      proposer_(MakeProposer(spec_, references_)),
      core_time_(spec_),
      turns_(spec_) {}

void Planner::Started(const journal::TrialRecord& trial) {
  trials_.push_back(trial);
  if (trial.IsOfSearch()) candidates_.reset();
}

void Planner::Finished(const journal::TrialRecord& trial, std::vector<float> field) {
  const auto known = std::find_if(trials_.begin(), trials_.end(),
                                  [&](const journal::TrialRecord& t) { return t.id == trial.id; });
  *known = trial;
  turns_.Told(trial);
  if (!trial.IsOfSearch()) return;
  const Reference& reference = ReferenceOf(trial);
  optimizer::Observation observation = ObservationOf(trial, reference, std::move(field));
  posterior_->Tell(observation);
  // What minimises an objective learns nothing from a trial without it.
  observation.failed |= !reference.Value(trial).has_value();
  if (proposer_) proposer_->Tell(observation);
  CheckThatSomeSucceed(trial);
  CheckThatNumbersAreDefined(trial.experiment);
}

std::string Planner::NameAmongSeveral(int experiment) const {
  return references_.size() == 1 ? ""
                                 : ExperimentsOf(spec_)[static_cast<std::size_t>(experiment)].name;
}

// An experiment whose first trials all fail has a mistake in its set-up; going on would only cost.
// Also one that is held out: without it there is nothing to predict.
void Planner::CheckThatSomeSucceed(const journal::TrialRecord& last) {
  if (last.status != journal::TrialStatus::kFailed) return;
  const std::set<int> failing = FailingExperiments(trials_);
  if (!failing.contains(last.experiment)) return;
  const auto failed = std::ranges::count_if(trials_, [&](const journal::TrialRecord& trial) {
    return trial.status == journal::TrialStatus::kFailed && failing.contains(trial.experiment);
  });
  StopSearch({.kind = StopKind::kAllFailed,
              .value = static_cast<double>(failed),
              .cause = last.reason,
              .experiment = failing.size() == 1 ? NameAmongSeveral(last.experiment) : ""});
}

// Nor does a number teach anything that no set defines.
void Planner::CheckThatNumbersAreDefined(int experiment) {
  std::vector<const journal::TrialRecord*> done;
  for (const journal::TrialRecord& trial : trials_) {
    const bool ok = trial.status == journal::TrialStatus::kOk;
    if (ok && trial.experiment == experiment) done.push_back(&trial);
    if (done.size() > kFailuresToGiveUp) return;  // it was judged by the first ones
  }
  if (done.size() < kFailuresToGiveUp) return;
  for (const journal::ScalarRecord& scalar : ReferenceOf(*done.front()).scalars()) {
    const auto has_it = [&](const auto* trial) { return trial->Metric(scalar.name).has_value(); };
    if (std::ranges::any_of(done, has_it)) continue;
    StopSearch({.kind = StopKind::kUndefined,
                .value = static_cast<double>(done.size()),
                .cause = scalar.name,
                .experiment = NameAmongSeveral(experiment)});
  }
}

void Planner::StopSearch(Stop stop) {
  if (!stop_) stop_ = std::move(stop);
}

int Planner::Count(journal::TrialKind kind) const {
  return static_cast<int>(
      std::count_if(trials_.begin(), trials_.end(),
                    [&](const journal::TrialRecord& t) { return t.kind == kind; }));
}

int Planner::NumOfSearch() const {
  return static_cast<int>(std::ranges::count_if(trials_, &journal::TrialRecord::IsOfSearch));
}

int Planner::NumPaidFor() const {
  return static_cast<int>(std::ranges::count_if(trials_, &journal::TrialRecord::IsPaidFor));
}

std::vector<journal::TrialRecord> Planner::Next(int count) {
  std::vector<journal::TrialRecord> planned;
  const std::size_t num_before = trials_.size();
  while (static_cast<int>(planned.size()) < count) {
    const int wanted = count - static_cast<int>(planned.size());
    if (!PlanNoise(planned) && !PlanReplicate(planned) && !PlanSearch(wanted, planned) &&
        !PlanConfirmation(planned)) {
      break;
    }
  }
  trials_.resize(num_before);  // they count once they are started
  return planned;
}

journal::TrialRecord Planner::Make(journal::TrialKind kind,
                                   const optimizer::Proposal& proposal) const {
  journal::TrialRecord trial;
  trial.kind = kind;
  trial.objective = base::NameOf(spec_.objective);
  trial.experiment = proposal.experiment;
  trial.scale_factor =
      proposal.scale_factor > 0 ? proposal.scale_factor : spec_.coarse_graining.scale_factor;
  const Eigen::VectorXd& point = proposal.point;
  trial.unit.assign(point.data(), point.data() + point.size());
  const std::vector<double> values = space_.ToNative(point);
  for (const int i : space_.Free()) trial.native.push_back(values[static_cast<std::size_t>(i)]);
  return trial;
}

void Planner::Append(journal::TrialRecord trial, std::vector<journal::TrialRecord>& planned) {
  trial.id = trials_.empty() ? 1 : trials_.back().id + 1;
  trial.kind_index =
      trial.kind == journal::TrialKind::kDesign || trial.kind == journal::TrialKind::kSearch
          ? Count(journal::TrialKind::kDesign) + Count(journal::TrialKind::kSearch)
          : Count(trial.kind);
  trial.seed = SeedOf(trial);
  trial.due = turns_.DueOf(trial);
  trials_.push_back(trial);
  planned.push_back(std::move(trial));
}

std::int64_t Planner::SeedOf(const journal::TrialRecord& trial) const {
  // A reused trial may have had the number and the campaign's seed: its grains would be filled in
  // alike.
  const auto index = static_cast<std::uint64_t>(trial.kind_index) |
                     (static_cast<std::uint64_t>(Count(journal::TrialKind::kReused)) << 24) |
                     (static_cast<std::uint64_t>(trial.attempts - 1) << 48);
  base::Random random(spec_.seed, StreamOf(trial.kind), index);
  return static_cast<std::int64_t>(1 + random.Below(rigs::kMostSeeds));
}

Eigen::VectorXd Planner::NoisePoint() const {
  if (!domain_.guesses.empty()) return domain_.guesses.front();
  const Eigen::VectorXd center = Eigen::VectorXd::Constant(domain_.num_parameters, 0.5);
  if (domain_.Contains(center)) return center;
  constexpr int kTries = 1024;
  for (const Eigen::VectorXd& point : optimizer::Sobol(kTries, domain_.num_parameters, 0)) {
    if (domain_.Contains(point)) return point;
  }
  return center;  // the strategy says that the constraints leave nothing
}

bool Planner::PlanNoise(std::vector<journal::TrialRecord>& planned) {
  if (stop_ || Count(journal::TrialKind::kNoise) >= spec_.noise.replicates) return false;
  Append(Make(journal::TrialKind::kNoise, {.point = NoisePoint()}), planned);
  return true;
}

// A proposal whose replicates are not complete yet. What `talus next` had simulated has none:
// nobody has proposed it, and the budget knows of no more of it.
bool Planner::PlanReplicate(std::vector<journal::TrialRecord>& planned) {
  if (spec_.replicates == 1) return false;
  std::map<std::int64_t, std::pair<int, const journal::TrialRecord*>> sets;
  for (const journal::TrialRecord& trial : trials_) {
    if (trial.kind != journal::TrialKind::kDesign && trial.kind != journal::TrialKind::kSearch)
      continue;
    if (trial.origin == journal::kOriginNext) continue;
    ++sets[trial.set].first;
    sets[trial.set].second = &trial;
  }
  for (const auto& [set, members] : sets) {
    if (members.first >= spec_.replicates) continue;
    const journal::TrialRecord& first = *members.second;
    journal::TrialRecord trial = Make(first.kind, {.point = PointOf(first),
                                                   .experiment = first.experiment,
                                                   .scale_factor = first.scale_factor});
    trial.origin = first.origin;
    trial.set = set;
    Append(std::move(trial), planned);
    return true;
  }
  return false;
}

double Planner::CoreTimeOfSearch() { return core_time_.OfSearch(trials_) + CoreTimeOfGoal(); }

// Proposals that the budget of simulations has room for.
int Planner::SetsLeft() const {
  if (spec_.budget.simulations == 0) return kMostAsked;
  const int left = spec_.budget.simulations - NumPaidFor();
  return (left + spec_.replicates - 1) / spec_.replicates;
}

std::optional<Stop> Planner::WhyBudgetIsUsed() {
  const int most = spec_.budget.simulations;
  if (most > 0 && NumPaidFor() >= most) {
    return Stop{.kind = StopKind::kSimulations, .value = 1.0 * most};
  }
  if (spec_.budget.core_time && CoreTimeOfSearch() >= *spec_.budget.core_time) {
    return Stop{.kind = StopKind::kCoreTime, .value = *spec_.budget.core_time};
  }
  return std::nullopt;
}

void Planner::LeaveCoresToTrials() const {
  const auto num_running =
      std::count_if(trials_.begin(), trials_.end(), [](const journal::TrialRecord& trial) {
        return trial.status == journal::TrialStatus::kRunning;
      });
  base::SetMostLoopThreads(most_threads_ - CoresTaken(spec_, static_cast<int>(num_running)));
}

bool Planner::PlanSearch(int count, std::vector<journal::TrialRecord>& planned) {
  if (stop_) return false;
  if (const auto used = WhyBudgetIsUsed()) {
    StopSearch(*used);
    return false;
  }
  LeaveCoresToTrials();
  if (NumOfSearch() >= spec_.budget.min_simulations) {
    if (goal_ && goal_->reason) {
      StopSearch({.kind = StopKind::kRule, .rule = *goal_->reason});
      return false;
    }
    if (const auto reason = Chooser().WhyStop()) {
      StopSearch({.kind = StopKind::kRule, .rule = *reason});
      return false;
    }
  }
  std::vector<optimizer::Proposal> pending;
  for (const journal::TrialRecord& trial : trials_) {
    if (trial.IsOfSearch() && trial.status == journal::TrialStatus::kRunning) {
      pending.push_back({.point = PointOf(trial),
                         .experiment = trial.experiment,
                         .scale_factor = trial.scale_factor});
    }
  }
  const auto proposals = Chooser().AskAt(std::min({count, SetsLeft(), kMostAsked}), pending);
  for (const optimizer::Proposal& proposal : proposals) {
    const bool design = proposal.origin == optimizer::Origin::kDesign;
    journal::TrialRecord trial =
        Make(design ? journal::TrialKind::kDesign : journal::TrialKind::kSearch, proposal);
    trial.origin = NameOfOrigin(proposal.origin);
    trial.set = 1;  // 0 is the noise's
    for (const journal::TrialRecord& other : trials_) {
      if (other.IsOfSearch()) trial.set = std::max(trial.set, other.set + 1);
    }
    Append(std::move(trial), planned);
  }
  if (proposals.empty() && pending.empty()) StopSearch({.kind = StopKind::kNothingLeft});
  return !proposals.empty();
}

std::optional<optimizer::StopShortfall> Planner::Shortfall() {
  if (!stop_) return std::nullopt;
  const bool is_budget = stop_->kind == StopKind::kSimulations ||
                         stop_->kind == StopKind::kCoreTime || stop_->kind == StopKind::kWallClock;
  if (!is_budget) return std::nullopt;
  return Chooser().Shortfall();
}

std::optional<optimizer::Answer> Planner::Recommend() {
  const bool any = std::any_of(trials_.begin(), trials_.end(), [&](const journal::TrialRecord& t) {
    return t.IsOfSearch() && t.status == journal::TrialStatus::kOk && ReferenceOf(t).IsMeasured(t);
  });
  if (!any || !FailingExperiments(trials_).empty()) return std::nullopt;
  LeaveCoresToTrials();
  return posterior_->Recommend();
}

const optimizer::ExperimentModel* Planner::ModelOf(int experiment) {
  if (!posterior_->CanModel()) return nullptr;
  return &posterior_->Model().models()[static_cast<std::size_t>(experiment)];
}

std::optional<double> Planner::NoiseSd(const Eigen::VectorXd& point, int experiment) {
  const optimizer::ExperimentModel* model = ModelOf(experiment);
  if (model == nullptr || !model->has_image()) return std::nullopt;
  return model->ObjectiveNoise(point);
}

std::vector<double> Planner::NumberNoise(const Eigen::VectorXd& point, int experiment) {
  const optimizer::ExperimentModel* model = ModelOf(experiment);
  return model == nullptr ? std::vector<double>() : model->ScalarNoise(point);
}

std::vector<float> Planner::PredictedField(const Eigen::VectorXd& point, int experiment) {
  const optimizer::ExperimentModel* model = ModelOf(experiment);
  if (model == nullptr || !model->has_image()) return {};
  return model->MeanImage(point);
}

}  // namespace talus::campaign
