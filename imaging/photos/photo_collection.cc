#include "imaging/photos/photo_collection.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "base/text/counted.h"

namespace talus::imaging {
namespace {

constexpr double kSameScale = 0.01;  // how far a photograph's plate width may be off the median [-]

// The size that most photographs have, of several the first one's.
void SetSize(const std::vector<Photo>& photos, PhotoCollection& collection) {
  std::ptrdiff_t most = 0;
  for (const Photo& photo : photos) {
    if (photo.width == 0) continue;  // not readable
    const auto count = std::ranges::count_if(photos, [&](const Photo& other) {
      return other.width == photo.width && other.height == photo.height;
    });
    if (count <= most) continue;
    most = count;
    collection.width = photo.width;
    collection.height = photo.height;
    collection.block = photo.block;
  }
}

void CheckSize(const PhotoCollection& collection, Photo& photo) {
  if (photo.width == 0) return;
  if (photo.width == collection.width && photo.height == collection.height) return;
  photo.fault = photo.path.string() + ": has " + PixelSizeText(photo.width, photo.height) +
                ", most photographs " + PixelSizeText(collection.width, collection.height) +
                "; all photographs must be of one size and scale";
  photo.lacks_plate = false;
}

double MedianWidth(const std::vector<Photo>& photos) {
  std::vector<double> widths;
  for (const Photo& photo : photos) {
    if (photo.fault.empty()) widths.push_back(photo.edges.width);
  }
  if (widths.empty()) return 0;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

void CheckScale(double median, Photo& photo) {
  if (!photo.fault.empty() || std::abs(photo.edges.width - median) <= kSameScale * median) return;
  std::ostringstream text;
  text.precision(4);
  text << photo.path.string() << ": its plate is " << photo.edges.width
       << " px wide, that of the other photographs " << median
       << " px: powder clings to its side, or they are not all at one scale; take it again, give "
          "the plate's place with "
          "\"frame\", or leave it out";
  photo.fault = text.str();
  photo.lacks_plate = true;
}

// What is wrong with one photograph, or that a view is missing.
struct Fault {
  std::string name;  // of the file, as the text begins; "" of a missing view
  std::string text;
  bool lacks_plate = false;

  std::string Reason() const {
    const std::string lead = name + ": ";
    return !name.empty() && text.starts_with(lead) ? text.substr(lead.size()) : text;
  }
};

// "; the same holds for b.png, c.png and 3 more" of photographs that share the first one's reason.
std::string AlsoOf(const std::vector<Fault>& alike) {
  constexpr std::size_t kMostNames = 8;
  std::string text = "; the same holds for ";
  for (std::size_t i = 1; i < std::min(alike.size(), kMostNames + 1); ++i) {
    text += (i == 1 ? "" : ", ") + alike[i].name;
  }
  const std::size_t rest = alike.size() - std::min(alike.size(), kMostNames + 1);
  return rest == 0 ? text
                   : text + " and " + base::Counted(static_cast<int>(rest), "more photograph");
}

// A line each; what more than a few photographs have alike is one line.
std::string FaultsText(const std::vector<Fault>& faults) {
  std::map<std::string, std::vector<Fault>> by_reason;
  for (const Fault& fault : faults) by_reason[fault.Reason()].push_back(fault);
  std::string all;
  for (const Fault& fault : faults) {
    std::vector<Fault>& alike = by_reason[fault.Reason()];
    if (alike.empty()) continue;  // said with the first of them
    all += (all.empty() ? "" : "\n") + fault.text;
    if (std::ssize(alike) <= kMostSingle) continue;
    all += AlsoOf(alike);
    alike.clear();
  }
  return all;
}

// Going on without most of the photographs is no remedy: then it is the scene or the options that
// do not fit. A table's fault names its remedies itself, and so do those of a file.
std::string RemedyFor(const ExperimentOptions& options, const std::vector<Fault>& faults,
                      const PhotoCollection& collection) {
  if (faults.size() <= collection.photos.size()) {
    return "\nput them right, or go on without them: \"allow_missing_views\": true in the spec's "
           "experiment, --allow-missing-views for talus measure";
  }
  if (!options.scale.empty() || std::ranges::none_of(faults, &Fault::lacks_plate)) return "";
  return "\nmost photographs have a fault: give the plate's place with \"frame\", or say with "
         "\"powder\" how they are lit; turn upright those that lie on their side without saying so "
         "in their EXIF data";
}

// Faults end the work, or become warnings.
void SettleFaults(const ExperimentOptions& options, const std::vector<Fault>& faults,
                  PhotoCollection& collection) {
  const std::string all = FaultsText(faults);
  if (!all.empty() && !options.allow_missing_views) {
    throw UnusablePhotosError(all + RemedyFor(options, faults, collection), collection.left_out);
  }
  if (collection.photos.empty()) throw base::ConfigError(all + "\nno photograph is left");
  for (const Fault& fault : faults) {
    collection.warnings.push_back({.doubt = PhotoDoubt::kLeftOut, .reason = fault.text});
  }
}

// Names the first photograph of the rarer kind of light.
void WarnOfLight(PhotoCollection& collection) {
  const std::vector<Photo>& photos = collection.photos;
  const auto front_lit = std::ranges::count(photos, true, &Photo::front_lit);
  if (front_lit == 0) return;
  PhotoWarning warning{.doubt = PhotoDoubt::kFrontLit, .value = static_cast<double>(front_lit)};
  const auto count = std::ssize(photos);
  if (front_lit < count) {
    warning.doubt = PhotoDoubt::kMixedLight;
    warning.photo = std::ranges::find(photos, 2 * front_lit <= count, &Photo::front_lit)->path;
  }
  collection.warnings.push_back(warning);
}

// Exposures of one series hardly differ. One at full white is warned of by itself, and so are two
// kinds of light.
void WarnOfBrightness(PhotoCollection& collection) {
  constexpr double kMuch = 1.4;  // times as dark or as bright as most [-]
  const auto front_lit = std::ranges::count(collection.photos, true, &Photo::front_lit);
  if (front_lit > 0 && front_lit < std::ssize(collection.photos)) return;
  std::vector<double> levels;
  for (const Photo& photo : collection.photos) levels.push_back(photo.light);
  if (levels.size() < 3) return;  // of two nothing tells which is the odd one
  const double most = base::Median(levels);
  for (const Photo& photo : collection.photos) {
    const double factor = std::max(photo.light, most) / std::min(photo.light, most);
    if (!(factor > kMuch) || photo.overexposed > kMuchOverexposed) continue;
    collection.warnings.push_back({.doubt = PhotoDoubt::kOtherLight,
                                   .photo = photo.path,
                                   .value = factor,
                                   .reason = photo.light < most ? "darker" : "brighter"});
  }
}

}  // namespace

std::string PixelSizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

PhotoCollection CollectPhotos(const ExperimentOptions& options, const PhotoSet& set,
                              std::vector<Photo> photos) {
  PhotoCollection collection;
  for (const PhotoFiles& run : set.runs) collection.runs.push_back(run.run);
  SetSize(photos, collection);
  for (Photo& photo : photos) CheckSize(collection, photo);
  const double median = MedianWidth(photos);
  for (Photo& photo : photos) CheckScale(median, photo);
  std::vector<Fault> faults;
  for (const std::string& missing : set.missing) faults.push_back({.name = "", .text = missing});
  for (Photo& photo : photos) {
    if (photo.fault.empty()) {
      collection.photos.push_back(std::move(photo));
    } else {
      faults.push_back(
          {.name = photo.path.string(), .text = photo.fault, .lacks_plate = photo.lacks_plate});
      collection.left_out.push_back({.photo = photo.path,
                                     .edges = std::move(photo.edges),
                                     .fault = photo.fault,
                                     .is_drawable = photo.has_light});
    }
  }
  SettleFaults(options, faults, collection);
  if (options.powder == PowderLook::kAuto) WarnOfLight(collection);
  WarnOfBrightness(collection);
  return collection;
}

}  // namespace talus::imaging
