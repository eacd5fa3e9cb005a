#include "experiments/analysis/compare/heap_pair.h"

#include <algorithm>

#include "imaging/formats/images/image_file.h"

namespace talus::analysis {

void WriteHeapPair(const std::filesystem::path& path, const imaging::GrayImage& left,
                   const imaging::GrayImage& right) {
  constexpr int kGap = 8;  // [px]
  imaging::GrayImage both{
      .width = left.width + kGap + right.width, .height = left.height, .pixels = {}};
  both.pixels.assign(static_cast<std::size_t>(both.width) * static_cast<std::size_t>(both.height),
                     255);
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) both.at(x, y) = left.at(x, y);
    for (int x = 0; x < right.width; ++x) both.at(left.width + kGap + x, y) = right.at(x, y);
  }
  std::filesystem::create_directories(path.parent_path());
  imaging::WritePng(path, both);
}

}  // namespace talus::analysis
