#include "experiments/report/profile_views.h"

#include <algorithm>
#include <map>

#include "imaging/image_file.h"
#include "imaging/outline.h"

namespace talus::experiments {
namespace {

// A trial worth a look, and why.
struct Shown {
  const TrialEvidence* trial = nullptr;
  std::string why;  // "best by SAD and RMSE"
};

std::vector<Shown> ShownTrials(const ReportData& data) {
  std::map<int, const TrialEvidence*> by_id;
  for (const TrialEvidence& trial : data.evidence.trials) by_id[trial.id] = &trial;
  std::vector<Shown> shown;
  const auto add = [&](int id, const std::string& first, const std::string& more) {
    const auto same = [&](const Shown& s) { return s.trial->id == id; };
    const auto found = std::find_if(shown.begin(), shown.end(), same);
    if (found == shown.end()) {
      shown.push_back({by_id.at(id), first});
    } else {
      found->why += more;
    }
  };
  for (const ObjectiveFinding& finding : data.findings) {
    if (!finding.absent.empty()) continue;
    const std::string title(finding.info.title);
    add(finding.from_trials.best.front().trials.front(), "best by " + title, ", " + title);
  }
  for (const TrialEvidence& trial : data.evidence.trials) {
    if (trial.purpose == "confirm" && trial.state == TrialState::kDone) {
      add(trial.id, "a confirming trial", ", a confirming trial");
      break;
    }
  }
  return shown;
}

// The highest powder of each column, from foot to foot.
OutlineCurve MakeOutline(const std::string& title, const imaging::Profile& profile) {
  const imaging::Frame& frame = profile.frame;
  const imaging::Outline outline = imaging::FindOutline(profile.image, frame);
  OutlineCurve curve{.title = title, .x = {}, .height = {}};
  if (outline.empty()) return curve;
  const auto at = [&](double column, double height) {
    curve.x.push_back((column - frame.center_x) * frame.pixel_size);
    curve.height.push_back(height * frame.pixel_size);
  };
  at(outline.rows.front().left, 0);
  for (std::size_t column = 0; column < outline.height.size(); ++column) {
    if (outline.height[column] > 0) {
      at(static_cast<double>(column) + 0.5, outline.height[column]);
    }
  }
  at(outline.rows.front().right, 0);
  return curve;
}

Picture MakePicture(const std::string& name, const std::string& title,
                    const imaging::GrayImage& image) {
  return {.name = name,
          .title = title,
          .caption = {},
          .width = image.width,
          .height = image.height,
          .png = imaging::EncodePng(image)};
}

}  // namespace

void AddProfileViews(ReportData& data) {
  const ReferenceEvidence& reference = data.evidence.reference;
  data.measures.push_back({"experiment", "AEHP", reference.metrics});
  data.outlines.push_back(MakeOutline("experiment (AEHP)", reference.aehp));
  data.pictures.push_back(MakePicture("aehp", "Experiment (AEHP)", reference.aehp.image));
  for (const Shown& shown : ShownTrials(data)) {
    const std::string name = "trial " + std::to_string(shown.trial->id);
    const std::string title = name + ", " + shown.why;
    data.measures.push_back({name, shown.why, shown.trial->metrics});
    const auto profile = data.evidence.profile(shown.trial->id);
    if (!profile) continue;
    data.outlines.push_back(MakeOutline(title, *profile));
    data.pictures.push_back(MakePicture("anhp_trial_" + std::to_string(shown.trial->id),
                                        "ANHP of " + title, profile->image));
  }
}

}  // namespace talus::experiments
