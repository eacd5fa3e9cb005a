// The design that a posterior starts from: a Latin hypercube over what is searched, smaller where
// nuisances are part of it and none of it where their prior has no mass.
#pragma once

#include <cstdint>

#include "optimizer/designs/design.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// 4 d + 4 evaluations of d parameters. A nuisance counts half, since its effect need be known
// roughly only, and less by as much as its prior is narrower than uniform.
int PosteriorDesignSize(const Domain& domain);

// `num_initial` where it states one, else that size.
int PosteriorDesignSize(const Domain& domain, int num_initial);

// Sets at each finer scale factor that the search takes after it, before gain alone decides.
inline constexpr int kFewestFinerSets = 3;

// The domain's guesses, then the hypercube's points that lie in the domain, and Sobol's where
// constraints leave too few of these.
Points PosteriorDesign(const Domain& domain, int size, std::uint64_t seed);

}  // namespace talus::optimizer
