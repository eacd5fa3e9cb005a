#include "experiments/analysis/report/data/profile_views.h"

#include "experiments/analysis/compare/profile_pictures.h"
#include "imaging/heap/film_strip.h"
#include "imaging/heap/outline.h"

namespace talus::analysis {
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

namespace {

// ", picture 2" of a film's pictures, from 1.
std::string WhichPicture(const imaging::Frame& frame, int picture) {
  return frame.num_pictures() > 1 ? ", picture " + std::to_string(picture) : "";
}

// Adds an outline for each picture of a film.
void AddOutlines(const OutlineCurve& like, const imaging::Profile& profile, ReportData& data) {
  for (int i = 0; i < profile.frame.num_pictures(); ++i) {
    data.outlines.push_back(MakeOutline(like.title + WhichPicture(profile.frame, i + 1),
                                        imaging::PictureOf(profile, i)));
    data.outlines.back().is_experiment = like.is_experiment;
  }
}

// The best by the campaign's own objective; where nothing can be said by that, by another one. Null
// without images.
const TrialEvidence* BestShown(const ReportData& data, const std::vector<ShownTrial>& shown) {
  if (!data.evidence.reference.has_image()) return nullptr;
  const ObjectiveFinding& own = data.own();
  for (const ShownTrial& s : shown) {
    if (own.absent.empty() && s.trial->id == own.from_trials.best.front().trials.front()) {
      return s.trial;
    }
  }
  return shown.empty() ? nullptr : shown.front().trial;
}

// The campaign's own map of what remains at the recommended set, after those of single trials.
void AddRemains(ReportData& data) {
  const Evidence& evidence = data.evidence;
  if (!evidence.answer) return;
  for (const campaign::ResultRemains& remains : evidence.answer->remains) {
    if (remains.experiment != evidence.experiments[evidence.experiment]) continue;
    const std::filesystem::path file = evidence.folder / remains.file;
    Picture map = ReadPicture(file, "remains_" + file.stem().string(),
                              "What remains at the recommended set" +
                                  WhichPicture(evidence.reference.aehp.frame, remains.picture),
                              data.left_out);
    if (!map.png.empty()) data.pictures.push_back(std::move(map));
  }
}

}  // namespace

void AddProfileViews(ReportData& data) {
  const ReferenceEvidence& reference = data.evidence.reference;
  const std::vector<ShownTrial> shown = TrialsToShow(data.evidence, data.findings);
  data.measures.push_back(
      {"experiment", reference.has_image() ? "AEHP" : "measured", reference.metrics});
  if (reference.has_image()) {
    AddOutlines({.title = "experiment (AEHP)", .x = {}, .height = {}, .is_experiment = true},
                reference.aehp, data);
  }
  for (const ShownTrial& s : shown) {
    const std::string name = "trial " + std::to_string(s.trial->id);
    data.measures.push_back({name, s.why, s.trial->metrics});
    if (const auto profile = data.evidence.profile(s.trial->id)) {
      AddOutlines({.title = name + ", " + s.why, .x = {}, .height = {}}, *profile, data);
    }
  }
  data.pictures = ProfilePictures(data.evidence, shown);
  AddRemains(data);
  data.representative = RepresentativeViews(data.evidence, data.left_out);
  data.film = FilmOf(data.evidence);
  data.overlay = MakeOverlay(data.evidence, BestShown(data, shown), data.left_out);
  if (data.overlay.photographs.empty()) return;
  data.overlay_outlines = {
      MakeOutline("experiment (AEHP)", reference.aehp),
      MakeOutline("simulation, trial " + std::to_string(data.overlay.trial->id),
                  *data.evidence.profile(data.overlay.trial->id))};
}

}  // namespace talus::analysis
