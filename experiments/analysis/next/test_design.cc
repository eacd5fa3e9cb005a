#include "experiments/analysis/next/test_design.h"

#include <limits>
#include <string>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/analysis/predict/draws.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/rigs/case/case_text.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

campaign::DesignFolder FolderOf(const campaign::JointView& view, const TestCandidate& test) {
  return {campaign::NextFolder(view.folder.root) / FileName(test)};
}

std::string TextOf(const campaign::JointView& view, const TestCandidate& test) {
  return rigs::RunText(
      campaign::CaseOf(SpecOf(view, test),
                       {.values = view.space.ToNative(Eigen::VectorXd::Constant(
                            static_cast<Eigen::Index>(view.space.Free().size()), 0.5))},
                       FrameOf(view, test)));
}

std::vector<std::vector<double>> PointsOf(const DesignPlace& place) {
  std::vector<std::vector<double>> points;
  for (const Eigen::Index row : FarApart(place.draws, place.size)) {
    const Eigen::RowVectorXd taken = place.draws.row(row);
    points.emplace_back(taken.data(), taken.data() + taken.size());
  }
  return points;
}

Eigen::VectorXd MiddleOf(const campaign::DesignRecord& record) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(PointOf(record, 0).size());
  for (std::size_t i = 0; i < record.points.size(); ++i) mean += PointOf(record, i);
  mean /= static_cast<double>(record.points.size());
  Eigen::VectorXd middle;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    const double distance = (PointOf(record, i) - mean).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    middle = PointOf(record, i);
  }
  return middle;
}

rigs::Case CaseAt(const campaign::JointView& view, const TestCandidate& test,
                  const campaign::DesignRecord& record, std::size_t index) {
  return campaign::CaseOf(SpecOf(view, test),
                          {.values = view.space.ToNative(PointOf(record, index)),
                           .seed = campaign::DesignSeed(view.spec.seed, index),
                           .scale_factor = record.scale_factor},
                          FrameOf(view, test));
}

std::optional<campaign::DesignRecord> ReadRecord(const campaign::JointView& view,
                                                 const TestCandidate& test) {
  auto record = FolderOf(view, test).Read();
  if (!record || record->test != TextOf(view, test)) return std::nullopt;
  if (record->seed != view.spec.seed || record->parameters != view.record.parameters) {
    return std::nullopt;
  }
  return record;
}

TestDesign Collect(const campaign::JointView& view, const TestCandidate& test,
                   const campaign::DesignRecord& record, trials::TrialEngine& engine) {
  TestDesign design{.scale_factor = record.scale_factor,
                    .middle = MiddleOf(record),
                    .frame = FrameOf(view, test),
                    .size = static_cast<int>(record.points.size())};
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    const campaign::FolderCase at{.folder = FolderOf(view, test).trial(i),
                                  .rig_case = CaseAt(view, test, record, i)};
    campaign::CaseOutcome outcome = campaign::OutcomeOf(at, engine);
    design.num_simulations += outcome.has_ended ? 1 : 0;
    design.core_time += outcome.core_time;
    if (!outcome.output) continue;
    design.trials.push_back(TrialOf(PointOf(record, i), std::move(*outcome.output)));
  }
  return design;
}

void Simulate(const campaign::JointView& view, const TestCandidate& test,
              const campaign::DesignRecord& record, const campaign::CampaignParts& parts) {
  const campaign::CaseRuns runs{
      .spec = view.spec, .count = record.points.size(), .at = [&](std::size_t i) {
        return campaign::FolderCase{.folder = FolderOf(view, test).trial(i),
                                    .rig_case = CaseAt(view, test, record, i)};
      }};
  if (campaign::RunCases(runs, parts)) return;
  throw base::Interrupted("interrupted; the same command goes on with \"" + test.name + "\"");
}

}  // namespace

DesignTrial TrialOf(const Eigen::VectorXd& point, trials::TrialOutput output) {
  return {
      .point = point, .profile = std::move(output.profile), .scalars = std::move(output.scalars)};
}

std::optional<TestDesign> StoredDesign(const campaign::JointView& view, const TestCandidate& test,
                                       trials::TrialEngine& engine) {
  const auto record = ReadRecord(view, test);
  if (!record) return std::nullopt;
  return Collect(view, test, *record, engine);
}

TestDesign SimulateDesign(const campaign::JointView& view, const TestCandidate& test,
                          const DesignPlace& place, const campaign::CampaignParts& parts) {
  std::optional<campaign::DesignRecord> record = ReadRecord(view, test);
  // A plan's sets follow from its priors. A campaign's were spread by what it knew by then.
  const bool is_plan = view.record.experiments.empty();
  if (record && is_plan && record->points != PointsOf(place)) record.reset();
  if (!record) {
    record = campaign::DesignRecord{.test = TextOf(view, test),
                                    .scale_factor = view.spec.coarse_graining.Levels().front(),
                                    .seed = view.spec.seed,
                                    .parameters = view.record.parameters,
                                    .points = PointsOf(place)};
    // Where there is one of the same name and another device, it makes room.
    FolderOf(view, test).Make(*record);
    base::WriteFileAtomically(FolderOf(view, test).root / "experiment.json",
                              ExperimentText(view, test));
  }
  Simulate(view, test, *record, parts);
  return Collect(view, test, *record, *parts.engine);
}

}  // namespace talus::analysis
