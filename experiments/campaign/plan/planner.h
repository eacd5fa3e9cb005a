// Which trial comes next: noise first, then what the optimiser asks for, then the confirmation.
//
// A planner's state follows from the trials it was told, in their order, and from those that are
// running; so it is rebuilt from a journal, and goes on as if nothing had happened.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "experiments/campaign/folder/goal_folder.h"
#include "experiments/campaign/plan/candidates.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/plan/stop.h"
#include "experiments/campaign/plan/turns.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"
#include "optimizer/strategy/posterior_strategy.h"
#include "optimizer/strategy/strategy.h"

namespace talus::campaign {

class Planner {
 public:
  // `references`: one for each of the campaign's experiments.
  Planner(const CampaignSpec& spec, const journal::CampaignRecord& record,
          std::vector<Reference> references);

  // A trial that is running, started now or by an earlier process.
  void Started(const journal::TrialRecord& trial);
  // A trial that has finished; the field is empty when it failed or its image is lost.
  void Finished(const journal::TrialRecord& trial, std::vector<float> field);

  // Up to `count` trials to start now, numbered on from the last. None while the confirmation waits
  // for running ones, and none at the end.
  std::vector<journal::TrialRecord> Next(int count);

  // No more trials of noise and search, for this reason; the first one counts.
  void StopSearch(Stop stop);
  const std::optional<Stop>& stop() const { return stop_; }
  // What is known of the spec's goal, and whether the search may end by it; none: nothing yet.
  void NoteGoal(std::optional<GoalState> goal) { goal_ = std::move(goal); }
  const std::optional<GoalState>& goal() const { return goal_; }
  // What runs in DIR/goal took before, though the spec may ask for no goal now [core seconds].
  void NoteGoalTime(double seconds) { goal_time_ = seconds; }
  double CoreTimeOfGoal() const { return goal_ ? goal_->core_time : goal_time_; }
  // What the strategy's own rule lacks; nothing where the budget did not end the search.
  std::optional<optimizer::StopShortfall> Shortfall();

  // What the trials so far say; nothing before the first that succeeded, or where an experiment is
  // set up wrongly (FailingExperiments).
  std::optional<optimizer::Answer> Recommend();

  // The sets to be confirmed; none where the spec asks for none.
  std::vector<Candidate> Candidates(const optimizer::Answer& answer) const;
  // The posterior's draws inside the joint 90 % region, where a set fits as well as any.
  Eigen::MatrixXd Region(const optimizer::PosteriorSummary& posterior) const;
  // TrialRecord::set of the trials that confirm a candidate: theirs where there are any.
  std::int64_t ConfirmSet(const Eigen::VectorXd& candidate) const;

  // The trials that confirm a candidate by an experiment.
  std::vector<const journal::TrialRecord*> Confirming(const Eigen::VectorXd& candidate,
                                                      int experiment) const;

  // As Strategy::CredibleLevels, from what was told so far.
  std::optional<Eigen::VectorXd> CredibleLevels(const Eigen::MatrixXd& points) const {
    return posterior_->CredibleLevels(points);
  }

  // Noise sd of the objective of one simulation of an experiment there, by the model that answers;
  // nothing without an image or while there are too few trials.
  std::optional<double> NoiseSd(const Eigen::VectorXd& point, int experiment);

  // The same of each number of an experiment, in its metric's unit; empty while there are too few.
  std::vector<double> NumberNoise(const Eigen::VectorXd& point, int experiment);

  // The mean image of an experiment there by that model, as Reference::ImageOf takes it; empty
  // where NoiseSd has nothing.
  std::vector<float> PredictedField(const Eigen::VectorXd& point, int experiment);

  const std::vector<journal::TrialRecord>& trials() const { return trials_; }  // by id
  const optimizer::ParameterSpace& space() const { return space_; }
  const optimizer::Domain& domain() const { return domain_; }

  // Processor time of noise and search so far [core seconds], the running ones estimated; that of
  // the goal's runs counts.
  double CoreTimeOfSearch();

  // A fresh seed for each trial and attempt; small enough for any engine.
  std::int64_t SeedOf(const journal::TrialRecord& trial) const;

 private:
  bool PlanNoise(std::vector<journal::TrialRecord>& planned);
  bool PlanReplicate(std::vector<journal::TrialRecord>& planned);
  bool PlanSearch(int count, std::vector<journal::TrialRecord>& planned);
  bool PlanConfirmation(std::vector<journal::TrialRecord>& planned);
  journal::TrialRecord Make(journal::TrialKind kind, const optimizer::Proposal& proposal) const;
  const Reference& ReferenceOf(const journal::TrialRecord& trial) const {
    return references_[static_cast<std::size_t>(trial.experiment)];
  }
  // A test's part of the model that answers; null where it cannot be made yet.
  const optimizer::ExperimentModel* ModelOf(int experiment);
  // The strategy that chooses the trials.
  optimizer::Strategy& Chooser() { return proposer_ ? *proposer_ : *posterior_; }
  int SetsLeft() const;
  std::optional<Stop> WhyBudgetIsUsed();
  void LeaveCoresToTrials() const;  // of those that the loops of the strategy may use
  void Append(journal::TrialRecord trial, std::vector<journal::TrialRecord>& planned);
  Eigen::VectorXd NoisePoint() const;
  int Count(journal::TrialKind kind) const;
  // Whether a trial is one of a confirmed set, by grains of the size that confirms now.
  bool Confirms(const journal::TrialRecord& trial, std::int64_t set, int experiment) const;
  int NumOfSearch() const;  // that the strategies are told of, noise and reused ones included
  int NumPaidFor() const;   // … without the reused ones
  std::string NameAmongSeveral(int experiment) const;  // empty where there is one only
  void CheckThatSomeSucceed(const journal::TrialRecord& last);
  void CheckThatNumbersAreDefined(int experiment);

  const CampaignSpec spec_;
  const std::vector<Reference> references_;
  const optimizer::ParameterSpace space_;
  const optimizer::Domain domain_;
  const std::unique_ptr<optimizer::PosteriorStrategy> posterior_;  // makes the answer
  const std::unique_ptr<optimizer::Strategy> proposer_;            // null: posterior_ chooses, too
  std::vector<journal::TrialRecord> trials_;
  std::optional<std::vector<Candidate>> candidates_;  // of this confirmation
  std::optional<Stop> stop_;
  std::optional<GoalState> goal_;
  double goal_time_ = 0;
  CoreTime core_time_;
  Turns turns_;
  const int most_threads_ = base::MostLoopThreads();
};

}  // namespace talus::campaign
