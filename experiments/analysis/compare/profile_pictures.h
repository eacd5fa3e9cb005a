// The heaps that objectives prefer, as pictures.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/compare/compare.h"
#include "imaging/formats/images/image_file.h"

namespace talus::analysis {

// A trial worth a look, and why.
struct ShownTrial {
  const TrialEvidence* trial = nullptr;
  std::string why;  // "best by SAD, RMSE"
};

// The first trial that confirms the recommended set; before there is an answer the first that
// confirms at all, and null without any.
const TrialEvidence* ConfirmingTrial(const Evidence& evidence);

// The first trial of the best set by each objective, and ConfirmingTrial; each once.
std::vector<ShownTrial> TrialsToShow(const Evidence& evidence,
                                     const std::vector<ObjectiveFinding>& findings);

struct Picture {
  std::string name;  // of the file, without ending: "signed_map_trial_12"
  std::string title;
  std::string caption;  // may be empty
  int width = 0;        // [px]
  int height = 0;       // [px]
  std::string png;
};

// A picture of a grey or a colour image, without a caption.
template <class Image>
Picture MakePicture(const std::string& name, const std::string& title, const Image& image) {
  return {.name = name,
          .title = title,
          .caption = {},
          .width = image.width,
          .height = image.height,
          .png = imaging::EncodePng(image)};
}

// The name of the picture of a trial's ANHP: "anhp_trial_12".
std::string AnhpName(const TrialEvidence& trial);

// The AEHP, then the ANHP and the signed difference map of each trial that has an image.
std::vector<Picture> ProfilePictures(const Evidence& evidence,
                                     const std::vector<ShownTrial>& shown);

// AEHP, ANHPs and differences on one sheet, with titles; no PNG when no trial has an image.
Picture SideBySide(const Evidence& evidence, const std::vector<ShownTrial>& shown);

}  // namespace talus::analysis
