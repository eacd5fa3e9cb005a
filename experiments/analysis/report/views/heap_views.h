// Heaps to look at: those of the sets that fit equally, and one on top of the real photographs.
#pragma once

#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/analysis/report/views/extras.h"

namespace talus::analysis {

// A set that fits as well as the recommended one, or that one itself.
struct RepresentativeView {
  std::vector<double> values;  // SI
  bool is_recommended = false;
  double expected = base::kNotKnown;  // the objective there, by the model that answers
  double expected_sd = base::kNotKnown;
  const TrialEvidence* trial = nullptr;  // the nearest simulation at the finest scale factor
  double distance = 0;                   // of it, largest difference / searched range
  Picture heap;                          // of it; no PNG where its grains are not kept
};

std::vector<RepresentativeView> RepresentativeViews(const Evidence& evidence, LeftOut& left_out);

// Photographs of a heap, and a simulated one as the same camera would see it.
struct PhotoOverlay {
  std::vector<Picture> photographs;  // one a view
  Picture simulated;                 // of the same frame and size
  const TrialEvidence* trial = nullptr;
  double pixel_mm = 0;   // of all of them
  double center_x = 0;   // of the plate, from the left [px]
  double baseline = 0;   // … from the top
  std::string absent{};  // why there are no photographs to show
};

// The heap of the confirming trial, or of the best one before there is one; null without any. No
// photographs where the spec's are no longer there, or the experiment is a map.
PhotoOverlay MakeOverlay(const Evidence& evidence, const TrialEvidence* best, LeftOut& left_out);

}  // namespace talus::analysis
