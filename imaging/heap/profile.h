// An average heap profile: an image and the frame that ties its pixels to the plate.
#pragma once

#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "imaging/gray_image.h"

namespace talus::imaging {

// Pixel (column, row) has its centre at column + 0.5, row + 0.5; rows grow downwards.
//
//   x [m] = (column + 0.5 - center_x) pixel_size
//   height [m] = (baseline - row - 0.5) pixel_size
struct Frame {
  int width = 640;               // [px], > 0
  int height = 480;              // [px], > 0
  double pixel_size = 0;         // [m], > 0
  double center_x = 0;           // of the plate [px] from the left edge of the image
  double baseline = 0;           // the plate's top [px] from the top edge of the image; with a
                                 // disc it may lie 1 % of the plate below its lowest row
  double plate_diameter = 0.01;  // [m], > 0
  // In a drum only what lies within this disc about its axis is known, and powder elsewhere is not
  // shown [m], > 0.
  std::optional<double> disc_diameter{};
  std::optional<int> pictures{};  // of a film strip (film_strip.h), side by side, >= 1; else one
  std::optional<bool> table{};    // whether the heap stands on a table, of which plate_diameter is
                                  // the part that counts; else on a plate that ends there

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("width_px", self.width, {.required = true, .doc = "image width, > 0"});
    visit("height_px", self.height, {.required = true, .doc = "image height, > 0"});
    visit("pixel_size", self.pixel_size,
          {.dimension = Dimension::kLength, .required = true, .doc = "edge of a pixel, > 0"});
    visit("center_x_px", self.center_x, {.required = true, .doc = "plate centre, from the left"});
    visit("baseline_px", self.baseline, {.required = true, .doc = "plate top, from the top"});
    visit("plate_diameter", self.plate_diameter,
          {.dimension = Dimension::kLength, .required = true, .doc = "plate diameter, > 0"});
    visit("disc_diameter", self.disc_diameter,
          {.dimension = Dimension::kLength,
           .doc = "of a drum, whose diameter is plate_diameter: only what lies within this disc "
                  "about its axis counts; default: all counts"});
    visit("pictures", self.pictures,
          {.doc = "of a film: so many pictures of equal width stand side by side, and the plate's "
                  "centre is that of the first; default: one"});
    visit("table", self.table,
          {.doc = "whether the heap stands on a table without an edge, of which plate_diameter is "
                  "the part that counts; default: on a plate"});
  }
  void Validate(base::Problems& problems) const;
  bool on_table() const { return table.value_or(false); }
  int num_pictures() const { return pictures.value_or(1); }
  int picture_width() const { return width / num_pictures(); }  // [px]
  // Whether a pixel shows what is known: all do without a disc.
  bool Knows(int column, int row) const;
  bool operator==(const Frame&) const = default;
};

// AEHP or ANHP: the mean of binary silhouettes, 0 = powder in every one, 255 = in none.
struct Profile {
  GrayImage image;  // width and height as in `frame`
  Frame frame;
};

}  // namespace talus::imaging
