// Drawing on a colour image: lines, text, and axes with units.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "imaging/color_image.h"

namespace talus::imaging {

inline constexpr Color kBlack{0, 0, 0};
inline constexpr Color kWhite{255, 255, 255};
inline constexpr Color kGridGray{225, 225, 225};
// On a photograph: what was found, and where it was looked for.
inline constexpr Color kRed{230, 30, 30};
inline constexpr Color kBlue{40, 90, 240};
inline constexpr Color kGreen{0, 170, 60};

ColorImage MakeCanvas(int width, int height);  // white

// A picture to draw on, each of its pixels `zoom` wide.
ColorImage Enlarged(const GrayImage& picture, int zoom);
// How far a photograph is enlarged to draw on: as long as it stays below 1300 px wide.
int OverlayZoom(const GrayImage& photo);

struct CanvasPoint {
  double x = 0;  // [px], pixel (0, 0) has its centre at 0.5, 0.5
  double y = 0;
};

struct Stroke {
  Color color = kBlack;
  int thickness = 1;  // [px]
};

void DrawLine(ColorImage& image, const CanvasPoint& from, const CanvasPoint& to,
              const Stroke& stroke);
void DrawPolygon(ColorImage& image, std::span<const CanvasPoint> points, const Stroke& stroke);
void DrawDisc(ColorImage& image, const CanvasPoint& center, double radius, const Color& color);
void FillBox(ColorImage& image, const CanvasPoint& from, const CanvasPoint& to, const Color& color);

enum class Align { kLeft, kCenter, kRight };

struct Text {
  std::string text;  // ASCII: the font has nothing else
  CanvasPoint at;    // of its vertical middle
  Align align = Align::kLeft;
  double size = 0.5;  // of OpenCV's font, about 22 px a line at 1
  Color color = kBlack;
};
void DrawText(ColorImage& image, const Text& text);

// Copies `source` into `target` with its upper left corner at (x, y), each pixel `zoom` wide.
void Paste(const ColorImage& source, int zoom, int x, int y, ColorImage& target);

// Round values within [low, high], about `count` of them, for the marks of an axis.
std::vector<double> Ticks(double low, double high, int count);
std::string TickText(double value);

// A value axis on the canvas: `low` at pixel `from`, `high` at pixel `to`.
struct Axis {
  double low = 0;
  double high = 1;
  double from = 0;  // [px]
  double to = 1;    // [px]
  double At(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

// The frame of a plot with marks, numbers and titles on the left and below.
struct PlotAxes {
  Axis x;
  Axis y;
  std::string x_title;
  std::string y_title;
  bool grid = false;
};
void DrawAxes(ColorImage& image, const PlotAxes& axes);

}  // namespace talus::imaging
