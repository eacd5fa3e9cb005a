// The posterior of the parameters that are asked for: that of all that are searched, the nuisances
// integrated out.
//
//   p(a) = ∫ p(a, n) dn ≈ 1/J Σ_j p(a, n_j) / q(n_j | a)
//   q    = ½ N(m(a), w² S_n|a) + ½ N(m, w² S_n)
//
// a what is asked for, n the nuisances; m(a) the linear regression of n on a over the posterior's
// draws and S_n|a what it leaves, m and S_n mean and covariance of n; w > 1, so that q has wider
// tails than p. The half that does not depend on a bounds the weights where the regression is
// wrong, as in a bent posterior. The same normal numbers serve at each a: p(a) is smooth. Exact,
// with one node, where nothing is a nuisance.
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
  // The point with the nuisances at the mean that they have given the others.
  Eigen::VectorXd WithTypicalNuisances(const Eigen::VectorXd& point) const;
  // Equally likely draws with their density; `joint` itself where nothing is a nuisance.
  PosteriorSample Sample(const PosteriorSample& joint) const;

  const std::vector<Eigen::Index>& asked() const { return asked_; }

 private:
  // The nodes at a point, whole points; and ln p(a, n_j) - ln q(n_j | a) of each.
  struct Nodes {
    Eigen::MatrixXd points;
    Eigen::VectorXd log_weight;
  };
  Eigen::MatrixXd NodesAt(const Eigen::VectorXd& point) const;
  Eigen::VectorXd LogProposal(const Eigen::VectorXd& point, const Eigen::MatrixXd& nodes) const;
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
  Eigen::VectorXd asked_mean_;
  Eigen::VectorXd mean_;        // m
  Eigen::MatrixXd slope_;       // m(a) = m + slope (a - its mean)
  Eigen::MatrixXd given_root_;  // of w² S_n|a
  Eigen::MatrixXd root_;        // of w² S_n
};

}  // namespace talus::optimizer
