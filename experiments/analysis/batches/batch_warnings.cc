#include "experiments/analysis/batches/batch_warnings.h"

#include <algorithm>
#include <optional>

#include "base/text/number_text.h"
#include "experiments/campaign/answer/standing_answer.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/rigs/case/case_text.h"

namespace talus::analysis {
namespace {

using campaign::JointView;

// What the two do otherwise with one set; empty if nothing.
std::string OtherCase(const JointView& first, const JointView& batch, int experiment) {
  const auto num_free = static_cast<Eigen::Index>(first.space.Free().size());
  const std::vector<double> values = first.space.ToNative(Eigen::VectorXd::Constant(num_free, 0.5));
  if (values.size() != batch.space.parameters.size()) return "";
  const auto case_of = [&](const JointView& view) {
    return campaign::CaseOf(view.spec, {.values = values, .experiment = experiment}, std::nullopt);
  };
  return rigs::RunDifference(case_of(first), case_of(batch)).value_or("");
}

std::string OtherScale(const JointView& first, const JointView& batch) {
  const double there = first.spec.coarse_graining.scale_factor;
  const double here = batch.spec.coarse_graining.scale_factor;
  if (there == here) return "";
  return "the scale factor is " + base::ShortNumber(there) + " there and " +
         base::ShortNumber(here) + " here";
}

}  // namespace

std::vector<std::string> AlarmsOf(const JointView& batch) {
  std::vector<std::string> texts;
  const auto answer = campaign::StandingAnswer(batch.folder.root);
  if (!answer) return texts;
  for (const campaign::Alarm& alarm : answer->warnings) {
    texts.push_back(batch.folder.root.string() + ": " +
                    campaign::WithFolder(campaign::AlarmText(alarm), batch.folder.root));
  }
  return texts;
}

std::vector<std::string> OtherConditions(const JointView& first, const JointView& batch) {
  std::vector<std::string> texts;
  const auto add = [&](const std::string& difference, const std::string& experiment) {
    if (difference.empty()) return;
    texts.push_back(batch.folder.root.string() + ": other conditions than in " +
                    first.folder.root.string() + experiment + ": " + difference +
                    "; a difference of the parameters may come of it");
  };
  add(OtherScale(first, batch), "");
  const std::size_t num_both =
      std::min(first.record.experiments.size(), batch.record.experiments.size());
  for (std::size_t e = 0; e < num_both; ++e) {
    add(OtherCase(first, batch, static_cast<int>(e)), ", " + first.record.experiments[e].name);
  }
  return texts;
}

}  // namespace talus::analysis
