#include "optimizer/search/image_knowledge.h"

#include <cmath>

#include "base/parallel_for.h"
#include "base/random.h"
#include "optimizer/outputs/mirrored_normals.h"

namespace talus::optimizer {
namespace {

constexpr int kNumDraws = 512;

// Draws whose squares have mean 1, so that no minimiser's mean moves on average.
Eigen::MatrixXd WithUnitSquares(Eigen::MatrixXd normals) {
  const auto num_draws = static_cast<double>(normals.rows());
  normals.array().rowwise() /= (normals.colwise().squaredNorm() / num_draws).array().sqrt();
  return normals;
}

}  // namespace

ImageKnowledge::ImageKnowledge(const ImageModel& model, const Eigen::MatrixXd& minimisers)
    : means_(model.Means(minimisers)) {
  const Sensitivities sensitivities = model.SensitivitiesAt(minimisers);
  for (Eigen::Index k = 0; k < model.num_modes(); ++k) {
    const surrogate::GaussianProcess& mode = model.outputs().output(k);
    sources_.push_back({mode, mode.Anchor(minimisers), sensitivities.slope.col(k),
                        sensitivities.curvature.col(k)});
  }
  if (model.reconstruction()) {
    sources_.push_back({*model.reconstruction(), model.reconstruction()->Anchor(minimisers),
                        Eigen::VectorXd::Ones(minimisers.rows()),
                        Eigen::VectorXd::Zero(minimisers.rows())});
  }
  const auto num_sources = static_cast<Eigen::Index>(sources_.size());
  const Eigen::MatrixXd normals = WithUnitSquares(
      MirroredNormals(kNumDraws, num_sources, base::Random(1, base::Stream("field knowledge"))));
  draws_.resize(2 * num_sources, kNumDraws);
  draws_.topRows(num_sources) = normals.transpose();
  draws_.bottomRows(num_sources) = (normals.array().square() - 1).matrix().transpose();
}

Eigen::VectorXd ImageKnowledge::Gains(const Eigen::MatrixXd& points) const {
  const auto num_sources = static_cast<Eigen::Index>(sources_.size());
  // What multiplies each row of the draws, for each point a block of one minimiser a row.
  Eigen::MatrixXd steps(means_.size() * points.rows(), 2 * num_sources);
  for (Eigen::Index k = 0; k < num_sources; ++k) {
    const Source& source = sources_[static_cast<std::size_t>(k)];
    const surrogate::Covariances at = source.process.PosteriorCovariances(source.anchors, points);
    const double noise2 = source.process.noise_variance();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::VectorXd moved = at.between.col(i) / std::sqrt(at.variance[i] + noise2);
      const auto block = Eigen::seqN(i * means_.size(), means_.size());
      steps(block, k) = source.slope.cwiseProduct(moved);
      steps(block, num_sources + k) = 0.5 * source.curvature.cwiseProduct(moved.cwiseAbs2());
    }
  }
  const double lowest = means_.minCoeff();
  const double rounding = 1e-12 * means_.cwiseAbs().maxCoeff();
  Eigen::VectorXd gains(points.rows());
  const auto work = static_cast<double>(means_.size() * draws_.size());
  base::ParallelFor({.num_items = points.rows(), .item_work = work}, [&](Eigen::Index i) {
    const auto of_point = steps.middleRows(i * means_.size(), means_.size());
    const Eigen::MatrixXd moved = (of_point * draws_).colwise() + means_;
    // The draws are standardised, so it is 0 or more but for rounding, which must not be a gain.
    const double gain = lowest - moved.colwise().minCoeff().mean();
    gains[i] = gain > rounding ? gain : 0;
  });
  return gains;
}

}  // namespace talus::optimizer
