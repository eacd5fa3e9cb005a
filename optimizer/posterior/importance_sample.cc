#include "optimizer/posterior/importance_sample.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

// Draws round weighted points: a mixture of normal kernels, whose density can be asked.
class KernelMixture {
 public:
  KernelMixture(Eigen::MatrixXd centres, const Eigen::MatrixXd& covariance)
      : centres_(std::move(centres)), factor_(covariance) {}

  Eigen::MatrixXd Draw(Eigen::Index count, base::Random& random) const {
    Eigen::MatrixXd points(count, centres_.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
      Eigen::VectorXd z(centres_.cols());
      for (double& one : z) one = random.Normal();
      points.row(i) = centres_.row(i % centres_.rows()) + (factor_.matrixL() * z).transpose();
    }
    return points;
  }

  // One a row.
  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points) const {
    const double log_root = Eigen::MatrixXd(factor_.matrixL()).diagonal().array().log().sum();
    const double log_root_two_pi = 0.5 * std::log(2 * std::numbers::pi);
    const double constant = -log_root - log_root_two_pi * static_cast<double>(centres_.cols()) -
                            std::log(static_cast<double>(centres_.rows()));
    const Eigen::MatrixXd white = factor_.matrixL().solve(points.transpose());
    const Eigen::MatrixXd centres = factor_.matrixL().solve(centres_.transpose());
    Eigen::VectorXd density(points.rows());
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::VectorXd squared =
          (centres.colwise() - white.col(i)).colwise().squaredNorm().transpose();
      density[i] = constant + LogSumExp(-0.5 * squared);
    }
    return density;
  }

 private:
  Eigen::MatrixXd centres_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

// A round's proposal, and how many draws are from it.
struct Round {
  KernelMixture mixture;
  double num_draws = 0;
};

// Log density of each point (rows) in each round (columns), times its draws. `known` has the
// earlier points in the earlier rounds, which are most of the pairs.
Eigen::MatrixXd LogsIn(const std::vector<Round>& rounds, const Eigen::MatrixXd& points,
                       const Eigen::MatrixXd& known) {
  Eigen::MatrixXd logs(points.rows(), static_cast<Eigen::Index>(rounds.size()));
  logs.topLeftCorner(known.rows(), known.cols()) = known;
  for (Eigen::Index m = 0; m < logs.cols(); ++m) {
    const Round& round = rounds[static_cast<std::size_t>(m)];
    const Eigen::Index left = points.rows() - (m < known.cols() ? known.rows() : 0);
    logs.col(m).tail(left) =
        round.mixture.LogDensity(points.bottomRows(left)).array() + std::log(round.num_draws);
  }
  return logs;
}

constexpr double kWidth = 0.25;     // of the sample's own sd: a curved valley stays thin
constexpr double kWideWidth = 0.6;  // likewise, where few points have weight

// `width`: of the kernels, in the sample's own standard deviations.
KernelMixture MixtureOf(const Eigen::MatrixXd& points, const Eigen::VectorXd& weight, double width,
                        base::Random& random) {
  constexpr int kCentres = 120;
  const Eigen::RowVectorXd mean = weight.transpose() * points;
  const Eigen::MatrixXd centred = points.rowwise() - mean;
  Eigen::MatrixXd covariance = width * width * centred.transpose() * weight.asDiagonal() * centred;
  covariance.diagonal().array() += 1e-6;
  return {points(Resample(weight, kCentres, random), Eigen::all), covariance};
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

// The sample while it grows, with the proposals that its points come from.
class ImportanceSampler {
 public:
  ImportanceSampler(const LogDensityFunction& density, const SampledSpace& space,
                    std::uint64_t seed)
      : density_(density),
        space_(space),
        num_prior_(space.prior->IsUniform() ? 0 : space.num_start),
        random_(seed, base::Stream("posterior")) {
    const EvenStart start = EvenlyIn(*space.domain, space.num_start, seed);
    log_even_ = std::log(static_cast<double>(start.points.rows()) / start.share_inside);
    sample_.points = Stack(start.points,
                           Inside(*space.domain, space.prior->Draw(num_prior_, Dimension(), seed)));
    sample_.log_density = density_(sample_.points);
    in_rounds_.resize(sample_.points.rows(), 0);
    Weigh();
  }

  PosteriorSample Take() {
    constexpr int kRounds = 4;
    constexpr int kMostRounds = 8;   // where few points have weight even then
    constexpr double kEnough = 600;  // effective draws
    constexpr double kFew = 30;
    for (int round = 0; round < kMostRounds; ++round) {
      const double effective = EffectiveNumber(sample_.weight);
      if (effective > kEnough || (round >= kRounds && effective > 2 * kFew)) break;
      if (effective < kFew) {
        const Eigen::VectorXd evened = Evened(sample_.weight, kFew);
        AddRound(MixtureOf(sample_.points, evened, kWidth, random_), space_.num_start / 4);
        AddRound(MixtureOf(sample_.points.topRows(evened.size()), evened, kWideWidth, random_),
                 space_.num_start / 4);
      } else {
        AddRound(MixtureOf(sample_.points, sample_.weight, kWidth, random_), space_.num_start / 2);
      }
      in_rounds_ = LogsIn(rounds_, sample_.points, in_rounds_);
      Weigh();
    }
    sample_.SetRegion();
    return std::move(sample_);
  }

 private:
  int Dimension() const { return static_cast<int>(space_.domain->num_parameters); }

  void AddRound(KernelMixture mixture, int num_draws) {
    rounds_.push_back({.mixture = std::move(mixture)});
    const Eigen::MatrixXd drawn = rounds_.back().mixture.Draw(num_draws, random_);
    rounds_.back().num_draws = static_cast<double>(drawn.rows());
    const Eigen::MatrixXd more = Inside(*space_.domain, drawn);
    const Eigen::Index before = sample_.points.rows();
    sample_.points.conservativeResize(before + more.rows(), Eigen::NoChange);
    sample_.points.bottomRows(more.rows()) = more;
    sample_.log_density.conservativeResize(before + more.rows());
    sample_.log_density.tail(more.rows()) = density_(more);
  }

  // Balance heuristic: the proposal is the mixture of all rounds.
  void Weigh() {
    Eigen::MatrixXd logs(sample_.points.rows(), in_rounds_.cols() + (num_prior_ > 0 ? 2 : 1));
    logs.col(0).setConstant(log_even_);
    logs.middleCols(1, in_rounds_.cols()) = in_rounds_;
    if (num_prior_ > 0) {
      logs.rightCols(1) =
          space_.prior->LogDensity(sample_.points).array() + std::log(1.0 * num_prior_);
    }
    Eigen::VectorXd log_volume(sample_.points.rows());
    for (Eigen::Index i = 0; i < logs.rows(); ++i) log_volume[i] = -LogSumExp(logs.row(i));
    const Eigen::VectorXd log_weight = sample_.log_density + log_volume;
    sample_.volume = log_volume.array().exp();
    sample_.weight = (log_weight.array() - LogSumExp(log_weight)).exp();
  }

  const LogDensityFunction& density_;
  const SampledSpace& space_;
  int num_prior_ = 0;
  base::Random random_;
  double log_even_ = 0;
  std::vector<Round> rounds_;
  Eigen::MatrixXd in_rounds_;  // LogsIn of all of them
  PosteriorSample sample_;
};

}  // namespace

PosteriorSample SampleByImportance(const LogDensityFunction& density, const SampledSpace& space,
                                   std::uint64_t seed) {
  return ImportanceSampler(density, space, seed).Take();
}

}  // namespace talus::optimizer
