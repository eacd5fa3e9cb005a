#include "imaging/drums/drum_bed.h"

#include <opencv2/imgproc.hpp>

#include "imaging/one_thread.h"

namespace talus::imaging {

GrayImage BedAlone(const GrayImage& map) {
  KeepToOneThread();
  const cv::Mat pixels(map.height, map.width, CV_8U, const_cast<std::uint8_t*>(map.pixels.data()));
  const cv::Mat powder = pixels < 128;
  cv::Mat labels, stats, centers;
  const int num_labels = cv::connectedComponentsWithStats(powder, labels, stats, centers, 8);
  int bed = 0;  // the background: there is no powder
  for (int label = 1; label < num_labels; ++label) {
    const auto area = [&](int part) { return stats.at<int>(part, cv::CC_STAT_AREA); };
    if (bed == 0 || area(label) > area(bed)) bed = label;
  }
  GrayImage alone = map;
  for (int y = 0; y < map.height; ++y) {
    const int* const label = labels.ptr<int>(y);
    for (int x = 0; x < map.width; ++x) {
      if (label[x] != 0 && label[x] != bed) alone.at(x, y) = 255;
    }
  }
  return alone;
}

}  // namespace talus::imaging
