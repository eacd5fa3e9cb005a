// From photographs of a turning drum, one by one or already averaged, to a silhouette map and its
// numbers.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "imaging/drums/drum_surface.h"
#include "imaging/heap/profile.h"

namespace talus::imaging {

// As the camera sees the drum turn: clockwise carries the powder up on the left.
enum class Turning { kClockwise, kCounterClockwise };

// One series, or its average, of one drum.
struct DrumPhotos {
  std::vector<std::filesystem::path> photos;
  double diameter = 0;                      // of the drum inside [m], > 0
  std::optional<double> circle_diameter{};  // of the outermost circle that is seen, the ring's
                                            // outside [m], >= diameter; without it the diameter
  std::optional<Turning> turning{};         // read from the picture without it
  void Validate(base::Problems& problems) const;
};

struct MeasuredDrum {
  DrumMap map;  // mean of the photographs
  DrumSurface surface;
  std::optional<Turning> turning{};  // not known of a powder without a slope unless it was said
  Measured angle;         // dynamic angle of repose [rad], < 0 where a nearly level surface leans
                          // against the turning; its standard error over the photographs
  double pixel_size = 0;  // [m]
  double surface_sd = 0;  // over the photographs, mean over the surface [m]; 0 for one photograph
};

// Throws ConfigError that names the file and what to do.
MeasuredDrum MeasureDrum(const DrumPhotos& options);

// The map as the rig `drum` shows its spheres: turning clockwise (mirrored where it does not), the
// baseline at the drum's lowest point, its diameter in the plate's place, and its disc that of what
// the ring does not hide.
Profile DrumProfile(const MeasuredDrum& drum);

}  // namespace talus::imaging

template <>
struct talus::base::Names<talus::imaging::Turning> {
  using enum talus::imaging::Turning;
  static constexpr std::array kList{std::pair{"clockwise", kClockwise},
                                    std::pair{"counter-clockwise", kCounterClockwise}};
};
