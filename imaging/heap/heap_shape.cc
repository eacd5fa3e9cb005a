#include "imaging/heap/heap_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace talus::imaging {
namespace {

// The lowest row is left out: an error of the baseline below half a pixel falls into it.
constexpr double kFootLow = 1.0;    // [px]
constexpr double kFootHigh = 8.0;   // [px]
constexpr double kFootShare = 0.2;  // of the heap's height, where that is more
constexpr double kTipWidth = 0.02;  // a flat top narrower than this / base width is a tip
constexpr double kBroadTop = 0.5;   // an upright cake is broader than this / base near its top,
constexpr double kUpright = 0.1;    // grows by less than this / base below that,
constexpr double kSteep = 0.2;      // and loses less than this / height of its width half-way down
constexpr double kStraightGrowth = 4 / 3.0;  // between 1 (round) and 5/3 (straight), see Top

// Least squares of the row ends over height, a parabola extended to the baseline: it follows a
// slope that bends near its foot, and over so many rows the extension is still sure to a fraction
// of a pixel.
template <class End>
double Foot(const std::vector<RowExtent>& rows, double height, End end) {
  const double high = std::max(kFootHigh, kFootShare * height);
  std::vector<const RowExtent*> used;
  for (const RowExtent& row : rows) {
    if (row.height >= kFootLow && row.height <= high) used.push_back(&row);
  }
  if (used.size() < 4) return end(rows.front());
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixX3d terms(n, 3);
  Eigen::VectorXd ends(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double h = used[static_cast<std::size_t>(i)]->height / high;
    terms.row(i) << 1, h, h * h;
    ends(i) = end(*used[static_cast<std::size_t>(i)]);
  }
  return terms.colPivHouseholderQr().solve(ends)(0);
}

struct Span {
  double left = 0;
  double right = 0;
  double width() const { return right - left; }
};

// Between which columns the outline is higher than `level`, linear between column centres.
Span SpanAbove(const std::vector<double>& height, double level) {
  const auto above = [level](double h) { return h >= level; };
  const auto first = std::find_if(height.begin(), height.end(), above) - height.begin();
  const auto last = height.rend() - std::find_if(height.rbegin(), height.rend(), above) - 1;
  const auto crossing = [&](std::ptrdiff_t inside, std::ptrdiff_t outside) {
    const auto size = static_cast<std::ptrdiff_t>(height.size());
    const double out =
        outside >= 0 && outside < size ? height[static_cast<std::size_t>(outside)] : 0;
    const double in = height[static_cast<std::size_t>(inside)];
    const double share = (in - level) / std::max(in - out, 1e-12);
    return static_cast<double>(inside) + 0.5 +
           static_cast<double>(outside - inside) * std::min(share, 1.0);
  };
  return {.left = crossing(first, first - 1), .right = crossing(last, last + 1)};
}

// Where the parabola through the columns of `span` has its vertex: the middle of a round top.
double VertexOf(const std::vector<double>& height, const Span& span) {
  const double middle = (span.left + span.right) / 2;
  double n = 0, s2 = 0, s4 = 0, h0 = 0, h1 = 0, h2 = 0;
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double x = static_cast<double>(i) + 0.5 - middle;
    if (std::abs(x) > span.width() / 2) continue;
    n += 1;
    s2 += x * x;
    s4 += x * x * x * x;
    h0 += height[i];
    h1 += x * height[i];
    h2 += x * x * height[i];
  }
  const double curvature = (n * h2 - s2 * h0) / (n * s4 - s2 * s2);
  const double vertex = -h1 / s2 / (2 * curvature);  // the odd sums are 0, or nearly
  const bool within = curvature < 0 && std::abs(vertex) < span.width() / 4;
  return within ? middle + vertex : middle;
}

struct Top {
  double axis = 0;
  double height = 0;
  double flat_width = 0;  // 0 unless flat
};

// The widths at depths d, 4d and 9d below the top tell its form: on straight slopes they grow by
// 3 : 5, on a round top, where width ~ √depth, by 1 : 1.
Top FindTop(const Outline& outline, double base_width) {
  const double height = *std::max_element(outline.height.begin(), outline.height.end());
  const double depth = std::min(std::max(1.0, 0.02 * height), height / 10);  // [px]
  const Span near = SpanAbove(outline.height, height - depth);
  const Span mid = SpanAbove(outline.height, height - 4 * depth);
  const Span far = SpanAbove(outline.height, height - 9 * depth);
  // A cake that stands upright, under a top that may be bumpy, is all top: it has no slope.
  const Span half = SpanAbove(outline.height, height / 2);
  if (mid.width() > kBroadTop * base_width && far.width() - mid.width() < kUpright * base_width &&
      base_width - half.width() < kSteep * height) {
    return {.axis = (half.left + half.right) / 2, .height = height, .flat_width = 2 * base_width};
  }
  const Top round{.axis = VertexOf(outline.height, mid), .height = height};
  if (far.width() - mid.width() < kStraightGrowth * (mid.width() - near.width())) return round;
  const Span top{.left = near.left + (near.left - mid.left) / 3,
                 .right = near.right + (near.right - mid.right) / 3};
  if (top.width() > kTipWidth * base_width) {
    return {.axis = (top.left + top.right) / 2, .height = height, .flat_width = top.width()};
  }
  const double growth = (mid.width() - near.width()) / (3 * depth);  // of the width with depth
  if (!(top.width() > 0) || !(growth > 0)) return round;
  const double lost = top.width() / growth;  // height of the rounded tip
  const double left_growth = (near.left - mid.left) / (3 * depth);
  return {.axis = top.left + left_growth * lost, .height = height + lost};
}

// Columns of one side, `direction` -1 left or +1 right.
Slope MakeSlope(const Outline& outline, const Top& top, double foot_column, int direction) {
  Slope slope{
      .foot = direction * (foot_column - top.axis), .shoulder = top.flat_width / 2, .points = {}};
  for (std::size_t i = 0; i < outline.height.size(); ++i) {
    const double across = direction * (static_cast<double>(i) + 0.5 - top.axis);
    if (across < slope.shoulder || across > slope.foot) continue;
    slope.points.push_back({.across = across, .height = outline.height[i]});
  }
  return slope;
}

}  // namespace

HeapShape FindHeapShape(const Outline& outline) {
  const double height = *std::max_element(outline.height.begin(), outline.height.end());
  const double left = Foot(outline.rows, height, [](const RowExtent& row) { return row.left; });
  const double right = Foot(outline.rows, height, [](const RowExtent& row) { return row.right; });
  const Top top = FindTop(outline, right - left);
  return {.axis = top.axis,
          .height = top.height,
          .left = MakeSlope(outline, top, left, -1),
          .right = MakeSlope(outline, top, right, +1)};
}

Overhang FindOverhang(const Outline& outline) {
  Overhang overhang;
  if (outline.empty()) return overhang;
  double innermost_left = outline.rows.front().left;
  double innermost_right = outline.rows.front().right;
  for (const RowExtent& row : outline.rows) {
    innermost_left = std::max(innermost_left, row.left);
    innermost_right = std::min(innermost_right, row.right);
    overhang.left = std::max(overhang.left, innermost_left - row.left);
    overhang.right = std::max(overhang.right, row.right - innermost_right);
  }
  return overhang;
}

Overhang WorstOverhang(const Outline& one, const Outline& other) {
  const Overhang a = FindOverhang(one);
  const Overhang b = FindOverhang(other);
  return {.left = std::max(a.left, b.left), .right = std::max(a.right, b.right)};
}

}  // namespace talus::imaging
