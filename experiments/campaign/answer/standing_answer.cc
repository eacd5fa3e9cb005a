#include "experiments/campaign/answer/standing_answer.h"

#include <string>

#include "experiments/journal/journal.h"

namespace talus::campaign {

std::optional<Answer> StandingAnswer(const std::filesystem::path& campaign) {
  const std::string text =
      journal::Journal::OpenReadOnly(journal::JournalPath(campaign)).Progress().result_json;
  if (text.empty()) return std::nullopt;
  return ParseAnswer(text);
}

}  // namespace talus::campaign
