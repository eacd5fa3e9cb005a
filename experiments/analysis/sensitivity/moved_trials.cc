#include "experiments/analysis/sensitivity/moved_trials.h"

#include <limits>

#include "base/error.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/rigs/case/case_text.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

std::string FolderName(const MovedSet& set) {
  std::string name = set.move == nullptr ? "as recommended" : set.move->name + " " + set.move->to;
  if (set.point) {
    name += " at";
    for (const double x : *set.point) name += " " + base::ShortNumber(x, 6);
  }
  return base::FileWord(name);
}

fs::path FolderOf(const SensitivitySetting& setting, const MovedSet& set, int experiment,
                  int replicate) {
  return SensitivityFolder(setting.view.folder.root) / FolderName(set) /
         ("experiment_" + std::to_string(experiment + 1)) / base::FileNumber(replicate + 1);
}

// The numbers that the experiment has measured, in its order.
std::vector<double> NumbersOf(const campaign::Reference& reference,
                              const trials::TrialOutput& output) {
  std::vector<double> numbers;
  for (const journal::ScalarRecord& wanted : reference.scalars()) {
    numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    for (const journal::MetricRecord& metric : output.scalars) {
      if (metric.name == wanted.name && metric.undefined.empty()) numbers.back() = metric.value;
    }
  }
  return numbers;
}

}  // namespace

fs::path SensitivityFolder(const fs::path& campaign) {
  return fs::absolute(campaign) / "sensitivity";
}

rigs::Case MovedCase(const SensitivitySetting& setting, const MovedSet& set, int experiment,
                     int replicate) {
  const campaign::JointView& view = setting.view;
  rigs::Case rig_case = campaign::CaseOf(
      view.spec,
      {.values = view.space.ToNative(set.point.value_or(setting.point)),
       .seed = campaign::DesignSeed(view.spec.seed, static_cast<std::size_t>(replicate)),
       .scale_factor = setting.scale_factor,
       .experiment = experiment},
      view.references[static_cast<std::size_t>(experiment)].frame());
  if (set.move != nullptr) set.move->apply(rig_case);
  return rig_case;
}

bool ActsOn(const SensitivitySetting& setting, const Move& move, int experiment) {
  return !rigs::IsSameRun(MovedCase(setting, {}, experiment, 0),
                          MovedCase(setting, {.move = &move}, experiment, 0));
}

void RunMoved(const SensitivitySetting& setting, const std::vector<MovedSet>& sets) {
  std::vector<campaign::FolderCase> cases;
  for (const MovedSet& set : sets) {
    const Move* acting = set.move != nullptr ? set.move : set.beside;
    for (const int e : setting.view.Answered()) {
      if (acting != nullptr && !ActsOn(setting, *acting, e)) continue;
      for (int i = 0; i < set.replicates; ++i) {
        cases.push_back(
            {.folder = FolderOf(setting, set, e, i), .rig_case = MovedCase(setting, set, e, i)});
      }
    }
  }
  const campaign::CaseRuns runs{.count = cases.size(),
                                .at = [&](std::size_t i) { return cases[i]; },
                                .time_cap = setting.view.spec.trial_time_cap};
  if (campaign::RunCases(runs, setting.parts)) return;
  throw base::Interrupted("interrupted; the same command goes on with the sensitivity");
}

MovedOutputs OutputsOf(const SensitivitySetting& setting, const MovedSet& set,
                       std::size_t answered) {
  const int experiment = setting.view.Answered()[answered];
  const campaign::Reference& reference =
      setting.view.references[static_cast<std::size_t>(experiment)];
  const optimizer::ExperimentModel& model = setting.posterior.models()[answered];
  MovedOutputs made{.outputs = Eigen::MatrixXd(0, model.num_outputs())};
  for (int i = 0; i < set.replicates; ++i) {
    const fs::path folder = FolderOf(setting, set, experiment, i);
    try {
      if (!setting.parts.engine->IsComplete(folder)) throw base::Error("did not end well");
      const trials::TrialOutput output =
          setting.parts.engine->Collect(MovedCase(setting, set, experiment, i), folder);
      made.core_time += output.cpu_time;
      std::vector<float> field;
      if (reference.has_image()) field = reference.Field(output.profile);
      made.outputs.conservativeResize(made.outputs.rows() + 1, Eigen::NoChange);
      made.outputs.bottomRows(1) = model.OutputsOf(field, NumbersOf(reference, output)).transpose();
    } catch (const base::Error&) {
      ++made.num_failed;  // it says nothing of the shift; the table counts it
    }
  }
  return made;
}

}  // namespace talus::analysis
