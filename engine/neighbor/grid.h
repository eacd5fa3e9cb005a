// Sorts points into cells, so that those near one point lie in a few contiguous ranges.
//
// Cells are at least `reach` wide, so that whatever is nearer than `reach` is in the same cell or
// one that touches it. They are numbered along the shortest sides of the cloud first: the points
// between a point and its neighbours are then few, and the memory that a sweep keeps in use is
// small.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/threads/team.h"

namespace talus::engine {

struct IndexRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

class Grid {
 public:
  // Sorts the points `alive` of rows {x, y, z, …}, `stride` numbers apart. Points far from all
  // others are put into the outermost cells, so that they do not make the cells large.
  void Build(const double* rows, std::int64_t stride, std::span<const std::int32_t> alive,
             double reach, Team& team);

  // Index in `rows` of each point, cell after cell; points of one cell in the order of `alive`.
  std::span<const std::int32_t> order() const { return order_; }

  // The points after the i-th sorted one that may be nearer to it than `reach`.
  std::array<IndexRange, 5> LaterNeighbors(std::int64_t i) const;

  std::int64_t num_cells() const { return static_cast<std::int64_t>(start_.size()) - 1; }
  std::int64_t CellOfSorted(std::int64_t i) const { return cell_of_[i]; }

  // Calls visit(cell) for every cell that a cube of half width `half` around `point` meets.
  template <class Visitor>
  void VisitBox(const double* point, double half, Visitor&& visit) const {
    VisitRows(point, half, [&](std::int64_t row_start, std::int64_t from, std::int64_t to) {
      for (std::int64_t c = from; c <= to; ++c) visit(row_start + c);
    });
  }

  // Calls visit(range) for the points in those cells, row by row.
  template <class Visitor>
  void VisitInBox(const double* point, double half, Visitor&& visit) const {
    VisitRows(point, half, [&](std::int64_t row_start, std::int64_t from, std::int64_t to) {
      visit(Cells(row_start, from, to));
    });
  }

  // Calls visit(range) for the points in those cells that may come after the i-th sorted one.
  template <class Visitor>
  void VisitLaterInBox(std::int64_t i, const double* point, double half, Visitor&& visit) const {
    VisitRows(point, half, [&](std::int64_t row_start, std::int64_t from, std::int64_t to) {
      const IndexRange range = Cells(row_start, from, to);
      if (range.end > i + 1) visit(range);
    });
  }

 private:
  struct Axis {
    int component = 0;  // 0, 1, 2 for x, y, z
    double low = 0;     // [m]
    double high = 0;    // [m]
    std::int64_t num_cells = 1;
  };

  void Measure(const double* rows, std::int64_t stride, std::span<const std::int32_t> alive);
  void TrimOutliers(const double* rows, std::int64_t stride, std::span<const std::int32_t> alive);
  std::int64_t SetCells(double cell_size);
  std::int64_t CellOf(const double* row) const;
  std::int64_t CellAlong(const Axis& axis, double coordinate) const;

  // Calls visit(row_start, from, to) for each row of cells along the first axis that the cube
  // meets.
  template <class Visitor>
  void VisitRows(const double* point, double half, Visitor&& visit) const {
    std::array<std::int64_t, 3> from{}, to{};
    for (int a = 0; a < 3; ++a) {
      const double at = point[axes_[a].component];
      from[a] = CellAlong(axes_[a], at - half * (1 + 1e-9));
      to[a] = CellAlong(axes_[a], at + half * (1 + 1e-9));
    }
    for (std::int64_t c2 = from[2]; c2 <= to[2]; ++c2) {
      for (std::int64_t c1 = from[1]; c1 <= to[1]; ++c1) {
        visit((c2 * axes_[1].num_cells + c1) * axes_[0].num_cells, from[0], to[0]);
      }
    }
  }
  IndexRange Cells(std::int64_t row_start, std::int64_t from, std::int64_t to) const;

  std::array<Axis, 3> axes_;  // the first runs fastest
  double inverse_size_ = 0;   // [1/m]
  std::vector<std::int32_t> order_;
  std::vector<std::int32_t> cell_of_;   // of each sorted point
  std::vector<std::int32_t> start_;     // of each cell in `order_`, and the end
  std::vector<std::int32_t> unsorted_;  // cell of each point of `alive`
  std::vector<double> scratch_;
};

}  // namespace talus::engine
