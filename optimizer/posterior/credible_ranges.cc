#include "optimizer/posterior/credible_ranges.h"

#include <algorithm>
#include <cmath>

#include "optimizer/posterior/sample_statistics.h"

namespace talus::optimizer {
namespace {

// How many draws of a sorted column are not beyond x, from the nearer end: 1 for the outermost. Of
// equal draws each is as deep as the innermost.
Eigen::Index Depth(const auto& sorted, double x) {
  const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), x);
  return std::min(last - sorted.begin(), sorted.end() - first);
}

}  // namespace

std::vector<Range> CredibleRanges(const Eigen::MatrixXd& sample, double confidence) {
  const Eigen::Index size = sample.rows();
  const Eigen::MatrixXd sorted = SortedColumns(sample);
  std::vector<Eigen::Index> depths(static_cast<std::size_t>(size), (size + 1) / 2);
  for (Eigen::Index i = 0; i < size; ++i) {
    Eigen::Index& depth = depths[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < sample.cols(); ++k) {
      depth = std::min(depth, Depth(sorted.col(k), sample(i, k)));
    }
  }
  std::sort(depths.rbegin(), depths.rend());
  const auto inside = static_cast<std::size_t>(std::ceil(confidence * static_cast<double>(size)));
  const Eigen::Index depth = depths[inside - 1];
  std::vector<Range> ranges;
  for (const auto& column : sorted.colwise()) {
    ranges.push_back({.low = column[depth - 1], .high = column[size - depth]});
  }
  return ranges;
}

std::vector<Range> AskedRanges(const Eigen::MatrixXd& sample,
                               const std::vector<Eigen::Index>& nuisances) {
  std::vector<Range> ranges(static_cast<std::size_t>(sample.cols()));
  const auto set = [&](const std::vector<Eigen::Index>& columns) {
    const std::vector<Range> some = CredibleRanges(sample(Eigen::all, columns));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      ranges[static_cast<std::size_t>(columns[k])] = some[k];
    }
  };
  std::vector<Eigen::Index> asked;
  for (Eigen::Index k = 0; k < sample.cols(); ++k) {
    if (std::ranges::find(nuisances, k) == nuisances.end()) asked.push_back(k);
  }
  set(asked);
  for (const Eigen::Index nuisance : nuisances) set({nuisance});
  return ranges;
}

Eigen::VectorXd CredibleWidths90(const Eigen::MatrixXd& sample,
                                 const std::vector<Eigen::Index>& nuisances) {
  const std::vector<Range> ranges = AskedRanges(sample, nuisances);
  Eigen::VectorXd width(sample.cols());
  for (Eigen::Index i = 0; i < width.size(); ++i) {
    const Range& range = ranges[static_cast<std::size_t>(i)];
    width[i] = range.high - range.low;
  }
  return width;
}

}  // namespace talus::optimizer
