// What a campaign's finished trials say together, looked at without writing anything: the ground of
// `talus consider` and `talus next`.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

struct JointView {
  CampaignFolder folder;
  CampaignSpec spec;
  journal::CampaignRecord record;
  std::vector<Reference> references;
  optimizer::ParameterSpace space;
  std::vector<journal::TrialRecord> trials;            // all, by id
  std::vector<optimizer::Observation> observations{};  // of the search, in the order of finish

  // The index of the experiment with this name; throws ConfigError that lists the names.
  int IndexOf(std::string_view name) const;
  const std::string& NameOf(int experiment) const {
    return record.experiments[static_cast<std::size_t>(experiment)].name;
  }
  // The id of the latest trial that has ended; 0: none.
  std::int64_t LastEnded() const;
  // All of them, by index.
  std::vector<int> All() const;
  // Those that the campaign's answer meets: all but the one that its spec holds out.
  std::vector<int> Answered() const;

  // Fills `observations` in; the field is of a trial's image (StoredField).
  void Observe(const std::function<std::vector<float>(const journal::TrialRecord&)>& field);
};

// The spec with the objective that the result is of, which may be another than the one it was
// started with.
CampaignSpec SpecOfAnswer(const journal::CampaignRecord& campaign,
                          const journal::ProgressRecord& progress);

// The campaign may be running.
JointView ReadJointView(const std::filesystem::path& folder);

// Told what the trials of these experiments say, and nothing of others.
std::unique_ptr<optimizer::PosteriorStrategy> StrategyOf(const JointView& view,
                                                         const std::vector<int>& experiments);

// The one that answers. Throws base::Error where there are too few trials for a posterior.
std::unique_ptr<optimizer::PosteriorStrategy> AnsweringStrategy(const JointView& view);

// What some of the experiments answer by themselves.
struct PartialAnswer {
  std::vector<std::string> experiments;  // by name
  Eigen::VectorXd point;                 // recommended, unit cube
  std::vector<double> values;            // of the free parameters, SI
  std::vector<double> low, high;         // joint 90 % ranges
  double region_volume = 1;              // of the joint 90 % region, share of the searched box
};
// Throws base::Error when there are too few trials of them.
PartialAnswer AnswerOf(const JointView& view, optimizer::PosteriorStrategy& strategy,
                       const std::vector<int>& experiments);

}  // namespace talus::campaign
