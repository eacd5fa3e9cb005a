#include "optimizer/posterior/asked_density.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/normal.h"
#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/outputs/mirrored_normals.h"

namespace talus::optimizer {
namespace {

constexpr Eigen::Index kNodes = 48;   // half of them round the regression; a multiple of 4
constexpr double kWider = 1.3;        // w
constexpr int kDraws = 1000;          // of a sample of what is asked for
constexpr int kEven = 500;            // points that tell a region's volume to some 3 % of it
constexpr Eigen::Index kBlock = 200;  // points whose nodes are evaluated at a time
constexpr double kLeast = 1e-8;  // variance: coordinates that are tied or hardly move have some
constexpr double kWidth = 0.25;  // of the second regression's weights / spread of the draws
constexpr double kGlobal = 5;    // draws near a that the first one counts as

Eigen::MatrixXd RootOf(const Eigen::MatrixXd& covariance) {
  const Eigen::Index d = covariance.rows();
  return (kWider * kWider * covariance + kLeast * Eigen::MatrixXd::Identity(d, d)).llt().matrixL();
}

// ln N(x | 0, L Lᵀ), one x a column.
Eigen::ArrayXd LogGaussian(const Eigen::MatrixXd& root, const Eigen::MatrixXd& x) {
  const Eigen::MatrixXd white = root.triangularView<Eigen::Lower>().solve(x);
  return -0.5 * white.colwise().squaredNorm().transpose().array() -
         root.diagonal().array().log().sum() -
         base::kLogRootTwoPi * static_cast<double>(root.rows());
}

}  // namespace

AskedDensity::AskedDensity(LogDensityFunction density, const Domain& domain,
                           const PosteriorSample& joint, std::uint64_t seed)
    : density_(std::move(density)), domain_(domain), seed_(seed), asked_(domain.Asked()) {
  const auto num_nuisances = static_cast<Eigen::Index>(domain_.nuisances.size());
  normals_ = num_nuisances == 0
                 ? Eigen::MatrixXd(1, 0)
                 : MirroredNormals(kNodes / 2, num_nuisances, {seed, base::Stream("nuisances")});
  if (num_nuisances == 0) return;
  const Eigen::RowVectorXd mean = joint.weight.transpose() * joint.points;
  const Eigen::MatrixXd centred = joint.points.rowwise() - mean;
  const Eigen::MatrixXd covariance = centred.transpose() * joint.weight.asDiagonal() * centred;
  const auto& n = domain_.nuisances;
  all_ = {.mean = mean.transpose()(n), .root = RootOf(covariance(n, n))};
  asked_mean_ = mean.transpose()(asked_);
  const auto num_asked = static_cast<Eigen::Index>(asked_.size());
  const Eigen::MatrixXd of_asked = Eigen::MatrixXd(covariance(asked_, asked_)) +
                                   kLeast * Eigen::MatrixXd::Identity(num_asked, num_asked);
  slope_ = of_asked.ldlt().solve(Eigen::MatrixXd(covariance(asked_, n)));
  rest_ = covariance(n, n) - slope_.transpose() * covariance(asked_, n);
  width_ = kWidth * of_asked.diagonal().array().sqrt();
  const Eigen::MatrixXd draws = joint.Draws(kDraws, seed);
  asked_of_draws_ = draws(Eigen::all, asked_);
  left_of_draws_ = (draws(Eigen::all, n).rowwise() - all_.mean.transpose()) -
                   (asked_of_draws_.rowwise() - asked_mean_.transpose()) * slope_;
}

AskedDensity::Normal AskedDensity::Near(const Eigen::VectorXd& point) const {
  if (domain_.nuisances.empty()) return {};
  constexpr double kFar = 1e-12;  // weight of draws far away: where none is near all count alike
  const Eigen::RowVectorXd a = point(asked_).transpose();
  const Eigen::ArrayXXd away =
      (asked_of_draws_.rowwise() - a).array().rowwise() / width_.transpose();
  Eigen::VectorXd weight = (-0.5 * away.square().rowwise().sum()).exp() + kFar;
  weight /= weight.sum();
  const double num_near = 1 / weight.squaredNorm();
  const Eigen::RowVectorXd asked_mean = weight.transpose() * asked_of_draws_;
  const Eigen::RowVectorXd mean = weight.transpose() * left_of_draws_;
  const Eigen::MatrixXd asked = asked_of_draws_.rowwise() - asked_mean;
  const Eigen::MatrixXd left = left_of_draws_.rowwise() - mean;
  const Eigen::MatrixXd weighted = asked.transpose() * weight.asDiagonal();
  Eigen::MatrixXd of_asked = weighted * asked;
  of_asked.diagonal() += (kGlobal / num_near * width_.square()).matrix();  // few show no slope
  const Eigen::MatrixXd slope = of_asked.ldlt().solve(weighted * left);
  const Eigen::MatrixXd rest = left - asked * slope;
  const Eigen::MatrixXd covariance = rest.transpose() * weight.asDiagonal() * rest;
  return {
      .mean =
          all_.mean +
          ((a - asked_mean_.transpose()) * slope_ + mean + (a - asked_mean) * slope).transpose(),
      .root = RootOf((num_near * covariance + kGlobal * rest_) / (num_near + kGlobal))};
}

Eigen::MatrixXd AskedDensity::NodesAt(const Eigen::VectorXd& point, const Normal& near) const {
  if (domain_.nuisances.empty()) return point.transpose();
  Eigen::MatrixXd nodes = point.transpose().replicate(2 * normals_.rows(), 1);
  Eigen::Index row = 0;
  for (const Normal* normal : {&near, &all_}) {
    const Eigen::MatrixXd half =
        (normals_ * normal->root.transpose()).rowwise() + normal->mean.transpose();
    nodes(Eigen::seqN(row, half.rows()), domain_.nuisances) = half;
    row += half.rows();
  }
  return nodes;
}

Eigen::VectorXd AskedDensity::LogProposal(const Normal& near, const Eigen::MatrixXd& nodes) const {
  if (domain_.nuisances.empty()) return Eigen::VectorXd::Zero(1);
  const Eigen::MatrixXd n = Eigen::MatrixXd(nodes(Eigen::all, domain_.nuisances)).transpose();
  const Eigen::ArrayXd of_near = LogGaussian(near.root, n.colwise() - near.mean);
  const Eigen::ArrayXd of_all = LogGaussian(all_.root, n.colwise() - all_.mean);
  const Eigen::ArrayXd most = of_near.max(of_all);
  return most + (0.5 * (of_near - most).exp() + 0.5 * (of_all - most).exp()).log();
}

AskedDensity::Nodes AskedDensity::Weighted(const Eigen::MatrixXd& points) const {
  const Eigen::Index each = domain_.nuisances.empty() ? 1 : 2 * normals_.rows();
  Nodes nodes{.points = Eigen::MatrixXd(points.rows() * each, points.cols()),
              .log_density = {},
              .log_weight = Eigen::VectorXd(points.rows() * each)};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::VectorXd point = points.row(i);
    const Normal near = Near(point);
    const Eigen::MatrixXd at = NodesAt(point, near);
    nodes.points.middleRows(i * each, each) = at;
    nodes.log_weight.segment(i * each, each) = -LogProposal(near, at);
  }
  nodes.log_density = DensityInside(nodes.points);
  nodes.log_weight += nodes.log_density;
  return nodes;
}

Eigen::VectorXd AskedDensity::DensityInside(const Eigen::MatrixXd& points) const {
  Eigen::VectorXd density = density_(points);
  for (Eigen::Index j = 0; j < points.rows(); ++j) {
    if (!domain_.Contains(points.row(j))) density[j] = -std::numeric_limits<double>::infinity();
  }
  return density;
}

Eigen::VectorXd AskedDensity::LogDensity(const Eigen::MatrixXd& points) const {
  if (domain_.nuisances.empty()) return DensityInside(points);
  Eigen::VectorXd density(points.rows());
  for (Eigen::Index from = 0; from < points.rows(); from += kBlock) {
    const Eigen::Index size = std::min(kBlock, points.rows() - from);
    const Nodes nodes = Weighted(points.middleRows(from, size));
    const Eigen::Index each = nodes.log_weight.size() / size;
    for (Eigen::Index i = 0; i < size; ++i) {
      density[from + i] =
          LogSumExp(nodes.log_weight.segment(i * each, each)) - std::log(static_cast<double>(each));
    }
  }
  return density;
}

Eigen::VectorXd AskedDensity::WithTypicalNuisances(const Eigen::VectorXd& point) const {
  const Nodes nodes = Weighted(point.transpose());
  const double sum = LogSumExp(nodes.log_weight);
  if (!std::isfinite(sum)) return point;
  const Eigen::VectorXd weight = (nodes.log_weight.array() - sum).exp();
  Eigen::VectorXd typical = point;
  typical(domain_.nuisances) =
      (weight.transpose() * Eigen::MatrixXd(nodes.points(Eigen::all, domain_.nuisances)))
          .transpose();
  // The mean of one solution is about as likely as its likeliest node; of a skewed one less, by the
  // half a standard deviation or so that it lies beside the mode in each nuisance.
  Eigen::Index likeliest = 0;
  const double most = nodes.log_density.maxCoeff(&likeliest);
  const double least = most - 1 - 0.5 * static_cast<double>(domain_.nuisances.size());
  if (DensityInside(typical.transpose())[0] >= least) return typical;
  return nodes.points.row(likeliest);
}

// From even points in the box of the region's draws. A sum of 1 / p(a) over the draws would be off
// by as much as the nodes miss.
double AskedDensity::RegionVolume(const PosteriorSample& sample) const {
  Eigen::VectorXd low = Eigen::VectorXd::Ones(sample.points.cols());
  Eigen::VectorXd high = Eigen::VectorXd::Zero(sample.points.cols());
  for (Eigen::Index i = 0; i < sample.points.rows(); ++i) {
    if (sample.log_density[i] < sample.region_log_density) continue;
    low = low.cwiseMin(sample.points.row(i).transpose());
    high = high.cwiseMax(sample.points.row(i).transpose());
  }
  const Eigen::VectorXd size = high - low;
  const Eigen::MatrixXd even = RSequence(kEven, static_cast<int>(asked_.size()), seed_);
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(kEven, sample.points.cols());
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    const Eigen::Index at = asked_[k];
    points.col(at) = (low[at] + size[at] * even.col(static_cast<Eigen::Index>(k)).array()).matrix();
  }
  const double share =
      (LogDensity(points).array() >= sample.region_log_density).cast<double>().mean();
  return share * size(asked_).prod();
}

// Each draw of the region stands for as much of its volume as another.
PosteriorSample AskedDensity::Sample(const PosteriorSample& joint) const {
  if (domain_.nuisances.empty()) return joint;
  PosteriorSample sample;
  sample.points = joint.Draws(kDraws, seed_);
  sample.log_density = LogDensity(sample.points);
  sample.weight = Eigen::VectorXd::Constant(kDraws, 1.0 / kDraws);
  sample.SetRegion();
  const auto inside = (sample.log_density.array() >= sample.region_log_density).count();
  sample.volume =
      Eigen::VectorXd::Constant(kDraws, RegionVolume(sample) / static_cast<double>(inside));
  return sample;
}

}  // namespace talus::optimizer
