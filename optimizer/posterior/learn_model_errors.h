// How large the error of each experiment is that no parameter set can explain, learnt from what is
// left at the sets that fit best.
//
//   p(m | data) ∝ exp(-½ (m/σ)²) ∫ p(data | x, m) p(x) dx,   m >= 0
//
// m model error in standard deviations of one heap from run to run, σ the scale of its half-normal
// prior. The posterior then counts with √E[m² | data]: σ itself where the measurements cannot tell,
// as with one number that some set always meets. One experiment after the other, the others at what
// is known of theirs.
#pragma once

#include <cstdint>

#include "optimizer/posterior/posterior.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// Sets the model error of every experiment of `posterior` that counts. `scale`: σ > 0.
void LearnModelErrors(const Domain& domain, double scale, std::uint64_t seed, Posterior& posterior);

}  // namespace talus::optimizer
