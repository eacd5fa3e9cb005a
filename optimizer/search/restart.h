// Where a search without noise goes on once it has converged: polishing a minimum finds no better
// one.
//
// Converged: the latest 2 d evaluations have gained next to nothing on the best one, and 2 d others
// lie within 0.01 of it. The basin of the best evaluation is what nearest-better links
// [preuss2010] lead to it: each evaluation is linked to the nearest better one, and links longer
// than twice the mean are cut. Elsewhere is what lies nearer to the evaluations of other basins.
#pragma once

#include <optional>

#include "optimizer/search/history.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

struct Elsewhere {
  History history;  // the evaluations of other basins
  Domain domain;    // the points nearer to them
};

// As above, or with more patience: the latest `patience` evaluations have gained nothing.
// `num_before` evaluations are from before the first step.
bool HasConverged(const History& history, int num_before, Eigen::Index patience);

// For a deterministic objective; `num_before` evaluations of it from before the first step. Nothing
// while the search gets on, or where too few evaluations lie elsewhere for a step to stand on.
std::optional<Elsewhere> RestartElsewhere(const History& history, const Domain& domain,
                                          int num_before);

}  // namespace talus::optimizer
