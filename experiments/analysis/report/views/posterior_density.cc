#include "experiments/analysis/report/views/posterior_density.h"

#include <algorithm>
#include <cmath>

namespace talus::analysis {
namespace {

// A draw's kernel is half as wide as the distance to this many of the others. Draws repeat, so some
// of these are at no distance: then it is as wide as `least`.
struct KernelWidth {
  double neighbour_share = 0;  // of the draws
  double least = 0;            // in cells
};
constexpr KernelWidth kCurve{.neighbour_share = 0.03, .least = 1};     // smooth to look at
constexpr KernelWidth kRegion{.neighbour_share = 0.02, .least = 0.6};  // a thin valley stays thin

constexpr double kReach = 4;  // of a kernel, in its widths

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Of each draw's kernel.
Eigen::VectorXd Widths(const Eigen::MatrixXd& draws, const KernelWidth& kernel, int num_cells) {
  const Eigen::Index count = draws.rows();
  const auto nth = static_cast<std::ptrdiff_t>(kernel.neighbour_share * static_cast<double>(count));
  Eigen::VectorXd widths(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd squared = (draws.rowwise() - draws.row(i)).rowwise().squaredNorm();
    std::vector<double> sorted(squared.data(), squared.data() + count);
    std::nth_element(sorted.begin(), sorted.begin() + nth, sorted.end());
    widths[i] =
        std::max(0.5 * std::sqrt(sorted[static_cast<std::size_t>(nth)]), kernel.least / num_cells);
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

Eigen::Index CellOf(double x, int num_cells) {
  return std::clamp(static_cast<int>(x * num_cells), 0, num_cells - 1);
}

}  // namespace

std::vector<double> MarginalDensity(const Eigen::VectorXd& draws, int num_cells) {
  const Eigen::VectorXd widths = Widths(draws, kCurve, num_cells);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_cells);
  for (Eigen::Index i = 0; i < draws.size(); ++i) sum += Shares(draws[i], widths[i], num_cells);
  sum *= static_cast<double>(num_cells) / static_cast<double>(draws.size());
  return {sum.data(), sum.data() + sum.size()};
}

std::vector<double> CredibleLevels(const Eigen::MatrixXd& draws, int num_cells) {
  const Eigen::VectorXd widths = Widths(draws, kRegion, num_cells);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(num_cells, num_cells);  // (x, y): x fastest
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    mass += Shares(draws(i, 0), widths[i], num_cells) *
            Shares(draws(i, 1), widths[i], num_cells).transpose();
  }
  // The draws themselves say which share of them a density holds; the kernels' mass would, too, but
  // it lies farther out than the draws, and its region is larger than theirs.
  std::vector<double> at_draws;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    at_draws.push_back(mass(CellOf(draws(i, 0), num_cells), CellOf(draws(i, 1), num_cells)));
  }
  std::sort(at_draws.begin(), at_draws.end());
  std::vector<double> levels;
  for (const double density : mass.reshaped()) {
    const auto denser =
        at_draws.end() - std::upper_bound(at_draws.begin(), at_draws.end(), density);
    levels.push_back(static_cast<double>(denser) / static_cast<double>(at_draws.size()));
  }
  return levels;
}

}  // namespace talus::analysis
