#include "imaging/photos/plate/edge_blur.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::imaging {
namespace {

constexpr int kReach = 30;  // to either side of an edge [px]
constexpr int kSteps = 4;   // a pixel

// Linear between the centres of a row's pixels, the last ones beyond.
double At(const RelativeImage& image, double x, int row) {
  const double clamped = std::clamp(x - 0.5, 0.0, image.width - 1.0);
  const int column = std::min(static_cast<int>(clamped), image.width - 2);
  const double right = clamped - column;
  return (1 - right) * image.at(column, row) + right * image.at(column + 1, row);
}

// Mean brightness of both sides against the way outwards, from -reach to reach.
std::vector<double> MeanEdge(const RelativeImage& image, const StraightSides& plate, int reach) {
  std::vector<double> edge;
  for (int step = -reach * kSteps; step <= reach * kSteps; ++step) {
    const double out = static_cast<double>(step) / kSteps;
    double sum = 0;
    for (int row = plate.first + kTrimmed; row <= plate.last - kTrimmed; ++row) {
      sum += At(image, plate.LeftAt(row) - out, row) + At(image, plate.RightAt(row) + out, row);
    }
    edge.push_back(sum);
  }
  return edge;
}

// How far from the edge, in the middle of `edge`, its brightness passes `level` [px]; `way` 1 goes
// outwards, -1 inwards.
double Passes(const std::vector<double>& edge, double level, int way) {
  const auto side = [&](int i) { return way * (edge[static_cast<std::size_t>(i)] - level); };
  const int middle = static_cast<int>(edge.size()) / 2;
  int i = middle;
  while (i + way >= 0 && i + way < static_cast<int>(edge.size()) && side(i) < 0) i += way;
  if (i == middle) return 0;
  return (std::abs(i - middle) - side(i) / (side(i) - side(i - way))) / kSteps;
}

}  // namespace

double EdgeBlur(const RelativeImage& image, const StraightSides& plate) {
  const int reach = std::min(kReach, static_cast<int>(plate.width() / 4));
  const std::vector<double> edge = MeanEdge(image, plate, reach);
  const double dark = edge.front();
  const double light = edge.back();
  const double apart =
      Passes(edge, 0.25 * dark + 0.75 * light, 1) + Passes(edge, 0.75 * dark + 0.25 * light, -1);
  constexpr double kQuartiles = 1.349;  // of a normal distribution, from one to the other
  return apart / kQuartiles;
}

}  // namespace talus::imaging
