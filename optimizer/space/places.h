// Points as the models take them: one a row.
#pragma once

#include <Eigen/Core>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

// Those of the rows that the domain contains, in their order.
Eigen::MatrixXd Inside(const Domain& domain, const Eigen::MatrixXd& points);

Eigen::MatrixXd Stack(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom);

}  // namespace talus::optimizer
