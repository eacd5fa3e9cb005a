// The posterior of the parameters that are asked for: that of all that are searched, the nuisances
// integrated out.
//
//   p(a) = ∫ p(a, n) dn ≈ 1/J Σ_j p(a, n_j) / q(n_j | a)
//   q    = ½ N(m(a), w² S(a)) + ½ N(m, w² S_n)
//
// a what is asked for, n the nuisances; m(a) the linear regression of n on a over the posterior's
// draws, and what a second one over the draws near a adds to it; S(a) what both leave. Without the
// second, S is as wide as a whole bend, and the nodes miss the posterior across it. m and S_n are
// mean and covariance of n; w > 1, so that q has wider tails than p. The half that does not depend
// on a bounds the weights where the regressions are wrong. The same normal numbers serve at each a:
// p(a) is smooth. Exact, with one node, where nothing is a nuisance.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "optimizer/posterior/posterior_sample.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

class AskedDensity {
 public:
  // `joint`: a sample of the density over all that is searched.
  AskedDensity(LogDensityFunction density, const Domain& domain, const PosteriorSample& joint,
               std::uint64_t seed);

  // ln p(a), one point a row: whole points, of which the nuisances' coordinates do not count.
  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points) const;
  // The point with the nuisances at the mean that they have given the others; where that is far
  // from likely, as between two solutions, at the likeliest node.
  Eigen::VectorXd WithTypicalNuisances(const Eigen::VectorXd& point) const;
  // Equally likely draws with their density; `joint` itself where nothing is a nuisance.
  PosteriorSample Sample(const PosteriorSample& joint) const;

  const std::vector<Eigen::Index>& asked() const { return asked_; }

 private:
  // The nodes at a point, whole points; ln p(a, n_j) of each, and that less ln q(n_j | a).
  struct Nodes {
    Eigen::MatrixXd points;
    Eigen::VectorXd log_density;
    Eigen::VectorXd log_weight;
  };
  // N(mean, root rootᵀ) of the nuisances.
  struct Normal {
    Eigen::VectorXd mean;
    Eigen::MatrixXd root;
  };
  Normal Near(const Eigen::VectorXd& point) const;  // N(m(a), w² S(a))
  Eigen::MatrixXd NodesAt(const Eigen::VectorXd& point, const Normal& near) const;
  Eigen::VectorXd LogProposal(const Normal& near, const Eigen::MatrixXd& nodes) const;
  Nodes Weighted(const Eigen::MatrixXd& points) const;  // of each point in turn
  // The joint density; none, -infinity, outside the domain.
  Eigen::VectorXd DensityInside(const Eigen::MatrixXd& points) const;
  // The share of what is searched of the parameters asked for.
  double RegionVolume(const PosteriorSample& sample) const;

  LogDensityFunction density_;
  Domain domain_;
  std::uint64_t seed_;
  std::vector<Eigen::Index> asked_;
  Eigen::MatrixXd normals_;  // of the nodes, one a row
  Normal all_;               // N(m, w² S_n)
  Eigen::VectorXd asked_mean_;
  Eigen::MatrixXd slope_;           // of the regression on all draws, one row a parameter asked for
  Eigen::MatrixXd asked_of_draws_;  // a of the posterior's draws, one a row
  Eigen::MatrixXd left_of_draws_;   // what the regression leaves of their n
  Eigen::ArrayXd width_;            // of the second one's weights, in a
  Eigen::MatrixXd rest_;            // S_n less what the regression explains
};

}  // namespace talus::optimizer
