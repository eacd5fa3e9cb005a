// How far each evaluation of several experiments is off, before there is a model to tell.
#pragma once

#include <span>
#include <vector>

#include "optimizer/observation.h"
#include "optimizer/outputs/experiment_target.h"

namespace talus::optimizer {

// How far the numbers of an evaluation are off: 1 + their mean squared misfit, in their errors, or
// in their own unit where these are 0; infinite where a number does not exist.
double MissOfNumbers(const Observation& one, const std::vector<ScalarTarget>& measured);

// The evaluations with the miss of their point in place of the objective, the mean over the
// experiments by their weights: of numbers as above, of an image the square of its objective over
// the least one of its experiment. Behind all others stand points that an experiment has not been
// evaluated at, and behind these those that it gives nothing at, because it fails there or a number
// does not exist.
std::vector<Observation> WithMisses(std::span<const Observation> told,
                                    std::span<const ExperimentTarget> targets);

}  // namespace talus::optimizer
