#include "imaging/photos/silhouette.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "imaging/one_thread.h"
#include "imaging/photos/photo_from_frame.h"

namespace talus::imaging {
namespace {

constexpr double kOntoPlate =
    2.0;  // powder whose lower end is nearer the baseline stands on it [px]
constexpr double kBesidePlate = 0.02;  // how far beside the plate powder counts / its diameter
// What stands apart from a heap on a table is a grain if it is lower and smaller than these shares
// of the heap: a grain a third as high as a heap of 30 degrees has 5 % of its area.
constexpr double kGrainHeight = 1.0 / 3;
constexpr double kGrainArea = 0.05;

cv::Mat Resample(const BacklitPhoto& photo, const PlatePose& plate, double scale,
                 const Frame& frame) {
  KeepToOneThread();
  cv::Mat source(photo.image.height, photo.image.width, CV_32F,
                 const_cast<float*>(photo.image.pixels.data()));
  if (scale > 1.2) {  // coarser than photographed: each pixel is the mean of what it covers
    cv::Mat smooth;
    cv::GaussianBlur(source, smooth, {}, 0.4 * scale, 0.4 * scale, cv::BORDER_REPLICATE);
    source = smooth;
  }
  cv::Mat target;
  cv::warpAffine(source, target, cv::Matx23d(PhotoFromFrame(plate, scale, frame).data()),
                 {frame.width, frame.height}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_CONSTANT, cv::Scalar(1));
  return target;
}

int RowsAboveBaseline(const Frame& frame) {
  return std::clamp(static_cast<int>(std::floor(frame.baseline + 0.5)), 0, frame.height);
}

// 255 for the labels of areas that reach down to the ground.
std::vector<std::uint8_t> Standing(const cv::Mat& labels, int num_labels, const Frame& frame,
                                   Ground ground) {
  std::vector<std::uint8_t> stands(static_cast<std::size_t>(num_labels), 0);
  const double half = ground == Ground::kFloor
                          ? labels.cols
                          : frame.plate_diameter / frame.pixel_size * (0.5 + kBesidePlate);
  const int first = std::max(0, static_cast<int>(std::floor(frame.center_x - half)));
  const int last = std::min(labels.cols - 1, static_cast<int>(std::ceil(frame.center_x + half)));
  const int highest = std::max(0, labels.rows - static_cast<int>(kOntoPlate));
  for (int y = highest; y < labels.rows; ++y) {
    for (int x = first; x <= last; ++x)
      stands[static_cast<std::size_t>(labels.at<int>(y, x))] = 255;
  }
  stands[0] = 0;  // the background
  return stands;
}

// The area that stands in the frame's middle, where the table's heap was found to be; 0: none.
std::size_t LabelInTheMiddle(const cv::Mat& labels, const std::vector<std::uint8_t>& stands,
                             const Frame& frame) {
  constexpr int kAbout = 3;  // [px]
  const int middle = static_cast<int>(frame.center_x);
  std::vector<int> count(stands.size(), 0);
  for (int y = std::max(0, labels.rows - static_cast<int>(kOntoPlate)); y < labels.rows; ++y) {
    for (int x = std::max(0, middle - kAbout); x <= std::min(labels.cols - 1, middle + kAbout);
         ++x) {
      const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
      if (stands[label] != 0) ++count[label];
    }
  }
  const auto most = std::max_element(count.begin(), count.end());
  return *most > 0 ? static_cast<std::size_t>(most - count.begin()) : 0;
}

// Only powder lies on a plate. On a table a ruler, a stand or a hand may be, too: what is neither
// the heap nor a grain beside it goes.
void DropThings(const cv::Mat& labels, const cv::Mat& stats, const Frame& frame,
                std::vector<std::uint8_t>& stands) {
  const auto area = [&](std::size_t label) {
    return stats.at<int>(static_cast<int>(label), cv::CC_STAT_AREA);
  };
  const auto height = [&](std::size_t label) {
    return stats.at<int>(static_cast<int>(label), cv::CC_STAT_HEIGHT);
  };
  const std::size_t heap = LabelInTheMiddle(labels, stands, frame);
  if (heap == 0) return;
  for (std::size_t label = 1; label < stands.size(); ++label) {
    const bool is_grain =
        height(label) <= kGrainHeight * height(heap) && area(label) <= kGrainArea * area(heap);
    if (label != heap && !is_grain) stands[label] = 0;
  }
}

// The connected areas that stand on the ground, or are the heap and grains on a table.
cv::Mat StandingOn(Ground ground, const cv::Mat& powder, const Frame& frame) {
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(powder, labels, stats, centers, 8);
  std::vector<std::uint8_t> stands = Standing(labels, count, frame, ground);
  if (frame.on_table()) DropThings(labels, stats, frame, stands);
  cv::Mat heap(powder.size(), CV_8U);
  for (int y = 0; y < powder.rows; ++y) {
    for (int x = 0; x < powder.cols; ++x) {
      heap.at<std::uint8_t>(y, x) = stands[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
  }
  return heap;
}

// Light that does not reach the image's left, right or upper border; the plate shuts it in below.
void FillHoles(cv::Mat& heap) {
  cv::Mat framed;
  cv::copyMakeBorder(heap, framed, 1, 0, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::floodFill(framed, cv::Point(0, 0), cv::Scalar(128));
  const cv::Mat inner = framed(cv::Rect(1, 1, heap.cols, heap.rows));
  heap.setTo(255, inner == 0);
}

// `powder` 255 where dark, rows above the baseline only.
GrayImage Finish(const cv::Mat& powder, const Frame& frame, Ground ground) {
  GrayImage silhouette{
      .width = frame.width,
      .height = frame.height,
      .pixels = std::vector<std::uint8_t>(
          static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height), 255)};
  if (powder.empty()) return silhouette;  // no row is above the baseline
  cv::Mat heap = StandingOn(ground, powder, frame);
  FillHoles(heap);
  for (int y = 0; y < heap.rows; ++y) {
    for (int x = 0; x < heap.cols; ++x) {
      if (heap.at<std::uint8_t>(y, x) != 0) silhouette.at(x, y) = 0;
    }
  }
  return silhouette;
}

}  // namespace

GrayImage MakeSilhouette(const BacklitPhoto& photo, const PlatePose& plate, double photo_pixel,
                         const Frame& frame, Ground ground) {
  const cv::Mat relative = Resample(photo, plate, frame.pixel_size / photo_pixel, frame);
  const cv::Mat powder = relative < photo.threshold;
  return Finish(powder.rowRange(0, RowsAboveBaseline(frame)), frame, ground);
}

bool ReachesBorder(const GrayImage& silhouette, const BacklitPhoto& photo, const PlatePose& plate,
                   double photo_pixel, const Frame& frame) {
  const double scale = frame.pixel_size / photo_pixel;
  const cv::Matx23d to_photo(PhotoFromFrame(plate, scale, frame).data());
  const double near = std::max(1.0, scale);  // of the border [px]
  for (int y = 0; y < silhouette.height; ++y) {
    for (int x = 0; x < silhouette.width; ++x) {
      if (silhouette.at(x, y) >= 128) continue;
      const cv::Vec2d at = to_photo * cv::Vec3d(x, y, 1);
      if (at[0] < near || at[1] < near || at[0] > photo.image.width - 1 - near) return true;
    }
  }
  return false;
}

}  // namespace talus::imaging
