#include "imaging/photos/photo_warning.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/median.h"
#include "base/text/plain_number.h"
#include "base/units.h"

namespace talus::imaging {
namespace {

constexpr double kRimMargin = 0.05;      // beyond the rim / plate radius [-]
constexpr double kLeastDeviation = 0.2;  // of a view's NEBP from the median [-]
constexpr double kManyUsual = 4;         // and so many standard deviations of the views

std::string Percent(double share) { return base::InPercent(share) + " %"; }

std::string Times(double factor) {
  std::ostringstream text;
  text.precision(2);
  text << factor << " times";
  return text.str();
}

std::string Reason(const PhotoWarning& warning) {
  switch (warning.doubt) {
    case PhotoDoubt::kLeftOut:
      return "left out: " + warning.reason;
    case PhotoDoubt::kUnread:
      return warning.reason;
    case PhotoDoubt::kSeveralHeaps:
      return "begins another heap, it seems: " + warning.reason + " look like " +
             std::to_string(static_cast<int>(warning.value)) +
             " heaps and are taken for views of one; give each heap a folder of its own, or names "
             "such as heap1_01.jpg (docs/imaging.md)";
    case PhotoDoubt::kRunDisagrees:
      return "run " + warning.reason + " differs from the others " + Times(warning.value) +
             " as much as they do: another heap, or one that slid; look at it, or leave it out";
    case PhotoDoubt::kNoNoise:
      return "the heaps are alike to " + base::PlainNumber(warning.value, 2) +
             " px along the outline, as no two heaps are: they are photographs of one heap, or "
             "what is taken for powder is the same thing in all; look at the overlays (--out)";
    case PhotoDoubt::kFrontLit:
      return "powder is brighter than its background and is taken to be lit from the front; say "
             "\"powder\": \"bright\" (--powder bright) if so, \"dark\" if not";
    case PhotoDoubt::kMixedLight:
      return "lit otherwise than most: " + std::to_string(static_cast<int>(warning.value)) +
             " photographs look lit from the front, the others from behind; say which with "
             "\"powder\" (--powder)";
    case PhotoDoubt::kHiddenTop:
      return "no photograph shows the plate's top, as powder hides it or nothing is sharp: the "
             "baseline may be as much too low as powder hangs over the rim; brush the rim clean, "
             "focus on the plate, or give \"frame\" (--frame)";
    case PhotoDoubt::kTilted:
      return "the plate looks tilted by " + base::PlainNumber(warning.value / base::kDegree, 2) +
             " degrees, and beyond some five its edges are misread: level the camera, turn the "
             "photographs, or give \"frame\" and \"tilt\" (--frame, --tilt)";
    case PhotoDoubt::kBeyondPicture:
      return Percent(warning.value) +
             " of the part of the table that counts lies beyond the picture, so that powder there "
             "is not seen; give a smaller \"plate_diameter\" (--plate-diameter), or take the "
             "photographs from farther away";
    case PhotoDoubt::kNoPowder:
      return "no powder stands on the plate";
    case PhotoDoubt::kTouchesFrame:
      return "the silhouette touches the edge of the picture: part of the heap may be missing, or "
             "something else is taken for powder";
    case PhotoDoubt::kBesidePlate:
      return Percent(warning.value) +
             " of the powder lies beyond the plate's rim: something else is taken for powder, or "
             "the plate for something else";
    case PhotoDoubt::kViewDisagrees:
      return "shows " + Percent(warning.value) +
             " of the powder that the median view shows: another heap, or a wrong outline";
    case PhotoDoubt::kOverexposed:
      return Percent(warning.value) +
             " of the background is at full white: light eats into the outline; expose less";
    case PhotoDoubt::kOtherLight:
      return "lit otherwise than the others: " + Times(warning.value) + " " + warning.reason +
             " than most; lamp or exposure have changed: look at its outline, or take it again";
    case PhotoDoubt::kCopied:
      return "is the same file as " + warning.reason +
             ": a copy is no other heap, and runs of copies agree better than heaps do";
  }
  return {};
}

bool IsOfSetUp(PhotoDoubt doubt) {
  return doubt == PhotoDoubt::kNoPowder || doubt == PhotoDoubt::kTouchesFrame ||
         doubt == PhotoDoubt::kBesidePlate || doubt == PhotoDoubt::kOverexposed ||
         doubt == PhotoDoubt::kOtherLight || doubt == PhotoDoubt::kCopied;
}

}  // namespace

std::vector<PhotoWarning> Gathered(const std::vector<PhotoWarning>& warnings) {
  std::vector<PhotoWarning> result;
  for (const PhotoWarning& warning : warnings) {
    const auto is_same = [&](const PhotoWarning& other) { return other.doubt == warning.doubt; };
    const auto count = std::ranges::count_if(warnings, is_same);
    if (!IsOfSetUp(warning.doubt) || count <= kMostSingle) {
      result.push_back(warning);
    } else if (const auto first = std::ranges::find_if(result, is_same); first == result.end()) {
      result.push_back(warning);
      result.back().num_photos = static_cast<int>(count);
    } else if (warning.value > first->value) {
      *first = warning;
      first->num_photos = static_cast<int>(count);
    }
  }
  return result;
}

std::string WarningText(const PhotoWarning& warning) {
  const std::string reason = Reason(warning);
  if (warning.photo.empty()) return reason;
  std::string place = warning.photo.string();
  if (warning.num_photos > 1) {
    place += warning.value > 0 ? ", the worst of " : ", the first of ";
    place += std::to_string(warning.num_photos) + " such photographs";
  }
  return place + ": " + reason;
}

double ShareBesidePlate(const GrayImage& silhouette, const Frame& frame) {
  const double rim = (0.5 + kRimMargin / 2) * frame.plate_diameter / frame.pixel_size;
  double beside = 0;
  double all = 0;
  for (int y = 0; y < silhouette.height; ++y) {
    for (int x = 0; x < silhouette.width; ++x) {
      const double powder = 255 - silhouette.at(x, y);
      all += powder;
      if (std::abs(x + 0.5 - frame.center_x) > rim) beside += powder;
    }
  }
  return all > 0 ? beside / all : 0;
}

std::vector<double> DisagreeingViews(const std::vector<double>& nebp) {
  std::vector<double> off(nebp.size(), 0.0);
  if (nebp.size() < 3) return off;
  const double median = base::Median(nebp);
  if (!(median > 0)) return off;
  std::vector<double> deviations;
  for (const double value : nebp) deviations.push_back(std::abs(value / median - 1));
  const double usual = 1.48 * base::Median(deviations);
  for (std::size_t i = 0; i < nebp.size(); ++i) {
    const bool much = deviations[i] > kLeastDeviation && deviations[i] > kManyUsual * usual;
    if (much) off[i] = nebp[i] / median;
  }
  return off;
}

std::vector<double> DisagreeingRuns(const std::vector<double>& differences) {
  constexpr std::size_t kFewest = 4;  // one run is one of two halves, and pulls the mean of three
  constexpr double kMuch = 2;
  std::vector<double> off(differences.size(), 0.0);
  if (differences.size() < kFewest) return off;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    std::vector<double> others = differences;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double usual = base::Median(others);
    if (usual > 0 && differences[i] > kMuch * usual) off[i] = differences[i] / usual;
  }
  return off;
}

std::vector<PhotoWarning> WarningsOf(const SeenView& view) {
  std::vector<PhotoWarning> warnings;
  const auto warn = [&](bool is_so, PhotoDoubt doubt, double value = 0) {
    if (is_so) warnings.push_back({.doubt = doubt, .photo = view.photo, .value = value});
  };
  const double beside =
      view.ground == Ground::kPlate ? ShareBesidePlate(view.silhouette, view.frame) : 0;
  warn(view.nebp == 0, PhotoDoubt::kNoPowder);
  warn(view.reaches_border, PhotoDoubt::kTouchesFrame);
  warn(beside > kMuchBesidePlate, PhotoDoubt::kBesidePlate, beside);
  warn(view.overexposed > kMuchOverexposed, PhotoDoubt::kOverexposed, view.overexposed);
  return warnings;
}

}  // namespace talus::imaging
