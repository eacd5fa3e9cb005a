#include "experiments/analysis/next/unknown_moves.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "experiments/analysis/sensitivity/sensitivity.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/rigs/case/case_text.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

constexpr int kBaseReplicates = 2 * kFirstReplicates;  // common to all moves
constexpr std::size_t kFirstSeed = 1000;               // beyond those of a design

rigs::Case MiddleCase(const campaign::JointView& view, const TestCandidate& test,
                      const TestDesign& design, int replicate) {
  const std::size_t seed = kFirstSeed + static_cast<std::size_t>(replicate);
  return campaign::CaseOf(SpecOf(view, test),
                          {.values = view.space.ToNative(design.middle),
                           .seed = campaign::DesignSeed(view.spec.seed, seed),
                           .scale_factor = design.scale_factor},
                          design.frame);
}

// The usual moves as the study had them: some depend on the set.
std::vector<Move> UsualThere(const campaign::JointView& view, const SensitivityTable& table) {
  const std::vector<int> free = view.space.Free();
  if (table.parameters.size() != free.size()) return {};  // a parameter was added since
  Eigen::VectorXd point(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    const optimizer::Parameter& p = view.space.parameters[static_cast<std::size_t>(free[i])];
    point[static_cast<Eigen::Index>(i)] = p.ToUnit(table.parameters[i].value);
  }
  std::vector<rigs::Case> experiments;
  for (const int e : view.Answered()) {
    experiments.push_back(campaign::CaseAt(view.spec, point, e, table.scale_factor));
  }
  return UsualMoves(view, experiments);
}

// The user's value; a test of another mass is moved by the same ratio.
std::string ValueHere(const rigs::Case& rig_case, const FixedMove& recorded) {
  if (!campaign::IsOfBulk(recorded.name) || campaign::IsFactor(recorded.name)) return recorded.to;
  const auto own = campaign::ParameterOf(rig_case, recorded.name);
  const double from = campaign::ParseProperty(recorded.name, recorded.from);
  const double to = campaign::ParseProperty(recorded.name, recorded.to);
  const std::string unit = campaign::UnitOf(recorded.name);
  if (!own || !(from > 0) || base::WithUnit(*own, unit) == recorded.from) return recorded.to;
  return base::ExactNumber(*own * to / from);
}

// The same of this test: as usual what was moved as usual, else to the value that the user gave.
std::optional<Move> MoveOf(const campaign::JointView& view, const rigs::Case& rig_case,
                           const FixedMove& recorded, const std::vector<Move>& usual_there) {
  const auto is_it = [&](const Move& m) { return m.name == recorded.name && m.to == recorded.to; };
  if (std::ranges::any_of(usual_there, is_it)) {
    for (Move& usual : UsualMoves(view, rig_case)) {
      if (usual.name == recorded.name) return std::move(usual);
    }
    return std::nullopt;  // it acts on none such
  }
  try {
    return MoveTo(view, rig_case, recorded.name, ValueHere(rig_case, recorded));
  } catch (const base::ConfigError&) {
    return std::nullopt;  // searched by now, or not what this test has
  }
}

bool Changes(const Move& move, const rigs::Case& rig_case) {
  if (!WhyNotMoved(move, rig_case).empty()) return false;
  rigs::Case moved = rig_case;
  move.apply(moved);
  return !rigs::IsSameRun(rig_case, moved);
}

// One simulation of a test: nothing moved where `move` is null.
struct UnknownRun {
  const Move* move = nullptr;
  int replicate = 0;
};

std::vector<UnknownRun> RunsOf(const std::vector<Move>& moves) {
  std::vector<UnknownRun> runs;
  if (moves.empty()) return runs;
  for (int i = 0; i < kBaseReplicates; ++i) runs.push_back({.replicate = i});
  for (const Move& move : moves) {
    for (int i = 0; i < kFirstReplicates; ++i) runs.push_back({.move = &move, .replicate = i});
  }
  return runs;
}

campaign::FolderCase FolderCaseOf(const campaign::JointView& view, const MovedDesign& moved,
                                  const UnknownRun& run) {
  const fs::path root = campaign::NextFolder(view.folder.root) / FileName(moved.test) / "unknown";
  const std::string name =
      run.move == nullptr ? "as_it_stands" : base::FileWord(run.move->name + "-" + run.move->to);
  campaign::FolderCase made{.folder = root / name / base::FileNumber(run.replicate + 1),
                            .rig_case = MiddleCase(view, moved.test, moved.design, run.replicate)};
  if (run.move != nullptr) run.move->apply(made.rig_case);
  return made;
}

}  // namespace

std::vector<Move> UnknownMoves(const campaign::JointView& view, const TestCandidate& test,
                               const TestDesign& design) {
  std::vector<Move> moves;
  const std::optional<SensitivityTable> table = LoadSensitivity(view.folder.root);
  if (!table) return moves;
  const rigs::Case rig_case = MiddleCase(view, test, design, 0);
  const std::vector<Move> usual = UsualThere(view, *table);
  for (const FixedMove& recorded : table->moves) {
    if (!recorded.why_not.empty()) continue;
    std::optional<Move> move = MoveOf(view, rig_case, recorded, usual);
    if (move && Changes(*move, rig_case)) moves.push_back(std::move(*move));
  }
  return moves;
}

UnknownTrials StoredUnknowns(const campaign::JointView& view, const MovedDesign& moved,
                             trials::TrialEngine& engine) {
  UnknownTrials all;
  for (const Move& move : moved.moves) {
    all.moved.push_back({.name = move.name, .from = move.from, .to = move.to, .trials = {}});
  }
  for (const UnknownRun& run : RunsOf(moved.moves)) {
    campaign::CaseOutcome outcome = campaign::OutcomeOf(FolderCaseOf(view, moved, run), engine);
    all.num_missing += outcome.has_ended ? 0 : 1;
    all.core_time += outcome.core_time;
    if (!outcome.output) continue;
    auto& trials = run.move == nullptr
                       ? all.base
                       : all.moved[static_cast<std::size_t>(run.move - moved.moves.data())].trials;
    trials.push_back(TrialOf(moved.design.middle, std::move(*outcome.output)));
  }
  return all;
}

UnknownTrials SimulateUnknowns(const campaign::JointView& view, const MovedDesign& moved,
                               const campaign::CampaignParts& parts) {
  const std::vector<UnknownRun> list = RunsOf(moved.moves);
  const campaign::CaseRuns runs{.spec = view.spec, .count = list.size(), .at = [&](std::size_t i) {
                                  return FolderCaseOf(view, moved, list[i]);
                                }};
  if (!campaign::RunCases(runs, parts)) {
    throw base::Interrupted("interrupted; the same command goes on with \"" + moved.test.name +
                            "\"");
  }
  return StoredUnknowns(view, moved, *parts.engine);
}

}  // namespace talus::analysis
