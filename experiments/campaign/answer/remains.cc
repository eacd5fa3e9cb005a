#include "experiments/campaign/answer/remains.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/text/counted.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "imaging/drawing/canvas.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/difference_map.h"
#include "imaging/heap/film_strip.h"
#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"

namespace talus::campaign {
namespace {

constexpr const char* kFolder = "remains";

struct Simulated {
  imaging::GrayImage image;
  int num_trials = 0;  // 0: predicted
};

std::optional<Simulated> SimulatedAt(const Eigen::VectorXd& point, int experiment, Planner& planner,
                                     const CampaignEvidence& evidence) {
  std::vector<imaging::GrayImage> profiles;
  for (const journal::TrialRecord* trial : planner.Confirming(point, experiment)) {
    if (trial->status != journal::TrialStatus::kOk) continue;
    if (auto profile = evidence.profile(trial->id)) profiles.push_back(std::move(*profile));
  }
  if (!profiles.empty()) {
    return Simulated{.image = imaging::MeanImage(profiles),
                     .num_trials = static_cast<int>(profiles.size())};
  }
  const std::vector<float> field = planner.PredictedField(point, experiment);
  if (field.empty()) return std::nullopt;
  return Simulated{.image =
                       evidence.references[static_cast<std::size_t>(experiment)].ImageOf(field)};
}

bool IsAscii(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) { return c < 128; });
}

// "wide plate, picture 2 of 3: 12 mm2, 4.1 % of the powder's area; mean of 3 simulations". The
// picture's font has ASCII only: of another name page and file tell.
std::string TitleOf(const ResultRemains& remains, int num_pictures) {
  std::string title = IsAscii(remains.experiment) ? remains.experiment : "";
  if (num_pictures > 1) {
    title += (title.empty() ? "" : ", ") + std::string("picture ") +
             std::to_string(remains.picture) + " of " + std::to_string(num_pictures);
  }
  title += (title.empty() ? "" : ": ") + base::ShortNumber(remains.sad_mm2, 3) + " mm2";
  if (remains.share) {
    title += ", " + base::ShortNumber(100 * *remains.share, 2) + " % of the powder's area";
  }
  return title + (remains.num_trials > 0
                      ? "; mean of " + base::Counted(remains.num_trials, "simulation")
                      : "; as the model predicts it");
}

void WriteMap(const std::filesystem::path& folder, const imaging::Profile& simulated,
              const imaging::Profile& measured, const std::string& title, const std::string& file) {
  constexpr double kLeft = 10;  // [px]
  constexpr double kTitle = 9;
  imaging::ColorImage map = imaging::DrawDifferenceMap(simulated, measured);
  imaging::DrawText(map, {.text = title, .at = {kLeft, kTitle}, .size = 0.42});
  base::WriteFileAtomically(folder / file, imaging::EncodePng(map));
}

void WritePictures(const std::filesystem::path& folder, int experiment, const std::string& name,
                   const imaging::Profile& measured, const Simulated& simulated,
                   std::vector<ResultRemains>& all) {
  const int num_pictures = measured.frame.num_pictures();
  const imaging::Profile strip{.image = simulated.image, .frame = measured.frame};
  const double pixel = 1e3 * measured.frame.pixel_size;  // [mm]
  for (int i = 0; i < num_pictures; ++i) {
    const imaging::Profile there = imaging::PictureOf(measured, i);
    const imaging::Profile here = imaging::PictureOf(strip, i);
    const double sad = imaging::Sad(here.image, there.image);
    const double area = imaging::Nebp(there.image);
    ResultRemains remains{.experiment = name,
                          .picture = i + 1,
                          .num_trials = simulated.num_trials,
                          .sad_mm2 = sad * pixel * pixel};
    if (area > 0) remains.share = sad / area;
    remains.file = std::string(kFolder) + "/" + std::to_string(experiment + 1) + "_" +
                   base::FileWord(name) +
                   (num_pictures > 1 ? "_" + std::to_string(i + 1) : std::string()) + ".png";
    WriteMap(folder, here, there, TitleOf(remains, num_pictures), remains.file);
    all.push_back(std::move(remains));
  }
}

}  // namespace

std::vector<ResultRemains> WriteRemains(const std::filesystem::path& folder, Planner& planner,
                                        const CampaignEvidence& evidence) {
  std::vector<ResultRemains> all;
  const auto answer = planner.Recommend();
  if (!answer) return all;
  for (std::size_t e = 0; e < evidence.references.size(); ++e) {
    const Reference& reference = evidence.references[e];
    if (!reference.has_image()) continue;
    const auto simulated = SimulatedAt(answer->point, static_cast<int>(e), planner, evidence);
    if (!simulated) continue;
    base::MakeOutputFolder(folder / kFolder);
    WritePictures(folder, static_cast<int>(e), evidence.campaign.experiments[e].name,
                  reference.aehp(), *simulated, all);
  }
  return all;
}

}  // namespace talus::campaign
