#include "imaging/drawing/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>

namespace talus::imaging {
namespace {

constexpr int kShift = 4;  // fractional bits of OpenCV's drawing coordinates
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

cv::Mat Wrap(ColorImage& image) {
  return {image.height, image.width, CV_8UC3, image.pixels.data()};
}
cv::Scalar Value(const Color& color) {
  return {double(color[0]), double(color[1]), double(color[2])};
}

cv::Point Fixed(const CanvasPoint& point) {
  constexpr double kUnit = 1 << kShift;
  return {static_cast<int>(std::lround((point.x - 0.5) * kUnit)),
          static_cast<int>(std::lround((point.y - 0.5) * kUnit))};
}

void DrawXAxis(ColorImage& image, const PlotAxes& axes) {
  const auto& [x, y, x_title, y_title, grid] = axes;
  for (const double value : Ticks(x.low, x.high, 7)) {
    if (grid) DrawLine(image, {x.At(value), y.from}, {x.At(value), y.to}, {.color = kGridGray});
    DrawLine(image, {x.At(value), y.from}, {x.At(value), y.from + 5}, {});
    DrawText(image, {TickText(value), {x.At(value), y.from + 15}, Align::kCenter, 0.42, kBlack});
  }
  DrawText(image, {x_title, {(x.from + x.to) / 2, y.from + 34}, Align::kCenter, 0.5, kBlack});
}

void DrawYAxis(ColorImage& image, const PlotAxes& axes) {
  const auto& [x, y, x_title, y_title, grid] = axes;
  for (const double value : Ticks(y.low, y.high, 6)) {
    if (grid) DrawLine(image, {x.from, y.At(value)}, {x.to, y.At(value)}, {.color = kGridGray});
    DrawLine(image, {x.from - 5, y.At(value)}, {x.from, y.At(value)}, {});
    DrawText(image, {TickText(value), {x.from - 8, y.At(value)}, Align::kRight, 0.42, kBlack});
  }
  DrawText(image, {y_title, {x.from - 40, y.to - 14}, Align::kLeft, 0.5, kBlack});
}

}  // namespace

ColorImage MakeCanvas(int width, int height) {
  return {.width = width,
          .height = height,
          .pixels = std::vector<Color>(
              static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kWhite)};
}

void DrawLine(ColorImage& image, const CanvasPoint& from, const CanvasPoint& to,
              const Stroke& stroke) {
  cv::Mat mat = Wrap(image);
  cv::line(mat, Fixed(from), Fixed(to), Value(stroke.color), stroke.thickness, cv::LINE_AA, kShift);
}

void DrawPolygon(ColorImage& image, std::span<const CanvasPoint> points, const Stroke& stroke) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    DrawLine(image, points[i], points[(i + 1) % points.size()], stroke);
  }
}

void DrawDisc(ColorImage& image, const CanvasPoint& center, double radius, const Color& color) {
  cv::Mat mat = Wrap(image);
  cv::circle(mat, Fixed(center), static_cast<int>(std::lround(radius * (1 << kShift))),
             Value(color), cv::FILLED, cv::LINE_AA, kShift);
}

void FillBox(ColorImage& image, const CanvasPoint& from, const CanvasPoint& to,
             const Color& color) {
  cv::Mat mat = Wrap(image);
  cv::rectangle(mat, Fixed(from), Fixed(to), Value(color), cv::FILLED, cv::LINE_8, kShift);
}

void DrawText(ColorImage& image, const Text& text) {
  cv::Mat mat = Wrap(image);
  int below = 0;
  const cv::Size size = cv::getTextSize(text.text, kFont, text.size, 1, &below);
  const double left = text.align == Align::kLeft     ? 0
                      : text.align == Align::kCenter ? size.width / 2.0
                                                     : size.width;
  const cv::Point origin(static_cast<int>(std::lround(text.at.x - left)),
                         static_cast<int>(std::lround(text.at.y + size.height / 2.0)));
  cv::putText(mat, text.text, origin, kFont, text.size, Value(text.color), 1, cv::LINE_AA);
}

ColorImage Enlarged(const GrayImage& picture, int zoom) {
  ColorImage canvas = MakeCanvas(zoom * picture.width, zoom * picture.height);
  Paste(ToColor(picture), zoom, 0, 0, canvas);
  return canvas;
}

int OverlayZoom(const GrayImage& photo) {
  constexpr int kWidest = 1300;
  return std::max(1, kWidest / photo.width);
}

void Paste(const ColorImage& source, int zoom, int x, int y, ColorImage& target) {
  for (int j = 0; j < source.height * zoom; ++j) {
    for (int i = 0; i < source.width * zoom; ++i) {
      if (x + i >= target.width || y + j >= target.height) continue;
      target.at(x + i, y + j) =
          source
              .pixels[static_cast<std::size_t>(j / zoom) * static_cast<std::size_t>(source.width) +
                      static_cast<std::size_t>(i / zoom)];
    }
  }
}

std::vector<double> Ticks(double low, double high, int count) {
  const double rough = (high - low) / count;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (step < rough) step = power * factor;
  }
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  // Counted: a large k may not change by one more.
  const double num = std::min(20.0, std::floor(high / step + 1e-9) - first + 1);
  for (int i = 0; i < num; ++i) ticks.push_back((first + i) * step);
  return ticks;
}

std::string TickText(double value) {
  std::ostringstream text;
  text.precision(6);
  text << (std::abs(value) < 1e-12 ? 0.0 : value);
  return text.str();
}

void DrawAxes(ColorImage& image, const PlotAxes& axes) {
  DrawXAxis(image, axes);
  DrawYAxis(image, axes);
  DrawLine(image, {axes.x.from, axes.y.from}, {axes.x.to, axes.y.from}, {});
  DrawLine(image, {axes.x.from, axes.y.from}, {axes.x.from, axes.y.to}, {});
}

}  // namespace talus::imaging
