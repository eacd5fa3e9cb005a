#include "imaging/drums/drum_overlay.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "imaging/drawing/canvas.h"

namespace talus::imaging {
namespace {

std::vector<CanvasPoint> Circle(const DrumCircle& circle, double radius, int zoom) {
  constexpr int kCorners = 360;
  std::vector<CanvasPoint> points;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    points.push_back({zoom * (circle.center_x + radius * std::cos(angle)),
                      zoom * (circle.center_y + radius * std::sin(angle))});
  }
  return points;
}

}  // namespace

ColorImage DrawDrum(const GrayImage& photo, const MeasuredDrum& drum) {
  const int zoom = OverlayZoom(photo);
  const DrumCircle& circle = drum.map.circle;
  ColorImage canvas = Enlarged(photo, zoom);
  DrawPolygon(canvas, Circle(circle, circle.radius, zoom), {.color = kBlue});
  DrawPolygon(canvas, Circle(circle, drum.map.inner_radius, zoom), {.color = kGreen});
  for (const DrumPoint& p : drum.surface.points) {
    DrawDisc(canvas, {zoom * (circle.center_x + p.x), zoom * (circle.center_y - p.height)}, 1.5,
             kRed);
  }
  return canvas;
}

}  // namespace talus::imaging
