// The experiment as a campaign uses it: what every trial is compared with, and by what number.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiments/journal/objective.h"
#include "experiments/journal/records.h"
#include "imaging/heap/metrics.h"
#include "optimizer/outputs/field_objective.h"

namespace talus::campaign {

// By which a heap without an angle is off its experiment's [deg]: as far as can be.
inline constexpr double kWorstAngle = 90;

struct ReferenceOptions {
  imaging::MetricOptions metrics = {};
  journal::Objective objective = journal::Objective::kSad;
  int num_heaps = 1;                                // that the experiment's profile is the mean of
  std::vector<journal::ScalarRecord> scalars = {};  // what else the experiment has measured
};

class Reference {
 public:
  // Without an image where the experiment has measured numbers only. Throws ConfigError when the
  // experiment has no such angle of repose.
  Reference(std::optional<imaging::Profile> aehp, ReferenceOptions options);

  bool has_image() const { return has_image_; }
  std::optional<imaging::Frame> frame() const {
    return has_image_ ? std::optional(aehp_.profile.frame) : std::nullopt;
  }
  const imaging::Profile& aehp() const { return aehp_.profile; }  // with an image
  const std::vector<journal::ScalarRecord>& scalars() const { return options_.scalars; }

  // Photographs that its image can be the mean of, by its grey levels: one if it is black and
  // white.
  int NumViews() const;  // with an image

  // Every metric of a trial's profile; none without an image.
  std::vector<journal::MetricRecord> Measure(const imaging::GrayImage& profile) const;

  // What is minimised, or nothing where it is not defined.
  std::optional<double> Value(const journal::TrialRecord& trial) const;

  // Whether the trial says anything of this experiment: has its image, whether or not that has the
  // objective's angle, or one of its numbers.
  bool IsMeasured(const journal::TrialRecord& trial) const;

  const journal::ObjectiveInfo& info() const {
    return journal::InfoOf(options_.objective);
  }  // of Value

  // The part of a profile that matters, 1 = powder: where the experiment has powder, with a margin;
  // never below the plate. Of a film it is the same part of each picture, side by side: all of them
  // are one field, whose modes know how the pictures of one run go together.
  std::vector<float> Field(const imaging::GrayImage& profile) const;
  // A whole image with this part, and no powder elsewhere.
  imaging::GrayImage ImageOf(std::span<const float> field) const;
  optimizer::FieldObjective MakeFieldObjective() const;

 private:
  // Calls `body(x, y)` for every pixel of a profile that is part of the field, in its order.
  template <class Body>
  void ForEachPixel(Body&& body) const;
  double ValueOfField(std::span<const float> field) const;
  imaging::Measured AngleOf(const imaging::GrayImage& image) const;  // in degrees

  bool has_image_ = false;
  imaging::HeapImages aehp_;  // empty without an image
  ReferenceOptions options_;
  imaging::Region region_;
  double angle_ = 0;  // of the experiment, for an angle objective [deg]
};

// The best trial of the search for an experiment at a scale factor; null where none has succeeded,
// or the reference has no image.
const journal::TrialRecord* BestOfSearch(std::span<const journal::TrialRecord> trials,
                                         const Reference& reference, int experiment,
                                         double scale_factor);

}  // namespace talus::campaign
