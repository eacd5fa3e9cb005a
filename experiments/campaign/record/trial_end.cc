#include "experiments/campaign/record/trial_end.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/text/joined.h"

namespace talus::campaign {

bool WasEndedByOthers(const runners::FinishedJob& job) {
  return job.end == runners::JobEnd::kPreempted || job.end == runners::JobEnd::kNodeFailure ||
         (job.end == runners::JobEnd::kExit && job.exit_status == base::kExitInterrupted);
}

void AddTimes(const runners::FinishedJob& job, journal::TrialRecord& trial) {
  if (job.duration > 0) trial.duration_s += job.duration;
  if (job.cpu_time > 0) trial.cpu_s += job.cpu_time;
}

std::string FailureText(const runners::FinishedJob& job, const std::filesystem::path& folder) {
  const std::string log = trials::LastLogLines(folder);
  return job.reason + (log.empty() ? "" : ": " + log);
}

void TakeOutput(const trials::TrialOutput& output, const Reference& reference,
                journal::TrialRecord& trial) {
  std::vector<journal::MetricRecord> metrics = reference.Measure(output.profile);
  for (const journal::MetricRecord& number : output.scalars) {
    if (std::ranges::count(metrics, number.name, &journal::MetricRecord::name) == 0) continue;
    throw base::Error("leaves a number \"" + number.name +
                      "\", which is what its image is measured by: give it another name");
  }
  trial.metrics = std::move(metrics);
  trial.metrics.insert(trial.metrics.end(), output.scalars.begin(), output.scalars.end());
  // As the journal gives them back: a resumed campaign must see the same trial.
  std::ranges::sort(trial.metrics, {}, &journal::MetricRecord::name);
  trial.status = journal::TrialStatus::kOk;
  trial.reason = output.note;
  trial.num_steps = output.num_steps;
  trial.num_particles = output.num_particles;
  // Where it had ended in an earlier process, what is known is of earlier attempts.
  trial.cpu_s = std::max(trial.cpu_s, output.cpu_time);
}

std::optional<std::string> MissingNumber(const Reference& reference,
                                         const std::vector<journal::MetricRecord>& left) {
  const std::string names = base::Joined(left, "\", \"", &journal::MetricRecord::name);
  for (const journal::ScalarRecord& measured : reference.scalars()) {
    if (std::ranges::any_of(left, [&](const auto& l) { return l.name == measured.name; })) continue;
    return "leaves no \"" + measured.name + "\", which was measured; it leaves " +
           (names.empty() ? "no number" : "\"" + names + "\"");
  }
  return std::nullopt;
}

TrialProgress ProgressOf(const journal::TrialRecord& trial, const journal::CampaignRecord& campaign,
                         const Reference& reference, journal::Objective objective) {
  TrialProgress progress{
      .trial = trial.id,
      .kind = trial.kind,
      .status = trial.status,
      .values = trial.native,
      .scale_factor = trial.scale_factor,
      .experiment = campaign.experiments[static_cast<std::size_t>(trial.experiment)].name,
      .objective = reference.Value(trial),
      .unit = reference.has_image() ? std::string(journal::InfoOf(objective).unit) : "",
      .reason = trial.reason,
      .duration = trial.duration_s};
  for (const journal::ParameterRecord& parameter : campaign.parameters) {
    progress.parameters.push_back(parameter.name);
  }
  for (const journal::ScalarRecord& measured : reference.scalars()) {
    if (const auto value = trial.Metric(measured.name)) {
      progress.numbers.push_back({measured.name, *value});
    }
  }
  return progress;
}

}  // namespace talus::campaign
