// When a session ends: what was found is written.
#include <cstdint>

#include "base/files/file.h"
#include "experiments/campaign/answer/conclude.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/remains.h"
#include "experiments/campaign/campaign.h"

namespace talus::campaign {

CampaignEnd Campaign::End(base::Interrupt interrupt) {
  const bool finished = interrupt == base::Interrupt::kNone && waiting_.empty();
  journal::ProgressRecord progress{
      .state = finished ? "finished" : "interrupted",
      .stop_reason = finished ? planner_.stop()->Text() : "it was interrupted",
      .elapsed_s = Elapsed(),
      .result_json = {}};
  if (finished) {
    const CampaignEvidence evidence{
        .spec = spec_,
        .campaign = record_,
        .references = references_,
        .profile = [this](std::int64_t id) { return StoredProfile(journal_, folder_, id); },
        .elapsed = Elapsed()};
    result_ = Conclude(planner_, evidence);
    if (result_) result_->remains = WriteRemains(folder_.root, planner_, evidence);
    if (result_) WriteResult(progress);
  }
  journal_.SetProgress(progress);
  journal_.AddEvent("stop", 0, progress.stop_reason);
  if (!finished) return CampaignEnd::kInterrupted;
  if (result_) return CampaignEnd::kFinished;
  console_.Line("no result: " + progress.stop_reason);
  return CampaignEnd::kFailed;
}

void Campaign::WriteResult(journal::ProgressRecord& progress) {
  progress.result_json = AnswerJson(*result_);
  base::WriteFileAtomically(folder_.result(), progress.result_json);
  const auto answer = planner_.Recommend();
  if (!answer || !answer->posterior) return;
  base::WriteFileAtomically(folder_.posterior(),
                            PosteriorCsv(*answer->posterior, planner_.space(), record_.parameters));
}

}  // namespace talus::campaign
