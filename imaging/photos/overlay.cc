#include "imaging/photos/overlay.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "imaging/drawing/canvas.h"
#include "imaging/formats/images/photograph_file.h"
#include "imaging/light/backlight.h"
#include "imaging/one_thread.h"
#include "imaging/photos/photo_from_frame.h"
#include "imaging/photos/silhouette.h"

namespace talus::imaging {
namespace {

// From the plate's coordinates (along it and down from the middle of its top) to the canvas.
class OnPhoto {
 public:
  OnPhoto(const PlatePose& plate, int zoom)
      : plate_(plate), zoom_(zoom), cosine_(std::cos(plate.tilt)), sine_(std::sin(plate.tilt)) {}
  CanvasPoint At(double along, double down) const {
    return {.x = zoom_ * (plate_.center_x + along * cosine_ - down * sine_),
            .y = zoom_ * (plate_.baseline + along * sine_ + down * cosine_)};
  }

 private:
  const PlatePose& plate_;
  int zoom_;
  double cosine_;
  double sine_;
};

// The border of the powder: its outermost pixels.
std::vector<std::vector<cv::Point>> Outlines(const GrayImage& silhouette) {
  const cv::Mat gray(silhouette.height, silhouette.width, CV_8U,
                     const_cast<std::uint8_t*>(silhouette.pixels.data()));
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(gray < 128, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  return outlines;
}

ColorImage DrawFault(const GrayImage& photo, const BacklitPhoto& flat, const PlateEdges& edges) {
  const int zoom = OverlayZoom(photo);
  ColorImage canvas = Enlarged(photo, zoom);
  GrayImage dark{.width = photo.width, .height = photo.height, .pixels = {}};
  for (const float level : flat.image.pixels)
    dark.pixels.push_back(level < flat.threshold ? 0 : 255);
  for (const auto& outline : Outlines(dark)) {
    std::vector<CanvasPoint> points;
    for (const cv::Point& p : outline) points.push_back({zoom * (p.x + 0.5), zoom * (p.y + 0.5)});
    DrawPolygon(canvas, points, {.color = kRed});
  }
  for (const auto* side : {&edges.left, &edges.right}) {
    for (const EdgePoint& p : *side) DrawDisc(canvas, {zoom * p.x, zoom * p.y}, 1.5, kBlue);
  }
  return canvas;
}

}  // namespace

ColorImage DrawOverlay(const GrayImage& photo, const PlatePose& plate, const GrayImage& silhouette,
                       const Frame& frame) {
  const int zoom = OverlayZoom(photo);
  ColorImage canvas = Enlarged(photo, zoom);
  const OnPhoto on(plate, zoom);
  const double scale = plate.width * frame.pixel_size / frame.plate_diameter;  // photo / frame px
  for (const auto& outline : Outlines(silhouette)) {
    std::vector<CanvasPoint> points;
    for (const cv::Point& p : outline) {
      points.push_back(
          on.At(scale * (p.x + 0.5 - frame.center_x), scale * (p.y + 0.5 - frame.baseline)));
    }
    DrawPolygon(canvas, points, {.color = kRed});
  }
  const double half = plate.width / 2;
  const double depth = 0.15 * plate.width;
  DrawLine(canvas, on.At(-half, 0), on.At(-half, depth), {.color = kBlue});
  DrawLine(canvas, on.At(half, 0), on.At(half, depth), {.color = kBlue});
  DrawLine(canvas, on.At(-1.2 * half, 0), on.At(1.2 * half, 0), {.color = kGreen});
  DrawLine(canvas, on.At(0, -0.03 * half), on.At(0, 0.1 * half), {.color = kGreen});
  return canvas;
}

ColorImage FaultOf(const UnusablePhoto& unusable, const ExperimentOptions& options) {
  const GrayImage photo = ReadPhotograph(unusable.photo).image;
  const BacklitPhoto flat = FlattenPhoto(photo, options.light(), unusable.photo.string());
  return DrawFault(photo, flat, unusable.edges);
}

ColorImage OverlayOf(const MeasuredView& view, const Frame& frame, const ExperimentOptions& options,
                     double photo_pixel) {
  const GrayImage photo = ReadPhotograph(view.photo).image;
  const BacklitPhoto flat = FlattenPhoto(photo, options.light(), view.photo.string());
  return DrawOverlay(photo, view.plate,
                     MakeSilhouette(flat, view.plate, photo_pixel, frame, options.ground), frame);
}

// Linear between pixel centres; what the photograph does not show is white.
GrayImage PhotoInFrame(const GrayImage& photo, const PlatePose& plate, double photo_pixel,
                       const Frame& frame) {
  GrayImage image{.width = frame.width, .height = frame.height, .pixels = {}};
  image.pixels.assign(
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height), 255);
  const cv::Mat source(photo.height, photo.width, CV_8U,
                       const_cast<std::uint8_t*>(photo.pixels.data()));
  cv::Mat target(frame.height, frame.width, CV_8U, image.pixels.data());
  KeepToOneThread();
  cv::warpAffine(source, target,
                 cv::Matx23d(PhotoFromFrame(plate, frame.pixel_size / photo_pixel, frame).data()),
                 {frame.width, frame.height}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_CONSTANT, cv::Scalar(255));
  return image;
}

}  // namespace talus::imaging
