#include "optimizer/space/draws_density.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/normal.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

constexpr double kRound = 0.1;     // share of the draws that a kernel is shaped by
constexpr double kNarrowed = 0.5;  // … and its variance over theirs; its centre has the rest
constexpr double kBroad = 0.05;    // weight of the broad Gaussian
constexpr double kBroader = 4;     // … and its variance over that of the draws
constexpr double kLeast = 1e-8;    // variance in the unit cube: draws that coincide have some
constexpr double kReach = 2.5;     // of a kernel, in its standard deviations

Eigen::MatrixXd CovarianceOf(const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd centred = rows.rowwise() - rows.colwise().mean();
  return centred.transpose() * centred / static_cast<double>(rows.rows() - 1);
}

// What the mass of every kernel is told by, one draw a column.
Eigen::MatrixXd Normals(Eigen::Index dimension) {
  constexpr Eigen::Index kDraws = 400;  // an error of 2 % where half is inside
  base::Random random(0, base::Stream("mass of a kernel"));
  Eigen::MatrixXd normals(dimension, kDraws);
  for (double& one : normals.reshaped()) one = random.Normal();
  return normals;
}

// Coordinates outside [0, 1].
Eigen::Index NumBeyond(const Eigen::VectorXd& point) {
  return (point.array() < 0 || point.array() > 1).count();
}

// Back into [0, 1], as if both ends were mirrors.
double Folded(double u) {
  const double twice = std::abs(std::remainder(u, 2.0));
  return std::min(twice, 1.0);
}

}  // namespace

DrawsDensity::DrawsDensity(Eigen::MatrixXd draws)
    : num_draws_(draws.rows()), mean_(draws.colwise().mean()) {
  const Eigen::MatrixXd covariance = CovarianceOf(draws);
  sd_ = (covariance.diagonal().array() + kLeast).sqrt().matrix().transpose();
  centres_ = std::move(draws);
  const auto count = static_cast<double>(centres_.rows());
  Eigen::MatrixXd moved = centres_;
  for (Eigen::Index i = 0; i < centres_.rows(); ++i) {
    const Eigen::MatrixXd round = DrawsRound(i);
    const Eigen::RowVectorXd middle = round.colwise().mean();
    kernels_.push_back(MakeKernel(kNarrowed * CovarianceOf(round), (1 - kBroad) / count));
    if (ReachesAFace(i)) continue;
    moved.row(i) = middle + std::sqrt(1 - kNarrowed) * (centres_.row(i) - middle);
  }
  centres_ = std::move(moved);
  kernels_.push_back(MakeKernel(kBroader * covariance, kBroad));
  centres_ = Stack(centres_, mean_);
  const Eigen::MatrixXd normals = Normals(centres_.cols());
  std::vector<Eigen::RowVectorXd> images;
  for (Eigen::Index i = 0; i <= num_draws_; ++i) Mirror(i, normals, images);
  Eigen::Index row = centres_.rows();
  centres_.conservativeResize(std::ssize(kernels_), Eigen::NoChange);
  for (const Eigen::RowVectorXd& image : images) centres_.row(row++) = image;
}

double DrawsDensity::MassInside(Eigen::Index draw, const Eigen::MatrixXd& normals) const {
  const Eigen::MatrixXd points =
      (kernels_[static_cast<std::size_t>(draw)].root * normals).colwise() +
      centres_.row(draw).transpose();
  Eigen::Index num_inside = 0;
  for (const auto& point : points.colwise()) num_inside += NumBeyond(point) <= 1 ? 1 : 0;
  return static_cast<double>(std::max<Eigen::Index>(1, num_inside)) /
         static_cast<double>(points.cols());
}

Eigen::ArrayXd DrawsDensity::Reach(Eigen::Index draw) const {
  return kReach * kernels_[static_cast<std::size_t>(draw)].root.rowwise().norm().array();
}

bool DrawsDensity::ReachesAFace(Eigen::Index draw) const {
  const Eigen::ArrayXd reach = Reach(draw), low = centres_.row(draw).transpose();
  return !(low > reach && 1 - low > reach).all();
}

// Adds the images of a kernel at the faces that it reaches, and their centres to `images`.
void DrawsDensity::Mirror(Eigen::Index draw, const Eigen::MatrixXd& normals,
                          std::vector<Eigen::RowVectorXd>& images) {
  Kernel kernel = kernels_[static_cast<std::size_t>(draw)];
  const Eigen::RowVectorXd centre = centres_.row(draw);
  const Eigen::ArrayXd reach = Reach(draw);
  if (!ReachesAFace(draw)) return;
  kernel.log_constant -= std::log(MassInside(draw, normals));
  kernels_[static_cast<std::size_t>(draw)].log_constant = kernel.log_constant;
  for (Eigen::Index k = 0; k < centre.size(); ++k) {
    for (const double face : {0.0, 1.0}) {
      if (std::abs(face - centre[k]) > reach[k]) continue;
      Kernel image = kernel;
      image.inverse_root.col(k) *= -1;
      kernels_.push_back(std::move(image));
      images.push_back(centre);
      images.back()[k] = 2 * face - centre[k];
    }
  }
}

DrawsDensity::Kernel DrawsDensity::MakeKernel(const Eigen::MatrixXd& covariance, double weight) {
  const Eigen::Index d = covariance.rows();
  const Eigen::MatrixXd root =
      (covariance + kLeast * Eigen::MatrixXd::Identity(d, d)).llt().matrixL();
  return {
      .root = root,
      .inverse_root = root.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(d, d)),
      .log_constant = std::log(weight) - root.diagonal().array().log().sum() -
                      base::kLogRootTwoPi * static_cast<double>(d)};
}

Eigen::MatrixXd DrawsDensity::DrawsRound(Eigen::Index draw) const {
  const Eigen::VectorXd distance =
      ((centres_.rowwise() - centres_.row(draw)).array().rowwise() / sd_.array())
          .square()
          .rowwise()
          .sum();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(centres_.rows()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto count = std::max(static_cast<std::ptrdiff_t>(2 * centres_.cols() + 2),
                              std::lround(kRound * static_cast<double>(centres_.rows())));
  std::nth_element(order.begin(), order.begin() + count, order.end(),
                   [&](Eigen::Index a, Eigen::Index b) {
                     return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
                   });
  order.resize(static_cast<std::size_t>(count));
  return centres_(order, Eigen::all);
}

Eigen::VectorXd DrawsDensity::LogDensity(const Eigen::MatrixXd& points) const {
  constexpr Eigen::Index kBlock = 256;  // points at a time: all of them times all kernels are many
  Eigen::VectorXd density(points.rows());
  for (Eigen::Index from = 0; from < points.rows(); from += kBlock) {
    const Eigen::Index size = std::min(kBlock, points.rows() - from);
    const Eigen::MatrixXd block = points.middleRows(from, size).transpose();
    Eigen::ArrayXXd logs(size, centres_.rows());
    for (Eigen::Index k = 0; k < centres_.rows(); ++k) {
      const Kernel& kernel = kernels_[static_cast<std::size_t>(k)];
      const Eigen::MatrixXd white =
          kernel.inverse_root * (block.colwise() - centres_.row(k).transpose());
      logs.col(k) = kernel.log_constant - 0.5 * white.colwise().squaredNorm().transpose().array();
    }
    const Eigen::ArrayXd most = logs.rowwise().maxCoeff();
    density.segment(from, size) = most + (logs.colwise() - most).exp().rowwise().sum().log();
  }
  return density;
}

Eigen::VectorXd DrawsDensity::Draw(base::Random& random) const {
  const bool broad = random.Uniform() < kBroad;
  const double at = random.Uniform() * static_cast<double>(num_draws_);
  const Eigen::Index k =
      broad ? num_draws_ : std::min(static_cast<Eigen::Index>(at), num_draws_ - 1);
  Eigen::VectorXd z(centres_.cols()), point;
  do {
    for (double& one : z) one = random.Normal();
    point = centres_.row(k).transpose() + kernels_[static_cast<std::size_t>(k)].root * z;
  } while (NumBeyond(point) > 1);
  return point.unaryExpr(&Folded);
}

}  // namespace talus::optimizer
