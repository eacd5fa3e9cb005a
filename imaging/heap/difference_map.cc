#include "imaging/heap/difference_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "imaging/drawing/canvas.h"
#include "imaging/heap/film_strip.h"
#include "imaging/heap/metrics.h"

namespace talus::imaging {
namespace {

constexpr int kLeft = 70;  // room for the axes [px]
constexpr int kBelow = 60;
constexpr int kAbove = 40;
constexpr int kRight = 110;     // for the colour scale
constexpr int kSmallest = 560;  // width that a small map is enlarged to [px]

// Columns and rows that hold powder in either image or the plate's top, with a margin.
Region Interesting(const Profile& anhp, const Profile& aehp) {
  const Frame& frame = aehp.frame;
  const double half = frame.plate_diameter / frame.pixel_size / 2;
  int left = static_cast<int>(frame.center_x - half);
  int right = static_cast<int>(frame.center_x + half) + 1;
  int top = static_cast<int>(frame.baseline) - 1;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (anhp.image.at(x, y) == 255 && aehp.image.at(x, y) == 255) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
    }
  }
  const int margin = static_cast<int>(0.15 * half) + 1;
  const int bottom = std::min(frame.height, static_cast<int>(frame.baseline) + margin);
  left = std::max(0, left - margin);
  top = std::clamp(top - margin, 0, bottom - 1);
  right = std::min(frame.width, right + margin);
  return {.left = left, .top = top, .width = right - left, .height = bottom - top};
}

ColorImage Crop(const ColorImage& image, const Region& region) {
  ColorImage part = MakeCanvas(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) {
      part.at(x, y) = image.pixels[static_cast<std::size_t>(region.top + y) *
                                       static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(region.left + x)];
    }
  }
  return part;
}

void DrawColorScale(ColorImage& canvas, double x, double top, double bottom) {
  constexpr double kWidth = 18;
  const Axis scale{.low = -255, .high = 255, .from = bottom, .to = top};
  for (double y = top; y < bottom; ++y) {
    const double level = -255 + 510 * (bottom - y) / (bottom - top);
    FillBox(canvas, {x, y + 0.5}, {x + kWidth, y + 0.5},
            DifferenceColor(static_cast<int>(std::lround(level))));
  }
  const CanvasPoint corners[] = {{x, top}, {x + kWidth, top}, {x + kWidth, bottom}, {x, bottom}};
  DrawPolygon(canvas, corners, {});
  for (const double level : {-255.0, -127.5, 0.0, 127.5, 255.0}) {
    DrawText(canvas,
             {TickText(level), {x + kWidth + 6, scale.At(level)}, Align::kLeft, 0.4, kBlack});
  }
  DrawText(canvas,
           {"too little", {x + kWidth / 2, top - 12}, Align::kCenter, 0.42, DifferenceColor(255)});
  DrawText(
      canvas,
      {"too much", {x + kWidth / 2, bottom + 14}, Align::kCenter, 0.42, DifferenceColor(-255)});
}

// A bar of a round length, about a fifth of the map wide.
void DrawLengthBar(ColorImage& canvas, const Axis& x, double y) {
  const double length = Ticks(0, (x.high - x.low) / 5, 3).back();  // [mm]
  const double right = x.to - 12;
  const double left = right - length / (x.high - x.low) * (x.to - x.from);
  DrawLine(canvas, {left, y}, {right, y}, {.color = kBlack, .thickness = 3});
  DrawText(canvas,
           {TickText(length) + " mm", {(left + right) / 2, y + 14}, Align::kCenter, 0.42, kBlack});
}

// One below the other.
ColorImage DrawFilm(const Profile& anhp, const Profile& aehp) {
  std::vector<ColorImage> maps;
  int width = 0;
  int height = 0;
  for (int i = 0; i < aehp.frame.num_pictures(); ++i) {
    maps.push_back(DrawDifferenceMap(PictureOf(anhp, i), PictureOf(aehp, i)));
    width = std::max(width, maps.back().width);
    height += maps.back().height;
  }
  ColorImage film = MakeCanvas(width, height);
  int top = 0;
  for (const ColorImage& map : maps) {
    Paste(map, 1, 0, top, film);
    top += map.height;
  }
  return film;
}

}  // namespace

Color DifferenceColor(int difference) {
  const auto faded = static_cast<std::uint8_t>(255 - std::min(std::abs(difference), 255));
  return difference >= 0 ? Color{faded, faded, 255} : Color{255, faded, faded};
}

ColorImage DifferenceImage(const Profile& anhp, const Profile& aehp) {
  RequireSameFrame(anhp.frame, aehp.frame);
  ColorImage map = MakeCanvas(aehp.frame.width, aehp.frame.height);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    map.pixels[i] = DifferenceColor(anhp.image.pixels[i] - aehp.image.pixels[i]);
  }
  return map;
}

ColorImage DrawDifferenceMap(const Profile& anhp, const Profile& aehp) {
  if (aehp.frame.num_pictures() > 1) return DrawFilm(anhp, aehp);
  const Frame& frame = aehp.frame;
  const ColorImage map = DifferenceImage(anhp, aehp);
  const Region region = Interesting(anhp, aehp);
  const int zoom = std::max(1, (kSmallest + region.width - 1) / region.width);
  const int width = zoom * region.width;
  const int height = zoom * region.height;
  ColorImage canvas = MakeCanvas(kLeft + width + kRight, kAbove + height + kBelow);
  Paste(Crop(map, region), zoom, kLeft, kAbove, canvas);
  const double pixel = frame.pixel_size * 1e3;  // [mm]
  const PlotAxes axes{.x = {.low = (region.left - frame.center_x) * pixel,
                            .high = (region.left + region.width - frame.center_x) * pixel,
                            .from = kLeft,
                            .to = static_cast<double>(kLeft + width)},
                      .y = {.low = (frame.baseline - region.top - region.height) * pixel,
                            .high = (frame.baseline - region.top) * pixel,
                            .from = static_cast<double>(kAbove + height),
                            .to = kAbove},
                      .x_title = "distance from the plate's centre [mm]",
                      .y_title = "height [mm]"};
  DrawAxes(canvas, axes);
  const double half = frame.plate_diameter * 1e3 / 2;  // [mm]
  DrawLine(canvas, {axes.x.At(-half), axes.y.At(0)}, {axes.x.At(half), axes.y.At(0)},
           {.color = kBlack, .thickness = 2});
  DrawLengthBar(canvas, axes.x, kAbove + 12);
  DrawColorScale(canvas, kLeft + width + 24, kAbove + 20, kAbove + height - 20);
  return canvas;
}

}  // namespace talus::imaging
