#include "optimizer/posterior/measured_response.h"

#include <vector>

namespace talus::optimizer {

Eigen::MatrixXd ResponseToMeasured(const Posterior& posterior, const Eigen::MatrixXd& draws) {
  const Eigen::MatrixXd centred = draws.rowwise() - draws.colwise().mean();
  Eigen::Index num_outputs = 0;
  for (const ExperimentModel& model : posterior.models()) num_outputs += model.num_outputs();
  Eigen::MatrixXd response(draws.cols(), num_outputs);
  Eigen::Index column = 0;
  Posterior moved = posterior;
  // Prior and success do not depend on what was measured, nor do the outputs.
  const std::vector<OutputMoments> outputs = posterior.Outputs(draws);
  for (std::size_t e = 0; e < posterior.models().size(); ++e) {
    ExperimentModel& model = moved.models()[e];
    const Eigen::VectorXd sd = model.Predict(draws.topRows(1)).single.cwiseSqrt();
    for (Eigen::Index k = 0; k < model.num_outputs(); ++k, ++column) {
      const Eigen::VectorXd half = 0.5 * sd[k] * Eigen::VectorXd::Unit(model.num_outputs(), k);
      model.MoveMeasured(half);
      Eigen::VectorXd slope = moved.LogDensity(outputs);
      model.MoveMeasured(-2 * half);
      slope -= moved.LogDensity(outputs);
      model.MoveMeasured(half);
      response.col(column) =
          centred.transpose() * slope / (sd[k] * static_cast<double>(draws.rows()));
    }
  }
  return response;
}

}  // namespace talus::optimizer
