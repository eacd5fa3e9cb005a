// The sets that are confirmed when the search has ended, and the trials of each.
#include <algorithm>

#include "experiments/campaign/plan/planner.h"
#include "experiments/campaign/record/stored.h"

namespace talus::campaign {
namespace {

constexpr double kSame = 1e-3;  // of a candidate that is confirmed already
// Confirmations after different searches must not share numbers.
constexpr std::int64_t kMostCandidates = 1000;

}  // namespace

bool Planner::Confirms(const journal::TrialRecord& trial, std::int64_t set, int experiment) const {
  return trial.kind == journal::TrialKind::kConfirm && trial.set == set &&
         trial.experiment == experiment && trial.scale_factor == spec_.ConfirmScaleFactor();
}

std::vector<const journal::TrialRecord*> Planner::Confirming(const Eigen::VectorXd& candidate,
                                                             int experiment) const {
  const std::int64_t set = ConfirmSet(candidate);
  std::vector<const journal::TrialRecord*> trials;
  for (const journal::TrialRecord& trial : trials_) {
    if (Confirms(trial, set, experiment)) trials.push_back(&trial);
  }
  return trials;
}

// A program of another version may recommend another set after the same search. What confirmed the
// former one says nothing of it. Nor do grains of another size, where the spec has changed.
std::int64_t Planner::ConfirmSet(const Eigen::VectorXd& candidate) const {
  std::int64_t next = NumOfSearch() * kMostCandidates;
  for (const journal::TrialRecord& trial : trials_) {
    if (trial.kind != journal::TrialKind::kConfirm || trial.set / kMostCandidates != NumOfSearch())
      continue;
    if (Confirms(trial, trial.set, trial.experiment) &&
        (PointOf(trial) - candidate).lpNorm<Eigen::Infinity>() < kSame) {
      return trial.set;
    }
    next = std::max(next, trial.set + 1);
  }
  return next;
}

Eigen::MatrixXd Planner::Region(const optimizer::PosteriorSummary& posterior) const {
  const Eigen::MatrixXd& draws = posterior.draws;
  const auto levels = CredibleLevels(draws);
  if (!levels) return draws;
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if ((*levels)[i] <= optimizer::kRegionLevel) inside.push_back(i);
  }
  return draws(inside, Eigen::all);
}

std::vector<Candidate> Planner::Candidates(const optimizer::Answer& answer) const {
  if (spec_.confirm.candidates == 0) return {};
  EqualSets equal{.region = {}, .asked = domain_.Asked()};
  if (answer.posterior) equal.region = Region(*answer.posterior);
  return CandidatesOf(answer, equal, spec_.confirm);
}

bool Planner::PlanConfirmation(std::vector<journal::TrialRecord>& planned) {
  const bool searching =
      std::any_of(trials_.begin(), trials_.end(), [](const journal::TrialRecord& t) {
        return t.IsOfSearch() && t.status == journal::TrialStatus::kRunning;
      });
  if (searching || spec_.confirm.candidates == 0) return false;
  if (!candidates_) {
    const auto answer = Recommend();
    if (!answer) return false;
    candidates_ = Candidates(*answer);
  }
  for (const Candidate& candidate : *candidates_) {
    const std::int64_t set = ConfirmSet(candidate.point);
    for (int e = 0; e < static_cast<int>(references_.size()); ++e) {
      const auto done =
          std::count_if(trials_.begin(), trials_.end(),
                        [&](const journal::TrialRecord& t) { return Confirms(t, set, e); });
      if (done >= spec_.confirm.replicates) continue;
      journal::TrialRecord trial = Make(journal::TrialKind::kConfirm,
                                        {.point = candidate.point,
                                         .experiment = e,
                                         .scale_factor = spec_.confirm.scale_factor.value_or(0)});
      trial.set = set;
      Append(std::move(trial), planned);
      return true;
    }
  }
  return false;
}

}  // namespace talus::campaign
