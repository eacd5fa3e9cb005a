#include "experiments/analysis/compare/heap_pair.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/text/plain_number.h"
#include "experiments/analysis/compare/crop.h"
#include "imaging/drawing/canvas.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/difference_map.h"

namespace talus::analysis {
namespace {

constexpr int kPairGap = 14;             // between panels, and round them [px]
constexpr double kPairTitleHeight = 24;  // of a panel so wide [px]
constexpr double kPairTitleSize = 0.36;  // … of OpenCV's font
constexpr int kPanelWidth = 320;         // at least, for the titles [px]

imaging::Profile Cut(const imaging::Profile& profile, const Box& box) {
  imaging::Profile cut{.image = Cropped(profile.image, box), .frame = profile.frame};
  cut.frame.width = box.width;
  cut.frame.height = box.height;
  cut.frame.center_x -= box.left;
  cut.frame.baseline -= box.top;
  return cut;
}

struct Difference {
  double area = 0;  // SAD [m²]
  double most = 0;  // distance from the plate's centre at which the columns differ most [m]
};

Difference DifferenceOf(const imaging::Profile& first, const imaging::Profile& second) {
  const imaging::Frame& frame = first.frame;
  Difference found;
  double largest = 0;
  for (int x = 0; x < frame.width; ++x) {
    double column = 0;  // [px]
    for (int y = 0; y < frame.height; ++y) {
      column += std::abs(first.image.at(x, y) - second.image.at(x, y)) / 255.0;
    }
    found.area += column * frame.pixel_size * frame.pixel_size;
    if (column <= largest) continue;
    largest = column;
    found.most = std::abs(x % frame.picture_width() + 0.5 - frame.center_x) * frame.pixel_size;
  }
  return found;
}

std::string DifferenceTitle(const Difference& difference) {
  return base::PlainNumber(1e6 * difference.area, 2) + " mm2, most at " +
         base::PlainNumber(1e3 * difference.most, 2) + " mm";
}

struct Panel {
  std::string title;
  imaging::ColorImage image;
};

}  // namespace

imaging::ColorImage DrawHeapPair(const imaging::Profile& first, const imaging::Profile& second) {
  const Box box = HeapBox({&first, &second});
  const imaging::Profile left = Cut(first, box);
  const imaging::Profile right = Cut(second, box);
  const std::vector<Panel> panels{
      {"first (red)", imaging::ToColor(left.image)},
      {"second (blue)", imaging::ToColor(right.image)},
      {DifferenceTitle(DifferenceOf(left, right)), imaging::DifferenceImage(left, right)}};
  const int zoom = std::max(1, (kPanelWidth + box.width - 1) / box.width);
  const int width = zoom * box.width + kPairGap;
  // Titles as wide as their panels, however wide these are.
  const double scale = static_cast<double>(width) / (kPanelWidth + kPairGap);
  const int title = static_cast<int>(kPairTitleHeight * scale);
  imaging::ColorImage sheet = imaging::MakeCanvas(
      static_cast<int>(panels.size()) * width + kPairGap, title + zoom * box.height + 2 * kPairGap);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int x = kPairGap + static_cast<int>(i) * width;
    imaging::DrawText(sheet, {.text = panels[i].title,
                              .at = {static_cast<double>(x), kPairGap + title / 2.0},
                              .size = kPairTitleSize * scale});
    imaging::Paste(panels[i].image, zoom, x, kPairGap + title, sheet);
  }
  return sheet;
}

void WriteHeapDifference(const std::filesystem::path& path, const imaging::Profile& first,
                         const imaging::Profile& second) {
  std::filesystem::create_directories(path.parent_path());
  imaging::WritePng(path, DrawHeapPair(first, second));
}

void WriteHeapPair(const std::filesystem::path& path, const imaging::GrayImage& left,
                   const imaging::GrayImage& right) {
  imaging::ColorImage both = imaging::MakeCanvas(left.width + kPairGap + right.width, left.height);
  imaging::Paste(imaging::ToColor(left), 1, 0, 0, both);
  imaging::Paste(imaging::ToColor(right), 1, left.width + kPairGap, 0, both);
  std::filesystem::create_directories(path.parent_path());
  imaging::WritePng(path, both);
}

}  // namespace talus::analysis
