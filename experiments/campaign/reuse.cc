#include "experiments/campaign/reuse.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/text/counted.h"
#include "base/text/joined.h"
#include "base/text/name.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/start.h"
#include "experiments/campaign/take_over.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/trials/engines/command_case.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

std::string NamesText(const std::vector<journal::ParameterRecord>& parameters) {
  return base::Joined(parameters, ", ", &journal::ParameterRecord::name);
}

NewExperiment ExperimentOf(const Reuser& reuser, std::size_t index) {
  return {
      .spec = reuser.spec, .index = static_cast<int>(index), .reference = reuser.references[index]};
}

// A scale factor here over the one there at which the grains are as large; or why the trials of a
// test are none of this experiment.
struct Match {
  double scale_ratio = 1;
  std::optional<std::string> why_not{};
};

std::optional<std::string> WhyNotAt(double scale_factor, const Reuser& reuser,
                                    const NewExperiment& experiment, FormerTrial former) {
  former.scale_factor = scale_factor;
  const rigs::Case rig_case = CaseOfTrial(reuser.spec, TrialOf(experiment, former, former.unit),
                                          experiment.reference.frame());
  try {
    return reuser.engine.WhyNotTaken(rig_case, former.folder);
  } catch (const base::Error& error) {
    return error.what();
  }
}

// A folder of another kind of engine is neither whole nor readable to the engine here.
std::optional<std::string> WhyNotByEngine(const Reuser& reuser, const FormerTrial& former) {
  const bool is_command_here = reuser.spec.engine.kind == EngineKind::kCommand;
  const std::string here = is_command_here ? "another engine simulates" : "talus itself simulates";
  try {
    const auto engine = trials::EngineOfCase(former.folder / rigs::kCaseFile);
    if (engine.has_value() == is_command_here) return std::nullopt;
    return (engine ? "it was run by another engine, \"" + base::Joined(engine->command, " ") + "\""
                   : std::string("it was run by talus itself")) +
           "; here " + here;
  } catch (const base::Error&) {
    return std::nullopt;  // its folder is not whole, which is told of it anyway
  }
}

// All trials of a test have one case but for what is searched, so the first that can be read tells.
Match MatchOf(const Reuser& reuser, const NewExperiment& experiment, const FormerTest& test) {
  if (test.trials.empty()) return {.why_not = "none of its simulations has succeeded"};
  if (!SearchesTheSame(reuser.spec, test)) {
    return {.why_not = "searched there: " + NamesText(test.parameters) +
                       "; here: " + NamesText(SearchedParameters(reuser.spec))};
  }
  if (auto other = WhyNotByEngine(reuser, test.trials.front())) return {.why_not = other};
  for (const FormerTrial& former : test.trials) {
    if (!reuser.engine.IsComplete(former.folder)) continue;
    Match match{.why_not = WhyNotAt(former.scale_factor, reuser, experiment, former)};
    for (const double level : reuser.spec.coarse_graining.Levels()) {
      if (!match.why_not) break;
      if (WhyNotAt(level, reuser, experiment, former)) continue;
      match = {.scale_ratio = level / former.scale_factor};
    }
    return match;
  }
  return {.why_not = "the folders of its simulations are empty or gone"};
}

// The level of the spec to the last bit; the scale factor itself where it is none of them.
double LevelNear(const CampaignSpec& spec, double scale_factor) {
  constexpr double kRounding = 1e-9;
  for (const double level : spec.coarse_graining.Levels()) {
    if (std::abs(level - scale_factor) <= kRounding * level) return level;
  }
  return scale_factor;
}

// What a folder has that is not taken.
struct LeftOut {
  int outside = 0;
  int other_scale_factor = 0;
  int twice = 0;
  int failed = 0;
  int incomplete = 0;

  std::string Text() const {
    std::string text;
    const auto add = [&](int count, const char* why) {
      if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + why;
    };
    add(outside, "outside the ranges here");
    add(other_scale_factor, "at scale factors that are not searched here");
    add(twice, "that were taken already");
    add(failed, "that failed");
    add(incomplete, "whose folders are not complete");
    return text;
  }
};

// Collects what the folders hold, one after the other.
class ReuseCollector {
 public:
  explicit ReuseCollector(const Reuser& reuser)
      : reuser_(reuser), experiments_(ExperimentsOf(reuser.spec)) {}

  void AddFolder(const fs::path& folder) {
    folder_ = folder.string();
    left_out_ = {};
    if (IsWorkedOn(folder)) {
      plan_.messages.push_back(folder_ +
                               ": another process works on it; what has ended by now is taken");
    }
    const std::vector<FormerTest> tests = FormerTestsIn(folder);
    std::string taken;
    const std::size_t before = plan_.trials.size();
    for (std::size_t e = 0; e < reuser_.references.size(); ++e) {
      const int count = AddTests(tests, e);
      if (count > 0) {
        taken +=
            (taken.empty() ? "" : ", ") + std::to_string(count) + " of " + experiments_[e].name;
      }
    }
    const std::size_t count = plan_.trials.size() - before;
    const std::string left_out = left_out_.Text();
    if (count == 0 && left_out.empty()) return;
    plan_.messages.push_back(folder_ + ": " +
                             base::Counted(static_cast<long long>(count), "simulation") +
                             " told first" + (count > 0 ? " (" + taken + ")" : "") +
                             (left_out.empty() ? "" : "; left out: " + left_out));
  }

  ReusePlan Take() {
    if (!plan_.trials.empty()) return std::move(plan_);
    std::string text = "--reuse: no simulation there is one of an experiment here";
    for (const std::string& message : plan_.messages) text += "\n  " + message;
    text +=
        "\n  what differs a little is refused as well: what it moves is not known here; `talus "
        "sensitivity` of the former campaign tells it for a fixed property";
    throw base::ConfigError(text);
  }

 private:
  // How many of the tests' trials the experiment has taken; says why none fits.
  int AddTests(const std::vector<FormerTest>& tests, std::size_t e) {
    const NewExperiment experiment = ExperimentOf(reuser_, e);
    int count = 0;
    bool any_fits = false;
    std::string why;
    for (const FormerTest& test : tests) {
      const Match match = MatchOf(reuser_, experiment, test);
      if (match.why_not) {
        // What is called the same was meant to be the same.
        if (why.empty() || base::FileWord(test.name) == base::FileWord(experiments_[e].name)) {
          why = "of \"" + test.name + "\" there, " + *match.why_not;
        }
        continue;
      }
      any_fits = true;
      left_out_.failed += test.num_failed;
      for (FormerTrial former : test.trials) {
        former.scale_factor = LevelNear(reuser_.spec, former.scale_factor * match.scale_ratio);
        count += AddTrial(experiment, test, former);
      }
    }
    if (!any_fits) {
      plan_.messages.push_back(folder_ + ": nothing for \"" + experiments_[e].name + "\": " + why);
    }
    return count;
  }

  bool AddTrial(const NewExperiment& experiment, const FormerTest& test,
                const FormerTrial& former) {
    const auto unit = UnitOf(reuser_.spec, test, former);
    if (int* count = LeftOutAs(experiment, former, unit.has_value())) {
      ++*count;
      return false;
    }
    plan_.trials.push_back({.former = former, .record = TrialOf(experiment, former, *unit)});
    return true;
  }

  // What it is counted as where it is not taken; else null, and it is known from now on.
  int* LeftOutAs(const NewExperiment& experiment, const FormerTrial& former, bool is_inside) {
    if (!is_inside) return &left_out_.outside;
    const std::vector<double> levels = reuser_.spec.coarse_graining.Levels();
    if (std::ranges::count(levels, former.scale_factor) == 0) return &left_out_.other_scale_factor;
    if (!reuser_.engine.IsComplete(former.folder)) return &left_out_.incomplete;
    const bool is_new =
        known_.emplace(experiment.index, former.seed, former.scale_factor, former.native).second;
    return is_new ? nullptr : &left_out_.twice;
  }

  const Reuser& reuser_;
  const std::vector<ExperimentSpec> experiments_;
  std::string folder_;
  LeftOut left_out_;
  // Experiment, seed, scale factor and values of those taken.
  std::set<std::tuple<int, std::int64_t, double, std::vector<double>>> known_;
  ReusePlan plan_;
};

CampaignFolder CopiesOf(const CampaignFolder& folder) { return {folder.root / kCopiesFolder}; }

}  // namespace

ReusePlan PlanReuse(const Reuser& reuser, const std::vector<fs::path>& folders) {
  if (reuser.spec.HasOwnProposer()) {
    throw base::ConfigError(
        "--reuse: strategy.kind must be \"auto\": the others begin with a design of their own");
  }
  ReuseCollector collector(reuser);
  for (const fs::path& folder : folders) collector.AddFolder(folder);
  return collector.Take();
}

std::vector<journal::TrialRecord> CopyReused(const Reuser& reuser, const CampaignFolder& folder,
                                             ReusePlan& plan) {
  const CampaignFolder copies = CopiesOf(folder);
  fs::remove_all(copies.root);
  TakenOver taken;
  for (const ReusePlan::Trial& planned : plan.trials) {
    journal::TrialRecord trial = planned.record;
    trial.id = static_cast<std::int64_t>(taken.trials.size()) + 1;
    trial.kind = journal::TrialKind::kReused;
    trial.kind_index = trial.id - 1;
    trial.set = trial.id;  // 0 is the noise's
    trial.origin = planned.former.folder.string();
    TakeOver(copies, ExperimentOf(reuser, static_cast<std::size_t>(trial.experiment)),
             planned.former, trial, reuser.engine, taken);
  }
  const std::size_t num_lost = plan.trials.size() - taken.trials.size();
  if (num_lost > 0 && taken.trials.empty()) {
    throw base::Error("--reuse: none of the " + std::to_string(num_lost) +
                      " simulations that fit could be read");
  }
  if (num_lost > 0) {
    plan.messages.push_back(std::to_string(num_lost) +
                            " of these have failed or cannot be read, and are left out");
  }
  return taken.trials;
}

void AdoptCopies(const CampaignFolder& folder) {
  const fs::path copies = CopiesOf(folder).root;
  if (fs::exists(copies / "trials")) fs::rename(copies / "trials", folder.root / "trials");
  fs::remove_all(copies);
}

}  // namespace talus::campaign
