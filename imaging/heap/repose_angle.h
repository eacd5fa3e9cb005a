// The angle of repose, by the three methods in use, on each side of a heap's outline.
//
//   1  tan θ = H / R, height of the heap over the distance from its axis to its foot
//   2  linear regression h(x) over the whole slope, from the foot to the top
//   3  the same over the part of the slope next to the base, half of it unless told otherwise
//
// The foot is where the lowest outline, extended, meets the baseline. The axis stands under the
// middle of the top. A flat top (trapezium) belongs to neither side for methods 2 and 3. A tip that
// the lens has rounded is put back by extending straight slopes to where they meet; a round top is
// left as it is. docs/imaging.md says how the cases are told apart.
#pragma once

#include <array>
#include <span>

#include "base/field.h"
#include "base/problems.h"
#include "imaging/heap/measured.h"
#include "imaging/heap/profile.h"

namespace talus::imaging {

struct ReposeOptions {
  double base_fraction = 0.5;  // method 3: share of the slope's base, from the foot, in (0, 1]
  double overhang_tolerance =
      0.05;  // outward step that is still no overhang / plate diameter, >= 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("base_fraction", self.base_fraction,
          {.doc = "method 3: share of the slope next to the base, in (0, 1]"});
    visit("overhang_tolerance", self.overhang_tolerance,
          {.doc = "how far the outline may step outwards going up, over the plate diameter, >= 0"});
  }
  void Validate(base::Problems& problems) const;
};

struct SideAngles {
  Measured left;   // [rad]
  Measured right;  // [rad]
  Measured mean;   // of the two [rad]; not defined unless both are
};
using ReposeAngles = std::array<SideAngles, 3>;  // by method, 1 first

// On the half-intensity outline of an average profile or of one view, of the heap without loose
// grains beside it (heap_alone.h): one would be taken for the slope's foot. A heap that overhangs
// in more than a tenth of the views of an average has no angle.
ReposeAngles MeasureRepose(const GrayImage& image, const Frame& frame,
                           const ReposeOptions& options = {});

// The same with standard errors: the standard deviation of the angles over `parts` (the views of
// the average, or its runs) divided by √n. None where fewer than two parts have an angle.
ReposeAngles MeasureRepose(const Profile& profile, std::span<const GrayImage> parts,
                           const ReposeOptions& options = {});

}  // namespace talus::imaging
