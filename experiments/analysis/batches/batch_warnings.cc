#include "experiments/analysis/batches/batch_warnings.h"

#include <algorithm>
#include <optional>

#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/answer/standing_answer.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/rigs/case/case_text.h"

namespace talus::analysis {
namespace {

using campaign::JointView;

// An experiment of one name in both, by its places.
struct Pair {
  int first = 0;
  int batch = 0;
};

// What the two do otherwise with one set; empty if nothing.
std::string OtherCase(const JointView& first, const JointView& batch, const Pair& experiment) {
  const auto num_free = static_cast<Eigen::Index>(first.space.Free().size());
  const std::vector<double> values = first.space.ToNative(Eigen::VectorXd::Constant(num_free, 0.5));
  if (values.size() != batch.space.parameters.size()) return "";
  const auto case_of = [&](const JointView& view, int e) {
    return campaign::CaseOf(view.spec, {.values = values, .experiment = e}, std::nullopt);
  };
  return rigs::RunDifference(case_of(first, experiment.first), case_of(batch, experiment.batch))
      .value_or("");
}

std::string OtherScale(const JointView& first, const JointView& batch) {
  const double there = first.spec.coarse_graining.scale_factor;
  const double here = batch.spec.coarse_graining.scale_factor;
  if (there == here) return "";
  return "the scale factor is " + base::ShortNumber(there) + " there and " +
         base::ShortNumber(here) + " here";
}

std::string EngineText(const campaign::EngineOptions& engine) {
  if (engine.kind == campaign::EngineKind::kTalus) return "talus itself";
  return "\"" + base::Joined(engine.command.command, " ") + "\"";
}

}  // namespace

std::string OtherEngine(const JointView& first, const JointView& batch) {
  const campaign::EngineOptions& there = first.spec.engine;
  const campaign::EngineOptions& here = batch.spec.engine;
  const bool same_engine = there.kind == here.kind && there.command.command == here.command.command;
  if (same_engine && there.command.templates_hash == here.command.templates_hash) return "";
  return batch.folder.root.string() + ": was simulated by " +
         (same_engine ? "other templates of " : "another engine, ") + EngineText(here) + ", " +
         first.folder.root.string() + " by " + (same_engine ? "its own" : EngineText(there)) +
         ": parameters of one name need not mean the same, and a difference of them may come of it";
}

std::vector<std::string> AlarmsOf(const JointView& batch) {
  std::vector<std::string> texts;
  const auto answer = campaign::StandingAnswer(batch.folder.root);
  if (!answer) {
    return {batch.folder.root.string() +
            ": is not finished, so that its ranges may still change; `talus resume " +
            base::ShellWord(batch.folder.root.string()) + "` goes on"};
  }
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
  for (const int e : first.All()) {
    const std::string& name = first.NameOf(e);
    const auto& others = batch.record.experiments;
    const auto found = std::ranges::find(others, name, &journal::ExperimentRecord::name);
    if (found == others.end()) continue;
    add(OtherCase(first, batch, {.first = e, .batch = static_cast<int>(found - others.begin())}),
        ", " + name);
  }
  return texts;
}

}  // namespace talus::analysis
