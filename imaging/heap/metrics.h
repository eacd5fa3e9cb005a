// Every number that two profiles are compared by, in one list.
//
// With a, b = 1 − I/255, the share of the views with powder, of the heap and of its reference:
//
//   sad       Σ|a − b| in px (equivalent black pixels), in mm², and over the reference's NEBP
//   rmse      255 √mean((a − b)²) in grey levels, over the canvas or a region of it
//   iou       Σ min(a, b) / Σ max(a, b)
//   nebp      Σ a in px, the number of equivalent black pixels, and in mm²
//   triangle  angle of the isosceles triangle on the plate of the same area, tan θ = 4 A / D²
//   cohesive  ∫|h − h_triangle| dx / A, how far the outline is from that triangle
//
// and the angles of repose (repose_angle.h). On a table, which has no diameter D, the triangle
// stands on the base of the heap alone, foot to foot. Angles and indices of a film strip are not
// defined.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imaging/heap/measured.h"
#include "imaging/heap/profile.h"
#include "imaging/heap/repose_angle.h"

namespace talus::imaging {

// Columns left … left+width−1, rows top … top+height−1.
struct Region {
  int left = 0;    // [px]
  int top = 0;     // [px]
  int width = 0;   // [px]
  int height = 0;  // [px]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("left_px", self.left, {.required = true, .doc = "first column"});
    visit("top_px", self.top, {.required = true, .doc = "first row"});
    visit("width_px", self.width, {.required = true, .doc = "number of columns, > 0"});
    visit("height_px", self.height, {.required = true, .doc = "number of rows, > 0"});
  }
  void Validate(base::Problems& problems) const;
  // Whether it lies within a picture of the frame, each of them where there are several.
  bool IsWithin(const Frame& frame) const;
};

struct MetricOptions {
  ReposeOptions repose;
  std::optional<Region> rmse_region;  // the whole canvas without one

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("repose", self.repose, {.doc = "how angles of repose are measured"});
    visit("rmse_region", self.rmse_region,
          {.doc = "where rmse_gray is taken, of each picture of a film; else everywhere"});
  }
};

// An average and what it is the average of: views, or runs. The parts give the standard errors and
// may be missing.
struct HeapImages {
  Profile profile;
  std::vector<GrayImage> parts;
};

// The name carries the unit, as in a JSON key or a CSV head: "sad_mm2", "repose_angle_2_mean_deg".
struct Metric {
  std::string name;
  std::string unit;    // "mm2", "px", "deg", "-", "gray"
  Measured value;      // of the heap
  Measured reference;  // the same of the AEHP (0 for a difference, 1 for iou)
};

// Root mean square of the differences of grey levels over `region` of every picture, by default all
// of it; not defined where the region is not within the image. The images are of one size.
Measured Rmse(const Profile& heap, const GrayImage& reference, const std::optional<Region>& region);

// All metrics, always the same names in the same order. Throws ConfigError when the frames differ
// or are not valid, or an image is not of its frame's size.
std::vector<Metric> CompareProfiles(const HeapImages& heap, const HeapImages& reference,
                                    const MetricOptions& options = {});

// Those that one heap alone has: nebp, angles, indices; the reference is not defined.
std::vector<Metric> DescribeProfile(const HeapImages& heap, const MetricOptions& options = {});

// The metric's names, to check a spec's objective against.
std::vector<std::string> MetricNames();

// Throws ConfigError when there is none.
const Metric& FindMetric(const std::vector<Metric>& metrics, const std::string& name);

double Nebp(const GrayImage& image);  // [px]
// [px]; throws ConfigError when the images differ in size.
double Sad(const GrayImage& a, const GrayImage& b);
void RequireSameFrame(const Frame& a, const Frame& b);  // throws ConfigError

}  // namespace talus::imaging
