#include "experiments/campaign/record/stored.h"

#include <algorithm>

#include "base/error.h"
#include "experiments/journal/record_json.h"
#include "experiments/rigs/case/run_files.h"
#include "imaging/formats/images/image_file.h"
#include "optimizer/space/point_rows.h"

namespace talus::campaign {

std::vector<journal::TrialRecord> InOrderOfFinish(std::vector<journal::TrialRecord> trials) {
  std::erase_if(trials, [](const journal::TrialRecord& t) {
    return t.status == journal::TrialStatus::kRunning;
  });
  std::sort(trials.begin(), trials.end(),
            [](const auto& a, const auto& b) { return a.finish_order < b.finish_order; });
  return trials;
}

optimizer::Parameter SearchedParameter(const journal::ParameterRecord& record) {
  return {.name = record.name,
          .low = record.low,
          .high = record.high,
          .scale = record.scale == base::NameOf(optimizer::Scale::kLog)
                       ? optimizer::Scale::kLog
                       : optimizer::Scale::kLinear};
}

Eigen::VectorXd PointOf(const journal::TrialRecord& trial) {
  return optimizer::VectorOf(trial.unit);
}

rigs::Case CaseOfTrial(const CampaignSpec& spec, const journal::TrialRecord& trial,
                       const std::optional<imaging::Frame>& frame) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  std::vector<double> values = space.ToNative(PointOf(trial));
  // The unit cube keeps them but for rounding, which would make another run of it.
  const std::vector<int> free = space.Free();
  for (std::size_t i = 0; i < free.size(); ++i) {
    values[static_cast<std::size_t>(free[i])] = trial.native[i];
  }
  rigs::Case rig_case = CaseOf(spec,
                               {.values = values,
                                .seed = static_cast<std::uint64_t>(trial.seed),
                                .scale_factor = trial.scale_factor,
                                .experiment = trial.experiment},
                               frame);
  rig_case.outputs.film = trial.kind == journal::TrialKind::kConfirm;  // the report shows one
  return rig_case;
}

std::vector<Reference> ReferencesOf(const journal::CampaignRecord& record,
                                    const CampaignSpec& spec) {
  const std::vector<ExperimentSpec> specs = ExperimentsOf(spec);
  std::vector<Reference> references;
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    const journal::ExperimentRecord& experiment = record.experiments[e];
    std::optional<imaging::Profile> aehp;
    if (!experiment.aehp_png.empty()) {
      aehp = {.image = imaging::DecodeGrayImage(experiment.aehp_png, "the journal's AEHP"),
              .frame = journal::ParseRecord<imaging::Frame>(experiment.frame_json,
                                                            "the journal's frame")};
    }
    references.emplace_back(std::move(aehp), ReferenceOptions{.metrics = specs.at(e).images.metrics,
                                                              .objective = spec.objective,
                                                              .num_heaps = experiment.num_heaps,
                                                              .scalars = experiment.scalars});
  }
  return references;
}

std::vector<float> StoredField(journal::Journal& journal, const CampaignFolder& folder,
                               const std::vector<Reference>& references,
                               const journal::TrialRecord& trial) {
  if (trial.status != journal::TrialStatus::kOk || !trial.IsOfSearch()) return {};
  const Reference& reference = references[static_cast<std::size_t>(trial.experiment)];
  if (!reference.has_image()) return {};
  const auto profile = StoredProfile(journal, folder, trial.id);
  if (!profile) return {};
  return reference.Field(*profile);
}

std::optional<imaging::GrayImage> StoredProfile(journal::Journal& journal,
                                                const CampaignFolder& folder, std::int64_t trial) {
  const std::string png = journal.ProfilePng(trial);
  try {
    if (!png.empty()) return imaging::DecodeGrayImage(png, "a profile of the journal");
    return imaging::ReadGrayImage(folder.trial(trial) / rigs::kProfileFile);
  } catch (const base::ConfigError&) {
    return std::nullopt;  // the trial then counts by its number alone
  }
}

}  // namespace talus::campaign
