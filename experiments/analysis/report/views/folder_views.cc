#include "experiments/analysis/report/views/folder_views.h"

#include <algorithm>
#include <filesystem>

#include "base/files/file.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/journal/record_json.h"
#include "experiments/trials/simulate/film.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

PredictionView ViewOf(const fs::path& folder, const Evidence& evidence, LeftOut& left_out) {
  const fs::path file = folder / "prediction.json";
  PredictionView view{
      .prediction = journal::ParseRecord<Prediction>(base::ReadFile(file), file.string()),
      .mean = {},
      .different = {}};
  Prediction& p = view.prediction;
  view.is_outdated = HaveTrialsEndedSince(evidence, p.last_trial);
  // Sets without a parameter that is searched since cannot be told beside its others.
  const bool is_of_these = std::ranges::all_of(p.draws, [&](const PredictedDraw& draw) {
    return draw.values.size() == evidence.parameters.size();
  });
  if (!is_of_these) p.different.clear();
  const auto picture = [&](const std::string& name, const std::string& title) {
    const std::string stem = fs::path(name).stem().string();
    return ReadPicture(folder / name, "predict_" + folder.filename().string() + "_" + stem,
                       p.name + title, left_out);
  };
  view.mean = picture(p.mean_profile, ": mean silhouette");
  view.different = picture(p.most_different, ": the two draws that differ most");
  return view;
}

}  // namespace

std::optional<FilmView> FilmOf(const Evidence& evidence) {
  const TrialEvidence* trial = ConfirmingTrial(evidence);
  if (trial == nullptr || evidence.folder.empty()) return std::nullopt;
  const auto file =
      campaign::CampaignFolder{evidence.folder}.trial(trial->id) / trials::kTrialFilmName;
  std::error_code absent;
  if (!fs::exists(file, absent)) return std::nullopt;
  return FilmView{.trial = trial->id, .gif = base::ReadFile(file)};
}

std::optional<SensitivityView> ReadSensitivity(const Evidence& evidence) {
  if (evidence.folder.empty()) return std::nullopt;
  const std::optional<SensitivityTable> table = LoadSensitivity(evidence.folder);
  if (!table) return std::nullopt;
  // One made before a parameter was searched says nothing of it.
  const auto same = [](const SensitivityParameter& told, const ParameterInfo& parameter) {
    return told.name == parameter.range.name;
  };
  if (!std::ranges::equal(table->parameters, evidence.parameters, same)) return std::nullopt;
  return SensitivityView{.table = *table,
                         .is_outdated = HaveTrialsEndedSince(evidence, table->last_trial)};
}

std::vector<PredictionView> ReadPredictions(const Evidence& evidence, LeftOut& left_out) {
  std::vector<fs::path> folders;
  const fs::path root = evidence.folder / "predict";
  if (evidence.folder.empty() || !fs::is_directory(root)) return {};
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    if (fs::exists(entry.path() / "prediction.json")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  std::vector<PredictionView> views;
  for (const fs::path& folder : folders) {
    const auto view = ReadExtra(left_out, [&] {
      return std::optional<PredictionView>(ViewOf(folder, evidence, left_out));
    });
    if (view) views.push_back(*view);
  }
  return views;
}

}  // namespace talus::analysis
