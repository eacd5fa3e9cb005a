#include "surrogate/images/column_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "surrogate/images/normal_table.h"

namespace talus::surrogate {
namespace {

constexpr double kReach = 4;   // widths from the edge beyond which a pixel is black or white
constexpr double kNoEdge = 3;  // widths inside the image an edge must lie to be measured
// A column without powder has no edge: it is given one that is white all the same, and equal in all
// images, so that it tells nothing.
constexpr double kEmptyWidth = 1;    // [px]
constexpr double kEmptyHeight = -3;  // [px], above the floor
constexpr double kFaint = 0.5;       // [px]: less powder than this counts the less for the width

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

struct Column {
  const Vessel& vessel;
  Eigen::Index index = 0;
  int num_rows = 0;
};

double AreaOf(const Column& column, double height, double width) {
  const Band band = GreyBand(height, width, column.num_rows);
  double area = column.vessel.OpenBelow(band.low, column.index);
  for (int r = band.low; r < band.high; ++r) {
    area += column.vessel.Open(r, column.index) * NormalTable::Cdf((height - r - 0.5) / width);
  }
  return area;
}

// The height at which a column of this edge width has this area; near the floor that is not the
// area above it, since the edge is cut there. Not below that of an empty column.
double HeightOf(const Column& column, double area, double width) {
  const double floor = column.vessel.Floor(column.index);
  const double margin = kNoEdge * width;
  if (area > margin && area + floor < column.num_rows - margin) return area + floor;
  double low = floor + kEmptyHeight;
  double high = column.num_rows + margin;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (AreaOf(column, middle, width) < area ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Columns whose edge is cut take the width of the nearest whole one, as far as there is powder.
void FillFromNeighbours(const std::vector<bool>& known, const Eigen::VectorXd& area,
                        Eigen::VectorXd& width) {
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
    if (known[static_cast<std::size_t>(c)]) continue;
    width[c] = std::lerp(kEmptyWidth, width[c], std::min(1.0, area[c] / kFaint));
  }
}

}  // namespace

ColumnEdges FitEdges(std::span<const float> field, const FieldSize& size, const Vessel& vessel) {
  const Eigen::MatrixXd columns = Columns(field, size);
  const Eigen::VectorXd area = columns.colwise().sum();
  const Eigen::VectorXd grey =
      (columns.array() * (vessel.open().array() - columns.array())).colwise().sum();
  ColumnEdges edges{.height = area,
                    .width = (std::sqrt(std::numbers::pi) * grey).cwiseMax(kSharpestEdge)};
  std::vector<bool> known(static_cast<std::size_t>(size.width));
  for (int c = 0; c < size.width; ++c) {
    const double margin = kNoEdge * edges.width[c] + 0.5;
    known[static_cast<std::size_t>(c)] =
        area[c] > margin && area[c] + vessel.Floor(c) < size.height - margin;
  }
  if (std::find(known.begin(), known.end(), true) == known.end()) {
    edges.width.setConstant(1);
  } else {
    FillFromNeighbours(known, area, edges.width);
  }
  for (int c = 0; c < size.width; ++c) {
    edges.height[c] = HeightOf({vessel, c, size.height}, area[c], edges.width[c]);
  }
  return edges;
}

std::vector<float> Render(const ColumnEdges& edges, const FieldSize& size, const Vessel& vessel) {
  std::vector<float> field(static_cast<std::size_t>(size.num_pixels()));
  for (int row = 0; row < size.height; ++row) {
    const int up = size.height - 1 - row;
    const double y = size.height - row - 0.5;
    for (int c = 0; c < size.width; ++c) {
      field[static_cast<std::size_t>(row * size.width + c)] = static_cast<float>(
          vessel.Open(up, c) * NormalTable::Cdf((edges.height[c] - y) / edges.width[c]));
    }
  }
  return field;
}

EdgeSad::EdgeSad(std::span<const float> target, const FieldSize& size, const Vessel& vessel)
    : size_(size),
      vessel_(vessel),
      target_(Columns(target, size)),
      cumulative_(size.height + 1, size.width) {
  cumulative_.row(0).setZero();
  for (int r = 0; r < size.height; ++r) {
    cumulative_.row(r + 1) = cumulative_.row(r) + target_.row(r);
  }
}

// Below the grey band the image is as bright as the vessel lets it be, which is no less than the
// target; above it 0.
double EdgeSad::Column(Eigen::Index column, double height, double width) const {
  const Band band = GreyBand(height, width, size_.height);
  const double* target = &target_(0, column);
  const double* below = &cumulative_(0, column);
  const double* open = &vessel_.open()(0, column);
  double sum = vessel_.OpenBelow(band.low, column) - below[band.low] + below[size_.height] -
               below[band.high];
  const NormalTable& normal = NormalTable::Get();
  const double inverse = 1 / width;
  double t = (height - band.low - 0.5) * inverse;
  for (int r = band.low; r < band.high; ++r, t -= inverse) {
    sum += std::abs(open[r] * normal(t) - target[r]);
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
