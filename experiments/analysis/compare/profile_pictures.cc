#include "experiments/analysis/compare/profile_pictures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "experiments/analysis/compare/crop.h"
#include "imaging/drawing/canvas.h"
#include "imaging/heap/difference_map.h"

namespace talus::analysis {
namespace {

constexpr int kTitleHeight = 26;  // [px]
constexpr int kGap = 14;          // between tiles [px]
constexpr int kTileWidth = 400;   // at least, for the titles [px]

std::string TitleOf(const ShownTrial& shown) { return "trial " + std::to_string(shown.trial->id); }

struct Tile {
  std::string title;
  imaging::ColorImage image;
};

// One column of the sheet: its tiles below each other.
using Column = std::vector<Tile>;

std::vector<Column> Columns(const Evidence& evidence, const std::vector<ShownTrial>& shown) {
  const imaging::Profile& aehp = evidence.reference.aehp;
  std::vector<Column> columns{{{"experiment (AEHP)", imaging::ToColor(aehp.image)}}};
  for (const ShownTrial& s : shown) {
    const auto profile = evidence.profile(s.trial->id);
    if (!profile) continue;
    columns.push_back({{TitleOf(s) + ", " + s.why, imaging::ToColor(profile->image)},
                       {"ANHP - AEHP", imaging::DifferenceImage(*profile, aehp)}});
  }
  return columns;
}

}  // namespace

const TrialEvidence* ConfirmingTrial(const Evidence& evidence) {
  for (const TrialEvidence& trial : evidence.trials) {
    if (trial.kind != journal::TrialKind::kConfirm || trial.state != journal::TrialStatus::kOk)
      continue;
    if (!evidence.answer || campaign::IsRecommended(*evidence.answer, trial.values)) return &trial;
  }
  return nullptr;
}

std::vector<ShownTrial> TrialsToShow(const Evidence& evidence,
                                     const std::vector<ObjectiveFinding>& findings) {
  std::map<int, const TrialEvidence*> by_id;
  for (const TrialEvidence& trial : evidence.trials) by_id[trial.id] = &trial;
  std::vector<ShownTrial> shown;
  const auto add = [&](int id, const std::string& first, const std::string& more) {
    const auto same = [&](const ShownTrial& s) { return s.trial->id == id; };
    const auto found = std::find_if(shown.begin(), shown.end(), same);
    if (found == shown.end()) {
      shown.push_back({by_id.at(id), first});
    } else {
      found->why += more;
    }
  };
  for (const ObjectiveFinding& finding : findings) {
    if (!finding.absent.empty()) continue;
    const std::string& title = finding.info.title;
    add(finding.from_trials.best.front().trials.front(), "best by " + title, ", " + title);
  }
  if (const TrialEvidence* trial = ConfirmingTrial(evidence)) {
    add(trial->id, "a confirming trial", ", a confirming trial");
  }
  return shown;
}

std::string AnhpName(const TrialEvidence& trial) {
  return "anhp_trial_" + std::to_string(trial.id);
}

std::vector<Picture> ProfilePictures(const Evidence& evidence,
                                     const std::vector<ShownTrial>& shown) {
  if (!evidence.reference.has_image()) return {};
  const imaging::Profile& aehp = evidence.reference.aehp;
  std::vector<std::optional<imaging::Profile>> profiles;
  std::vector<const imaging::Profile*> all{&aehp};
  for (const ShownTrial& s : shown) profiles.push_back(evidence.profile(s.trial->id));
  for (const auto& profile : profiles) {
    if (profile) all.push_back(&*profile);
  }
  const Box box = HeapBox(all);
  std::vector<Picture> pictures{MakePicture("aehp", "Experiment (AEHP)", Cropped(aehp.image, box))};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!profiles[i]) continue;
    const std::string title = TitleOf(shown[i]) + ", " + shown[i].why;
    pictures.push_back(MakePicture(AnhpName(*shown[i].trial), "ANHP of " + title,
                                   Cropped(profiles[i]->image, box)));
    pictures.push_back(MakePicture("signed_map_trial_" + std::to_string(shown[i].trial->id),
                                   "Signed map of " + title,
                                   imaging::DrawDifferenceMap(*profiles[i], aehp)));
  }
  return pictures;
}

Picture SideBySide(const Evidence& evidence, const std::vector<ShownTrial>& shown) {
  const std::vector<Column> columns = Columns(evidence, shown);
  if (columns.size() < 2) return {};
  const imaging::Frame& frame = evidence.reference.aehp.frame;
  const int width = std::max(frame.width, kTileWidth) + kGap;
  const int height = frame.height + kTitleHeight + kGap;
  auto sheet =
      imaging::MakeCanvas(static_cast<int>(columns.size()) * width + kGap, 2 * height + kGap);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t r = 0; r < columns[c].size(); ++r) {
      const int left = static_cast<int>(c) * width + kGap;
      const int top = static_cast<int>(r) * height + kGap;
      imaging::DrawText(sheet, {.text = columns[c][r].title,
                                .at = {static_cast<double>(left), top + kTitleHeight / 2.0},
                                .size = 0.45});
      imaging::Paste(columns[c][r].image, 1, left, top + kTitleHeight, sheet);
    }
  }
  return MakePicture("side_by_side", "Experiment, best simulations and their differences", sheet);
}

}  // namespace talus::analysis
