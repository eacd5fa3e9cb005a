#include "imaging/photos/plate/side_lines.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/line_fit.h"
#include "imaging/one_thread.h"

namespace talus::imaging {
namespace {

constexpr int kFewestRows = 8;          // that make a straight side
constexpr double kLargestRms = 0.35;    // of a side to its line [px]
constexpr double kLargestStep = 1.0;    // of the next row to the line so far [px]
constexpr double kLargestSlope = 0.14;  // 8°
constexpr double kSlopeNoise = 0.4;     // px over the length: how unlike the two slopes may be
constexpr double kAsWide = 0.95;        // of the widest: powder may hang over the rim by the rest
constexpr double kNarrower = 0.9;       // of the plate: where its own outline has ended
constexpr double kLeastThick = 0.015;   // rows with straight sides / width
constexpr double kOffLine = 0.75;       // where a side has left its line [px]
// Thickness of a plate on a pedestal nearly as wide / width: of powder that hangs over a rim a few
// rows may be straight, or a whole column.
constexpr double kLeastPlate = 0.05;
constexpr double kLargestPlate = 0.3;
constexpr int kLedge = 6;  // rows in which an image's blur spreads a step

constexpr double kLeastBelow = 0.1;  // of a hanging area's size: what lies below it as a heap does

// The largest dark area; where that hangs from the upper border, as a lifted tube does, the largest
// of those that lie wholly below it, if one is large enough for a heap on its plate.
cv::Mat LargestArea(const BacklitPhoto& photo) {
  KeepToOneThread();
  const cv::Mat relative(photo.image.height, photo.image.width, CV_32F,
                         const_cast<float*>(photo.image.pixels.data()));
  const cv::Mat dark = relative < photo.threshold;
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(dark, labels, stats, centers, 8);
  const auto area = [&](int label) { return stats.at<int>(label, cv::CC_STAT_AREA); };
  const auto top = [&](int label) { return stats.at<int>(label, cv::CC_STAT_TOP); };
  int best = 0;
  for (int label = 1; label < count; ++label) {
    if (best == 0 || area(label) > area(best)) best = label;
  }
  if (best == 0) return cv::Mat::zeros(dark.size(), CV_8U);
  if (top(best) == 0) {
    const int end = stats.at<int>(best, cv::CC_STAT_HEIGHT);
    int below = 0;
    for (int label = 1; label < count; ++label) {
      const bool lies_below = top(label) >= end && area(label) >= kLeastBelow * area(best);
      if (lies_below && (below == 0 || area(label) > area(below))) below = label;
    }
    if (below != 0) best = below;
  }
  return labels == best;
}

// Between the centre of a dark pixel and of its light neighbour.
double Crossing(const BacklitPhoto& photo, int row, int dark, int light) {
  const double from = photo.image.at(dark, row);
  const double to = photo.image.at(light, row);
  const double share =
      to > from ? std::clamp((photo.threshold - from) / (to - from), 0.0, 1.0) : 0.5;
  return dark + 0.5 + share * (light - dark);
}

// The rows from `first` on that stay straight.
class Grower {
 public:
  Grower(const std::vector<std::optional<SideEnds>>& sides, int first)
      : sides_(sides), first_(first), last_(first - 1) {
    while (Next() && (Length() < kFewestRows || Fits(*Next()))) Take(*Next());
  }

  std::optional<StraightSides> Result() const {
    if (Length() < kFewestRows || !Straight()) return std::nullopt;
    const double slope = MeanSlope();
    return StraightSides{.first = first_,
                         .last = last_,
                         .left = left_.At(0, slope),
                         .right = right_.At(0, slope),
                         .slope = slope};
  }

 private:
  int Length() const { return last_ - first_ + 1; }
  double MeanSlope() const { return (left_.Slope() + right_.Slope()) / 2; }
  const std::optional<SideEnds>& Next() const {
    static const std::optional<SideEnds> kNone;
    const auto row = static_cast<std::size_t>(last_ + 1);
    return row < sides_.size() ? sides_[row] : kNone;
  }
  void Take(const SideEnds& ends) {
    ++last_;
    left_.Add(last_ - first_, ends.left);
    right_.Add(last_ - first_, ends.right);
  }
  bool Straight() const {
    const double noise = kSlopeNoise / Length();
    return left_.Rms() < kLargestRms && right_.Rms() < kLargestRms &&
           std::abs(left_.Slope() - right_.Slope()) < 2 * noise &&
           std::abs(MeanSlope()) < kLargestSlope + noise;
  }
  bool Fits(const SideEnds& ends) const {
    const double slope = MeanSlope();
    return Straight() && std::abs(ends.left - left_.At(Length(), slope)) < kLargestStep &&
           std::abs(ends.right - right_.At(Length(), slope)) < kLargestStep;
  }

  const std::vector<std::optional<SideEnds>>& sides_;
  int first_;
  int last_;
  base::LineFit left_;  // its column over the rows from `first` on
  base::LineFit right_;
};

// The columns of a row that reaches the left or right border [px].
struct CutRow {
  int first = 0;
  int last = -1;

  double width() const { return last + 1 - first; }
};

struct Rows {
  std::vector<std::optional<SideEnds>> sides;
  std::vector<CutRow> cut;  // empty where there are sides
};

Rows FindRows(const BacklitPhoto& photo) {
  const cv::Mat area = LargestArea(photo);
  const auto num_rows = static_cast<std::size_t>(area.rows);
  Rows rows{.sides = std::vector<std::optional<SideEnds>>(num_rows),
            .cut = std::vector<CutRow>(num_rows)};
  for (int y = 0; y < area.rows; ++y) {
    const auto* const begin = area.ptr<std::uint8_t>(y);
    const auto* const end = begin + area.cols;
    const int first = static_cast<int>(std::find(begin, end, 255) - begin);
    if (first == area.cols) continue;
    int last = area.cols - 1;
    while (begin[last] == 0) --last;
    const auto row = static_cast<std::size_t>(y);
    if (first == 0 || last == area.cols - 1) {
      rows.cut[row] = {.first = first, .last = last};
    } else {
      rows.sides[row] = SideEnds{.left = Crossing(photo, y, first, first - 1),
                                 .right = Crossing(photo, y, last, last + 1)};
    }
  }
  return rows;
}

// The longest runs of rows with straight parallel sides, from the top.
std::vector<StraightSides> FindStraightSides(const std::vector<std::optional<SideEnds>>& sides) {
  std::vector<StraightSides> found;
  for (int row = 0; row < static_cast<int>(sides.size()); ++row) {
    const std::optional<StraightSides> straight = Grower(sides, row).Result();
    if (!straight) continue;
    found.push_back(*straight);
    row = straight->last;
  }
  return found;
}

// Whether the one below, which reaches the picture's lower border, carries the one above as a
// pedestal does its plate: both sides step in at once, and about as far.
bool Carries(const StraightSides& below, const StraightSides& above) {
  if (below.first - above.last - 1 > kLedge) return false;
  const double thickness = above.num_rows() / above.width();
  if (thickness < kLeastPlate || thickness > kLargestPlate) return false;
  const double left = below.left - above.LeftAt(below.first);
  const double right = above.RightAt(below.first) - below.right;
  return std::min(left, right) > kOffLine &&
         std::max(left, right) < 2 * std::min(left, right) + kOffLine;
}

// The lowest of those about as wide as the widest; its pedestal may be among them.
std::optional<StraightSides> ChoosePlate(std::vector<StraightSides> straight, int height) {
  double widest = 0;
  for (const StraightSides& sides : straight) widest = std::max(widest, sides.width());
  std::erase_if(straight, [&](const StraightSides& sides) {
    return sides.num_rows() < kLeastThick * sides.width() || sides.width() < kAsWide * widest;
  });
  if (straight.empty()) return std::nullopt;
  auto plate = straight.rbegin();
  const auto above = std::next(plate);
  const bool goes_on = plate->last >= height - 1 - kLedge;  // beyond the picture
  if (goes_on && above != straight.rend() && Carries(*plate, *above)) plate = above;
  return *plate;
}

// Whether the sides are those of a pedestal, whose plate above is wider to both sides and reaches
// the image's left or right border. What is parted from them by a narrower outline, as the heap's,
// is no plate, an arm that holds a tube, say; nor is what reaches out to one side, as a thread.
bool CarriesCutPlate(const Rows& rows, const StraightSides& plate) {
  int num_cut = 0;
  for (int y = plate.first - 1; y >= 0; --y) {
    const auto row = static_cast<std::size_t>(y);
    const std::optional<SideEnds>& ends = rows.sides[row];
    const CutRow& cut = rows.cut[row];
    const double width = ends ? ends->right - ends->left : cut.width();
    if (width < kNarrower * plate.width()) break;
    if (!ends && cut.first < plate.LeftAt(y) && cut.last > plate.RightAt(y)) ++num_cut;
  }
  return num_cut >= kLeastThick * plate.width();
}

// The row above which a side has left its line for good.
template <class Line>
double EndOfSide(const PlateSides& sides, double SideEnds::*end, Line line) {
  const auto off = [&](int row) {
    const std::optional<SideEnds>& ends = sides.ends[static_cast<std::size_t>(row)];
    return !ends || std::abs((*ends).*end - line(row)) > kOffLine;
  };
  int row = (sides.straight.first + sides.straight.last) / 2;
  while (row > 1 && !(off(row) && off(row - 1))) --row;
  return row + 1;
}

}  // namespace

std::optional<PlateSides> FindPlateSides(const BacklitPhoto& photo) {
  Rows rows = FindRows(photo);
  const std::optional<StraightSides> plate =
      ChoosePlate(FindStraightSides(rows.sides), photo.image.height);
  if (!plate) return std::nullopt;
  const bool is_cut = CarriesCutPlate(rows, *plate);
  PlateSides sides{.ends = std::move(rows.sides), .straight = *plate, .is_cut = is_cut};
  sides.left_top = EndOfSide(sides, &SideEnds::left, [&](int row) { return plate->LeftAt(row); });
  sides.right_top =
      EndOfSide(sides, &SideEnds::right, [&](int row) { return plate->RightAt(row); });
  return sides;
}

}  // namespace talus::imaging
