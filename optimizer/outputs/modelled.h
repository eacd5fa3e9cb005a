// Which evaluations a model of outputs stands on, when there are more than it can take.
#pragma once

#include <span>

#include "optimizer/outputs/output_model.h"

namespace talus::optimizer {

// A Gaussian process costs the cube of its evaluations: beyond these an answer takes minutes.
constexpr int kMostEvaluations = 400;

// The first `count` of `data`, or kMostEvaluations of these: one half are those that tell the
// answer most, of the finest scale factor and then of the lowest objective, and the other half are
// spread evenly over the rest, in their order. `values` are the objectives, one an evaluation.
OutputData Modelled(const OutputData& data, std::span<const double> values, int count);

}  // namespace talus::optimizer
