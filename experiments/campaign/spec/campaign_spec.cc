#include "experiments/campaign/spec/campaign_spec.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/joined.h"
#include "base/text/name.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/spec/ignored_keys.h"
#include "experiments/journal/record_json.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/trials/engines/command_engine.h"
#include "imaging/heap/film_strip.h"
#include "imaging/spheres/projection.h"

namespace talus::campaign {
namespace {

constexpr int kMostReplicates = 1000;
constexpr int kMostWorkers = 4096;

// What is searched, and how.
void ValidateSearch(const CampaignSpec& spec, base::Problems& problems) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  space.Validate(problems);
  problems.Within("strategy", [&] {
    spec.strategy.ValidateUse(true, problems);
    const auto num_parameters = static_cast<int>(space.Free().size());
    spec.strategy.ValidateFor(num_parameters, space.IsContinuous(), problems);
    if (space.constraints.empty() && spec.budget.simulations > 0) {
      const int num_sets = spec.budget.simulations / std::max(1, spec.replicates);
      spec.strategy.ValidateGrid(num_parameters, num_sets, problems);
    }
  });
}

}  // namespace

void CheckTemplates(const CampaignSpec& spec, base::Problems& problems) {
  if (spec.engine.kind != EngineKind::kCommand) return;
  const optimizer::ParameterSpace space = SpaceOf(spec);
  std::vector<double> values;
  for (const optimizer::Parameter& parameter : space.parameters) {
    values.push_back(parameter.fixed.value_or(parameter.low));
  }
  const auto case_at = [&](const std::vector<double>& point) {
    rigs::Case rig_case = CaseOf(
        spec, {.values = point, .seed = 1, .scale_factor = spec.coarse_graining.scale_factor}, {});
    for (const ExperimentSpec& experiment : ExperimentsOf(spec)) {  // whose pairs it must know, too
      rig_case.pairs.insert(rig_case.pairs.end(), experiment.pairs->begin(),
                            experiment.pairs->end());
    }
    return rig_case;
  };
  const rigs::Case rig_case = case_at(values);
  std::vector<trials::SearchedParameter> searched;
  for (std::size_t i = 0; i < space.parameters.size(); ++i) {
    const optimizer::Parameter& parameter = space.parameters[i];
    if (parameter.fixed) continue;
    std::vector<double> end = values;
    end[i] = parameter.high;
    searched.push_back({.name = parameter.name, .low = rig_case, .high = case_at(end)});
  }
  problems.Within("engine", [&] {
    trials::CheckCommand(spec.engine.command,
                         {.rig_case = rig_case,
                          .searched = searched,
                          .elsewhere = spec.runner.kind != RunnerKind::kLocal},
                         problems);
  });
}

namespace {

void RequireEffect(const ParameterRanges& parameters, const engine::ContactModels& models,
                   base::Problems& problems) {
  for (const optimizer::Parameter& parameter : MakeSpace(parameters).parameters) {
    const auto missing = LawMissingFor(parameter.name, models);
    if (!missing) continue;
    problems.Add("parameters." + parameter.name,
                 missing->why + "; " + missing->remedy + " or leave it out");
  }
}

bool IsGiven(const nlohmann::json& root, const char* section, const char* key) {
  return root.contains(section) && root[section].is_object() && root[section].contains(key);
}

// Defaults that depend on other keys.
void CompleteDefaults(CampaignSpec& spec, const nlohmann::json& root) {
  // Beside core time the number of trials is free.
  if (spec.budget.core_time && !IsGiven(root, "budget", "simulations")) spec.budget.simulations = 0;
}

// What only an entry of the list may have beside its images.
void PointToList(const nlohmann::json& root, base::Problems& problems) {
  if (!root.contains("experiment") || !root["experiment"].is_object()) return;
  const auto keys_of = [](const auto& options) {
    std::vector<std::string> keys;
    options.Visit(options, [&](std::string_view key, const auto&, const base::FieldInfo& = {}) {
      keys.emplace_back(key);
    });
    return keys;
  };
  const std::vector<std::string> of_images = keys_of(imaging::ExperimentOptions{});
  std::vector<std::string> of_list;
  for (const std::string& key : keys_of(ExperimentSpec{})) {
    const bool is_only_there = std::ranges::count(of_images, key) == 0 && key != "name";
    if (is_only_there && root["experiment"].contains(key)) of_list.push_back(key);
  }
  problems.Require(of_list.empty(), "experiment",
                   "has " + base::Listed(of_list) +
                       ": numbers and what is a test's own stand in `experiments`, a list: "
                       "\"experiments\": [{\"name\": \"heap\", …}] in place of \"experiment\"");
}

constexpr double kLongestBudget = 1e12;  // [s]; beyond, times and counts are printed as nonsense

// Whether every trial has the same objective, as a plain minimiser needs it.
bool HasOneObjective(const CampaignSpec& spec) {
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  return !spec.coarse_graining.AreSeveral() && experiments.size() == 1 &&
         experiments.front().images.HasImages();
}

}  // namespace

void BudgetOptions::Validate(base::Problems& problems) const {
  problems.Require(
      (simulations >= 1 || (simulations == 0 && core_time)) && simulations <= kMostSimulations,
      "simulations", simulations, "must be from 1 to 1000000");
  problems.Require(!core_time || (*core_time > 0 && *core_time <= kLongestBudget), "core_time",
                   core_time.value_or(0), "must be positive, and at most 1e12 s");
  problems.RequireFromTo("min_simulations", min_simulations, 0, kMostSimulations);
  problems.Require(sensitivity_share >= 0 && sensitivity_share <= 1, "sensitivity_share",
                   sensitivity_share, "must be in [0, 1]");
  problems.Require(!wall_clock || (*wall_clock > 0 && *wall_clock <= kLongestBudget), "wall_clock",
                   wall_clock.value_or(0), "must be positive, and at most 1e12 s");
}

void NoiseOptions::Validate(base::Problems& problems) const {
  problems.Require(replicates == 0 || (replicates >= 2 && replicates <= kMostReplicates),
                   "replicates", replicates,
                   "must be 0, or from 2 to 1000: one trial has no scatter");
}

void PosteriorOptions::Validate(base::Problems& problems) const {
  problems.Require(model_error >= 0 && model_error <= 1000, "model_error", model_error,
                   "must be in [0, 1000]");
  problems.Require(!learn_model_error || model_error > 0, "model_error", model_error,
                   "must be positive where it is the scale of a model error that is learnt");
  problems.Require(stop_share >= 0, "stop_share", stop_share, "must not be negative");
}

void ConfirmOptions::Validate(base::Problems& problems) const {
  problems.RequireFromTo("candidates", candidates, 0, kMostReplicates);
  problems.RequireFromTo("replicates", replicates, 1, kMostReplicates);
  problems.Require(!scale_factor || *scale_factor >= 1, "scale_factor", scale_factor.value_or(1),
                   "must be at least 1");
}

void AdviceOptions::Validate(base::Problems& problems) const {
  problems.Require(share >= 0 && share <= 10, "share", share, "must be from 0 to 10");
}

void CampaignSpec::Validate(base::Problems& problems) const {
  if (!name.empty()) base::RequireName(problems, "name", name);
  problems.Require(gravity > 0, "gravity", gravity, "must be positive");
  problems.Require(rayleigh_fraction > 0 && rayleigh_fraction <= 0.4, "rayleigh_fraction",
                   rayleigh_fraction, "must be in (0, 0.4]");
  problems.RequireFromTo("num_views", num_views, 1, imaging::kMostViews);
  problems.RequireFromTo("replicates", replicates, 1, kMostReplicates);
  problems.RequireFromTo("workers", workers, 0, kMostWorkers);
  problems.RequireFromTo("threads", threads, 1, kMostWorkers);
  problems.Require(trial_time_cap > 0 && trial_time_cap <= runners::kYear, "trial_time_cap",
                   trial_time_cap, "must be positive, and at most a year");
  problems.Require(budget.simulations == 0 || budget.simulations > noise.replicates,
                   "budget.simulations", budget.simulations, "must be more than noise.replicates");
  ValidateExperiments(*this, problems);
  ValidatePairs(*this, problems);
  problems.Require(!HasOwnProposer() || !goal, "goal",
                   "is reached by the strategy \"auto\" only: the others look for one set");
  problems.Require(!HasOwnProposer() || HasOneObjective(*this), "strategy.kind",
                   "must be \"auto\" with several scale factors or experiments, or without "
                   "an image: the others minimise one objective only");
  if (!parameters) return;
  problems.Within("parameters", [&] { ValidateRanges(*parameters, powder.material, problems); });
  RequireEffect(*parameters, models, problems);
}

bool CampaignSpec::HasOwnProposer() const {
  return strategy.kind != optimizer::StrategyKind::kAuto;
}

void AddByOwnKeys(const base::Problems& found, const CampaignSpec& spec, base::Problems& problems) {
  const std::string place = "experiments[" + std::to_string(spec.experiments->size() - 1) + "].";
  for (base::Problem problem : found.list()) {
    if (problem.path.starts_with(place)) problem.path.erase(0, place.size());
    problems.Add(std::move(problem));
  }
}

std::vector<ExperimentSpec> ExperimentsOf(const CampaignSpec& spec) {
  std::vector<ExperimentSpec> list = spec.experiments.value_or(std::vector<ExperimentSpec>{});
  if (spec.experiment) {
    ExperimentSpec only;
    only.name = "heap";
    only.images = *spec.experiment;
    list.push_back(std::move(only));
  }
  for (ExperimentSpec& experiment : list) {
    if (!experiment.rig) experiment.rig = spec.rig;
    if (!experiment.device) experiment.device = spec.device;
    if (KindOf(experiment) != rigs::RigKind::kLiftedTube) {
      experiment.device = rigs::MaterialsOf(*experiment.device);
    }
    if (!experiment.pairs) experiment.pairs = spec.pairs;
    if (!experiment.filling) experiment.filling = spec.filling;
    if (!experiment.rules) experiment.rules = spec.rules;
    if (experiment.mass || HasFill(experiment) || spec.powder.mass == 0) continue;
    experiment.mass = spec.powder.mass;
  }
  return list;
}

CampaignSpec ParseSpecText(const std::string& text) {
  return journal::ParseRecord<CampaignSpec>(text, "the journal's spec");
}

void CompleteEngine(CampaignSpec& spec, base::Problems& problems) {
  if (spec.engine.kind != EngineKind::kCommand || !spec.engine.command.templates_hash.empty()) {
    return;
  }
  CheckTemplates(spec, problems);
  if (!std::filesystem::is_directory(*spec.engine.command.templates)) return;  // which is said
  spec.engine.command.templates_hash =
      trials::TemplateFolder(*spec.engine.command.templates).Hash();
}

CampaignSpec ReadCampaignSpec(const base::JsonFile& file) {
  CampaignSpec spec;
  base::Problems problems(file.path.string(), file.places);
  base::ReadOptions(file.root, spec,
                    {problems, std::filesystem::absolute(file.path).parent_path()});
  if (spec.name.empty()) spec.name = base::OneLine(file.path.stem().string());
  if (!spec.parameters) spec.parameters = UsualRanges(spec.models.adhesion);
  CompleteDefaults(spec, file.root);
  SetDrumDiameters(spec);
  PointToList(file.root, problems);
  base::TreeValidator(problems).Check(spec);
  RefuseIgnoredKeys(file, spec, problems);
  if (problems.empty()) ValidateSearch(spec, problems);
  problems.ThrowIfAny();
  spec.coarse_graining.scale_factor = spec.coarse_graining.Levels().back();
  engine::ReadSizeFile(spec.powder.sizes);
  SetDrumFills(spec);
  if (spec.powder.mass == 0) spec.powder.mass = TypicalCase(spec, 0, 1).powder.mass;
  CompleteEngine(spec, problems);
  ValidateCases(spec, problems);
  problems.ThrowIfAny();
  return spec;
}

void CheckSpec(const CampaignSpec& spec, base::Problems& problems) {
  base::TreeValidator(problems).Check(spec);
  if (problems.empty()) ValidateSearch(spec, problems);
  if (problems.empty()) ValidateCases(spec, problems);
}

std::string SpecText(const CampaignSpec& spec) {
  return base::JsonText(base::ToJson(spec), 2) + "\n";
}

optimizer::ParameterSpace SpaceOf(const CampaignSpec& spec) {
  optimizer::ParameterSpace space = MakeSpace(spec.parameters.value());
  space.constraints = spec.constraints;
  return space;
}

rigs::Case CaseOf(const CampaignSpec& spec, const TrialSettings& settings,
                  const std::optional<imaging::Frame>& frame) {
  rigs::Case rig_case;
  rig_case.powder = spec.powder;
  const ExperimentSpec experiment =
      ExperimentsOf(spec).at(static_cast<std::size_t>(settings.experiment));
  if (experiment.mass) rig_case.powder.mass = *experiment.mass;
  rig_case.rig = experiment.rig.value_or(rigs::RigOptions{});
  rig_case.SetDevice(*experiment.device);
  rig_case.pairs = *experiment.pairs;
  rig_case.models = spec.models;
  rig_case.coarse_graining = {
      .scale_factor = settings.scale_factor,
      .surface_energy_exponent = spec.coarse_graining.surface_energy_exponent};
  rig_case.filling = *experiment.filling;
  rig_case.rules = *experiment.rules;
  rig_case.gravity = spec.gravity;
  rig_case.rayleigh_fraction = spec.rayleigh_fraction;
  rig_case.seed = settings.seed;
  if (frame) rig_case.frame = imaging::OnePicture(*frame);
  rig_case.num_views = spec.num_views;
  rig_case.threads = spec.threads;
  const optimizer::ParameterSpace space = SpaceOf(spec);
  for (std::size_t i = 0; i < space.parameters.size(); ++i) {
    SetParameter(rig_case, space.parameters[i].name, settings.values[i]);
  }
  rig_case.SetMassByFill();
  return rig_case;
}

rigs::Case TypicalCase(const CampaignSpec& spec, int experiment, double scale_factor) {
  const auto num_free = static_cast<Eigen::Index>(SpaceOf(spec).Free().size());
  return CaseAt(spec, Eigen::VectorXd::Constant(num_free, 0.5), experiment, scale_factor);
}

rigs::Case CaseAt(const CampaignSpec& spec, const Eigen::VectorXd& point, int experiment,
                  double scale_factor) {
  const std::vector<double> values = SpaceOf(spec).ToNative(point);
  rigs::Case rig_case = CaseOf(
      spec,
      {.values = values, .seed = spec.seed, .scale_factor = scale_factor, .experiment = experiment},
      {});
  rig_case.frame = imaging::Frame{
      .pixel_size = 1e-4, .baseline = 1, .plate_diameter = rigs::EntryOf(rig_case).width(rig_case)};
  return rig_case;
}

}  // namespace talus::campaign
