// A campaign as its user writes it: one JSON file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/json/json_changes.h"
#include "base/json/json_file.h"
#include "experiments/campaign/spec/campaign_options.h"
#include "experiments/campaign/spec/experiment_spec.h"
#include "experiments/campaign/spec/goal_spec.h"
#include "experiments/campaign/spec/grain_sizes.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/campaign/spec/where_options.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/case/case.h"
#include "imaging/photos/experiment.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::campaign {

struct CampaignSpec {
  std::string name;
  rigs::Powder powder;
  std::optional<rigs::RigOptions> rig{};  // default: the lifted tube
  rigs::Device device;
  std::vector<engine::PairSpec> pairs{};
  engine::ContactModels models;
  GrainSizes coarse_graining;
  rigs::FillingRule filling;
  rigs::PhaseRules rules;
  double gravity = 9.81;  // [m/s²], > 0
  double rayleigh_fraction =
      rigs::kUsualRayleighFraction;  // Δt / t_R of the smallest grain [-], <= 0.4
  std::optional<imaging::ExperimentOptions> experiment{};  // of a campaign with one only
  std::optional<std::vector<ExperimentSpec>> experiments{};
  std::optional<std::string> hold_out{};  // name of one that the answer is not made from
  // So many of `experiments`, the last, were added after the campaign had begun: its file need not
  // have them.
  std::optional<int> num_added{};
  int num_views = 16;  // of a simulated profile, >= 1
  std::optional<ParameterRanges> parameters{};
  std::vector<optimizer::LinearConstraint> constraints{};
  journal::Objective objective = journal::Objective::kSad;
  optimizer::StrategyOptions strategy;
  BudgetOptions budget;
  std::optional<GoalSpec> goal{};  // the search ends when it is reached
  NoiseOptions noise;
  int replicates = 1;  // seeds of each proposed set, >= 1
  PosteriorOptions posterior;
  ConfirmOptions confirm;
  AdviceOptions next;
  std::uint64_t seed = 1;
  int workers = 0;                   // trials at the same time, >= 0; 0: as many as cores
  int threads = 1;                   // of a trial, >= 1
  double trial_time_cap = 6 * 3600;  // [s] wall-clock, > 0
  bool retry_failed = false;         // once, with another seed
  EngineOptions engine;
  RunnerOptions runner;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("name", self.name, {.doc = "for people; default: the file's name"});
    visit("powder", self.powder, {.required = true, .doc = "what is heaped"});
    visit("rig", self.rig, {.doc = "kind of bulk test (docs/rigs.md); default: the lifted tube"});
    visit("device", self.device, {.doc = "tube and plate"});
    visit("pairs", self.pairs,
          {.doc = "what grains with \"plate\", \"tube\" or \"powder\" state themselves, such as a "
                  "measured friction; else it follows from the two"});
    visit("models", self.models, {.doc = "contact laws"});
    visit("coarse_graining", self.coarse_graining, {.doc = "fewer, larger grains"});
    visit("filling", self.filling, {.doc = "how the powder gets into the tube"});
    visit("rules", self.rules, {.doc = "when each phase of a simulation ends"});
    visit("gravity", self.gravity,
          {.dimension = Dimension::kAcceleration, .doc = "downwards, > 0"});
    visit("rayleigh_fraction", self.rayleigh_fraction,
          {.doc = "time step over Rayleigh time of the smallest grain, in (0, 0.4]"});
    visit("experiment", self.experiment,
          {.doc = "photographs or a map; this or `experiments` is needed"});
    visit(
        "experiments", self.experiments,
        {.doc = "several tests of the same powder, each with a name and the keys of `experiment`, "
                "to be met by one parameter set"});
    visit("hold_out", self.hold_out,
          {.doc = "name of one of the experiments: the answer is made without it and predicts it"});
    visit("num_added", self.num_added,
          {.doc = "filled in by `talus add-experiment`: so many of the experiments it has added"});
    visit("num_views", self.num_views, {.doc = "of a simulated profile over 180 deg, >= 1"});
    visit("parameters", self.parameters,
          {.doc = "what is searched; default: sliding and rolling friction, surface energy"});
    visit("constraints", self.constraints, {.doc = "linear inequalities between parameters"});
    visit(
        "objective", self.objective,
        {.doc = "what trials are compared and listed by; strategies other than auto minimise it"});
    visit("strategy", self.strategy, {.doc = "how the next trial is chosen"});
    visit("budget", self.budget, {.doc = "when the search ends at the latest"});
    visit("goal", self.goal,
          {.doc = "what is to be predicted, and how well: the search ends when it is"});
    visit("noise", self.noise, {.doc = "how the run-to-run scatter is estimated first"});
    visit("replicates", self.replicates, {.doc = "seeds of each proposed set, >= 1"});
    visit("posterior", self.posterior, {.doc = "what the observations are held to say"});
    visit("confirm", self.confirm, {.doc = "what is simulated again at the end"});
    visit("next", self.next, {.doc = "what is looked into where the answer is no point"});
    visit("seed", self.seed, {.doc = "every random choice follows from it"});
    visit("workers", self.workers, {.doc = "trials at the same time; 0: as many as cores"});
    visit("threads", self.threads, {.doc = "of one trial, >= 1"});
    visit("trial_time_cap", self.trial_time_cap,
          {.dimension = Dimension::kTime, .doc = "a trial fails when it takes longer, > 0"});
    visit("retry_failed", self.retry_failed,
          {.doc = "try a failed trial once more with another seed"});
    visit("engine", self.engine, {.doc = "what simulates a trial"});
    visit("runner", self.runner, {.doc = "where trials run"});
  }
  // What each part cannot see by itself.
  void Validate(base::Problems& problems) const;

  // Whether another strategy than the calibration's own chooses the trials.
  bool HasOwnProposer() const;

  // What the recommended sets are confirmed at.
  double ConfirmScaleFactor() const {
    return confirm.scale_factor.value_or(coarse_graining.scale_factor);
  }
};

// Reads, completes and validates a spec; throws one ConfigError with every problem.
CampaignSpec ReadCampaignSpec(const base::JsonFile& file);

// A spec that was not read from one file: every problem of it.
void CheckSpec(const CampaignSpec& spec, base::Problems& problems);

// Problems of a spec, those of its last experiment by the keys of the experiment itself.
void AddByOwnKeys(const base::Problems& found, const CampaignSpec& spec, base::Problems& problems);

// What shows only when the cases of a spec are put together, such as a tube that cannot hold the
// mass.
void ValidateCases(const CampaignSpec& spec, base::Problems& problems);

// Whether another engine's templates use every parameter that is searched, and only what there is.
void CheckTemplates(const CampaignSpec& spec, base::Problems& problems);
// Another engine's templates are checked once, when the user's spec is read; what was read then is
// recognised by its hash.
void CompleteEngine(CampaignSpec& spec, base::Problems& problems);

// The spec with all its defaults and absolute paths, as JSON that reads back to the same.
std::string SpecText(const CampaignSpec& spec);
CampaignSpec ParseSpecText(const std::string& text);

// What is searched.
optimizer::ParameterSpace SpaceOf(const CampaignSpec& spec);

// The campaign's experiments, one at least, each with its rig, device, filling and rules filled
// in.
std::vector<ExperimentSpec> ExperimentsOf(const CampaignSpec& spec);

// Why the experiment does not go together with its rig and the others; a rule a problem.
void ValidateExperiments(const CampaignSpec& spec, base::Problems& problems);

// Pairs that name no body, and those that contradict each other or a parameter.
void ValidatePairs(const CampaignSpec& spec, base::Problems& problems);

// The case of a trial: `values` of all of the space's parameters, in its order; `frame` that of the
// experiment's profile, be it one picture or a film's strip.
struct TrialSettings {
  std::span<const double> values;
  std::uint64_t seed = 0;
  double scale_factor = 1;
  int experiment = 0;
};
rigs::Case CaseOf(const CampaignSpec& spec, const TrialSettings& settings,
                  const std::optional<imaging::Frame>& frame);

// A trial in the middle of the ranges, or at a point of the unit cube, without the experiment's
// frame: for checks and estimates.
rigs::Case TypicalCase(const CampaignSpec& spec, int experiment, double scale_factor);
rigs::Case CaseAt(const CampaignSpec& spec, const Eigen::VectorXd& point, int experiment,
                  double scale_factor);

// What differs between two specs (as SpecText writes them); what a running campaign may change is
// left out, and so is the place of what has moved together with `folder`, that of the new spec.
std::vector<base::JsonChange> ForbiddenChanges(const std::string& old_text,
                                               const std::string& new_text,
                                               const std::filesystem::path& folder = {});

// Whether the new one may end a search elsewhere than the old: where it differs in what is to be
// found or spent, and not only in how trials are run.
bool AsksMore(const std::string& old_text, const std::string& new_text);

// "powder.mass: 0.001 → 0.002"
std::string ChangeText(const base::JsonChange& change);

}  // namespace talus::campaign
