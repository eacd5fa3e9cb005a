#include "engine/neighbor/grid.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace talus::engine {

namespace {

constexpr std::int64_t kCellsPerPoint = 4;  // empty cells cost time too
constexpr double kOutlierShare = 0.01;      // at each end of an axis

}  // namespace

void Grid::Measure(const double* rows, std::int64_t stride, std::span<const std::int32_t> alive) {
  for (int c = 0; c < 3; ++c) {
    Axis& axis = axes_[c];
    axis = {.component = c, .low = INFINITY, .high = -INFINITY};
    for (const std::int32_t i : alive) {
      axis.low = std::min(axis.low, rows[stride * i + c]);
      axis.high = std::max(axis.high, rows[stride * i + c]);
    }
    if (alive.empty()) axis.low = axis.high = 0;
  }
}

// Narrows each axis to what holds all but the outliers, and a margin.
void Grid::TrimOutliers(const double* rows, std::int64_t stride,
                        std::span<const std::int32_t> alive) {
  scratch_.resize(alive.size());
  const auto skip = static_cast<std::ptrdiff_t>(kOutlierShare * static_cast<double>(alive.size()));
  for (Axis& axis : axes_) {
    std::transform(alive.begin(), alive.end(), scratch_.begin(),
                   [&](std::int32_t i) { return rows[stride * i + axis.component]; });
    const auto low = scratch_.begin() + skip, high = scratch_.end() - 1 - skip;
    std::nth_element(scratch_.begin(), low, scratch_.end());
    const double low_value = *low;
    std::nth_element(scratch_.begin(), high, scratch_.end());
    const double margin = 0.1 * (*high - low_value);
    axis.low = std::max(axis.low, low_value - margin);
    axis.high = std::min(axis.high, *high + margin);
  }
}

std::int64_t Grid::SetCells(double cell_size) {
  inverse_size_ = 1 / cell_size;
  double total = 1;
  for (Axis& axis : axes_) {
    const double count = std::min((axis.high - axis.low) * inverse_size_, 1e6) + 1;
    axis.num_cells = static_cast<std::int64_t>(count);
    total *= static_cast<double>(axis.num_cells);
  }
  return static_cast<std::int64_t>(std::min(total, 1e18));
}

std::int64_t Grid::CellOf(const double* row) const {
  std::int64_t cell = 0;
  for (int a = 2; a >= 0; --a) {
    cell = cell * axes_[a].num_cells + CellAlong(axes_[a], row[axes_[a].component]);
  }
  return cell;
}

std::int64_t Grid::CellAlong(const Axis& axis, double coordinate) const {
  const double at = (coordinate - axis.low) * inverse_size_;
  const auto last = static_cast<double>(axis.num_cells - 1);
  return static_cast<std::int64_t>(std::clamp(at, 0.0, last));
}

void Grid::Build(const double* rows, std::int64_t stride, std::span<const std::int32_t> alive,
                 double reach, Team& team) {
  const auto num_points = static_cast<std::int64_t>(alive.size());
  const std::int64_t limit = kCellsPerPoint * num_points + 64;
  // The factor: so that rounding does not put neighbours two cells apart.
  double size = num_points == 0 ? 1.0 : reach * (1 + 1e-9);
  Measure(rows, stride, alive);
  if (SetCells(size) > limit) TrimOutliers(rows, stride, alive);
  while (SetCells(size) > limit) size *= 1.25;
  std::sort(axes_.begin(), axes_.end(), [](const Axis& a, const Axis& b) {
    return std::tie(a.num_cells, a.component) < std::tie(b.num_cells, b.component);
  });

  const std::int64_t num_cells = axes_[0].num_cells * axes_[1].num_cells * axes_[2].num_cells;
  start_.assign(num_cells + 1, 0);
  unsorted_.resize(num_points);
  team.ForParts(num_points, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      unsorted_[k] = static_cast<std::int32_t>(CellOf(rows + stride * alive[k]));
    }
  });
  for (const std::int32_t cell : unsorted_) ++start_[cell + 1];
  for (std::int64_t c = 0; c < num_cells; ++c) start_[c + 1] += start_[c];
  order_.resize(num_points);
  cell_of_.resize(num_points);
  for (std::int64_t k = 0; k < num_points; ++k) {
    const std::int32_t place = start_[unsorted_[k]]++;
    order_[place] = alive[k];
    cell_of_[place] = unsorted_[k];
  }
  for (std::int64_t c = num_cells; c > 0; --c) start_[c] = start_[c - 1];
  start_[0] = 0;
}

IndexRange Grid::Cells(std::int64_t row_start, std::int64_t from, std::int64_t to) const {
  return {start_[row_start + from], start_[row_start + to + 1]};
}

std::array<IndexRange, 5> Grid::LaterNeighbors(std::int64_t i) const {
  const std::int64_t n0 = axes_[0].num_cells, n1 = axes_[1].num_cells, n2 = axes_[2].num_cells;
  const std::int64_t cell = cell_of_[i];
  const std::int64_t c0 = cell % n0, c1 = cell / n0 % n1, c2 = cell / n0 / n1;
  const std::int64_t from = std::max<std::int64_t>(c0 - 1, 0), to = std::min(c0 + 1, n0 - 1);
  std::array<IndexRange, 5> ranges{};
  ranges[0] = {i + 1, Cells(cell - c0, c0, to).end};
  if (c1 + 1 < n1) ranges[1] = Cells(cell - c0 + n0, from, to);
  if (c2 + 1 < n2) {
    const std::int64_t above = cell - c0 + n0 * n1;
    if (c1 > 0) ranges[2] = Cells(above - n0, from, to);
    ranges[3] = Cells(above, from, to);
    if (c1 + 1 < n1) ranges[4] = Cells(above + n0, from, to);
  }
  return ranges;
}

}  // namespace talus::engine
