#include "imaging/drums/drum.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/sample.h"
#include "base/text/plain_number.h"
#include "base/units.h"
#include "imaging/formats/images/photograph_file.h"
#include "imaging/light/backlight.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {
namespace {

constexpr double kLeastLight = 0.25;   // share of a circle that is light: the ring hides it no more
constexpr double kBeyondRing = 0.01;   // farther in, as the lens blurs the ring / radius
constexpr double kThickestRing = 0.1;  // / radius
// Between powder and light [grey levels]. Where both are dim less will do, as long as it is above
// the camera's noise and half of the light.
constexpr double kLeastContrast = 40;
constexpr double kDimContrast = 12;
constexpr double kDimShare = 0.5;
constexpr double kSameCircle = 0.01;  // how far circles of one series may differ / radius

double Radius(const DrumCircle& circle, int x, int y) {
  return std::hypot(x + 0.5 - circle.center_x, y + 0.5 - circle.center_y);
}

// The outermost circle of a photograph and the drum's inner radius within it.
struct DrumPlace {
  DrumCircle circle;
  double drum_radius = 0;  // [px]
};

DrumPlace PlaceOf(const DrumCircle& circle, const DrumPhotos& options) {
  const double share = options.diameter / options.circle_diameter.value_or(options.diameter);
  return {.circle = circle, .drum_radius = share * circle.radius};
}

// Levels of powder and light within the drum. What is left of a ring that no diameter tells is too
// thin to count.
TwoClasses Levels(const GrayImage& photo, const DrumPlace& place, const std::string& name) {
  std::vector<float> levels;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      if (Radius(place.circle, x, y) < 0.95 * place.drum_radius) levels.push_back(photo.at(x, y));
    }
  }
  const TwoClasses classes = SplitByOtsu(levels);
  const double contrast = classes.light - classes.dark;
  const bool is_dim = contrast >= kDimContrast && contrast >= kDimShare * classes.light;
  if (contrast >= kLeastContrast || is_dim) return classes;
  throw base::ConfigError(name +
                          ": shows no powder before a light background in the drum; light it from "
                          "behind");
}

double LightShare(const GrayImage& photo, const DrumCircle& circle, double r, double level) {
  constexpr int kSteps = 720;
  int light = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    const int x = static_cast<int>(circle.center_x + r * std::cos(angle));
    const int y = static_cast<int>(circle.center_y + r * std::sin(angle));
    if (x < 0 || y < 0 || x >= photo.width || y >= photo.height) continue;
    light += photo.at(x, y) > level;
  }
  return static_cast<double>(light) / kSteps;
}

// From the circle inwards through the dark ring to where the light side is seen.
double InnerRadius(const GrayImage& photo, const DrumCircle& circle, const TwoClasses& levels) {
  constexpr double kStep = 0.5;  // [px]
  const auto light = [&](double r) {
    return LightShare(photo, circle, r, levels.middle()) >= kLeastLight;
  };
  const double least = circle.radius * (1 - kThickestRing);
  double r = circle.radius;
  while (r > least && light(r)) r -= kStep;
  if (r <= least) r = circle.radius;  // no ring
  while (r > least && !light(r)) r -= kStep;
  return r - kBeyondRing * circle.radius;
}

// Powder and light become 0 and 255; what the ring hides is white.
DrumMap MapOf(const GrayImage& photo, const DrumPlace& place, const std::string& name) {
  const DrumCircle& circle = place.circle;
  const TwoClasses levels = Levels(photo, place, name);
  DrumMap map{.image = photo,
              .circle = circle,
              .drum_radius = place.drum_radius,
              .inner_radius = InnerRadius(photo, circle, levels)};
  map.inner_radius = std::min(map.inner_radius, (1 - kBeyondRing) * map.drum_radius);
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double share = (photo.at(x, y) - levels.dark) / (levels.light - levels.dark);
      const bool known = Radius(circle, x, y) <= map.inner_radius;
      map.image.at(x, y) =
          known ? static_cast<std::uint8_t>(255 * std::clamp(share, 0.0, 1.0) + 0.5) : 255;
    }
  }
  return map;
}

// Whether one is light where the other is dark.
bool AreInverse(const GrayImage& a, const GrayImage& b) {
  const auto mean = [](const GrayImage& image) {
    double sum = 0;
    for (const std::uint8_t level : image.pixels) sum += level;
    return sum / static_cast<double>(image.pixels.size());
  };
  const double mean_a = mean(a), mean_b = mean(b);
  double covariance = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    covariance += (a.pixels[i] - mean_a) * (b.pixels[i] - mean_b);
  }
  return covariance < 0;
}

struct Photographs {
  std::vector<GrayImage> images;
  std::vector<DrumCircle> circles;
};

// The average of a series would be of neither kind of light.
void RequireSameLight(const Photographs& photos, const DrumPhotos& options,
                      const std::string& name) {
  constexpr double kMuch = 1.4;  // times as dark or as bright as the first [-]
  const GrayImage& first = photos.images.front();
  const GrayImage& last = photos.images.back();
  const double light = Levels(last, PlaceOf(photos.circles.back(), options), name).light;
  const double usual = Levels(first, PlaceOf(photos.circles.front(), options), name).light;
  std::string how;
  if (AreInverse(first, last)) {
    how = "light where the first photograph is dark";
  } else if (std::max(light, usual) > kMuch * std::min(light, usual)) {
    how = base::PlainNumber(light / usual, 2) + " times as bright as the first photograph";
  }
  if (how.empty()) return;
  throw base::ConfigError(name + ": is lit otherwise than its series, " + how +
                          "; take it again, or leave it out");
}

Photographs Read(const DrumPhotos& options) {
  Photographs photos;
  for (const std::filesystem::path& file : options.photos) {
    photos.images.push_back(ReadPhotograph(file).image);
    const GrayImage& image = photos.images.back();
    photos.circles.push_back(FindDrumCircle(image, file.string()));
    const DrumCircle& first = photos.circles.front();
    const DrumCircle& last = photos.circles.back();
    const bool same = image.width == photos.images.front().width &&
                      image.height == photos.images.front().height &&
                      std::hypot(last.center_x - first.center_x, last.center_y - first.center_y) +
                              std::abs(last.radius - first.radius) <=
                          kSameCircle * first.radius;
    if (!same) {
      throw base::ConfigError(
          file.string() +
          ": its drum is not where that of the first photograph is; a series is "
          "taken by one camera that stands still");
    }
    RequireSameLight(photos, options, file.string());
  }
  return photos;
}

// Standard deviation over the photographs of the surface's height, mean over its columns [px].
double SurfaceSd(const std::vector<DrumSurface>& surfaces) {
  std::map<double, std::vector<double>> heights;  // by place
  for (const DrumSurface& surface : surfaces) {
    for (const DrumPoint& p : surface.points) heights[p.x].push_back(p.height);
  }
  double sum = 0, columns = 0;
  for (const auto& [x, column] : heights) {
    if (column.size() < std::max<std::size_t>(2, surfaces.size())) continue;
    double mean = 0, squares = 0;
    for (const double h : column) mean += h / static_cast<double>(column.size());
    for (const double h : column) squares += (h - mean) * (h - mean);
    sum += std::sqrt(squares / static_cast<double>(column.size() - 1));
    columns += 1;
  }
  return columns > 0 ? sum / columns : 0;
}

std::vector<double> ValuesOf(const std::vector<DrumSurface>& surfaces,
                             Measured DrumSurface::*number) {
  std::vector<double> values;
  for (const DrumSurface& surface : surfaces) {
    if ((surface.*number).defined()) values.push_back((surface.*number).value);
  }
  return values;
}

// As the rig has them, the means of the pictures' own: where few of them differ much, as in a drum
// that avalanches, the mean picture has the surface of most.
void TakeMeans(const std::vector<DrumSurface>& each, DrumSurface& surface) {
  const std::vector<double> slopes = ValuesOf(each, &DrumSurface::slope_angle);
  const std::vector<double> fills = ValuesOf(each, &DrumSurface::fill);
  if (!slopes.empty() && surface.slope_angle.defined()) {
    surface.slope_angle.value = base::SampleOf(slopes).mean;
    surface.slope_angle.standard_error = StandardError(slopes);
  }
  if (!fills.empty() && surface.fill.defined()) surface.fill.value = base::SampleOf(fills).mean;
}

// A slope this far to either side is no flat surface's scatter [rad].
constexpr double kClearSlope = 5 * base::kDegree;

// A series is of one turning; a mirrored picture among them would be averaged away.
void RequireOneTurning(const std::vector<DrumSurface>& surfaces,
                       const std::vector<std::filesystem::path>& photos) {
  const auto leans = [&](double side) {
    return std::ranges::find_if(surfaces, [side](const DrumSurface& surface) {
      return surface.slope_angle.defined() && side * surface.slope_angle.value > kClearSlope;
    });
  };
  const auto left = leans(1), right = leans(-1);
  if (left == surfaces.end() || right == surfaces.end()) return;
  const auto photo = [&](auto surface) {
    return photos[static_cast<std::size_t>(surface - surfaces.begin())].string();
  };
  throw base::ConfigError(photo(right) + ": the powder is higher on the right, in " + photo(left) +
                          " on the left: a series is of a drum that turns one way; mirror the "
                          "pictures that are mirrored, or measure them by themselves");
}

// Σ height · powder / (R · pixels of the disc) [-]: of a segment 2/3 (1 − d²)^(3/2) / π below the
// axis, d its chord's distance / R; the same above it for the picture's negative.
double MomentAboveAxis(const DrumMap& map) {
  double moment = 0, pixels = 0;
  for (int y = 0; y < map.image.height; ++y) {
    for (int x = 0; x < map.image.width; ++x) {
      if (Radius(map.circle, x, y) > map.inner_radius) continue;
      pixels += 1;
      moment += (map.circle.center_y - y - 0.5) * (255 - map.image.at(x, y)) / 255.0;
    }
  }
  return moment / (map.inner_radius * pixels);
}

// Share of the photograph that is dark beyond the map's inner radius, within 30 degrees of the
// lowest point; the ring itself is left out.
double DarkBelow(const GrayImage& photo, const DrumMap& map, double middle) {
  double dark = 0, pixels = 0;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double radius = Radius(map.circle, x, y);
      const double down = y + 0.5 - map.circle.center_y;
      if (radius < map.inner_radius || radius > 0.95 * map.drum_radius ||
          down < std::cos(std::numbers::pi / 6) * radius) {
        continue;
      }
      pixels += 1;
      if (photo.at(x, y) < middle) dark += 1;
    }
  }
  return pixels > 0 ? dark / pixels : 0;
}

// Gravity holds the powder below the axis, on average. A centrifuging one covers the whole rim,
// where it passes for a broad ring, and may be thicker at the top.
void RequirePowderBelow(const GrayImage& photo, const DrumMap& map, const std::string& name) {
  constexpr double kMostAbove = 0.03;  // one full to 5 % and upside down has 0.036 at 35 degrees
  if (!(MomentAboveAxis(map) > kMostAbove)) return;
  if (DarkBelow(photo, map, Levels(photo, {map.circle, map.drum_radius}, name).middle()) > 0.9)
    return;
  throw base::ConfigError(name +
                          ": the powder lies at the top of the drum: the picture is upside down, "
                          "or lit from the front, so that powder is bright; turn it, or take it "
                          "lit from behind (of a bright powder before a dark background, its "
                          "negative serves)");
}

// What a series tells beyond its mean picture.
void MeasureEach(const Photographs& photos, const DrumPhotos& options, const DrumPlace& place,
                 MeasuredDrum& drum) {
  std::vector<DrumSurface> each;
  for (const GrayImage& image : photos.images) {
    each.push_back(MeasureSurface(MapOf(image, place, options.photos.front().string())));
  }
  RequireOneTurning(each, options.photos);
  TakeMeans(each, drum.surface);
  drum.surface_sd = SurfaceSd(each) * drum.pixel_size;
}

// The powder climbs where it is carried up, so that a surface that falls to the right turns
// clockwise.
void ReadTurning(const DrumPhotos& options, MeasuredDrum& drum) {
  const Measured& slope = drum.surface.slope_angle;
  drum.angle = slope;
  drum.turning = options.turning;
  if (!slope.defined()) return;
  drum.turning = slope.value >= 0 ? Turning::kClockwise : Turning::kCounterClockwise;
  drum.angle.value = std::abs(slope.value);
  if (!options.turning || *options.turning == drum.turning) return;
  if (std::abs(slope.value) <= kClearSlope) {  // next to level: the direction is what was said
    drum.turning = options.turning;
    drum.angle.value = -drum.angle.value;
    return;
  }
  throw base::ConfigError(options.photos.front().string() + ": the powder is higher on the " +
                          (slope.value >= 0 ? "left" : "right") +
                          ", so that the drum turns the other way than was said; mirror the "
                          "photographs, or leave the direction out");
}

}  // namespace

void DrumPhotos::Validate(base::Problems& problems) const {
  problems.Require(!photos.empty(), "photos", "are missing");
  problems.Require(diameter > 0 && diameter <= 5, "diameter", diameter,
                   "must be positive and at most 5 m; write \"84 mm\" for 84 mm");
  problems.Require(!circle_diameter || (*circle_diameter >= diameter && *circle_diameter <= 5),
                   "circle_diameter", circle_diameter.value_or(0),
                   "must be the drum's diameter or more, as its ring lies around it");
}

MeasuredDrum MeasureDrum(const DrumPhotos& options) {
  base::Problems problems;
  options.Validate(problems);
  problems.ThrowIfAny();
  const Photographs photos = Read(options);
  MeasuredDrum drum;
  const std::string name = options.photos.front().string();
  const GrayImage mean = MeanImage(photos.images);
  const DrumPlace place = PlaceOf(FindDrumCircle(mean, name), options);
  drum.map = MapOf(mean, place, name);
  RequirePowderBelow(mean, drum.map, name);
  drum.pixel_size = options.diameter / (2 * place.drum_radius);
  drum.surface = MeasureSurface(drum.map);
  if (photos.images.size() > 1) MeasureEach(photos, options, place, drum);
  ReadTurning(options, drum);
  return drum;
}

Profile DrumProfile(const MeasuredDrum& drum) {
  const DrumCircle& circle = drum.map.circle;
  const int width = drum.map.image.width;
  Profile profile{.image = drum.map.image,
                  .frame = {.width = width,
                            .height = drum.map.image.height,
                            .pixel_size = drum.pixel_size,
                            .center_x = circle.center_x,
                            .baseline = circle.center_y + drum.map.drum_radius,
                            .plate_diameter = 2 * drum.map.drum_radius * drum.pixel_size,
                            .disc_diameter = 2 * drum.map.inner_radius * drum.pixel_size}};
  if (drum.turning != Turning::kCounterClockwise) return profile;
  profile.frame.center_x = width - circle.center_x;
  for (auto row = profile.image.pixels.begin(); row != profile.image.pixels.end(); row += width) {
    std::reverse(row, row + width);
  }
  return profile;
}

}  // namespace talus::imaging
