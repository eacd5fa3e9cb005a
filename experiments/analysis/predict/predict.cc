#include "experiments/analysis/predict/predict.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/predict/draws.h"
#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/analysis/predict/prediction_pictures.h"
#include "experiments/analysis/predict/prediction_runs.h"
#include "experiments/analysis/predict/prediction_text.h"
#include "experiments/analysis/predict/regimes.h"
#include "experiments/analysis/predict/scene_engine.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/folder/console.h"
#include "experiments/campaign/folder/record_file.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/rig_list.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using campaign::JointView;

constexpr int kUsualDraws = 12;
constexpr int kUsualSeeds = 3;
constexpr int kUsualSeedsOfOne = 8;  // scatter is all there is to tell
constexpr const char* kSceneTest = "scene";

// design.json: which sets are simulated, of what.
struct PredictionDesign {
  std::string test;   // the case in the middle of the ranges, without its frame; or the scene
  std::string frame;  // that the images are drawn in
  PredictedBy by = PredictedBy::kPosterior;
  int num_draws = 0;  // that were asked for
  std::int64_t last_trial = 0;
  std::vector<std::vector<double>> points{};  // unit cube
  std::vector<double> weights{};

  static constexpr base::FieldKey kKeys[] = {{"last_trial", "after_trial"}};
  TALUS_FIELDS(test, frame, by, num_draws, last_trial, points, weights);
};

PredictedBy ByOf(const PredictOptions& options) {
  if (options.recommended) return PredictedBy::kRecommended;
  return options.set.empty() ? PredictedBy::kPosterior : PredictedBy::kSet;
}

Eigen::VectorXd RecommendedPoint(const JointView& view) {
  const fs::path file = view.folder.result();
  if (!fs::exists(file)) {
    throw base::ConfigError(view.folder.root.string() +
                            ": has no result yet; without --recommended, draws of what its trials "
                            "say so far are taken");
  }
  const campaign::Answer answer = campaign::ParseAnswer(base::ReadFile(file));
  Eigen::VectorXd point(static_cast<Eigen::Index>(answer.parameters.size()));
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    const campaign::ResultParameter& p = answer.parameters[static_cast<std::size_t>(i)];
    point[i] = p.Range().ToUnit(p.value);
  }
  return point;
}

Eigen::VectorXd OneSet(const JointView& view, const PredictOptions& options) {
  if (options.recommended) return RecommendedPoint(view);
  return campaign::Filled(campaign::ReadSet(view.space, options.set),
                          *campaign::StrategyOf(view, view.Answered()));
}

// `options` with what an earlier call for this file had, where it has ended.
PredictOptions AsBefore(const JointView& view, PredictOptions options) {
  const fs::path root =
      PredictFolder(view.folder.root) / base::FileWord(options.file.stem().string());
  const auto design = campaign::ReadRecordFile<PredictionDesign>(root / "design.json");
  const fs::path file = root / "prediction.json";
  if (!design || !fs::exists(file)) return options;
  const auto before = journal::ParseRecord<Prediction>(base::ReadFile(file), file.string());
  if (before.draws.empty() || before.by != PredictedBy::kPosterior) return options;
  options.num_draws = design->num_draws;
  options.num_seeds = before.num_runs / static_cast<int>(before.draws.size());
  const nlohmann::json given = base::ReadJsonFile(options.file).root;
  const bool states =
      given.contains("coarse_graining") && given["coarse_graining"].contains("scale_factor");
  if (before.test != kSceneTest && !states) options.scale_factor = before.scale_factor;
  return options;
}

// One call's work on DIR/predict/NAME.
class Predictor {
 public:
  Predictor(const JointView& view, PredictOptions options, campaign::CampaignParts parts)
      : view_(view),
        options_(std::move(options)),
        parts_(std::move(parts)),
        num_draws_(ByOf(options_) == PredictedBy::kPosterior
                       ? options_.num_draws.value_or(kUsualDraws)
                       : 1),
        num_seeds_(options_.num_seeds.value_or(num_draws_ > 1 ? kUsualSeeds : kUsualSeedsOfOne)),
        case_(ReadPredictedCase(view, options_.file, options_.scale_factor,
                                num_draws_ * num_seeds_)) {
    if (!options_.measured.empty()) {
      measured_ = ReadMeasured(options_.measured, case_);
      if (measured_.profile) case_.rig_case.frame = measured_.profile->frame;
    }
    if (!case_.scene_text.empty()) {
      parts_.engine = std::make_unique<SceneEngine>(case_.scene_text);
    }
    // What is wrong with a set shows before anything is written.
    if (num_draws_ == 1) one_set_ = OneSet(view, options_);
    root_ = PredictFolder(view.folder.root) / FolderName();
  }

  Prediction Run() {
    fs::create_directories(root_);
    const campaign::CampaignLock lock(root_);
    design_ = TakeDesign();
    PredictionRuns runs(design_.weights, num_seeds_);
    campaign::Console console(root_ / "predict.log");
    const bool done =
        campaign::RunCases({.count = runs.size(),
                            .at = [&](std::size_t run) { return FolderCaseOf(runs, run); },
                            .time_cap = view_.spec.trial_time_cap,
                            .has_ended =
                                [&](std::size_t run) {
                                  Collect(run, runs);
                                  ShowProgress(runs, console);
                                }},
                           parts_);
    if (done) regimes_ = Regimes(runs);
    Prediction prediction = Conclude(runs);
    if (!done) {
      throw base::Interrupted("interrupted; the same command goes on in " + root_.string());
    }
    return prediction;
  }

 private:
  std::string FolderName() const {
    const std::string name = base::FileWord(case_.name);
    switch (ByOf(options_)) {
      case PredictedBy::kPosterior:
        return name;
      case PredictedBy::kRecommended:
        return name + "-recommended";
      case PredictedBy::kSet:
        return name + "-set";
    }
    return name;
  }

  std::string TestText() const {
    if (!case_.scene_text.empty()) return case_.scene_text;
    rigs::Case rig_case = case_.rig_case;
    rig_case.frame.reset();
    return rigs::CaseText(rig_case);
  }

  std::string FrameText() const {
    return case_.rig_case.frame ? base::JsonText(base::ToJson(*case_.rig_case.frame)) : "";
  }

  std::int64_t LastTrial() const {
    std::int64_t last = 0;
    for (const journal::TrialRecord& trial : view_.trials) {
      if (trial.status != journal::TrialStatus::kRunning) last = std::max(last, trial.id);
    }
    return last;
  }

  // Draws have as many parameters as are searched now.
  bool HasPoints(const PredictionDesign& design) const {
    return std::ranges::all_of(design.points, [&](const std::vector<double>& point) {
      return point.size() == view_.space.Free().size();
    });
  }

  // The sets of an earlier call, where it was for the same.
  PredictionDesign TakeDesign() {
    const fs::path file = root_ / "design.json";
    PredictionDesign wanted{.test = TestText(),
                            .frame = FrameText(),
                            .by = ByOf(options_),
                            .num_draws = num_draws_,
                            .last_trial = LastTrial()};
    const auto stored = campaign::ReadRecordFile<PredictionDesign>(file);
    if (stored && options_.as_before) wanted.last_trial = stored->last_trial;
    const bool same = stored && stored->test == wanted.test && stored->by == wanted.by &&
                      stored->num_draws == wanted.num_draws &&
                      stored->last_trial == wanted.last_trial && HasPoints(*stored);
    if (one_set_) {
      wanted.points = {{one_set_->data(), one_set_->data() + one_set_->size()}};
      wanted.weights = {1};
    } else if (same) {
      wanted.points = stored->points;
      wanted.weights = stored->weights;
    } else {
      WeightedDraws chosen = PosteriorSets(view_, num_draws_);
      wanted.points = std::move(chosen.points);
      wanted.weights = std::move(chosen.weights);
    }
    if (same && stored->frame != wanted.frame) DrawAnew(wanted);
    campaign::WriteRecordFile(file, wanted);
    return wanted;
  }

  // Finished runs in another frame, without simulating them again.
  void DrawAnew(const PredictionDesign& design) {
    design_ = design;
    const PredictionRuns runs(design.weights, num_seeds_);
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const campaign::FolderCase at = FolderCaseOf(runs, run);
      const fs::path anew = at.folder.string() + ".anew";
      if (!parts_.engine->IsComplete(at.folder) ||
          !parts_.engine->TakeOver(at.rig_case, at.folder, anew)) {
        continue;
      }
      fs::remove_all(at.folder);
      fs::rename(anew, at.folder);
    }
  }

  campaign::FolderCase FolderCaseOf(const PredictionRuns& runs, std::size_t run) const {
    const std::size_t draw = runs.draw(run);
    const std::vector<double>& point = design_.points[draw];
    const auto unit =
        Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
    const std::string name = base::FileNumber(static_cast<std::int64_t>(draw) + 1) + "_" +
                             std::to_string(runs.seed(run) + 1);
    // Every run has a seed of its own: the filling of one says nothing of another's.
    const std::uint64_t seed = view_.spec.seed + draw * PredictOptions::kMostSeeds + runs.seed(run);
    return {.folder = root_ / "trials" / name,
            .rig_case = CaseWith(view_, case_, view_.space.ToNative(unit), seed)};
  }

  void Collect(std::size_t run, PredictionRuns& runs) {
    const campaign::FolderCase at = FolderCaseOf(runs, run);
    if (!parts_.engine->IsComplete(at.folder)) {
      campaign::RequireWritable(root_);  // a full disk is no failure of the run
      const std::string why = trials::LastLogLines(at.folder);
      runs.AddFailure(run, why.empty() ? "left no result" : why);
      return;
    }
    try {
      runs.Add(run, parts_.engine->Collect(at.rig_case, at.folder));
    } catch (const base::Error& error) {
      runs.AddFailure(run, error.what());
    }
  }

  // The process by all its runs, and each test by a coarse run with the first of the sets.
  std::vector<FlowRegime> Regimes(const PredictionRuns& runs) const {
    std::vector<rigs::Regime> seen;
    for (std::size_t run = 0; run < runs.size(); ++run) {
      if (const auto regime = RegimeIn(FolderCaseOf(runs, run).folder)) seen.push_back(*regime);
    }
    if (seen.empty()) return {};
    std::vector<FlowRegime> regimes{
        DescribeRegime(case_.name, seen, FolderCaseOf(runs, 0).rig_case)};
    regimes.front().is_process = true;
    const auto tests = campaign::ExperimentsOf(view_.spec);
    const auto at = [&](std::size_t test) { return TestCase(tests[test].name, test); };
    if (!campaign::RunCases(
            {.count = tests.size(), .at = at, .time_cap = view_.spec.trial_time_cap}, parts_)) {
      return {};
    }
    for (std::size_t test = 0; test < tests.size(); ++test) {
      const campaign::FolderCase run = at(test);
      if (const auto regime = RegimeIn(run.folder)) {
        regimes.push_back(DescribeRegime(tests[test].name, {*regime}, run.rig_case));
      }
    }
    return regimes;
  }

  campaign::FolderCase TestCase(const std::string& name, std::size_t experiment) const {
    const std::vector<double>& point = design_.points.front();
    const auto unit =
        Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
    return {
        .folder = root_ / "tests" / base::FileWord(name),
        .rig_case = campaign::CaseOf(view_.spec,
                                     {.values = view_.space.ToNative(unit),
                                      .seed = view_.spec.seed,
                                      .scale_factor = view_.spec.coarse_graining.Levels().front(),
                                      .experiment = static_cast<int>(experiment)},
                                     std::nullopt)};
  }

  Prediction Describe(const PredictionRuns& runs) const {
    Prediction prediction{.name = case_.name,
                          .test = case_.scene_text.empty()
                                      ? std::string(base::NameOf(case_.rig_case.rig.kind))
                                      : kSceneTest,
                          .by = ByOf(options_),
                          .scale_factor = case_.rig_case.coarse_graining.scale_factor,
                          .last_trial = design_.last_trial,
                          .notes = case_.notes};
    for (std::size_t d = 0; d < design_.points.size(); ++d) {
      const std::vector<double>& point = design_.points[d];
      prediction.draws.push_back(
          {.weight = design_.weights[d],
           .values = campaign::FreeValues(
               view_.space, Eigen::Map<const Eigen::VectorXd>(
                                point.data(), static_cast<Eigen::Index>(point.size())))});
    }
    runs.Summarise(prediction);
    for (PredictedNumber& number : prediction.numbers) number.is_usual = IsUsual(number.name);
    return prediction;
  }

  // After 4, 8, 16, … runs: the range as it is known by then.
  void ShowProgress(const PredictionRuns& runs, campaign::Console& console) const {
    const int ended = runs.num_ended();
    if (ended < 4 || !std::has_single_bit(static_cast<unsigned>(ended)) ||
        ended == static_cast<int>(runs.size())) {
      return;
    }
    std::string text =
        case_.name + ": " + std::to_string(ended) + " of " + std::to_string(runs.size()) + " runs";
    const Prediction so_far = Describe(runs);
    for (const PredictedNumber& number : so_far.numbers) {
      if (!number.is_usual || number.num_defined < 2) continue;
      text += "; " + NumberTitle(number) + " " + NumberText(number);
    }
    console.Line(text + " so far");
  }

  // What the rig is made to measure; of a scene everything.
  bool IsUsual(const std::string& name) const {
    if (!case_.scene_text.empty()) return true;
    return std::ranges::any_of(rigs::EntryOf(case_.rig_case).observables,
                               [&](const rigs::RigObservable& o) {
                                 return o.usual && rigs::MetricName(o.observable) == name;
                               });
  }

  Prediction Conclude(const PredictionRuns& runs) const {
    Prediction prediction = Describe(runs);
    runs.Compare(measured_, prediction);
    WritePictures(runs, root_, prediction);
    prediction.regimes = regimes_;
    for (std::string& warning : RegimeWarnings(regimes_)) prediction.notes.push_back(warning);
    if (!case_.rig_case.frame && case_.scene_text.empty()) {
      prediction.notes.push_back("no pictures: the case has no frame");
    }
    base::WriteFileAtomically(root_ / "draws.csv", DrawsCsv(prediction, view_.record.parameters));
    base::WriteFileAtomically(root_ / "prediction.json",
                              base::JsonText(base::ToJson(prediction), 2) + "\n");
    return prediction;
  }

  const JointView& view_;
  PredictOptions options_;
  campaign::CampaignParts parts_;
  int num_draws_;
  int num_seeds_;
  PredictedCase case_;
  MeasuredProcess measured_;
  std::optional<Eigen::VectorXd> one_set_;  // instead of draws
  fs::path root_;
  PredictionDesign design_;
  std::vector<FlowRegime> regimes_;
};

void Require(bool ok, const std::string& message) {
  if (!ok) throw base::ConfigError(message);
}

}  // namespace

fs::path PredictFolder(const fs::path& campaign) { return fs::absolute(campaign) / "predict"; }

Prediction Predict(const JointView& view, const PredictOptions& options,
                   campaign::CampaignParts parts) {
  const int draws = options.num_draws.value_or(kUsualDraws);
  const int seeds = options.num_seeds.value_or(kUsualSeeds);
  Require(draws >= 2 && draws <= PredictOptions::kMostDraws,
          "--draws: is " + std::to_string(draws) +
              ", must be from 2 to 200; --set or --recommended "
              "predicts by one set");
  Require(seeds >= 1 && seeds <= PredictOptions::kMostSeeds,
          "--seeds: is " + std::to_string(seeds) + ", must be from 1 to 100");
  Require(
      !options.scale_factor || (*options.scale_factor >= 1 && std::isfinite(*options.scale_factor)),
      "--scale: is " + base::ShortNumber(options.scale_factor.value_or(1)) +
          ", must be 1 or more: no grain is smaller than the powder's own");
  return Predictor(view, options.as_before ? AsBefore(view, options) : options, std::move(parts))
      .Run();
}

}  // namespace talus::analysis
