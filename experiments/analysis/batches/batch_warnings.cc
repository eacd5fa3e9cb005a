#include "experiments/analysis/batches/batch_warnings.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/answer/standing_answer.h"
#include "experiments/campaign/earlier_posterior.h"
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

rigs::Case MiddleCase(const JointView& view, int experiment) {
  const auto num_free = static_cast<Eigen::Index>(view.space.Free().size());
  std::vector<double> values = view.space.ToNative(Eigen::VectorXd::Constant(num_free, 0.5));
  for (const int i : view.space.Free()) {
    const auto k = static_cast<std::size_t>(i);
    if (campaign::IsFactor(view.space.parameters[k].name)) values[k] = 1;
  }
  return campaign::CaseOf(view.spec, {.values = values, .experiment = experiment}, std::nullopt);
}

// Both cases with `giver`'s values of what is searched: that is no condition.
void Align(const optimizer::ParameterSpace& searched, rigs::Case& giver, rigs::Case& taker) {
  for (const int i : searched.Free()) {
    const std::string& name = searched.parameters[static_cast<std::size_t>(i)].name;
    if (campaign::IsFactor(name)) continue;
    const auto own = campaign::ParameterOf(taker, name);
    const auto value = campaign::ParameterOf(giver, name);
    if (!own && !value) continue;
    campaign::SetParameter(value ? taker : giver, name, value ? *value : *own);
  }
}

// What the two do otherwise with one set; empty if nothing.
std::string OtherCase(const JointView& first, const JointView& batch, const Pair& experiment) {
  rigs::Case there = MiddleCase(first, experiment.first);
  rigs::Case here = MiddleCase(batch, experiment.batch);
  Align(batch.space, there, here);
  Align(first.space, here, there);
  return rigs::RunDifference(there, here).value_or("");
}

std::string Differ(const std::string& what, double there, double here) {
  if (there == here) return "";
  return what + " is " + base::ShortNumber(there) + " there and " + base::ShortNumber(here) +
         " here";
}

std::string OtherScale(const JointView& first, const JointView& batch) {
  const campaign::GrainSizes& there = first.spec.coarse_graining;
  const campaign::GrainSizes& here = batch.spec.coarse_graining;
  const std::string answers =
      Differ("the scale factor that it answers for", there.Target(), here.Target());
  if (!answers.empty()) return answers;
  return Differ("the finest scale factor simulated", there.Levels().back(), here.Levels().back());
}

// The tests that only one of two batches has: ranges that rest on other tests are other ranges.
std::string OtherTests(const JointView& first, const JointView& batch) {
  const auto alone = [](const JointView& view, const JointView& other) {
    std::vector<std::string> names;
    for (const journal::ExperimentRecord& e : view.record.experiments) {
      const auto& others = other.record.experiments;
      const auto same = std::ranges::find(others, e.name, &journal::ExperimentRecord::name);
      if (same == others.end()) names.push_back("\"" + e.name + "\"");
    }
    return names;
  };
  std::string text;
  const auto add = [&](const std::vector<std::string>& names, const char* where) {
    if (names.empty()) return;
    text += (text.empty() ? "" : ", and ") + base::Listed(names) + " only " + where;
  };
  add(alone(first, batch), "there");
  add(alone(batch, first), "here");
  return text.empty() ? "" : "there is " + text;
}

// One name for one folder.
std::filesystem::path WholePath(const std::filesystem::path& folder) {
  const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(folder));
  return whole.has_filename() ? whole : whole.parent_path();  // of "february/"
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

std::string CommonPrior(const JointView& first, const JointView& batch) {
  const auto priors_of = [](const JointView& view) {
    std::set<std::filesystem::path> folders;
    for (const std::filesystem::path& folder : campaign::PriorFolders(view.spec)) {
      folders.insert(WholePath(folder));
    }
    return folders;
  };
  const std::string a = first.folder.root.string(), b = batch.folder.root.string();
  const auto there = priors_of(first), here = priors_of(batch);
  const auto common = std::ranges::find_if(
      here, [&](const std::filesystem::path& folder) { return there.contains(folder); });
  std::string which;
  if (here.contains(WholePath(first.folder.root))) {
    which = b + ": has the posterior of " + a + " as its prior";
  } else if (there.contains(WholePath(batch.folder.root))) {
    which = a + ": has the posterior of " + b + " as its prior";
  } else if (common != here.end()) {
    which = b + ": has the posterior of " + common->string() + " as its prior, as " + a + " has";
  } else {
    return "";
  }
  return which +
         ", so that a difference is shown smaller than it is; calibrate without it (calibrate "
         "--reuse takes the simulations over)";
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
  add(OtherTests(first, batch), "");
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
