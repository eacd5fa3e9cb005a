// Places grains into a region at random, densely and without overlaps, in no simulated time.
//
// The grains start on a low-discrepancy point set at the wanted solid fraction; sweeps over the
// overlapping pairs then push each pair apart by its overlap, as position-based dynamics does
// [mueller2007], and each grain back into the region. Radii are enlarged a little meanwhile, so
// that the pairs that are left when the sweeps end do not touch. One grain after the other, in a
// fixed order: the same input gives the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "base/vec3.h"

namespace talus::engine {

using base::Vec3;

enum class RegionShape { kCylinder, kBox };
constexpr RegionShape LastOf(RegionShape) { return RegionShape::kBox; }

// Upright; `base` is the centre of its lower face.
struct FillRegion {
  RegionShape shape = RegionShape::kCylinder;
  Vec3 base{};                       // [m]
  std::optional<double> diameter{};  // [m], > 0: cylinder
  std::optional<double> width_x{};   // [m], > 0: box
  std::optional<double> width_y{};   // [m], > 0: box
  std::optional<double> height{};    // [m]; default: open at the top, as high as the grains need

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("shape", self.shape, {.doc = "upright cylinder or box"});
    visit("base", self.base, {.dimension = kLength, .doc = "centre of the lower face"});
    visit("diameter", self.diameter, {.dimension = kLength, .doc = "of the cylinder, > 0"});
    visit("width_x", self.width_x, {.dimension = kLength, .doc = "of the box, > 0"});
    visit("width_y", self.width_y, {.dimension = kLength, .doc = "of the box, > 0"});
    visit("height", self.height,
          {.dimension = kLength, .doc = "default: open, as high as the grains need"});
  }
  void Validate(base::Problems& problems) const;
  double Area() const;       // of the lower face [m²]
  double Narrowest() const;  // of its widths [m]
  double Widest() const;     // of its widths [m]
};

struct FillRequest {
  FillRegion region;
  double solid_fraction = 0.55;  // aimed at where the height is free [-], in (0, 0.6]
  double max_overlap = 0.001;    // the filling ends when no overlap / radius is above [-], > 0
  int max_sweeps = 1000;         // cap [-], > 0
  std::uint64_t seed = 1;

  // Asked for grains of these radii [m], each of which must fit into the region.
  void Validate(std::span<const double> radii, base::Problems& problems) const;
};

struct Filling {
  std::vector<Vec3> positions;  // one for each radius, in the given order [m]
  double height = 0;            // of the grains above the base [m]
  double max_overlap = 0;  // of any pair, over the smaller radius [-]; 0 with the region's faces
  int num_sweeps = 0;
};

// Throws base::ConfigError for a request that is not valid of these radii [m].
Filling Fill(std::span<const double> radii, const FillRequest& request);

// Why so many grains cannot be simulated on this machine; empty when they can.
std::string TooManyGrains(double num_grains);

// The same values in an order that depends on the seed only.
std::vector<double> Shuffled(std::vector<double> values, std::uint64_t seed);

}  // namespace talus::engine
