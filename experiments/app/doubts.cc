#include "experiments/app/doubts.h"

#include <iostream>

#include "experiments/campaign/answer/standing_answer.h"
#include "experiments/campaign/folder/folder_in_text.h"

namespace talus::app {

void WarnOfDoubts(const std::filesystem::path& campaign) {
  const auto answer = campaign::StandingAnswer(campaign);
  if (!answer) return;
  for (const campaign::Alarm& alarm : answer->warnings) {
    if (!campaign::IsDoubt(alarm.kind)) continue;
    std::cerr << "warning: " << campaign::WithFolder(campaign::AlarmText(alarm), campaign)
              << std::endl;
  }
}

}  // namespace talus::app
