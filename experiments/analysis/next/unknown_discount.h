// What a test still teaches that hangs on something unknown, and the words that say so.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/analysis/next/ground.h"
#include "experiments/analysis/next/next_table.h"
#include "experiments/analysis/next/unknown_moves.h"

namespace talus::analysis {

// Outputs of the simulations of UnknownTrials, one a row; NaN where one is undefined. The first
// `num_modes` are those of an image.
struct UnknownRows {
  Eigen::MatrixXd base;
  std::vector<Eigen::MatrixXd> moved;  // of each UnknownTrials::moved
  Eigen::VectorXd noise;  // variance of one simulation by the model, of each output; the rows' own
                          // scatter counts where it is larger
  Eigen::Index num_modes = 0;
};

// Lists in `candidate` what moves it, the most first, and learns anew with errors C' in place of C
// (unknown_shift.h). Nothing changes where no move is beyond chance.
void Discount(const Ground& ground, const UnknownTrials& unknown, const UnknownRows& rows,
              NextCandidate& candidate);

}  // namespace talus::analysis
