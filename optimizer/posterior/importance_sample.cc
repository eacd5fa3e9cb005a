#include "optimizer/posterior/importance_sample.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

// Width of the kernels in the sample's own standard deviations. In up to three dimensions a
// quarter, so that a curved valley stays thin. In more such kernels would leave most of the density
// between them; as wide as a normal density is estimated with [silverman1986] they fill it.
double KernelWidth(int dimension) {
  if (dimension <= 3) return 0.25;
  return std::pow(4 / ((dimension + 2.0) * KernelMixture::kCentres), 1 / (dimension + 4.0));
}

// Likewise, where few points have weight.
double WideKernelWidth(int dimension) { return std::max(0.6, 1.5 * KernelWidth(dimension)); }

Eigen::VectorXd WeightOf(const Eigen::VectorXd& log_density, const Eigen::VectorXd& log_volume) {
  const Eigen::VectorXd log_weight = log_density + log_volume;
  return (log_weight.array() - LogSumExp(log_weight)).exp();
}

double EffectiveNumber(const Eigen::VectorXd& weight) { return 1 / weight.squaredNorm(); }

// Weights to the power that leaves an effective number of `least`: kernels round the few points
// that have weight would not reach the tails.
Eigen::VectorXd Evened(const Eigen::VectorXd& weight, double least) {
  const auto to_the = [&](double power) -> Eigen::VectorXd {
    Eigen::VectorXd evened = weight.array().pow(power);
    return evened / evened.sum();
  };
  double low = 0;
  double high = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (EffectiveNumber(to_the(middle)) > least ? low : high) = middle;
  }
  return to_the(low);
}

// Even points of the domain, as many as `num_start` of the cube hold, or where constraints leave
// little, more of the sequence; and the share of the cube that the domain has.
struct EvenStart {
  Eigen::MatrixXd points;
  double share_inside = 0;
};

EvenStart EvenlyIn(const Domain& domain, int num_start, std::uint64_t seed) {
  constexpr Eigen::Index kFewest = 200;
  constexpr int kMost = 1 << 22;
  for (int count = num_start;; count *= 4) {
    EvenStart start{.points = Inside(domain, RSequence(count, domain.num_parameters, seed))};
    start.share_inside = static_cast<double>(start.points.rows()) / count;
    if (start.points.rows() >= std::min<Eigen::Index>(kFewest, num_start / 2)) return start;
    if (count < kMost) continue;
    if (start.points.rows() > 0) return start;
    throw base::Error("the constraints leave nothing of the ranges");
  }
}

}  // namespace

ImportanceSampler::ImportanceSampler(const SampledSpace& space, std::uint64_t seed)
    : space_(space),
      num_prior_(space.prior->IsUniform() ? 0 : space.num_start),
      random_(seed, base::Stream("posterior")) {
  const EvenStart start = EvenlyIn(*space.domain, space.num_start, seed);
  log_even_ = std::log(static_cast<double>(start.points.rows()) / start.share_inside);
  points_ =
      Stack(start.points, Inside(*space.domain, space.prior->Draw(num_prior_, Dimension(), seed)));
  in_rounds_.resize(points_.rows(), 0);
  TellPrior();
}

void ImportanceSampler::Cover(const LogDensityFunction& density) {
  constexpr int kRounds = 4;
  constexpr int kMostRounds = 8;   // where few points have weight even then
  constexpr double kEnough = 600;  // effective draws
  constexpr double kFew = 30;
  const double width = KernelWidth(Dimension());
  for (int round = 0; round < kMostRounds; ++round) {
    const Eigen::VectorXd weight = WeightOf(density(points_), LogVolume());
    const double effective = EffectiveNumber(weight);
    if (effective > kEnough || (round >= kRounds && effective > 2 * kFew)) break;
    if (effective < kFew) {
      const Eigen::MatrixXd before = points_;
      const Eigen::VectorXd evened = Evened(weight, kFew);
      AddRound({before, evened, width, random_}, space_.num_start / 4);
      AddRound({before, evened, WideKernelWidth(Dimension()), random_}, space_.num_start / 4);
    } else {
      AddRound({points_, weight, width, random_}, space_.num_start / 2);
    }
    TellRounds();
    TellPrior();
  }
}

void ImportanceSampler::AddRound(KernelMixture mixture, int num_draws) {
  const Eigen::MatrixXd drawn = mixture.Draw(num_draws, random_);
  rounds_.push_back(
      {.mixture = std::move(mixture), .num_draws = static_cast<double>(drawn.rows())});
  points_ = Stack(points_, Inside(*space_.domain, drawn));
}

// The earlier points in the earlier rounds, which are most of the pairs, are known.
void ImportanceSampler::TellRounds() {
  Eigen::MatrixXd logs(points_.rows(), static_cast<Eigen::Index>(rounds_.size()));
  logs.topLeftCorner(in_rounds_.rows(), in_rounds_.cols()) = in_rounds_;
  for (Eigen::Index m = 0; m < logs.cols(); ++m) {
    const Round& round = rounds_[static_cast<std::size_t>(m)];
    const Eigen::Index left = points_.rows() - (m < in_rounds_.cols() ? in_rounds_.rows() : 0);
    logs.col(m).tail(left) =
        round.mixture.LogDensity(points_.bottomRows(left)).array() + std::log(round.num_draws);
  }
  in_rounds_ = std::move(logs);
}

// A prior from a campaign has a kernel for each of a thousand draws, so it is asked of new points
// only.
void ImportanceSampler::TellPrior() {
  if (num_prior_ == 0) return;
  const Eigen::Index left = points_.rows() - in_prior_.size();
  in_prior_.conservativeResize(points_.rows());
  in_prior_.tail(left) = space_.prior->LogDensity(points_.bottomRows(left)).array() +
                         std::log(static_cast<double>(num_prior_));
}

Eigen::VectorXd ImportanceSampler::LogVolume() const {
  Eigen::MatrixXd logs(points_.rows(), in_rounds_.cols() + (num_prior_ > 0 ? 2 : 1));
  logs.col(0).setConstant(log_even_);
  logs.middleCols(1, in_rounds_.cols()) = in_rounds_;
  if (num_prior_ > 0) logs.rightCols(1) = in_prior_;
  Eigen::VectorXd log_volume(points_.rows());
  for (Eigen::Index i = 0; i < logs.rows(); ++i) log_volume[i] = -LogSumExp(logs.row(i));
  return log_volume;
}

PosteriorSample SampleByImportance(const LogDensityFunction& density, const SampledSpace& space,
                                   std::uint64_t seed) {
  ImportanceSampler sampler(space, seed);
  PosteriorSample sample;
  // Asked of new points only.
  const auto of_all = [&](const Eigen::MatrixXd& points) {
    const Eigen::Index known = sample.log_density.size();
    if (points.rows() == known) return sample.log_density;
    sample.log_density.conservativeResize(points.rows());
    sample.log_density.tail(points.rows() - known) =
        density(points.bottomRows(points.rows() - known));
    return sample.log_density;
  };
  sampler.Cover(of_all);
  of_all(sampler.points());
  sample.points = sampler.points();
  const Eigen::VectorXd log_volume = sampler.LogVolume();
  sample.volume = log_volume.array().exp();
  sample.weight = WeightOf(sample.log_density, log_volume);
  sample.SetRegion();
  return sample;
}

}  // namespace talus::optimizer
