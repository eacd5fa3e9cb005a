// Which strategy, with which options: the one way in for everyone who runs simulations.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "optimizer/outputs/field_objective.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategy/strategy.h"

namespace talus::optimizer {

enum class StrategyKind {
  kAuto,  // a calibration's own; of one objective: images where there are, as long as they predict
          // better, else numbers
  kGp,
  kRbf,
  kLhs,
  kSobol,
  kGrid,
  kDirectL,
  kBobyqa,
  kNelderMead,
};

struct StrategyOptions {
  StrategyKind kind = StrategyKind::kAuto;
  int num_initial = 0;         // of surrogates: size of the initial design, in [0, 100]; 0: theirs
  double stop_multiple = 0.7;  // of surrogates: stop when the gain left is below this × noise sd
  int max_replicates = 5;      // of surrogates: deliberate repeats beside the first, in [0, 1000]
  bool exact = false;          // of surrogates: the same point always gives the same value
  int num_points = 60;         // of lhs and sobol, in [1, 10000]
  std::vector<int> levels = {};  // of grid, one a parameter, each >= 1; empty: 8 each
  int refine_best = 20;          // of grid: this many of the best are refined by half steps, >= 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind, {.doc = "how the next simulations are chosen"});
    visit("num_initial", self.num_initial,
          {.doc = "auto, gp, rbf: size of the initial design; 0 for 4 d + 4, where a nuisance "
                  "adds to d half of how wide its prior is (auto of a campaign), else 2 d + 3, "
                  "d + 3 on an exact table"});
    visit("stop_multiple", self.stop_multiple,
          {.doc = "gp, auto of one objective: stops when less than this times the noise "
                  "standard deviation of one evaluation is left to gain; 0 never"});
    visit("max_replicates", self.max_replicates,
          {.doc = "gp, rbf, auto of one objective: deliberate repeats beside the first one, in "
                  "all; of a list of candidates, how often each may be evaluated"});
    visit("exact", self.exact,
          {.doc = "gp, rbf, auto of one objective: the same parameters always give the same "
                  "value, so that nothing is repeated"});
    visit("num_points", self.num_points, {.doc = "lhs, sobol: size of the design, 1 to 10000"});
    visit("levels", self.levels,
          {.doc = "grid: values of each parameter, in their order; 8 each if not given"});
    visit("refine_best", self.refine_best,
          {.doc = "grid: so many of the best are refined by half steps; 0 for none"});
  }
  void Validate(base::Problems& problems) const;

  // What a person has set and the kind does not read; `in_campaign`: "auto" is a calibration's own.
  void ValidateUse(bool in_campaign, base::Problems& problems) const;

  // What only shows once the space is known; `continuous`: with neither levels nor candidates.
  void ValidateFor(int num_parameters, bool continuous, base::Problems& problems) const;

  // A grid larger than the evaluations that may be made, which go through it in order and would see
  // a corner of the ranges alone.
  void ValidateGrid(int num_parameters, int num_evaluations, base::Problems& problems) const;
};

// `field` is given when evaluations bring images; the strategy copies it. Equal arguments and equal
// observations make equal proposals. Throws base::ConfigError where one of them cannot be.
std::unique_ptr<Strategy> MakeStrategy(const StrategyOptions& options, const Domain& domain,
                                       const FieldObjective* field, std::uint64_t seed);

}  // namespace talus::optimizer

template <>
struct talus::base::Names<talus::optimizer::StrategyKind> {
  using Kind = talus::optimizer::StrategyKind;
  static constexpr std::array kList{
      std::pair{"auto", Kind::kAuto},
      std::pair{"gp", Kind::kGp},
      std::pair{"rbf", Kind::kRbf},
      std::pair{"lhs", Kind::kLhs},
      std::pair{"sobol", Kind::kSobol},
      std::pair{"grid", Kind::kGrid},
      std::pair{"direct_l", Kind::kDirectL},
      std::pair{"bobyqa", Kind::kBobyqa},
      std::pair{"nelder_mead", Kind::kNelderMead},
  };
  static constexpr std::array kRetired{
      std::pair{"surrogate", "is \"auto\" now"},
      std::pair{"field", "is part of \"auto\" now, which takes images where they predict better"},
      std::pair{"crs2", "is no longer there: use \"direct_l\", the global search that needs least"},
      std::pair{"cobyla", "is no longer there: use \"bobyqa\", which needs fewer evaluations"},
      std::pair{"subplex", "is no longer there: use \"nelder_mead\""},
  };
};
