#include "experiments/rigs/phased/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/line_fit.h"
#include "base/units.h"

namespace talus::rigs {

std::vector<SurfacePoint> SurfaceOf(std::span<const engine::Particle> grains,
                                    const SurfaceStrips& strips) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const double span = strips.to - strips.from;
  if (!(span > 0) || !(strips.width > 0)) return {};
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(span / strips.width));
  const double width = span / static_cast<double>(count);
  std::vector<double> top(count, kNone);
  for (const engine::Particle& p : grains) {
    const double at = (p.position.x - strips.from) / width;
    if (at < 0 || at >= static_cast<double>(count)) continue;
    double& highest = top[static_cast<std::size_t>(at)];
    highest = std::max(highest, p.position.z + p.radius);
  }
  std::vector<SurfacePoint> surface;
  for (std::size_t i = 0; i < count; ++i) {
    if (top[i] == kNone) continue;
    surface.push_back({.x = strips.from + width * (static_cast<double>(i) + 0.5), .top = top[i]});
  }
  return surface;
}

double EndOfLayer(std::span<const engine::Particle> grains, double from, double width,
                  double diameter) {
  constexpr double kLeast = 0.2;  // thickness of solid, in diameters
  struct Strip {
    double volume = 0;
    double end = 0;  // the farthest edge of its grains
  };
  std::vector<Strip> strips;
  for (const engine::Particle& p : grains) {
    const double at = (p.position.x - from) / diameter;
    if (!(at >= 0)) continue;
    const auto k = static_cast<std::size_t>(at);
    if (k >= strips.size()) strips.resize(k + 1);
    strips[k].volume += 4.0 / 3 * std::numbers::pi * p.radius * p.radius * p.radius;
    strips[k].end = std::max(strips[k].end, p.position.x + p.radius);
  }
  double end = from;
  for (const Strip& strip : strips) {
    if (strip.volume < kLeast * diameter * diameter * width) break;
    end = std::max(end, strip.end);
  }
  return end;
}

bool IsLessThanALayer(std::span<const engine::Particle> grains, const LayerOnFloor& layer,
                      double near_gate) {
  double all = 0;  // R³
  double out = 0;
  double beyond = 0;
  for (const engine::Particle& p : grains) {
    const double cube = p.radius * p.radius * p.radius;
    all += cube;
    if (p.position.x > layer.begin) out += cube;
    if (p.position.x > layer.end) beyond += cube;
  }
  return out > near_gate * all / 2 && beyond > out / 2;
}

namespace {

bool HasSunk(const SurfacePoint& point, const FormerBed& bed) {
  constexpr double kUnmoved = 0.9;
  return point.top <= bed.floor + kUnmoved * bed.height;
}

}  // namespace

std::vector<SurfacePoint> Sunken(std::vector<SurfacePoint> surface, const FormerBed& bed) {
  std::erase_if(surface, [&](const SurfacePoint& p) { return !HasSunk(p, bed); });
  return surface;
}

std::optional<double> EndOfUnmoved(std::span<const SurfacePoint> surface, const FormerBed& bed) {
  const auto last = std::find_if(surface.rbegin(), surface.rend(),
                                 [&](const auto& p) { return !HasSunk(p, bed); });
  return last == surface.rend() ? std::nullopt : std::optional(last->x);
}

std::optional<double> SlopeOf(std::span<const SurfacePoint> surface) {
  if (surface.size() < 3) return std::nullopt;
  base::LineFit fit;
  for (const SurfacePoint& p : surface) fit.Add(p.x, p.top);
  return fit.Slope();
}

Reading AngleOf(Observable observable, std::span<const SurfacePoint> surface) {
  Reading angle{observable};
  if (const auto slope = SlopeOf(surface)) {
    angle.value = SlopeAngle(std::abs(*slope));
  } else {
    angle.undefined = "the slope is fewer than three grains long";
  }
  return angle;
}

double MassQuantile(std::span<const engine::Particle> grains, double share,
                    const std::function<double(const engine::Particle&)>& place) {
  std::vector<std::pair<double, double>> sorted;  // place, R³
  double total = 0;
  for (const engine::Particle& p : grains) {
    sorted.emplace_back(place(p), p.radius * p.radius * p.radius);
    total += sorted.back().second;
  }
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const auto& [at, cube] : sorted) {
    sum += cube;
    if (sum >= share * total) return at;
  }
  return 0;
}

double SlopeAngle(double slope) { return std::atan(slope) / base::kDegree; }

}  // namespace talus::rigs
