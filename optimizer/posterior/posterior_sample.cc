#include "optimizer/posterior/posterior_sample.h"

#include <algorithm>
#include <cmath>

#include "optimizer/answer.h"
#include "optimizer/space/ascending.h"

namespace talus::optimizer {

double LogSumExp(const Eigen::VectorXd& x) {
  const double most = x.maxCoeff();
  if (!std::isfinite(most)) return most;
  return most + std::log((x.array() - most).exp().sum());
}

std::vector<Eigen::Index> Resample(const Eigen::VectorXd& weight, int count, base::Random& random) {
  std::vector<Eigen::Index> rows;
  const double offset = random.Uniform();
  double sum = 0;
  Eigen::Index i = 0;
  for (int k = 0; k < count; ++k) {
    const double goal = (k + offset) / count;
    while (i + 1 < weight.size() && sum + weight[i] < goal) sum += weight[i++];
    rows.push_back(i);
  }
  return rows;
}

Eigen::MatrixXd Resampled(const Eigen::MatrixXd& draws, const Eigen::VectorXd& weight) {
  const Eigen::Index size = draws.rows();
  Eigen::MatrixXd sample(size, draws.cols());
  const double step = weight.sum() / static_cast<double>(size);
  double at = weight[0];
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    const double aim = step * (static_cast<double>(i) + 0.5);
    while (at < aim && row + 1 < size) at += weight[++row];
    sample.row(i) = draws.row(row);
  }
  return sample;
}

void PosteriorSample::SetRegion() {
  double sum = 0;
  for (const Eigen::Index i : Ascending(-log_density)) {
    region_log_density = log_density[i];
    if ((sum += weight[i]) >= kRegionLevel) break;
  }
}

double PosteriorSample::CredibleLevel(double at) const {
  const auto denser = log_density.array() > at;
  if (denser.all()) return 1;  // the weights sum to 1 but for rounding
  return std::min(1.0, denser.select(weight, 0).sum());
}

double PosteriorSample::RegionVolume() const {
  return std::min(1.0, (log_density.array() >= region_log_density).select(volume, 0).sum());
}

Eigen::MatrixXd PosteriorSample::Draws(int count, std::uint64_t seed) const {
  base::Random random(seed, base::Stream("equally likely draws"));
  return points(Resample(weight, count, random), Eigen::all);
}

}  // namespace talus::optimizer
