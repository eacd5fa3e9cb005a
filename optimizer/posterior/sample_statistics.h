// A sample's order, and how parameters hang together in it.
#pragma once

#include <Eigen/Core>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

// Each column by itself in ascending order.
Eigen::MatrixXd SortedColumns(Eigen::MatrixXd sample);

// Spearman's rank correlation between the columns of `sample`, one draw a row and no column
// constant: a valley that is bent is as tight as a straight one.
Eigen::MatrixXd RankCorrelation(const Eigen::MatrixXd& sample);

// The share of the standard deviation of column `other` that a regression on column `known`, linear
// and quadratic, explains: 1 - √(1 - R²), in [0, 1]. `draws`: equally likely, one a row, ten at
// least. A correlation of 0.6 makes 0.2.
double Narrowing(const Eigen::MatrixXd& draws, Eigen::Index known, Eigen::Index other);

// How many parameters the data move: the degrees of freedom of a fit.
//
//   Σ 1 over what is asked for + Σ (1 - s²/σ²) over the nuisances
//
// s the standard deviation of the posterior and σ that of the prior: a nuisance that its prior
// decides is hardly one. `draws` of the posterior: equally likely, one a row.
double MovedParameters(const Domain& domain, const Eigen::MatrixXd& draws);

}  // namespace talus::optimizer
