#include "optimizer/space/prior.h"

#include <cmath>
#include <utility>

#include "base/normal.h"
#include "base/not_known.h"
#include "base/random.h"
#include "optimizer/space/draws_density.h"

namespace talus::optimizer {

void Prior::Add(Eigen::Index coordinate, const ScaledRange& range, const NormalPrior& normal) {
  normals_.push_back({.coordinate = coordinate, .range = range, .normal = normal});
}

void Prior::Add(std::vector<Eigen::Index> coordinates, const Eigen::MatrixXd& draws) {
  joint_.push_back({.coordinates = std::move(coordinates),
                    .density = std::make_shared<const DrawsDensity>(draws)});
}

double Prior::Single::Score(double unit) const {
  const double value = range.ToNative(unit);
  return ((normal.of_logarithm ? std::log(value) : value) - normal.mean) / normal.sd;
}

// A normal variable between two ends: with φ and Φ of the standard normal, Z = Φ(b) - Φ(a), its
// mean is (φ(a) - φ(b)) / Z and its variance 1 + (a φ(a) - b φ(b)) / Z - mean².
Prior::Single::Moments Prior::Single::ScoreWithin() const {
  const double a = Score(0), b = Score(1);
  const auto density = base::NormalDensity;
  const double inside = base::NormalProbability(b) - base::NormalProbability(a);
  const double mean = (density(a) - density(b)) / inside;
  return {.mean = mean,
          .sd = std::sqrt(1 + (a * density(a) - b * density(b)) / inside - mean * mean)};
}

double Prior::Single::LogDensity(double unit) const {
  const double score = Score(unit);
  const double slope =  // dt/du
      range.Slope(unit) / (normal.of_logarithm ? range.ToNative(unit) : 1);
  return std::log(slope / normal.sd) - 0.5 * score * score - base::kLogRootTwoPi;
}

double Prior::Single::AtScore(double score) const {
  const double t = normal.mean + normal.sd * score;
  return range.ToUnit(normal.of_logarithm ? std::exp(t) : t);
}

Eigen::VectorXd Prior::LogDensity(const Eigen::MatrixXd& points) const {
  Eigen::VectorXd density = Eigen::VectorXd::Zero(points.rows());
  for (const Single& single : normals_) {
    density += points.col(single.coordinate).unaryExpr([&](double unit) {
      return single.LogDensity(unit);
    });
  }
  for (const Joint& joint : joint_) {
    density += joint.density->LogDensity(points(Eigen::all, joint.coordinates));
  }
  return density;
}

Eigen::MatrixXd Prior::Draw(Eigen::Index count, Eigen::Index dimension, std::uint64_t seed) const {
  base::Random random(seed, base::Stream("prior"));
  Eigen::MatrixXd points(count, dimension);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (double& coordinate : points.row(i)) coordinate = random.Uniform();
    for (const Single& single : normals_) {
      points(i, single.coordinate) = single.AtScore(random.Normal());
    }
    for (const Joint& joint : joint_) {
      const Eigen::VectorXd draw = joint.density->Draw(random);
      for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
        points(i, joint.coordinates[k]) = draw[static_cast<Eigen::Index>(k)];
      }
    }
  }
  return points;
}

Eigen::VectorXd Prior::Offset(const Eigen::MatrixXd& draws) const {
  Eigen::VectorXd offset = Eigen::VectorXd::Constant(draws.cols(), base::kNotKnown);
  for (const Single& single : normals_) {
    const Single::Moments within = single.ScoreWithin();
    const double mean = draws.col(single.coordinate)
                            .unaryExpr([&](double unit) { return single.Score(unit); })
                            .mean();
    offset[single.coordinate] = (mean - within.mean) / within.sd;
  }
  for (const Joint& joint : joint_) {
    for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      offset[joint.coordinates[k]] =
          (draws.col(joint.coordinates[k]).mean() - joint.density->mean()[i]) /
          joint.density->sd()[i];
    }
  }
  return offset;
}

}  // namespace talus::optimizer
