// The surface of a bed that is seen from the front: its top over x, and its slope.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::rigs {

struct SurfacePoint {
  double x = 0;    // [m]
  double top = 0;  // height of the highest grain there [m]
};

// In strips of `width` [m] from `from` to `to` [m]; strips without grains are left out.
struct SurfaceStrips {
  double from = 0;
  double to = 0;
  double width = 0;
};
std::vector<SurfacePoint> SurfaceOf(std::span<const engine::Particle> grains,
                                    const SurfaceStrips& strips);

// Where a bed stood before the powder flowed.
struct FormerBed {
  double floor = 0;   // [m]
  double height = 0;  // above it [m]
};

// Where a layer ends that begins at `from` and runs out along x over a floor of this width [m]: the
// farthest edge of its grains, as far as every strip of a mean diameter holds a fifth of a diameter
// of solid, half of what a loose single layer does. `from` where there is none. Single grains that
// have rolled on are no layer.
double EndOfLayer(std::span<const engine::Particle> grains, double from, double width,
                  double diameter);

// Whether a powder ran out to less than a layer, which lies on the floor between these places: more
// than half of what could leave is beyond where it begins, and more than half of that beyond its
// end. A runout read to that end would be the shorter the farther the powder has run. `near_gate`:
// the share of all powder that was within the column's height of the gate, 0 to 1; of a long column
// no more leaves than its face.
struct LayerOnFloor {
  double begin = 0;  // [m]
  double end = 0;    // [m]
};
bool IsLessThanALayer(std::span<const engine::Particle> grains, const LayerOnFloor& layer,
                      double near_gate);

// What lies below nine tenths of the former height: the rest has not moved, and is no slope.
std::vector<SurfacePoint> Sunken(std::vector<SurfacePoint> surface, const FormerBed& bed);

// x of the last strip that has not, along x; nothing where all have sunk.
std::optional<double> EndOfUnmoved(std::span<const SurfacePoint> surface, const FormerBed& bed);

// Slope of the least-squares line [-]; nothing for fewer than three points.
std::optional<double> SlopeOf(std::span<const SurfacePoint> surface);

// The angle of the slope as an observable, whichever side is the higher [deg].
Reading AngleOf(Observable observable, std::span<const SurfacePoint> surface);

// Below which `share` of the grains' volume has its place along an axis; 0 without grains.
double MassQuantile(std::span<const engine::Particle> grains, double share,
                    const std::function<double(const engine::Particle&)>& place);

// Angle of a slope with the horizontal [deg].
double SlopeAngle(double slope);

}  // namespace talus::rigs
