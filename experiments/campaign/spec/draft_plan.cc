#include "experiments/campaign/spec/draft_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/json/json_reader.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/first_design.h"
#include "experiments/rigs/case/case_warnings.h"
#include "experiments/rigs/load_case.h"

namespace talus::campaign {
namespace {

// The heap's shape needs so many grains across the plate; twice as coarse ones find the region.
constexpr double kFineAcross = rigs::kAdvisedAcross;
constexpr double kCoarseAcross = 12.5;

constexpr double kFactorStep = 0.5;  // halves are fine enough

double Rounded(double factor) {
  return std::max(1.0, std::floor(factor / kFactorStep) * kFactorStep);
}

// The spec as far as it can be read, if what it says of each part can be.
std::optional<CampaignSpec> Sketched(const std::string& text) {
  CampaignSpec spec;
  base::Problems problems;
  base::ReadOptions(base::ParseJson(text, "").root, spec, {problems, {}});
  if (problems.empty()) base::TreeValidator(problems).Check(spec);
  return problems.empty() ? std::optional(spec) : std::nullopt;
}

std::vector<rigs::Case> CasesAt(const CampaignSpec& spec, double scale_factor) {
  std::vector<rigs::Case> cases;
  for (int e = 0; e < static_cast<int>(ExperimentsOf(spec).size()); ++e) {
    cases.push_back(TypicalCase(spec, e, scale_factor));
  }
  return cases;
}

// Orifice and outlet as many of the largest grains across as `talus next` makes its own
// (usual_tests.cc), a slot as an orifice; below a spreader's gap so many pass (GapWarning).
bool PassesOpening(const rigs::Case& c) {
  constexpr double kOrificeAcross = 6;
  constexpr double kOutletAcross = 4;
  constexpr double kGapAcross = 1.5;
  const double grain = rigs::LargestDiameter(c);
  switch (c.rig.kind) {
    case rigs::RigKind::kOrificeFlow:
      return c.rig.orifice_flow.orifice >= kOrificeAcross * grain;
    case rigs::RigKind::kDrawDown:
      return c.rig.draw_down.slot >= kOrificeAcross * grain;
    case rigs::RigKind::kFunnelHeap:
      return c.rig.funnel_heap.outlet >= kOutletAcross * grain;
    case rigs::RigKind::kSpreading:
      return rigs::SpreadingGap(c) >= kGapAcross * grain;
    default:
      return true;
  }
}

base::Problems ProblemsOf(const rigs::Case& c) {
  base::Problems problems;
  rigs::ValidateCase(c, problems);
  return problems;
}

// Whether nothing is wrong with a case but that it has too much powder, or grains.
bool IsOnlyTooMuch(const rigs::Case& c) {
  return std::ranges::all_of(ProblemsOf(c).list(), [](const base::Problem& problem) {
    return problem.path == "powder.mass";
  });
}

// The largest factor up to the wanted one at which every test can be simulated, if possible with
// grains that pass its opening: finer ones may be more than this machine can hold.
double LargestFactor(const CampaignSpec& spec, double wanted) {
  for (const bool must_pass : {true, false}) {
    for (double factor = wanted; factor >= 1; factor -= kFactorStep) {
      const bool goes = std::ranges::all_of(CasesAt(spec, factor), [&](const rigs::Case& c) {
        return ProblemsOf(c).empty() && (!must_pass || PassesOpening(c));
      });
      if (goes) return factor;
    }
  }
  // What is wrong is said of the true grains, as nobody has asked for others.
  return std::ranges::all_of(CasesAt(spec, 1), IsOnlyTooMuch) ? wanted : 1;
}

// True grains across the smallest plate of a lifted tube; infinite without any.
double FewestAcross(const std::vector<rigs::Case>& cases) {
  double fewest = std::numeric_limits<double>::infinity();
  for (const rigs::Case& c : cases) {
    if (c.rig.kind != rigs::RigKind::kLiftedTube) continue;
    fewest = std::min(fewest, rigs::GrainsAcrossPlate(c));
  }
  return fewest;
}

// So coarse that the largest filling is of some ten thousand grains, which a core simulates in
// seconds: numbers have no outline that single grains would show in, but for the heap of a lifted
// tube.
double FactorForNumbers(const std::vector<rigs::Case>& cases) {
  constexpr double kGrains = 1e4;
  double grains = 0;
  for (const rigs::Case& c : cases) grains = std::max(grains, rigs::EstimatePowder(c).grains);
  return std::min(std::cbrt(grains / kGrains), FewestAcross(cases) / kCoarseAcross);
}

std::vector<double> WantedFactors(const CampaignSpec& spec) {
  const std::vector<rigs::Case> cases = CasesAt(spec, 1);
  const bool has_images = std::ranges::any_of(
      ExperimentsOf(spec), [](const ExperimentSpec& e) { return e.images.HasImages(); });
  if (!has_images) return {Rounded(FactorForNumbers(cases))};
  const double across = FewestAcross(cases);
  return {Rounded(across / kCoarseAcross), Rounded(across / kFineAcross)};
}

// A search of about as many as its first design, in tens.
int NumSimulations(const CampaignSpec& spec) {
  constexpr int kUsual = 60;
  return std::max(kUsual, (2 * FirstSimulations(spec) + 9) / 10 * 10);
}

}  // namespace

DraftPlan PlanOf(const std::string& text) {
  DraftPlan plan;
  std::optional<CampaignSpec> spec = Sketched(text);
  if (!spec) return plan;
  std::vector<double> factors = WantedFactors(*spec);
  for (double& factor : factors) {
    const double wanted = factor;
    factor = LargestFactor(*spec, wanted);
    plan.is_held = plan.is_held || factor < wanted;
  }
  factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  plan.scale_factors = factors;
  spec->coarse_graining.scale_factors = factors;
  plan.simulations = NumSimulations(*spec);
  return plan;
}

}  // namespace talus::campaign
