// What is doubtful about an experiment's photographs, as data: the terminal, measure.json and the
// report say it in the same words.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/units.h"
#include "imaging/heap/profile.h"
#include "imaging/photos/ground.h"

namespace talus::imaging {

enum class PhotoDoubt {
  kLeftOut,        // not usable; `reason` says why
  kUnread,         // `reason`: images that the pattern does not fit
  kSeveralHeaps,   // in one run; value: how many, `photo`: the first of the second, `reason`: the
                   // sign
  kRunDisagrees,   // `reason`: the run; value: its difference from the others / the usual one [-]
  kNoNoise,        // heaps are alike as no two are; value: noise floor / heap's width [px]
  kFrontLit,       // powder is brighter than its background; value: number of such photographs
  kMixedLight,     // it is in some only; value: their number; `photo`: the first of the rarer kind
  kHiddenTop,      // no photograph shows the plate's top
  kTilted,         // plate or table, farther than its edges are looked for; value: tilt [rad]
  kBeyondPicture,  // value: share of a table's part that counts and that no picture shows [-]
  kNoPowder,       // nothing stands on the plate
  kTouchesFrame,   // powder at the picture's edge
  kBesidePlate,    // value: share of the powder farther out than the plate's rim [-]
  kViewDisagrees,  // value: NEBP / median NEBP of all views [-]
  kOverexposed,    // value: share of the background at full white [-]
  kOtherLight,     // `reason` ("darker") than most by the factor `value` [-]
  kCopied,         // the same file as `reason`, of an earlier run
};

struct PhotoWarning {
  PhotoDoubt doubt = PhotoDoubt::kLeftOut;
  std::filesystem::path photo{};  // empty where it is of all
  double value = 0;               // as the doubt says
  std::string reason{};  // of kLeftOut, kUnread, kSeveralHeaps, kRunDisagrees, kOtherLight,
                         // kCopied
  int num_photos = 1;    // that share the doubt; `photo` and `value` are of the worst
};

// The same doubt about more than three photographs is a fault of the set-up: one warning, at the
// place of the first. Photographs left out and views that disagree stay single, each to be looked
// at.
std::vector<PhotoWarning> Gathered(const std::vector<PhotoWarning>& warnings);

// One sentence with the photograph, the number and what to look at.
std::string WarningText(const PhotoWarning& warning);

// One silhouette and what its photograph is known to be.
struct SeenView {
  const std::filesystem::path& photo;
  const GrayImage& silhouette;
  double nebp = 0;  // [px]
  const Frame& frame;
  Ground ground = Ground::kPlate;
  double overexposed = 0;       // as in BacklitPhoto [-]
  bool reaches_border = false;  // of the photograph
};
std::vector<PhotoWarning> WarningsOf(const SeenView& view);

// Share of the powder that lies farther from the axis than the plate's rim and a margin [-].
double ShareBesidePlate(const GrayImage& silhouette, const Frame& frame);

inline constexpr double kMuchBesidePlate = 0.01;  // [-]
inline constexpr double kMuchOverexposed = 0.5;   // [-]
inline constexpr double kMuchTilted = 4 * base::kDegree;
// When more photographs than these are alike in a fault, one line says how many they are.
inline constexpr std::ptrdiff_t kMostSingle = 3;

// NEBP of each view over the median of all, for those that are off by more than 20 % and by more
// than four standard deviations (1.48 × median absolute deviation); 0 for the others.
std::vector<double> DisagreeingViews(const std::vector<double>& nebp);

// The leave-one-out difference of each run over the median of the others', for those that differ
// more than twice as much; 0 for the others, and for all of fewer than four runs.
std::vector<double> DisagreeingRuns(const std::vector<double>& differences);

}  // namespace talus::imaging

template <>
struct talus::base::Names<talus::imaging::PhotoDoubt> {
  using enum talus::imaging::PhotoDoubt;
  static constexpr std::array kList{std::pair{"left_out", kLeftOut},
                                    std::pair{"unread", kUnread},
                                    std::pair{"several_heaps", kSeveralHeaps},
                                    std::pair{"run_disagrees", kRunDisagrees},
                                    std::pair{"no_noise", kNoNoise},
                                    std::pair{"front_lit", kFrontLit},
                                    std::pair{"mixed_light", kMixedLight},
                                    std::pair{"hidden_top", kHiddenTop},
                                    std::pair{"tilted", kTilted},
                                    std::pair{"beyond_picture", kBeyondPicture},
                                    std::pair{"no_powder", kNoPowder},
                                    std::pair{"touches_frame", kTouchesFrame},
                                    std::pair{"beside_plate", kBesidePlate},
                                    std::pair{"view_disagrees", kViewDisagrees},
                                    std::pair{"overexposed", kOverexposed},
                                    std::pair{"other_light", kOtherLight},
                                    std::pair{"copied", kCopied}};
};
