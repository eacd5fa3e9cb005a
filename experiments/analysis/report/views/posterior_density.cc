#include "experiments/analysis/report/views/posterior_density.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"

namespace talus::analysis {
namespace {

// A draw reaches half as far as this many of the others are. Draws repeat, so some
// of these are at no distance: then it is `least`.
struct KernelWidth {
  double neighbour_share = 0;  // of the draws
  double least = 0;            // in cells
};
constexpr KernelWidth kCurve{.neighbour_share = 0.03, .least = 1};      // smooth to look at
constexpr KernelWidth kRegion{.neighbour_share = 0.01, .least = 0.71};  // its own cell's middle

// From so many parameters on the draws, which are of a sequence that fills the cube evenly, stand
// in some eleven stripes over one of them: kernels are then no narrower than UsualWidth, which
// smooths over these and leaves a narrow density narrow.
constexpr int kFewestStriped = 5;

constexpr double kReach = 4;  // of a kernel, in its widths

// From the i-th row to each. In plain loops, since there are as many as draws, squared, and what
// makes pages is little optimised.
void SquaredDistances(const Eigen::MatrixXd& rows, Eigen::Index i, std::vector<double>& squared) {
  squared.assign(static_cast<std::size_t>(rows.rows()), 0.0);
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const double* column = rows.data() + k * rows.rows();
    const double here = column[i];
    for (std::size_t j = 0; j < squared.size(); ++j) {
      const double apart = column[j] - here;
      squared[j] += apart * apart;
    }
  }
}

// The width of each draw's kernel.
Eigen::VectorXd Widths(const Eigen::MatrixXd& draws, const KernelWidth& kernel, int num_cells) {
  const Eigen::Index count = draws.rows();
  const auto nth = static_cast<std::ptrdiff_t>(kernel.neighbour_share * static_cast<double>(count));
  Eigen::VectorXd widths(count);
  std::vector<double> squared;
  for (Eigen::Index i = 0; i < count; ++i) {
    SquaredDistances(draws, i, squared);
    std::nth_element(squared.begin(), squared.begin() + nth, squared.end());
    widths[i] =
        std::max(0.5 * std::sqrt(squared[static_cast<std::size_t>(nth)]), kernel.least / num_cells);
  }
  return widths;
}

// The width of normal kernels that leaves the least mean squared error where the density is normal
// itself: σ (4 / 3n)^(1/5). Of an even density's 2000 draws 0.067.
double UsualWidth(const Eigen::VectorXd& draws) {
  const auto count = static_cast<double>(draws.size());
  const double deviation = std::sqrt((draws.array() - draws.mean()).square().mean());
  return deviation * std::pow(4 / (3 * count), 0.2);
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
      shares[cell] +=
          base::NormalProbability(low + 1 / (num_cells * width)) - base::NormalProbability(low);
    }
  }
  return shares / shares.sum();
}

// The least or the largest value within `radius` cells of each cell.
template <class Better>
Eigen::MatrixXd BestWithin(double radius, const Eigen::MatrixXd& map, const Better& better) {
  const auto reach = static_cast<Eigen::Index>(radius);
  Eigen::MatrixXd result = map;
  for (Eigen::Index dy = -reach; dy <= reach; ++dy) {
    for (Eigen::Index dx = -reach; dx <= reach; ++dx) {
      if (std::hypot(dx, dy) > radius) continue;
      const Eigen::Index rows = map.rows() - std::abs(dx);
      const Eigen::Index cols = map.cols() - std::abs(dy);
      auto here =
          result.block(std::max<Eigen::Index>(0, -dx), std::max<Eigen::Index>(0, -dy), rows, cols);
      here = here.binaryExpr(map.block(std::max<Eigen::Index>(0, dx), std::max<Eigen::Index>(0, dy),
                                       rows, cols),
                             better)
                 .eval();
    }
  }
  return result;
}

// Draws of a region in more dimensions leave gaps on a plane that the region's shadow does not
// have: the regions of all levels are closed over gaps narrower than two radii.
Eigen::MatrixXd WithoutGaps(const Eigen::MatrixXd& levels) {
  constexpr double kRadius = 4;  // cells
  const auto lower = [](double a, double b) { return std::min(a, b); };
  const auto higher = [](double a, double b) { return std::max(a, b); };
  return BestWithin(kRadius, BestWithin(kRadius, levels, lower), higher);
}

}  // namespace

std::vector<double> MarginalDensity(const Eigen::VectorXd& draws, int num_cells,
                                    int num_parameters) {
  Eigen::VectorXd widths = Widths(draws, kCurve, num_cells);
  if (num_parameters >= kFewestStriped) widths = widths.cwiseMax(UsualWidth(draws));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_cells);
  for (Eigen::Index i = 0; i < draws.size(); ++i) sum += Shares(draws[i], widths[i], num_cells);
  sum *= static_cast<double>(num_cells) / static_cast<double>(draws.size());
  return {sum.data(), sum.data() + sum.size()};
}

std::vector<double> ProjectedLevels(const Eigen::MatrixXd& draws, const Eigen::VectorXd& levels,
                                    int num_cells) {
  const Eigen::VectorXd reach = num_cells * Widths(draws, kRegion, num_cells);  // in cells
  Eigen::MatrixXd least = Eigen::MatrixXd::Ones(num_cells, num_cells);          // (x, y): x fastest
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const Eigen::Vector2d at = num_cells * draws.row(i).transpose();
    const auto first = [&](int k) { return std::max(0, static_cast<int>(at[k] - reach[i])); };
    const auto last = [&](int k) {
      return std::min(num_cells - 1, static_cast<int>(at[k] + reach[i]));
    };
    for (int y = first(1); y <= last(1); ++y) {
      for (int x = first(0); x <= last(0); ++x) {
        if ((Eigen::Vector2d(x + 0.5, y + 0.5) - at).norm() > reach[i]) continue;
        least(x, y) = std::min(least(x, y), levels[i]);
      }
    }
  }
  least = WithoutGaps(least);
  return {least.data(), least.data() + least.size()};
}

}  // namespace talus::analysis
