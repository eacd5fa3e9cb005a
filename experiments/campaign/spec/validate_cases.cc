// What shows only when the cases of a spec are put together.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/text/number_text.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/deck_gaps.h"
#include "experiments/rigs/case/case_warnings.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

constexpr double kFewestAcross = 10;  // grains across the plate

// Whether it decides if the powder fits into its vessel, or how far its grains are pressed there.
bool DecidesWhetherItFits(const std::string& parameter) {
  return IsOfBulk(parameter) || parameter == "density" || parameter == "youngs_modulus";
}

// Points of the cube whose cases are checked: the middle, and both ends of what decides whether the
// powder fits into its vessel.
std::vector<Eigen::VectorXd> CheckedPoints(const CampaignSpec& spec) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  const std::vector<int> free = space.Free();
  const Eigen::VectorXd middle =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(free.size()), 0.5);
  std::vector<Eigen::VectorXd> points{middle};
  for (std::size_t k = 0; k < free.size(); ++k) {
    const std::string& name = space.parameters[static_cast<std::size_t>(free[k])].name;
    if (!DecidesWhetherItFits(name)) continue;
    for (const double end : {0.0, 1.0}) {
      points.push_back(middle);
      points.back()[static_cast<Eigen::Index>(k)] = end;
    }
  }
  return points;
}

// The key of a spec that a case's problem is of: the experiment's own, where it has one.
std::string KeyInSpec(const CampaignSpec& spec, std::size_t e, const std::string& path) {
  if (!spec.experiments) return path;
  const ExperimentSpec& own = (*spec.experiments)[e];
  const std::string place = "experiments[" + std::to_string(e) + "].";
  if (own.mass && path == "powder.mass") return place + "mass";
  const std::string section = path.substr(0, path.find_first_of(".["));
  const bool has_own = (section == "rig" && own.rig) || (section == "device" && own.device) ||
                       (section == "filling" && own.filling) || (section == "rules" && own.rules) ||
                       (section == "pairs" && own.pairs);
  return has_own ? place + path : path;
}

// What is the campaign's own is said of the first experiment that it does not go with.
void AddToSpec(const CampaignSpec& spec, std::size_t e, const base::Problem& problem,
               base::Problems& problems) {
  const std::string key = KeyInSpec(spec, e, problem.path);
  const bool is_shared = key == problem.path && spec.experiments;
  if (is_shared && std::ranges::count(problems.list(), key, &base::Problem::path) > 0) return;
  const std::string whose =
      is_shared ? " (in the experiment \"" + (*spec.experiments)[e].name + "\")" : "";
  problems.Add({.path = key, .message = problem.message + whose, .value = problem.value});
}

// Whether the experiment's cases are in order, at every scale factor and point.
bool CheckCases(const CampaignSpec& spec, std::size_t e, base::Problems& problems) {
  for (const double factor : spec.coarse_graining.Levels()) {
    for (const Eigen::VectorXd& point : CheckedPoints(spec)) {
      base::Problems of_case;
      rigs::ValidateCase(CaseAt(spec, point, static_cast<int>(e), factor), of_case);
      if (of_case.empty()) continue;
      for (const base::Problem& problem : of_case.list()) AddToSpec(spec, e, problem, problems);
      return false;  // the same for every scale factor
    }
  }
  return true;
}

// A wall's parameter is without effect where no experiment has such a wall.
void CheckBodies(const CampaignSpec& spec, std::size_t num_experiments, base::Problems& problems) {
  if (spec.engine.kind != EngineKind::kTalus) return;  // a command may build what it likes
  std::set<int> bodies{rigs::kPowder};
  for (std::size_t e = 0; e < num_experiments; ++e) {
    const rigs::Case rig_case =
        TypicalCase(spec, static_cast<int>(e), spec.coarse_graining.Levels().front());
    for (const engine::Wall& wall : rigs::EntryOf(rig_case).walls(rig_case, 0)) {
      bodies.insert(wall.material);
    }
  }
  for (const optimizer::Parameter& parameter : SpaceOf(spec).parameters) {
    const int body = PlaceOf(parameter.name).body;
    problems.Require(bodies.contains(body), "parameters." + parameter.name,
                     "has no effect: no experiment's rig has a " +
                         std::string(rigs::kBodyNames[body]) + "; leave it out");
  }
}

// The answer's sets may be simulated again at a scale factor that no search has.
void CheckConfirmation(const CampaignSpec& spec, int experiment, base::Problems& problems) {
  const double factor = spec.ConfirmScaleFactor();
  const std::vector<double> levels = spec.coarse_graining.Levels();
  if (spec.confirm.candidates == 0 || std::ranges::count(levels, factor) > 0) return;
  base::Problems of_case;
  rigs::ValidateCase(TypicalCase(spec, experiment, factor), of_case);
  if (of_case.empty()) return;
  const base::Problem& first = of_case.list().front();
  problems.Require(false, "confirm.scale_factor", factor,
                   "leaves a case that cannot be simulated: " + first.path + " " + first.message);
}

// Those of the search, and that of the confirmation.
std::set<double> SimulatedFactors(const CampaignSpec& spec) {
  const std::vector<double> levels = spec.coarse_graining.Levels();
  std::set<double> factors(levels.begin(), levels.end());
  if (spec.confirm.candidates > 0) factors.insert(spec.ConfirmScaleFactor());
  return factors;
}

}  // namespace

void ValidateCases(const CampaignSpec& spec, base::Problems& problems) {
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  CheckBodies(spec, experiments.size(), problems);
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    if (!CheckCases(spec, e, problems)) continue;
    CheckConfirmation(spec, static_cast<int>(e), problems);
    for (const double factor : SimulatedFactors(spec)) {
      const rigs::Case rig_case = TypicalCase(spec, static_cast<int>(e), factor);
      if (rig_case.rig.kind != rigs::RigKind::kLiftedTube) continue;
      const double across = rigs::GrainsAcrossPlate(rig_case);
      problems.Require(across >= kFewestAcross, "coarse_graining",
                       "leaves " + base::ShortNumber(across, 3) + " grains across the plate of \"" +
                           experiments[e].name + "\" at scale factor " + base::ShortNumber(factor) +
                           ", must be 10 or more: their heap says nothing of the powder");
    }
  }
  if (problems.empty()) CheckDeckTellsApart(spec, problems);
}

}  // namespace talus::campaign
