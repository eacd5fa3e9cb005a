#include "experiments/analysis/report/views/film_view.h"

#include <filesystem>

#include "base/files/file.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/trials/simulate/film.h"

namespace talus::analysis {

std::optional<FilmView> FilmOf(const Evidence& evidence) {
  const TrialEvidence* trial = ConfirmingTrial(evidence);
  if (trial == nullptr || evidence.folder.empty()) return std::nullopt;
  const auto file =
      campaign::CampaignFolder{evidence.folder}.trial(trial->id) / trials::kTrialFilmName;
  std::error_code absent;
  if (!std::filesystem::exists(file, absent)) return std::nullopt;
  return FilmView{.trial = trial->id, .gif = base::ReadFile(file)};
}

}  // namespace talus::analysis
