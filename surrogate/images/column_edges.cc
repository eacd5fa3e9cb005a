#include "surrogate/images/column_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "surrogate/images/normal_table.h"

namespace talus::surrogate {
namespace {

constexpr double kReach = 4;       // widths from the edge beyond which a pixel is black or white
constexpr double kNoEdge = 3;      // widths inside the image an edge must lie to be measured
constexpr double kMinWidth = 0.2;  // [px]: sharper than pixels can tell

// One column of a field from the bottom up.
Eigen::MatrixXd Columns(std::span<const float> field, const FieldSize& size) {
  Eigen::MatrixXd columns(size.height, size.width);
  for (int row = 0; row < size.height; ++row) {
    const auto start = static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width);
    for (int c = 0; c < size.width; ++c) {
      columns(size.height - 1 - row, c) = field[start + static_cast<std::size_t>(c)];
    }
  }
  return columns;
}

// The pixels of a column that are neither black nor white.
struct Band {
  int low = 0;
  int high = 0;  // one past the last
};

Band GreyBand(double height, double width, int num_rows) {
  const double reach = kReach * width;
  return {.low = static_cast<int>(std::clamp(std::floor(height - reach), 0.0, 1.0 * num_rows)),
          .high = static_cast<int>(std::clamp(std::ceil(height + reach), 0.0, 1.0 * num_rows))};
}

double AreaOf(double height, double width, int num_rows) {
  const Band band = GreyBand(height, width, num_rows);
  double area = band.low;
  for (int r = band.low; r < band.high; ++r) area += NormalTable::Cdf((height - r - 0.5) / width);
  return area;
}

// The height at which a column of this edge width has this area; near the bottom that is not the
// area itself, since the edge is cut there.
double HeightOf(double area, double width, int num_rows) {
  double low = -kNoEdge * width;
  double high = num_rows + kNoEdge * width;
  if (area > kNoEdge * width && area < num_rows - kNoEdge * width) return area;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (AreaOf(middle, width, num_rows) < area ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Columns whose edge is cut take the width of the nearest whole one.
void FillFromNeighbours(const std::vector<bool>& known, Eigen::VectorXd& width) {
  const auto size = static_cast<int>(width.size());
  const Eigen::VectorXd given = width;
  for (int c = 0; c < size; ++c) {
    for (int distance = 0; distance < size; ++distance) {
      const int left = c - distance;
      const int right = c + distance;
      const bool has_left = left >= 0 && known[static_cast<std::size_t>(left)];
      const bool has_right = right < size && known[static_cast<std::size_t>(right)];
      if (!has_left && !has_right) continue;
      width[c] = has_left && has_right ? 0.5 * (given[left] + given[right])
                                       : given[has_left ? left : right];
      break;
    }
  }
}

}  // namespace

ColumnEdges FitEdges(std::span<const float> field, const FieldSize& size) {
  const Eigen::MatrixXd columns = Columns(field, size);
  const Eigen::VectorXd area = columns.colwise().sum();
  const Eigen::VectorXd grey = (columns.array() * (1 - columns.array())).colwise().sum();
  ColumnEdges edges{.height = area,
                    .width = (std::sqrt(std::numbers::pi) * grey).cwiseMax(kMinWidth)};
  std::vector<bool> known(static_cast<std::size_t>(size.width));
  for (int c = 0; c < size.width; ++c) {
    const double margin = kNoEdge * edges.width[c] + 0.5;
    known[static_cast<std::size_t>(c)] = area[c] > margin && area[c] < size.height - margin;
  }
  if (std::find(known.begin(), known.end(), true) == known.end()) {
    edges.width.setConstant(1);
  } else {
    FillFromNeighbours(known, edges.width);
  }
  for (int c = 0; c < size.width; ++c) {
    edges.height[c] = HeightOf(area[c], edges.width[c], size.height);
  }
  return edges;
}

std::vector<float> Render(const ColumnEdges& edges, const FieldSize& size) {
  std::vector<float> field(static_cast<std::size_t>(size.num_pixels()));
  for (int row = 0; row < size.height; ++row) {
    const double y = size.height - row - 0.5;
    for (int c = 0; c < size.width; ++c) {
      field[static_cast<std::size_t>(row * size.width + c)] =
          static_cast<float>(NormalTable::Cdf((edges.height[c] - y) / edges.width[c]));
    }
  }
  return field;
}

EdgeSad::EdgeSad(std::span<const float> target, const FieldSize& size)
    : size_(size), target_(Columns(target, size)), cumulative_(size.height + 1, size.width) {
  cumulative_.row(0).setZero();
  for (int r = 0; r < size.height; ++r) {
    cumulative_.row(r + 1) = cumulative_.row(r) + target_.row(r);
  }
}

// Below the grey band the image is 1, above it 0.
double EdgeSad::Column(Eigen::Index column, double height, double width) const {
  const Band band = GreyBand(height, width, size_.height);
  const double* target = &target_(0, column);
  const double* below = &cumulative_(0, column);
  double sum = band.low - below[band.low] + below[size_.height] - below[band.high];
  const double inverse = 1 / width;
  double t = (height - band.low - 0.5) * inverse;
  for (int r = band.low; r < band.high; ++r, t -= inverse) {
    sum += std::abs(NormalTable::Cdf(t) - target[r]);
  }
  return sum;
}

double EdgeSad::Of(const ColumnEdges& edges) const {
  double sum = 0;
  for (Eigen::Index c = 0; c < edges.height.size(); ++c) {
    sum += Column(c, edges.height[c], edges.width[c]);
  }
  return sum;
}

double EdgeSad::Expected(const ColumnEdges& edges, const Eigen::VectorXd& variance) const {
  // Means of the sixths of a normal distribution, in standard deviations. |h - target| has a kink,
  // where polynomial rules fail (five Gauss–Hermite nodes are 17 % low); these are exact for a kink
  // at the mean.
  constexpr std::array kNodes{0.212040, 0.682358, 1.499248};
  double sum = 0;
  for (Eigen::Index c = 0; c < edges.height.size(); ++c) {
    const double sd = std::sqrt(variance[c]);
    for (const double node : kNodes) {
      sum += (Column(c, edges.height[c] + node * sd, edges.width[c]) +
              Column(c, edges.height[c] - node * sd, edges.width[c])) /
             (2 * kNodes.size());
    }
  }
  return sum;
}

}  // namespace talus::surrogate
