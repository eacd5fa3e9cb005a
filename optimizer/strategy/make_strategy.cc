#include "optimizer/strategy/make_strategy.h"

#include <numeric>
#include <string>

#include "base/error.h"
#include "base/text/number_text.h"
#include "optimizer/designs/points_within.h"
#include "optimizer/strategy/design_strategy.h"
#include "optimizer/strategy/image_strategy.h"
#include "optimizer/strategy/ranked_strategy.h"
#include "optimizer/strategy/rbf_strategy.h"
#include "optimizer/strategy/replayed_search.h"
#include "optimizer/strategy/scalar_strategy.h"

namespace talus::optimizer {
namespace {

constexpr int kMaxDesign = 10000;
constexpr int kUsualLevels = 8;

std::vector<int> LevelsFor(const StrategyOptions& options, int num_parameters) {
  if (!options.levels.empty()) return options.levels;
  return std::vector<int>(static_cast<std::size_t>(num_parameters), kUsualLevels);
}

double GridSize(const StrategyOptions& options, int num_parameters) {
  const std::vector<int> all = LevelsFor(options, num_parameters);
  return std::accumulate(all.begin(), all.end(), 1.0, std::multiplies<>());
}

bool HasModel(StrategyKind kind) {
  using enum StrategyKind;
  return kind == kAuto || kind == kGp || kind == kRbf;
}

bool TakesLists(StrategyKind kind) {
  return HasModel(kind) || kind == StrategyKind::kLhs || kind == StrategyKind::kSobol;
}

std::unique_ptr<Strategy> MakeModelStrategy(const StrategyOptions& options, const Domain& domain,
                                            const FieldObjective* field, std::uint64_t seed) {
  const SurrogateOptions surrogate{.num_initial = options.num_initial,
                                   .stop_multiple = options.stop_multiple,
                                   .max_replicates = options.max_replicates,
                                   .exact = options.exact,
                                   .seed = seed};
  if (options.kind == StrategyKind::kRbf) return std::make_unique<RbfStrategy>(domain, surrogate);
  if (options.kind == StrategyKind::kGp || field == nullptr) {
    return std::make_unique<ScalarStrategy>(domain, surrogate);
  }
  return std::make_unique<ImageStrategy>(domain, *field, surrogate);
}

ReplayOptions SearchOf(StrategyKind kind) {
  using surrogate::SearchAlgorithm;
  switch (kind) {
    case StrategyKind::kDirectL:
      return {.algorithm = SearchAlgorithm::kDirectL, .name = "DIRECT-L"};
    case StrategyKind::kBobyqa:
      return {.algorithm = SearchAlgorithm::kBobyqa, .name = "multi-start BOBYQA", .local = true};
    case StrategyKind::kNelderMead:
      return {.algorithm = SearchAlgorithm::kNelderMead,
              .name = "multi-start Nelder-Mead",
              .local = true};
    default:
      throw base::Error("this kind of strategy is no search");
  }
}

}  // namespace

void StrategyOptions::Validate(base::Problems& problems) const {
  problems.RequireFromTo("num_points", num_points, 1, kMaxDesign);
  problems.RequireFromTo("num_initial", num_initial, 0, 100);
  problems.Require(stop_multiple >= 0, "stop_multiple", stop_multiple, "must not be negative");
  problems.RequireFromTo("max_replicates", max_replicates, 0, 1000);
  problems.Require(refine_best >= 0, "refine_best", refine_best, "must not be negative");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    problems.Require(levels[i] >= 1 && levels[i] <= kMaxDesign, "levels[" + std::to_string(i) + "]",
                     levels[i], "must be from 1 to 10000");
  }
}

void StrategyOptions::ValidateUse(bool in_campaign, base::Problems& problems) const {
  using enum StrategyKind;
  const StrategyOptions usual;
  const bool models_one_objective = HasModel(kind) && !(in_campaign && kind == kAuto);
  const std::string models = in_campaign ? "\"gp\" and \"rbf\"" : "\"auto\", \"gp\" and \"rbf\"";
  const auto require = [&](bool is_read, bool is_usual, std::string_view key,
                           const std::string& readers) {
    problems.Require(is_read || is_usual, key,
                     "is not read by the strategy \"" + std::string(base::NameOf(kind)) +
                         "\" but by " + readers + ": leave it out");
  };
  require(HasModel(kind), num_initial == usual.num_initial, "num_initial",
          "\"auto\", \"gp\" and \"rbf\"");
  require(models_one_objective && kind != kRbf, stop_multiple == usual.stop_multiple,
          "stop_multiple",
          in_campaign ? "\"gp\", and posterior.stop_share ends \"auto\"" : "\"auto\" and \"gp\"");
  require(models_one_objective, max_replicates == usual.max_replicates, "max_replicates", models);
  require(models_one_objective, exact == usual.exact, "exact", models);
  require(kind == kLhs || kind == kSobol, num_points == usual.num_points, "num_points",
          "\"lhs\" and \"sobol\"");
  require(kind == kGrid, levels.empty(), "levels", "\"grid\"");
  require(kind == kGrid, refine_best == usual.refine_best, "refine_best", "\"grid\"");
}

void StrategyOptions::ValidateFor(int num_parameters, bool continuous,
                                  base::Problems& problems) const {
  problems.Require(continuous || TakesLists(kind), "kind",
                   "is a search over continuous parameters: with levels or candidates use "
                   "\"auto\", \"gp\", \"rbf\", \"lhs\" or \"sobol\"");
  if (kind != StrategyKind::kGrid) return;
  problems.Require(levels.empty() || static_cast<int>(levels.size()) == num_parameters, "levels",
                   "has " + std::to_string(levels.size()) + " numbers for " +
                       std::to_string(num_parameters) + " parameters: give one for each");
  problems.Require(GridSize(*this, num_parameters) <= kMaxDesign, "levels",
                   GridSize(*this, num_parameters),
                   "points of the grid, must be at most 10000: give fewer levels");
}

void StrategyOptions::ValidateGrid(int num_parameters, int num_evaluations,
                                   base::Problems& problems) const {
  if (kind != StrategyKind::kGrid) return;
  const double size = GridSize(*this, num_parameters);
  problems.Require(size <= num_evaluations, "levels",
                   "make a grid of " + base::ShortNumber(size) + " points for " +
                       std::to_string(num_evaluations) +
                       " evaluations, which would all be in a corner of it: give fewer levels, or "
                       "pay for more");
}

std::unique_ptr<Strategy> MakeStrategy(const StrategyOptions& options, const Domain& domain,
                                       const FieldObjective* field, std::uint64_t seed) {
  base::Problems problems;
  problems.Within("domain", [&] { domain.Validate(problems); });
  if (field != nullptr) problems.Within("field", [&] { field->Validate(problems); });
  problems.ThrowIfAny();  // the options are judged by the domain
  options.Validate(problems);
  options.ValidateFor(domain.num_parameters, domain.IsContinuous(), problems);
  problems.ThrowIfAny();
  switch (options.kind) {
    case StrategyKind::kAuto:
    case StrategyKind::kGp:
    case StrategyKind::kRbf: {
      const auto make = [&](const Domain& space) {
        return MakeModelStrategy(options, space, field, seed);
      };
      if (domain.IsList()) return std::make_unique<RankedStrategy>(domain, make);
      return make(domain);
    }
    case StrategyKind::kLhs:
      return std::make_unique<DesignStrategy>(
          domain,
          PointsWithin(domain, LatinHypercube(options.num_points, domain.num_parameters, seed),
                       seed),
          "the Latin hypercube");
    case StrategyKind::kSobol:
      return std::make_unique<DesignStrategy>(domain, SobolInside(domain, options.num_points, seed),
                                              "the Sobol sequence");
    case StrategyKind::kGrid: {
      const std::vector<int> levels = LevelsFor(options, domain.num_parameters);
      problems.Require(
          std::ranges::any_of(FullFactorial(levels),
                              [&](const auto& point) { return domain.Contains(point); }),
          "levels",
          "make a grid of which no point meets the constraints: give more levels, or "
          "take another kind of strategy");
      problems.ThrowIfAny();
      return std::make_unique<GridStrategy>(
          domain, GridStrategy::Sweep{.levels = levels, .refine_best = options.refine_best});
    }
    default:
      return std::make_unique<ReplayedSearch>(domain, SearchOf(options.kind), seed);
  }
}

}  // namespace talus::optimizer
