// talus validate
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/json/json_reader.h"
#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "engine/scene/scene_json.h"
#include "engine/scene/scene_warnings.h"
#include "experiments/analysis/design/design_spec.h"
#include "experiments/analysis/design/design_text.h"
#include "experiments/analysis/next/campaign_goal.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/earlier_posterior.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/plan/estimate.h"
#include "experiments/campaign/spec/deck_gaps.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/start.h"
#include "experiments/rigs/case/case_warnings.h"
#include "experiments/rigs/case/device_text.h"
#include "experiments/rigs/filling/vessel.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/observables/shown_number.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/optimize/evaluator.h"
#include "experiments/trials/optimize/optimize_problem.h"
#include "optimizer/space/candidate_table.h"

namespace talus::app {
namespace {

void PrintExperiment(const journal::ExperimentRecord& e, const campaign::ExperimentSpec& spec,
                     const journal::CampaignRecord& record) {
  const std::string reading = campaign::ReadingText(spec);
  std::cout << "  experiment        " << (record.experiments.size() > 1 ? e.name + ": " : "")
            << reading << (reading.empty() ? "" : "\n                    ")
            << (!e.aehp_png.empty() ? "NEBP " + base::ShortNumber(e.nebp_px) + " px"
                                    : "numbers only");
  if (e.noise_mm2) std::cout << ", noise floor " << base::ShortNumber(*e.noise_mm2) << " mm²";
  for (const journal::ScalarRecord& s : e.scalars) {
    std::cout << ", " << rigs::SpokenName(s.name) << " " << rigs::ShownNumber(s.name, s.value)
              << " ± " << rigs::ShownError(s.name, s.standard_error);
  }
  std::cout << '\n';
}

// What each test is simulated with, in the bench's units: a slip shows where it can be believed.
void PrintRigs(const campaign::CampaignSpec& spec,
               const std::vector<campaign::ExperimentSpec>& experiments) {
  const double finest = spec.coarse_graining.Finest();
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const rigs::Case rig_case = campaign::TypicalCase(spec, static_cast<int>(e), finest);
    std::cout << "  rig               "
              << (experiments.size() > 1 ? experiments[e].name + ": " : "")
              << rigs::DeviceText(rig_case.rig) << ", mass "
              << base::ShortNumber(1e3 * rig_case.powder.mass) << " g\n";
  }
}

// Where a warning holds.
std::string At(const std::string& experiment, double scale_factor) {
  return experiment + " at scale factor " + base::ShortNumber(scale_factor) + ": ";
}

bool IsNuisance(const campaign::CampaignSpec& spec, const std::string& name) {
  return std::ranges::any_of(campaign::SpaceOf(spec).parameters,
                             [&](const auto& p) { return p.name == name && p.is_nuisance; });
}

// An objective is of images; numbers alone are met by their errors.
std::string AimText(const campaign::CampaignSpec& spec) {
  long long num_numbers = 0;
  for (const campaign::ExperimentSpec& e : campaign::ExperimentsOf(spec)) {
    if (e.images.HasImages())
      return "comparing images by " + std::string(base::NameOf(spec.objective));
    num_numbers += std::ssize(campaign::ScalarsOf(e));
  }
  return "meeting " + base::Counted(num_numbers, "number");
}

void PrintSearched(const std::vector<journal::ParameterRecord>& parameters,
                   const campaign::CampaignSpec& spec) {
  const std::map<std::string, std::string> priors = campaign::PriorTexts(*spec.parameters);
  std::cout << "  searched         ";
  for (const journal::ParameterRecord& p : parameters) {
    std::cout << ' ' << p.name << " in " << base::ShortNumber(p.low) << " … "
              << base::ShortNumber(p.high) << (p.unit.empty() ? "" : " " + p.unit);
    if (const auto prior = priors.find(p.name); prior != priors.end()) {
      std::cout << ", prior " << prior->second;
    }
    std::cout << (IsNuisance(spec, p.name) ? " (nuisance);" : ";");
  }
  std::cout << ' ' << AimText(spec) << '\n';
}

void PrintShallow(const rigs::Case& rig_case, const std::string& where) {
  const std::string text = rigs::ShallowWarning(rig_case, rigs::EntryOf(rig_case).vessel(rig_case));
  if (!text.empty()) std::cout << "  warning: " << where << text << '\n';
}

// Photographs that are not there yet need not keep the cost from being planned.
journal::CampaignRecord MeasuredRecord(const campaign::CampaignSpec& spec,
                                       const base::JsonFile& file) {
  try {
    return campaign::MakeRecord(spec, file);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(std::string(error.what()) +
                            "\n--without-experiment checks all else and plans the cost");
  }
}

// "lmp -in in.heap, templates in /a/deck, leaves heap.dump".
void PrintEngine(const trials::CommandOptions& engine) {
  std::cout << "  engine            " << base::Joined(engine.command, " ") << ", templates in "
            << engine.templates->string() << ", leaves " << engine.result << '\n';
}

// How long a trial of another engine takes only a trial tells.
void PrintForeignCost(const campaign::CampaignSpec& spec) {
  std::cout << "  cost              ";
  const bool by_number = spec.budget.simulations > 0;
  if (by_number) {
    std::cout << base::Counted(spec.budget.simulations, "simulation") << " and at most "
              << campaign::MostConfirming(spec) << " to confirm";
  }
  if (spec.budget.core_time) {
    std::cout << (by_number ? ", or " : "") << base::DurationText(*spec.budget.core_time)
              << " of core time" << (by_number ? ", whichever is spent first" : "");
  }
  std::cout << ", a trial at most " << base::DurationText(spec.trial_time_cap)
            << " (trial_time_cap); how long one takes is not known before one has run\n";
}

// Slurm counts in whole minutes.
void WarnOfMinutes(const campaign::CampaignSpec& spec) {
  constexpr double kMinute = 60;  // [s]
  if (spec.runner.kind != campaign::RunnerKind::kSlurm) return;
  const double limit = spec.runner.slurm.time.value_or(spec.trial_time_cap);
  const double minutes = std::ceil(limit / kMinute);
  if (!(limit > 0) || minutes * kMinute == limit) return;
  std::cout << "  warning: the limit of a trial, " << base::ShortNumber(limit) << " s, is "
            << base::ShortNumber(minutes) << " min on Slurm, which counts in whole minutes\n";
}

void ValidateCampaign(const base::JsonFile& file, bool with_experiment) {
  const campaign::CampaignSpec spec = campaign::ReadSpecWithPosteriors(file);
  analysis::CheckGoal(spec, file);
  journal::CampaignRecord record;
  if (with_experiment) record = MeasuredRecord(spec, file);
  std::cout << file.path.string() << ": is in order\n";
  PrintSearched(campaign::SearchedParameters(spec), spec);
  if (!with_experiment) std::cout << "  experiment        not looked at (--without-experiment)\n";
  const std::vector<campaign::ExperimentSpec> experiments = campaign::ExperimentsOf(spec);
  PrintRigs(spec, experiments);
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    PrintExperiment(record.experiments[e], experiments[e], record);
  }
  std::cout << std::flush;
  if (spec.engine.kind == campaign::EngineKind::kTalus) {
    const campaign::CampaignEstimate estimate = campaign::EstimateCampaign(spec);
    std::cout << campaign::EstimateText(spec, estimate);
    for (const std::string& warning : campaign::EstimateWarnings(spec, estimate)) {
      std::cout << "  warning: " << warning << '\n';
    }
  } else {
    PrintEngine(spec.engine.command);
    PrintForeignCost(spec);
  }
  for (const std::string& warning : campaign::EarlierWarnings(spec, record)) {
    std::cout << "  warning: " << warning << '\n';
  }
  WarnOfMinutes(spec);
  if (const auto warning = campaign::CoresWarning(spec, campaign::NumCores())) {
    std::cout << "  warning: " << *warning << '\n';
  }
  for (const std::string& warning : campaign::DeckWarnings(spec)) {
    std::cout << "  warning: " << warning << '\n';
  }
  const double finest = spec.coarse_graining.Finest();
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    for (const double factor : spec.coarse_graining.Levels()) {
      const rigs::Case rig_case = campaign::TypicalCase(spec, static_cast<int>(e), factor);
      for (const std::string& warning :
           factor == finest ? rigs::CaseWarnings(rig_case) : rigs::SetUpWarnings(rig_case)) {
        std::cout << "  warning: " << At(experiments[e].name, factor) << warning << '\n';
      }
      if (factor == finest) PrintShallow(rig_case, At(experiments[e].name, factor));
    }
  }
}

void ValidateHeap(const base::JsonFile& file, bool) {
  const rigs::Case rig_case = rigs::LoadCase(file.path);
  const campaign::RunEstimate run = campaign::EstimateRun(rig_case);
  std::cout << file.path.string() << ": is a case in order\n  rig               "
            << rigs::DeviceText(rig_case.rig) << "\n  simulation        " << campaign::RunText(run)
            << ", about " << base::DurationText(run.core_seconds) << " of a core\n";
  for (const std::string& warning : rigs::CaseWarnings(rig_case)) {
    std::cout << "  warning: " << warning << '\n';
  }
  PrintShallow(rig_case, "");
}

void ValidateScene(const base::JsonFile& file, bool) {
  const engine::LoadedScene loaded = engine::LoadScene(file.path);
  std::cout << file.path.string() << ": is a scene in order\n  spheres           "
            << loaded.scene.particles.size() << "\n  walls             "
            << loaded.scene.walls.size() << '\n';
  for (const std::string& warning : engine::SceneWarnings(loaded.spec, loaded.scene)) {
    std::cout << "  warning: " << warning << '\n';
  }
}

// A table made for wider ranges is read as far as it serves; how far, only this shows.
void PrintCandidates(const optimizer::ParameterSpace& space, const optimizer::Domain& domain) {
  if (space.candidates.empty()) return;
  const auto usable = domain.candidates.rows();
  std::vector<std::string> names;
  for (const int i : space.Free())
    names.push_back(space.parameters.at(static_cast<std::size_t>(i)).name);
  const auto num_rows = std::ssize(optimizer::ReadCandidateTable(space.candidates, names));
  std::cout << "  candidates        " << usable << " of " << base::Counted(num_rows, "row")
            << " of " << space.candidates.string()
            << (usable < num_rows ? "; the others repeat one, or lie outside the ranges, levels or "
                                    "constraints\n"
                                  : "\n");
}

void ValidateProblem(const base::JsonFile& file, bool) {
  const auto problem = base::LoadOptions<trials::OptimizeProblem>(file);
  const optimizer::Domain domain = problem.space.MakeDomain();  // reads the table of candidates
  if (problem.target) trials::TargetImage(*problem.target);
  std::cout << file.path.string() << ": is a problem for `talus optimize` in order\n"
            << "  evaluations       at most " << problem.evaluations << '\n';
  PrintCandidates(problem.space, domain);
}

void ValidateDesign(const base::JsonFile& file, bool) {
  const analysis::DesignSpec design = analysis::LoadDesignSpec(file.path);
  std::cout << file.path.string() << ": is a plan for `talus design` in order\n"
            << analysis::DesignCostText(design);
}

void ValidateCommandCase(const base::JsonFile& file, bool) {
  const trials::CommandCase command_case = trials::LoadCommandCase(file);
  std::cout << file.path.string() << ": is a case of another engine in order\n";
  PrintEngine(command_case.engine);
}

// A problem's parameters are a list, a campaign's an object; its candidates are a table's name.
bool IsProblem(const nlohmann::json& root) {
  if (!root.is_object()) return false;
  return root.contains("evaluations") || root.value("parameters", nlohmann::json()).is_array() ||
         root.value("candidates", nlohmann::json()).is_string();
}

// What a file is: by a key that only it has. The order matters: a campaign has a powder, too,
// and what is to be searched without data is a plan, by whichever engine.
struct ValidatedKind {
  const char* key;
  void (*validate)(const base::JsonFile& file, bool with_experiment);
};
constexpr ValidatedKind kKinds[] = {
    {"candidates", &ValidateDesign},   {"budget", &ValidateCampaign},
    {"experiment", &ValidateCampaign}, {"experiments", &ValidateCampaign},
    {"target", &ValidateProblem},      {"parameters", &ValidateDesign},
    {"engine", &ValidateCommandCase},  {"powder", &ValidateHeap},
    {"materials", &ValidateScene}};

void Validate(const std::string& path, bool with_experiment) {
  const base::JsonFile file = base::ReadJsonFile(path);
  if (file.root.is_object() && file.root.contains("spec_path")) {
    throw base::ConfigError(path +
                            ": is the record of a campaign, which needs no checking; its spec is " +
                            base::TextAt(file.root, "spec_path"));
  }
  if (IsProblem(file.root)) return ValidateProblem(file, with_experiment);
  for (const ValidatedKind& kind : kKinds) {
    if (file.root.is_object() && file.root.contains(kind.key)) {
      return kind.validate(file, with_experiment);
    }
  }
  ValidateCampaign(file, with_experiment);  // says what is missing
}

}  // namespace

void AddValidateCommand(CLI::App& app) {
  struct Arguments {
    std::string path;
    bool without_experiment = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "validate", "Every problem of a spec at once, or what its campaign will cost");
  command
      ->add_option("SPEC", arguments->path,
                   "a campaign, a plan for design, a case or scene for simulate, or a problem for "
                   "optimize")
      ->required();
  command->add_flag("--without-experiment", arguments->without_experiment,
                    "do not look at the photographs, which may not be taken yet");
  command->callback([arguments] { Validate(arguments->path, !arguments->without_experiment); });
}

}  // namespace talus::app
