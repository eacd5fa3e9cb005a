#include "experiments/analysis/predict/predict.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <iostream>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/predict/as_before.h"
#include "experiments/analysis/predict/draws.h"
#include "experiments/analysis/predict/number_surrogate.h"
#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/analysis/predict/prediction_design.h"
#include "experiments/analysis/predict/prediction_pictures.h"
#include "experiments/analysis/predict/prediction_plan.h"
#include "experiments/analysis/predict/prediction_runs.h"
#include "experiments/analysis/predict/prediction_text.h"
#include "experiments/analysis/predict/regimes.h"
#include "experiments/analysis/predict/scene_engine.h"
#include "experiments/analysis/predict/surrogate_answer.h"
#include "experiments/analysis/predict/test_regimes.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/folder/console.h"
#include "experiments/campaign/folder/record_file.h"
#include "experiments/campaign/folder/time_taken.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/heap/film_strip.h"
#include "optimizer/space/point_rows.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using campaign::JointView;

// One call's work on DIR/predict/NAME.
class Predictor {
 public:
  Predictor(const JointView& view, PredictOptions options, campaign::CampaignParts parts)
      : view_(view),
        options_(std::move(options)),
        parts_(std::move(parts)),
        num_draws_(options_.Draws()),
        num_seeds_(options_.Seeds()),
        case_(ReadPredictedCase(view, options_.file, options_.Finest(), num_draws_ * num_seeds_,
                                StageTime())),
        stages_(PlanStages(view, case_,
                           {.num_draws = num_draws_,
                            .num_seeds = num_seeds_,
                            .coarser = options_.Coarser(),
                            .core_time = CoreTime()})) {
    for (const PredictionStage& stage : stages_) RequireSimulable(case_, stage.scale_factor);
    if (!options_.measured.empty()) {
      measured_ = ReadMeasured(options_.measured, case_);
      if (measured_.profile) case_.rig_case.frame = imaging::OnePicture(measured_.profile->frame);
    }
    if (!case_.scene_text.empty()) {
      parts_.engine = std::make_unique<SceneEngine>(case_.scene_text);
    }
    // What is wrong with a set shows before anything is written.
    if (num_draws_ == 1) one_set_ = OneSet(view, options_);
    root_ = PredictionFolder(view.folder.root, options_);
  }

  Prediction Run() {
    fs::create_directories(root_);
    const campaign::CampaignLock lock(root_);
    design_ = TakeDesign();
    PredictionRuns runs = NoRuns();
    campaign::Console console(root_ / "predict.log");
    if (case_.scene_text.empty()) {
      console.Line(case_.name + ": " + PlanText(view_, case_, stages_, CoreTime()));
    }
    const bool done =
        campaign::RunCases({.spec = view_.spec,
                            .count = runs.size(),
                            .at = [&](std::size_t run) { return FolderCaseOf(runs, run); },
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
  double CoreTime() const { return options_.core_time.value_or(PredictOptions::kUsualTime); }
  // What the runs that every draw has may take, where a draw has several seeds.
  double StageTime() const {
    constexpr double kShare = 0.6;
    return (num_draws_ > 1 ? kShare : 1) * CoreTime();
  }
  double ScaleFactor() const { return case_.rig_case.coarse_graining.scale_factor; }

  PredictionRuns NoRuns() const {
    return {design_.weights, RunsOf(stages_, design_.weights.size()), ScaleFactor()};
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
    PredictionDesign wanted{.test = TestText(case_),
                            .frame = FrameText(case_),
                            .by = options_.By(),
                            .num_draws = num_draws_,
                            .last_trial = view_.LastEnded(),
                            .stages = {},
                            .source = SourceSeenFrom(view_.folder.root, options_.file)};
    const auto stored = campaign::ReadRecordFile<PredictionDesign>(file);
    if (stored) wanted.source = SourceToKeep(*stored, wanted, view_.folder.root, root_);
    if (stored && options_.as_before) {
      wanted.last_trial = stored->last_trial;
      if (!stored->stages.empty() && stored->test == wanted.test) {
        stages_ = StagesAsBefore(*stored, num_draws_);
      }
    }
    wanted.stages = stages_;
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
    const PredictionRuns runs = NoRuns();
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
    const PlannedRun& planned = runs.planned(run);
    const Eigen::VectorXd unit = optimizer::VectorOf(design_.points[planned.draw]);
    std::string name = base::FileNumber(static_cast<std::int64_t>(planned.draw) + 1) + "_" +
                       std::to_string(planned.seed + 1);
    if (planned.scale_factor != ScaleFactor()) {
      name += "_at_" + base::ShortNumber(planned.scale_factor);
    }
    // Every run has a seed of its own: the filling of one says nothing of another's.
    const std::uint64_t seed =
        view_.spec.seed + planned.draw * PredictOptions::kMostSeeds + planned.seed;
    campaign::FolderCase at{.folder = root_ / "trials" / name,
                            .rig_case = CaseWith(view_, case_, view_.space.ToNative(unit), seed)};
    at.rig_case.coarse_graining.scale_factor = planned.scale_factor;
    return at;
  }

  void Collect(std::size_t run, PredictionRuns& runs) {
    const campaign::FolderCase at = FolderCaseOf(runs, run);
    const auto fail = [&](const std::string& why) {
      runs.AddFailure(run, why, campaign::TimeTaken(at.folder));
    };
    if (!parts_.engine->IsComplete(at.folder)) {
      const std::string why = trials::LastLogLines(at.folder);
      return fail(why.empty() ? "left no result" : why);
    }
    try {
      trials::TrialOutput output = parts_.engine->Collect(at.rig_case, at.folder);
      output.cpu_time = std::max(output.cpu_time, campaign::TimeTaken(at.folder));
      if (case_.scene_text.empty()) KeepRigNumbers(at.rig_case, output);
      runs.Add(run, std::move(output));
    } catch (const base::Error& error) {
      fail(error.what());
    }
  }

  // The process by all its runs, and each test by one run with the first of the sets.
  std::vector<FlowRegime> Regimes(const PredictionRuns& runs) const {
    std::vector<rigs::Regime> seen;
    std::size_t first = 0;
    for (std::size_t run = runs.size(); run-- > 0;) {
      if (runs.planned(run).scale_factor != ScaleFactor()) continue;
      first = run;
      if (const auto regime = RegimeIn(FolderCaseOf(runs, run).folder)) seen.push_back(*regime);
    }
    if (seen.empty()) return {};
    std::vector<FlowRegime> regimes{
        DescribeRegime(case_.name, seen, FolderCaseOf(runs, first).rig_case)};
    regimes.front().is_process = true;
    const auto tests = TestRegimes(view_,
                                   {.set = optimizer::VectorOf(design_.points.front()),
                                    .scale_factor = ScaleFactor(),
                                    .prediction = root_},
                                   parts_);
    if (!tests) return {};
    regimes.insert(regimes.end(), tests->begin(), tests->end());
    return regimes;
  }

  // Without numbers; `scale_factor`: of the runs that they are to be by.
  Prediction Frame(double scale_factor) const {
    Prediction prediction{.name = case_.name,
                          .test = case_.scene_text.empty()
                                      ? std::string(base::NameOf(case_.rig_case.rig.kind))
                                      : kSceneTest,
                          .by = options_.By(),
                          .scale_factor = scale_factor,
                          .target = scale_factor,
                          .last_trial = design_.last_trial,
                          .notes = case_.notes};
    for (std::size_t d = 0; d < design_.points.size(); ++d) {
      prediction.draws.push_back(
          {.weight = design_.weights[d],
           .values = campaign::FreeValues(view_.space, optimizer::VectorOf(design_.points[d]))});
    }
    return prediction;
  }

  // The scale factor that surrogates tell: the answer's, where a few runs have ended well at each
  // of several. What is planned alone says nothing.
  double Target(const PredictionRuns& runs) const {
    double target = view_.spec.coarse_graining.Target();
    int num_levels = 0;
    for (const PredictionStage& stage : stages_) {
      if (runs.NumEnded(stage.scale_factor) < NumberSurrogate::kFewestRuns) continue;
      target = std::min(target, stage.scale_factor);
      ++num_levels;
    }
    return num_levels > 1 ? target : ScaleFactor();
  }

  // After 4, 8, 16, … runs: the range as it is known by then.
  void ShowProgress(const PredictionRuns& runs, campaign::Console& console) const {
    const int ended = runs.num_ended();
    if (ended < 4 || !std::has_single_bit(static_cast<unsigned>(ended)) ||
        ended == static_cast<int>(runs.size())) {
      return;
    }
    const bool is_first = runs.NumEnded(ScaleFactor()) < 4;
    Prediction so_far = Frame(is_first ? stages_.front().scale_factor : ScaleFactor());
    runs.Summarise(so_far);
    std::string text =
        case_.name + ": " + std::to_string(ended) + " of " + std::to_string(runs.size()) + " runs";
    for (const PredictedNumber& number : so_far.numbers) {
      if (!IsUsual(number.name) || number.num_defined < 2) continue;
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
    Prediction prediction = Frame(ScaleFactor());
    prediction.target = Target(runs);
    std::vector<std::optional<Spread>> spreads = runs.Summarise(prediction);
    for (PredictedNumber& number : prediction.numbers) number.is_usual = IsUsual(number.name);
    AskSurrogates(prediction, spreads);
    runs.Compare(measured_, spreads, prediction);
    NoteScaleFactor(prediction);
    WritePictures(runs, root_, prediction);
    prediction.regimes = regimes_;
    for (std::string& warning : RegimeWarnings(regimes_)) prediction.notes.push_back(warning);
    if (!case_.rig_case.frame && case_.scene_text.empty()) {
      prediction.notes.push_back("no pictures: the case has no frame");
    }
    if (options_.as_before) KeepMeasured(root_ / "prediction.json", prediction);
    base::WriteFileAtomically(root_ / "draws.csv", DrawsCsv(prediction, view_.record.parameters));
    base::WriteFileAtomically(root_ / "prediction.json",
                              base::JsonText(base::ToJson(prediction), 2) + "\n");
    return prediction;
  }

  void AskSurrogates(Prediction& prediction, std::vector<std::optional<Spread>>& spreads) const {
    if (design_.points.size() < NumberSurrogate::kFewest) return;
    const Eigen::MatrixXd points = PosteriorDraws(view_);
    for (std::size_t n = 0; n < spreads.size(); ++n) {
      if (!spreads[n]) continue;
      AnswerBySurrogate(prediction, {.space = view_.space, .points = points}, prediction.numbers[n],
                        spreads[n]);
    }
  }

  void NoteScaleFactor(Prediction& prediction) const {
    const double target = view_.spec.coarse_graining.Target();
    // A surrogate carries a number on to the target; the draws, where it is not used, do not.
    const bool is_carried =
        prediction.target <= target &&
        std::ranges::all_of(prediction.numbers, [&](const PredictedNumber& number) {
          const auto& surrogate = number.surrogate;
          return !number.is_usual ||
                 (surrogate && surrogate->is_used && surrogate->scale_factor <= target);
        });
    if (!case_.scene_text.empty() || ScaleFactor() <= target || is_carried) return;
    prediction.notes.push_back("simulated at scale factor " + base::ShortNumber(ScaleFactor()) +
                               ", where the answer is for " + base::ShortNumber(target) +
                               ": what coarse grains change in this test is not known; --scale " +
                               base::ShortNumber(target) + " shows it");
  }

  const JointView& view_;
  PredictOptions options_;
  campaign::CampaignParts parts_;
  int num_draws_;
  int num_seeds_;
  PredictedCase case_;
  std::vector<PredictionStage> stages_;
  MeasuredProcess measured_;
  std::optional<Eigen::VectorXd> one_set_;  // instead of draws
  fs::path root_;
  PredictionDesign design_;
  std::vector<FlowRegime> regimes_;
};

// A value as it was typed, in a file's name: "2 uJ/m^2" has a slash.
std::string PlainWord(std::string value) {
  std::ranges::replace_if(
      value, [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; }, '_');
  return value;
}

PredictOptions CheckedOptions(const JointView& view, const PredictOptions& options) {
  CheckOptions(options);
  return options.as_before ? AsBefore(view, options) : options;
}

}  // namespace

fs::path PredictFolder(const fs::path& campaign) { return fs::absolute(campaign) / "predict"; }

fs::path PredictionFolder(const fs::path& campaign, const PredictOptions& options) {
  std::string name = base::FileWord(options.file.stem().string());
  if (options.By() == PredictedBy::kRecommended) name += "-recommended";
  char before = '-';
  for (const auto& [parameter, value] : options.set) {
    name += before + parameter + "=" + PlainWord(value);
    before = ',';
  }
  return PredictFolder(campaign) / name;
}

void CheckPrediction(const JointView& view, const PredictOptions& options) {
  Predictor(view, CheckedOptions(view, options), {});
}

Prediction Predict(const JointView& view, const PredictOptions& options,
                   campaign::CampaignParts parts) {
  return Predictor(view, CheckedOptions(view, options), std::move(parts)).Run();
}

}  // namespace talus::analysis
