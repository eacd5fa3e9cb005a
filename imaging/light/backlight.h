// A photograph made independent of its light: 1 is the background, powder is dark.
//
//   relative(x, y) = I(x, y) / background(x, y)
//
// A front-lit photograph, powder brighter than its background, becomes its negative first.
//
// The background is a polynomial of fourth degree through what is light, found in a few rounds:
// what is dark on the picture relative to the last background is left out of the next one.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"
#include "imaging/gray_image.h"

namespace talus::imaging {

struct RelativeImage {
  int width = 0;              // [px]
  int height = 0;             // [px]
  std::vector<float> pixels;  // row by row from the top [-]

  float& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  float at(int x, int y) const { return const_cast<RelativeImage&>(*this).at(x, y); }
};

// How powder and plate look before their background.
enum class PowderLook {
  kAuto,    // bright if nearly all of the picture's upper border is in the darker class
  kDark,    // lit from behind
  kBright,  // lit from the front, before a dark background
};

struct LightOptions {
  std::optional<double> threshold{};
  PowderLook powder = PowderLook::kAuto;
  // Whether a dark table reaches across the lower border. Nothing tells how bright the background
  // would be behind it: the polynomial is fitted above it, and the table is 0 in the result.
  bool table = false;
};

struct BacklitPhoto {
  RelativeImage image;
  double threshold = 0;    // darker is powder or plate [-]
  bool negative = false;   // it was front-lit
  double overexposed = 0;  // share of the background at full white [-]; 0 if it is front-lit
  double light = 0;        // mean of what is lit, background or front-lit powder [grey levels]
};

// `threshold` fixes the threshold; else it is half-way between the means of the two classes that
// Otsu's method finds, where a blurred edge has its true place. Throws ConfigError that starts with
// `name` when the picture is black, blank or without contrast.
BacklitPhoto FlattenPhoto(const GrayImage& photo, const LightOptions& light,
                          const std::string& name);

// Where Otsu's method splits the values: means of the darker and of the lighter class.
struct TwoClasses {
  double dark = 0;
  double light = 0;
  double middle() const { return (dark + light) / 2; }
};
TwoClasses SplitByOtsu(const std::vector<float>& values);

}  // namespace talus::imaging

template <>
struct talus::base::Names<talus::imaging::PowderLook> {
  using enum talus::imaging::PowderLook;
  static constexpr std::array kList{std::pair{"auto", kAuto}, std::pair{"dark", kDark},
                                    std::pair{"bright", kBright}};
};
