#include "imaging/heap/heap_alone.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "imaging/one_thread.h"

namespace talus::imaging {
namespace {

// The label of the heap among the connected parts, of which 0 is the background.
int HeapAmong(const cv::Mat& stats, const Frame& frame) {
  int heap = 0, nearest = frame.width;
  for (int label = 1; label < stats.rows; ++label) {
    const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
    const int right = left + stats.at<int>(label, cv::CC_STAT_WIDTH);
    const int middle = static_cast<int>(frame.center_x);
    const int away = frame.on_table() ? std::max({0, left - middle, middle - right}) : 0;
    const bool is_larger =
        heap == 0 || stats.at<int>(label, cv::CC_STAT_AREA) > stats.at<int>(heap, cv::CC_STAT_AREA);
    if (away > nearest || (away == nearest && !is_larger)) continue;
    nearest = away;
    heap = label;
  }
  return heap;
}

}  // namespace

GrayImage HeapAlone(const GrayImage& image, const Frame& frame) {
  KeepToOneThread();
  const cv::Mat pixels(image.height, image.width, CV_8U,
                       const_cast<std::uint8_t*>(image.pixels.data()));
  const cv::Mat powder = pixels < 255;
  cv::Mat labels, stats, centers;
  GrayImage alone = image;
  // Most images, of all that a model predicts, are of one part, which is found in half of the time.
  if (cv::connectedComponents(powder, labels, 8) <= 2) return alone;
  cv::connectedComponentsWithStats(powder, labels, stats, centers, 8);
  const int heap = HeapAmong(stats, frame);
  for (int y = 0; y < image.height; ++y) {
    const int* const label = labels.ptr<int>(y);
    for (int x = 0; x < image.width; ++x) {
      if (label[x] != heap) alone.at(x, y) = 255;
    }
  }
  return alone;
}

}  // namespace talus::imaging
