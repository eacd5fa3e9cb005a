#include "optimizer/posterior/posterior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

// Outputs that the likelihood is made of: none of an experiment that is held out.
int NumCounted(const ExperimentModel& model) {
  return model.weight() > 0 ? model.num_outputs() : 0;
}

// Residuals of all experiments side by side: a row for each set and scale factor, NaN where an
// experiment was not simulated there. Replicates go to rows of their own.
Eigen::MatrixXd Stack(const std::vector<ExperimentModel>& models,
                      const std::vector<OutputData>& data) {
  Eigen::Index width = 0;
  for (const ExperimentModel& model : models) width += NumCounted(model);
  struct Place {
    Eigen::VectorXd point;
    int level;
    std::vector<bool> has;
  };
  std::vector<Place> places;
  Eigen::MatrixXd stacked(0, width);
  Eigen::Index left = 0;
  for (std::size_t e = 0; e < models.size(); ++e) {
    if (NumCounted(models[e]) == 0) continue;
    const Eigen::MatrixXd z = models[e].LeaveOneOut();
    for (int i = 0; i < data[e].size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      auto place = std::find_if(places.begin(), places.end(), [&](const Place& p) {
        return p.level == data[e].level[k] && !p.has[e] && SamePoint(p.point, data[e].points[k]);
      });
      if (place == places.end()) {
        places.push_back({data[e].points[k], data[e].level[k], std::vector<bool>(models.size())});
        place = places.end() - 1;
        stacked.conservativeResize(stacked.rows() + 1, Eigen::NoChange);
        stacked.bottomRows(1).setConstant(std::numeric_limits<double>::quiet_NaN());
      }
      place->has[e] = true;
      stacked.row(place - places.begin()).segment(left, z.cols()) = z.row(i);
    }
    left += models[e].num_outputs();
  }
  return stacked;
}

// The experiment that each output is of, counted among those that count.
std::vector<int> TestOfOutputs(const std::vector<ExperimentModel>& models) {
  std::vector<int> test;
  int num_tests = 0;
  for (const ExperimentModel& model : models) {
    if (NumCounted(model) == 0) continue;
    test.insert(test.end(), static_cast<std::size_t>(NumCounted(model)), num_tests++);
  }
  return test;
}

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

KernelMixture MixtureOf(const Eigen::MatrixXd& points, const Eigen::VectorXd& weight,
                        base::Random& random) {
  constexpr int kCentres = 120;
  constexpr double kWidth = 0.25;  // of the sample's own sd: a curved valley stays thin
  const Eigen::RowVectorXd mean = weight.transpose() * points;
  const Eigen::MatrixXd centred = points.rowwise() - mean;
  Eigen::MatrixXd covariance =
      kWidth * kWidth * centred.transpose() * weight.asDiagonal() * centred;
  covariance.diagonal().array() += 1e-6;
  return {points(Resample(weight, kCentres, random), Eigen::all), covariance};
}

}  // namespace

Posterior::Posterior(std::vector<ExperimentModel> models, const std::vector<OutputData>& data,
                     Prior prior)
    : models_(std::move(models)),
      misfit_(Stack(models_, data), TestOfOutputs(models_)),
      prior_(std::move(prior)) {}

// An experiment that is held out has none.
std::vector<OutputMoments> Posterior::Outputs(const Eigen::MatrixXd& points) const {
  std::vector<OutputMoments> outputs;
  for (const ExperimentModel& model : models_) {
    outputs.push_back(NumCounted(model) == 0 ? OutputMoments{} : model.Outputs(points));
  }
  for (std::size_t e = 0; e < shifts_.size(); ++e) {
    if (NumCounted(models_[e]) > 0) outputs[e].mean += shifts_[e](points);
  }
  return outputs;
}

Eigen::VectorXd Posterior::LogDensity(const Eigen::MatrixXd& points, double softness) const {
  return LogDensity(Outputs(points), softness) + prior_.LogDensity(points);
}

Eigen::VectorXd Posterior::LogDensity(const std::vector<OutputMoments>& outputs,
                                      double softness) const {
  Eigen::Index num_points = 0;
  for (const OutputMoments& one : outputs) num_points = std::max(num_points, one.mean.rows());
  Eigen::MatrixXd residual(num_points, misfit_.num_outputs());
  Eigen::MatrixXd share(num_points, 0);
  Eigen::VectorXd log_sd = Eigen::VectorXd::Zero(num_points);
  Eigen::Index left = 0;
  for (std::size_t e = 0; e < models_.size(); ++e) {
    const ExperimentModel& model = models_[e];
    if (NumCounted(model) == 0) continue;
    const OutputMisfit misfit = model.MisfitOf(outputs[e]);
    const double weight = model.weight();
    residual.middleCols(left, misfit.residual.cols()) = std::sqrt(weight) * misfit.residual;
    log_sd += weight * misfit.log_sd;
    share.conservativeResize(Eigen::NoChange, share.cols() + 1);
    share.rightCols(1) = misfit.share;
    left += misfit.residual.cols();
  }
  return misfit_.LogDensity(misfit_.Squared(residual, share), log_sd, softness);
}

PosteriorSample Posterior::Sample(const Domain& domain, int num_start, double softness,
                                  std::uint64_t seed) const {
  constexpr std::size_t kRounds = 4;
  constexpr double kEnough = 600;  // effective draws
  base::Random random(seed, base::Stream("posterior"));
  PosteriorSample sample;
  sample.points = Inside(domain, RSequence(num_start, domain.num_parameters, seed));
  const double share_inside = static_cast<double>(sample.points.rows()) / num_start;
  const auto first = static_cast<double>(sample.points.rows());
  const int num_prior = prior_.IsUniform() ? 0 : num_start;
  sample.points = optimizer::Stack(
      sample.points, Inside(domain, prior_.Draw(num_prior, domain.num_parameters, seed)));
  sample.log_density = LogDensity(sample.points, softness);
  std::vector<Round> rounds;
  Eigen::MatrixXd in_rounds(sample.points.rows(), 0);
  for (;;) {
    // Balance heuristic: the proposal is the mixture of all rounds.
    Eigen::MatrixXd logs(sample.points.rows(), in_rounds.cols() + (num_prior > 0 ? 2 : 1));
    logs.col(0).setConstant(std::log(first / share_inside));
    logs.middleCols(1, in_rounds.cols()) = in_rounds;
    if (num_prior > 0) {
      logs.rightCols(1) = prior_.LogDensity(sample.points).array() + std::log(1.0 * num_prior);
    }
    Eigen::VectorXd log_volume(sample.points.rows());
    for (Eigen::Index i = 0; i < logs.rows(); ++i) log_volume[i] = -LogSumExp(logs.row(i));
    const Eigen::VectorXd log_weight = sample.log_density + log_volume;
    sample.volume = log_volume.array().exp();
    sample.weight = (log_weight.array() - LogSumExp(log_weight)).exp();
    if (rounds.size() == kRounds || 1 / sample.weight.squaredNorm() > kEnough) break;
    rounds.push_back({.mixture = MixtureOf(sample.points, sample.weight, random)});
    const Eigen::MatrixXd drawn = rounds.back().mixture.Draw(num_start / 2, random);
    rounds.back().num_draws = static_cast<double>(drawn.rows());
    const Eigen::MatrixXd more = Inside(domain, drawn);
    const Eigen::Index before = sample.points.rows();
    sample.points.conservativeResize(before + more.rows(), Eigen::NoChange);
    sample.points.bottomRows(more.rows()) = more;
    sample.log_density.conservativeResize(before + more.rows());
    sample.log_density.tail(more.rows()) = LogDensity(more, softness);
    in_rounds = LogsIn(rounds, sample.points, in_rounds);
  }
  sample.SetRegion();
  return sample;
}

double Posterior::Implausibility(std::size_t experiment, const Eigen::VectorXd& x) const {
  return models_[experiment].Misfit(x) / std::sqrt(temper());
}

Eigen::VectorXd Posterior::SquaredMisfit(std::size_t experiment,
                                         const Eigen::MatrixXd& points) const {
  return models_[experiment].SquaredMisfit(points) / temper();
}

std::vector<ExperimentStanding> Posterior::StandingsAt(const Eigen::VectorXd& x) const {
  std::vector<ExperimentStanding> standings;
  for (std::size_t e = 0; e < models_.size(); ++e) {
    standings.push_back(models_[e].StandingAt(x));
    standings.back().implausibility = Implausibility(e, x);
  }
  return standings;
}

}  // namespace talus::optimizer
