#include "experiments/analysis/next/test_design.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/files/file.h"
#include "base/interrupt.h"
#include "base/json/json_writer.h"
#include "experiments/journal/record_json.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

constexpr int kDesignSize = 16;

// design.json: what was simulated where.
struct DesignRecord {
  std::string test;  // its JSON: a design of another device is none of this test
  double scale_factor = 1;
  std::vector<std::vector<double>> points{};  // unit cube

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("test", self.test);
    visit("scale_factor", self.scale_factor);
    visit("points", self.points);
  }
};

fs::path FolderOf(const campaign::JointView& view, const TestCandidate& test) {
  return fs::absolute(view.folder.root) / "next" / FileName(test);
}

std::string TextOf(const campaign::JointView& view, const TestCandidate& test) {
  return base::ToJson(
             campaign::CaseOf(SpecOf(view, test),
                              {.values = view.space.ToNative(Eigen::VectorXd::Constant(
                                   static_cast<Eigen::Index>(view.space.Free().size()), 0.5))},
                              FrameOf(view, test)))
      .dump();
}

// The farthest from those that are taken already, one after the other.
std::vector<std::vector<double>> Spread(const Eigen::MatrixXd& draws) {
  std::vector<std::vector<double>> points;
  Eigen::VectorXd distance =
      Eigen::VectorXd::Constant(draws.rows(), std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  for (int i = 0; i < kDesignSize && i < draws.rows(); ++i) {
    const Eigen::RowVectorXd taken = draws.row(next);
    points.emplace_back(taken.data(), taken.data() + taken.size());
    distance = distance.cwiseMin((draws.rowwise() - taken).rowwise().norm());
    distance.maxCoeff(&next);
  }
  return points;
}

fs::path TrialFolder(const fs::path& folder, std::size_t index) {
  char name[16];
  std::snprintf(name, sizeof name, "%04zu", index + 1);
  return folder / "trials" / name;
}

rigs::HeapCase CaseAt(const campaign::JointView& view, const TestCandidate& test,
                      const DesignRecord& record, std::size_t index) {
  const std::vector<double>& point = record.points[index];
  const Eigen::VectorXd unit =
      Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
  return campaign::CaseOf(SpecOf(view, test),
                          {.values = view.space.ToNative(unit),
                           .seed = view.spec.seed + index,
                           .scale_factor = record.scale_factor},
                          FrameOf(view, test));
}

std::optional<DesignRecord> ReadRecord(const campaign::JointView& view, const TestCandidate& test) {
  const fs::path file = FolderOf(view, test) / "design.json";
  if (!fs::exists(file)) return std::nullopt;
  DesignRecord record = journal::ParseRecord<DesignRecord>(base::ReadFile(file), file.string());
  if (record.test != TextOf(view, test)) return std::nullopt;
  return record;
}

TestDesign Collect(const campaign::JointView& view, const TestCandidate& test,
                   const DesignRecord& record, trials::TrialEngine& engine) {
  TestDesign design{.scale_factor = record.scale_factor,
                    .frame = FrameOf(view, test),
                    .num_simulations = static_cast<int>(record.points.size())};
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    const fs::path folder = TrialFolder(FolderOf(view, test), i);
    if (!engine.IsComplete(folder)) continue;
    try {
      trials::TrialOutput output = engine.Collect(CaseAt(view, test, record, i), folder);
      design.trials.push_back(
          {.point = Eigen::Map<const Eigen::VectorXd>(
               record.points[i].data(), static_cast<Eigen::Index>(record.points[i].size())),
           .profile = std::move(output.profile),
           .scalars = std::move(output.scalars)});
    } catch (const base::Error&) {
      continue;  // it failed, and says nothing
    }
  }
  return design;
}

void Simulate(const campaign::JointView& view, const TestCandidate& test,
              const DesignRecord& record, const campaign::CampaignParts& parts) {
  const base::InterruptGuard interrupt;
  trials::TrialEngine& engine = *parts.engine;
  runners::Runner& runner = *parts.runner;
  std::size_t next = 0;
  int running = 0;
  while (next < record.points.size() || running > 0) {
    while (next < record.points.size() && running < runner.Capacity()) {
      const fs::path folder = TrialFolder(FolderOf(view, test), next);
      engine.Prepare(CaseAt(view, test, record, next), folder);
      ++next;
      if (engine.IsComplete(folder)) continue;
      const runners::Job job{.id = static_cast<std::int64_t>(next),
                             .folder = folder,
                             .command = engine.Command(folder),
                             .time_cap = view.spec.trial_time_cap};
      runner.Submit({&job, 1});
      ++running;
    }
    running -= static_cast<int>(runner.Wait(0.5).size());
    if (interrupt.Asked() != base::Interrupt::kNone) {
      throw base::Interrupted("interrupted; the same command goes on with \"" + test.name + "\"");
    }
  }
}

}  // namespace

std::optional<TestDesign> StoredDesign(const campaign::JointView& view, const TestCandidate& test,
                                       trials::TrialEngine& engine) {
  const auto record = ReadRecord(view, test);
  if (!record) return std::nullopt;
  return Collect(view, test, *record, engine);
}

TestDesign SimulateDesign(const campaign::JointView& view, const TestCandidate& test,
                          const Eigen::MatrixXd& draws, const campaign::CampaignParts& parts) {
  std::optional<DesignRecord> record = ReadRecord(view, test);
  if (!record) {
    record = DesignRecord{.test = TextOf(view, test),
                          .scale_factor = view.spec.coarse_graining.Levels().front(),
                          .points = Spread(draws)};
    const fs::path folder = FolderOf(view, test);
    fs::remove_all(folder);  // of a test of the same name and another device
    fs::create_directories(folder);
    base::WriteFileAtomically(folder / "design.json", base::ToJson(*record).dump(1) + "\n");
  }
  Simulate(view, test, *record, parts);
  return Collect(view, test, *record, *parts.engine);
}

}  // namespace talus::analysis
