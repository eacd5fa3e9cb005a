#include "experiments/analysis/report/views/posterior_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus::analysis {
namespace {

// A draw's kernel reaches as far as so many of its neighbours. Draws repeat, so some of these are
// at no distance.
constexpr double kNeighbourShare = 0.03;
constexpr double kReach = 4;  // of a kernel, in its widths

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Width of each draw's kernel, at least that of a cell.
Eigen::VectorXd Widths(const Eigen::MatrixXd& draws, int num_cells) {
  const Eigen::Index count = draws.rows();
  const auto nth = static_cast<std::ptrdiff_t>(kNeighbourShare * static_cast<double>(count));
  Eigen::VectorXd widths(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd squared = (draws.rowwise() - draws.row(i)).rowwise().squaredNorm();
    std::vector<double> sorted(squared.data(), squared.data() + count);
    std::nth_element(sorted.begin(), sorted.begin() + nth, sorted.end());
    widths[i] = std::max(0.5 * std::sqrt(sorted[static_cast<std::size_t>(nth)]), 1.0 / num_cells);
  }
  return widths;
}

// The share that a kernel round x gives to each cell of the unit interval, all of it together 1.
// What reaches beyond an end is mirrored there.
Eigen::VectorXd Shares(double x, double width, int num_cells) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(num_cells);
  for (const double centre : {x, -x, 2 - x}) {
    const auto cell_of = [&](double at) { return static_cast<int>(std::floor(at * num_cells)); };
    const int first = std::max(0, cell_of(centre - kReach * width));
    const int last = std::min(num_cells - 1, cell_of(centre + kReach * width));
    for (int cell = first; cell <= last; ++cell) {
      const double low = (static_cast<double>(cell) / num_cells - centre) / width;
      shares[cell] += NormalCdf(low + 1 / (num_cells * width)) - NormalCdf(low);
    }
  }
  return shares / shares.sum();
}

}  // namespace

std::vector<double> MarginalDensity(const Eigen::VectorXd& draws, int num_cells) {
  const Eigen::VectorXd widths = Widths(draws, num_cells);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_cells);
  for (Eigen::Index i = 0; i < draws.size(); ++i) sum += Shares(draws[i], widths[i], num_cells);
  sum *= static_cast<double>(num_cells) / static_cast<double>(draws.size());
  return {sum.data(), sum.data() + sum.size()};
}

std::vector<double> CredibleLevels(const Eigen::MatrixXd& draws, int num_cells) {
  const Eigen::VectorXd widths = Widths(draws, num_cells);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(num_cells, num_cells);  // (x, y): x fastest
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    mass += Shares(draws(i, 0), widths[i], num_cells) *
            Shares(draws(i, 1), widths[i], num_cells).transpose();
  }
  mass /= static_cast<double>(draws.rows());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(mass.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return mass.data()[a] > mass.data()[b]; });
  std::vector<double> levels(order.size());
  double sum = 0;
  for (const Eigen::Index cell : order) {
    levels[static_cast<std::size_t>(cell)] = sum;
    sum += mass.data()[cell];
  }
  return levels;
}

}  // namespace talus::analysis
