// How far each evaluation of several experiments is off, before there is a model to tell.
#pragma once

#include <span>
#include <vector>

#include "optimizer/observation.h"
#include "optimizer/outputs/experiment_target.h"

namespace talus::optimizer {

// The evaluations that did not fail, with their miss in place of the objective: 1 + the mean of the
// numbers' squared misfits, in their errors; of an image the square of its objective over the least
// one of its experiment. Evaluations of several experiments at one point share their mean.
std::vector<Observation> WithMisses(std::span<const Observation> told,
                                    std::span<const ExperimentTarget> targets);

}  // namespace talus::optimizer
