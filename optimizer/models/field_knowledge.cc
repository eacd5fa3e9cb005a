#include "optimizer/models/field_knowledge.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_for.h"
#include "base/random.h"

namespace talus::optimizer {
namespace {

constexpr int kNumDraws = 64;  // half of them the mirror images of the others

Eigen::MatrixXd MirroredNormals(Eigen::Index num_sources) {
  base::Random random(1, base::Stream("field knowledge"));
  Eigen::MatrixXd normals(kNumDraws, num_sources);
  for (double& z : normals.topRows(kNumDraws / 2).reshaped()) z = random.Normal();
  normals.bottomRows(kNumDraws / 2) = -normals.topRows(kNumDraws / 2);
  return normals;
}

}  // namespace

FieldKnowledge::FieldKnowledge(const FieldModel& model, const Eigen::MatrixXd& minimisers)
    : means_(model.Means(minimisers)) {
  const Eigen::MatrixXd sensitivities = model.Sensitivities(minimisers);
  const std::vector<surrogate::GaussianProcess>& modes = model.modes().processes();
  for (std::size_t k = 0; k < modes.size(); ++k) {
    sources_.push_back(
        {modes[k], modes[k].Anchor(minimisers), sensitivities.col(static_cast<Eigen::Index>(k))});
  }
  if (model.reconstruction()) {
    sources_.push_back({*model.reconstruction(), model.reconstruction()->Anchor(minimisers),
                        Eigen::VectorXd::Ones(minimisers.rows())});
  }
  normals_ = MirroredNormals(static_cast<Eigen::Index>(sources_.size()));
}

Eigen::VectorXd FieldKnowledge::Gains(const Eigen::MatrixXd& points) const {
  const auto num_sources = static_cast<Eigen::Index>(sources_.size());
  // One source a column, for each point a block of one minimiser a row.
  Eigen::MatrixXd steps(means_.size() * points.rows(), num_sources);
  for (Eigen::Index k = 0; k < num_sources; ++k) {
    const Source& source = sources_[static_cast<std::size_t>(k)];
    const surrogate::Covariances at = source.process.PosteriorCovariances(source.anchors, points);
    const double noise2 = source.process.noise_variance();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      steps.col(k).segment(i * means_.size(), means_.size()) =
          source.sensitivity.cwiseProduct(at.between.col(i)) / std::sqrt(at.variance[i] + noise2);
    }
  }
  const double lowest = means_.minCoeff();
  Eigen::VectorXd gains(points.rows());
  const auto work = static_cast<double>(means_.size() * num_sources * kNumDraws);
  base::ParallelFor({.num_items = points.rows(), .item_work = work}, [&](Eigen::Index i) {
    const auto of_point = steps.middleRows(i * means_.size(), means_.size());
    const Eigen::MatrixXd moved = (of_point * normals_.transpose()).colwise() + means_;
    // Mirrored draws make it 0 or more but for rounding.
    gains[i] = std::max(0.0, lowest - moved.colwise().minCoeff().mean());
  });
  return gains;
}

}  // namespace talus::optimizer
