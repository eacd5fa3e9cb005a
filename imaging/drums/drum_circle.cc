#include "imaging/drums/drum_circle.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <vector>

#include "base/error.h"
#include "imaging/light/backlight.h"

namespace talus::imaging {
namespace {

constexpr int kNumRays = 720;
constexpr double kLeastStep = 60;       // of an edge, in a picture of usual contrast [grey levels]
constexpr double kLeastShare = 0.4;     // of an edge / the picture's contrast, where that is low
constexpr double kNoise = 16;           // a lower step may be the camera's noise [grey levels]
constexpr int kShortestEdge = 3;        // length over which an edge is looked for [px]
constexpr double kEdgeShare = 0.005;    // the same / shorter side: large pictures are blurred more
constexpr int kLongestEdge = 5;         // lengths that a blurred edge may have
constexpr double kStillRising = 1;      // from pixel to pixel of one edge [grey levels]
constexpr double kMarch = 0.25;         // in which half-way is looked for [px]
constexpr double kOnCircle = 0.01;      // how far a point may lie off the circle / its radius
constexpr double kLeastOn = 0.5;        // share of the rays whose point lies on it
constexpr double kMostBeyond = 0.01;    // how far it may reach out of the picture / its radius
constexpr double kSmallestShare = 0.2;  // radius / shorter side of the picture

struct Point {
  double x = 0;  // [px]
  double y = 0;
};

// What counts as an edge.
struct EdgeRule {
  int length = kShortestEdge;      // [px]
  double least_step = kLeastStep;  // [grey levels over the length]
};

EdgeRule RuleFor(const GrayImage& photo) {
  const TwoClasses classes =
      SplitByOtsu(std::vector<float>(photo.pixels.begin(), photo.pixels.end()));
  const double shorter = std::min(photo.width, photo.height);
  return {
      .length = std::max(kShortestEdge, static_cast<int>(kEdgeShare * shorter)),
      .least_step = std::clamp(kLeastShare * (classes.light - classes.dark), kNoise, kLeastStep)};
}

// The outermost edge along a ray from the middle, where the level is half-way.
std::optional<Point> OutermostEdge(const GrayImage& photo, double angle, const EdgeRule& edge) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double x0 = photo.width / 2.0, y0 = photo.height / 2.0;
  const auto level = [&](double way) {
    return static_cast<double>(
        photo.at(static_cast<int>(x0 + way * c), static_cast<int>(y0 + way * s)));
  };
  const double reach = std::min(x0 / std::max(std::abs(c), 1e-9), y0 / std::max(std::abs(s), 1e-9));
  for (double way = reach - 1; way > edge.length; way -= 1) {
    const double outside = level(way);
    const auto step = [&](double to) { return std::abs(level(to) - outside); };
    double to = way - edge.length;
    if (step(to) < edge.least_step) continue;
    // A blurred edge goes on inwards, and half-way is half of all of it.
    const double farthest = std::max(1.0, way - kLongestEdge * edge.length);
    while (to > farthest && step(to - 1) > step(to) + kStillRising) to -= 1;
    const double half = (level(to) + outside) / 2;
    double at = way;
    while (at > to && (level(at) > half) == (outside > half)) at -= kMarch;
    at += kMarch / 2;
    return Point{.x = x0 + at * c, .y = y0 + at * s};
  }
  return std::nullopt;
}

// Least squares of x² + y² = 2 a x + 2 b y + c, which is linear in a, b, c.
DrumCircle FitCircle(const std::vector<Point>& points) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Point& p : points) {
    const Eigen::Vector3d row(2 * p.x, 2 * p.y, 1);
    normal += row * row.transpose();
    right += row * (p.x * p.x + p.y * p.y);
  }
  const Eigen::Vector3d abc = normal.ldlt().solve(right);
  return {.center_x = abc[0],
          .center_y = abc[1],
          .radius = std::sqrt(abc[2] + abc[0] * abc[0] + abc[1] * abc[1])};
}

std::vector<Point> OnCircle(const std::vector<Point>& points, const DrumCircle& circle,
                            double tolerance) {
  std::vector<Point> on;
  for (const Point& p : points) {
    const double off = std::hypot(p.x - circle.center_x, p.y - circle.center_y) - circle.radius;
    if (std::abs(off) <= tolerance * circle.radius) on.push_back(p);
  }
  return on;
}

// A cut drum's fill would be that of a part of it.
void RequireWhole(const DrumCircle& circle, const GrayImage& photo, const std::string& name) {
  const double inside = std::min({circle.center_x, circle.center_y, photo.width - circle.center_x,
                                  photo.height - circle.center_y});
  const double beyond = circle.radius - inside;
  if (beyond <= kMostBeyond * circle.radius) return;
  throw base::ConfigError(name + ": its drum reaches " + std::to_string(std::lround(beyond)) +
                          " px out of the picture; the whole ring must be in it");
}

// A smaller circle may be something in the drum, or beside it.
void RequireLarge(const DrumCircle& circle, const GrayImage& photo, const std::string& name) {
  const int side = std::min(photo.width, photo.height);
  if (circle.radius >= kSmallestShare * side) return;
  throw base::ConfigError(name + ": its largest circle is " +
                          std::to_string(std::lround(2 * circle.radius)) + " px across, of " +
                          std::to_string(side) +
                          " px of the picture's shorter side; a drum must be four tenths of it at "
                          "least: cut the picture down to the drum");
}

}  // namespace

DrumCircle FindDrumCircle(const GrayImage& photo, const std::string& name) {
  const EdgeRule edge = RuleFor(photo);
  std::vector<Point> points;
  for (int ray = 0; ray < kNumRays; ++ray) {
    const auto point = OutermostEdge(photo, 2 * std::numbers::pi * ray / kNumRays, edge);
    if (point) points.push_back(*point);
  }
  DrumCircle circle;
  std::vector<Point> on = points;
  for (const double tolerance : {0.1, 0.05, 0.02, kOnCircle, kOnCircle}) {
    if (on.size() < kLeastOn * kNumRays) break;
    circle = FitCircle(on);
    on = OnCircle(points, circle, tolerance);
  }
  if (on.size() < kLeastOn * kNumRays) {
    throw base::ConfigError(name +
                            ": no drum found: no circle around most of the picture's middle; the "
                            "whole ring must be in the picture, near its middle, and differ from "
                            "what is around it");
  }
  RequireWhole(circle, photo, name);
  RequireLarge(circle, photo, name);
  return circle;
}

}  // namespace talus::imaging
