// What `talus optimize` is asked: parameters, what to aim at, how to search and for how long.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "optimizer/space/parameter_space.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::trials {

// The image the command's images are compared with: one of the two.
struct OptimizeTarget {
  std::filesystem::path profile;           // a grey image, black = powder
  std::vector<std::vector<double>> field;  // rows from the top, in [0, 1] with 1 = powder

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("profile", self.profile, {.doc = "a grey image, black where there is powder"});
    visit("field", self.field,
          {.doc = "or the image as numbers: rows from the top, in [0, 1] with 1 = powder"});
  }
  void Validate(base::Problems& problems) const;
};

struct OptimizeProblem {
  optimizer::ParameterSpace space;
  std::optional<OptimizeTarget> target;  // without one the command must return values
  optimizer::StrategyOptions strategy;
  int evaluations = 60;     // at most, >= 1
  int workers = 1;          // evaluations at a time, in [1, 8]
  double time_cap = 86400;  // of one evaluation [s], > 0; after it the evaluation has failed
  std::uint64_t seed = 1;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    optimizer::ParameterSpace::Visit(self.space, visit);
    visit("target", self.target, {.doc = "the image to be met, if the command returns images"});
    visit("strategy", self.strategy, {.doc = "how the next evaluations are chosen"});
    visit("evaluations", self.evaluations, {.doc = "at most so many, >= 1"});
    visit("workers", self.workers, {.doc = "evaluations at a time, 1 to 8"});
    visit("time_cap", self.time_cap,
          {.dimension = Dimension::kTime, .doc = "of one evaluation, > 0"});
    visit("seed", self.seed, {.doc = "of everything that is drawn"});
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::trials
