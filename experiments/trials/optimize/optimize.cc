#include "experiments/trials/optimize/optimize.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/json/json_text.h"
#include "experiments/runners/process_guard.h"
#include "experiments/trials/optimize/evaluator.h"
#include "experiments/trials/optimize/optimize_folder.h"
#include "experiments/trials/optimize/optimize_result_json.h"
#include "optimizer/space/domain.h"
#include "surrogate/same_point.h"

namespace talus::trials {
namespace {

using json = nlohmann::ordered_json;

class OptimizeLoop {
 public:
  OptimizeLoop(const OptimizeProblem& problem, const std::vector<std::string>& command,
               const OptimizeOutput& output)
      : problem_(problem),
        output_(output),
        evaluator_(problem, command),
        strategy_(optimizer::MakeStrategy(problem.strategy, problem.space.MakeDomain(),
                                          evaluator_.field(), problem.seed)) {
    if (!output.folder.empty()) folder_.emplace(output.folder, problem, command);
    processes_.emplace();  // after the folder, whose lock it keeps until all has ended
  }

  OptimizeEnd Run() {
    TellRecorded();
    std::string stopped = num_told() == 0 ? "" : WhyStop(false);
    while (stopped.empty()) {
      const int left = problem_.evaluations - num_told();
      const auto batch = strategy_->Ask(std::min(problem_.workers, left), {});
      EvaluateAndTell(batch);
      stopped = WhyStop(batch.empty());
    }
    if (!interrupted_ && num_told() > 0 && tally_.num_failed == num_told()) AllFailed();
    const std::string result =
        base::JsonText(OptimizeResult(problem_, strategy_->Recommend(), tally_, stopped), 2) + "\n";
    if (folder_) folder_->WriteResult(result);
    return {.result = result, .interrupted = interrupted_};
  }

 private:
  int num_told() const { return tally_.num_evaluations; }

  std::string WhyStop(bool nothing_left) {
    interrupted_ = guard_.Asked() != base::Interrupt::kNone;
    if (interrupted_) return "interrupted";
    if (num_told() >= problem_.evaluations) return "all evaluations are used";
    if (nothing_left) return "the strategy has no more points";
    const auto reason = strategy_->WhyStop();
    return reason ? optimizer::TextOf(*reason) : "";
  }

  void TellRecorded() {
    if (!folder_) return;
    const int complete = folder_->NumToTell();
    for (int number = 1; number <= complete; ++number) Tell(*folder_->Recorded(number));
    if (folder_->num_recorded() > 0 && !output_.quiet) {
      const bool is_done = complete == problem_.evaluations;
      std::cerr << output_.folder.string() << (is_done ? ": has all its " : ": goes on after ")
                << (is_done ? complete : folder_->num_recorded()) << " evaluations"
                << (is_done ? "; raise `evaluations` for more" : "") << std::endl;
    }
  }

  // From the record of an earlier run, where it has this very point.
  Evaluated Evaluate(const Eigen::VectorXd& point, int number, int asked_after) {
    if (folder_) {
      const auto recorded = folder_->Recorded(number);
      if (recorded && surrogate::SamePoint(recorded->observation.point, point)) return *recorded;
    }
    const Evaluated evaluated =
        evaluator_.Run(point, problem_.seed * 1000003 + static_cast<std::uint64_t>(number),
                       processes_->MarkOf(number), [this] { return IsDropped(); });
    if (IsDropped()) throw base::Interrupted("interrupted; the same command goes on");
    const int width = evaluator_.field() == nullptr ? 0 : evaluator_.field()->width;
    if (folder_) folder_->Record(number, evaluated, asked_after, width);
    return evaluated;
  }

  // Told in the order of asking, whichever ends first, so that a run can be repeated.
  void EvaluateAndTell(const std::vector<optimizer::Proposal>& batch) {
    std::vector<std::future<Evaluated>> running;
    const int told = num_told();
    for (const optimizer::Proposal& proposal : batch) {
      const int number = told + static_cast<int>(running.size()) + 1;
      running.push_back(std::async(
          std::launch::async,
          [this, point = proposal.point, number, told] { return Evaluate(point, number, told); }));
    }
    for (auto& one : running) Await(one, running.size());
    for (auto& one : running) Tell(one.get());
    if (num_told() >= kHopeless && tally_.num_failed == num_told()) AllFailed();
  }

  bool IsDropped() const { return guard_.Asked() == base::Interrupt::kDrop; }

  void Await(std::future<Evaluated>& one, std::size_t num_running) {
    constexpr std::chrono::milliseconds kPause{50};
    while (one.wait_for(kPause) != std::future_status::ready) {
      if (guard_.Asked() == base::Interrupt::kNone || std::exchange(announced_, true)) continue;
      std::cerr << "ends when the " << num_running
                << " running evaluations have ended; press Ctrl-C again to drop them" << std::endl;
    }
  }

  [[noreturn]] void AllFailed() const {
    if (folder_) folder_->NoteGivenUp();
    throw base::Error("the first " + std::to_string(num_told()) +
                      " evaluations have all failed, the last: " + last_failure_);
  }

  void Tell(const Evaluated& evaluated) {
    const optimizer::Observation& observation = evaluated.observation;
    strategy_->Tell(observation);
    tally_.Add(observation);
    json line{{"evaluation", num_told()},
              {"parameters", NativeParameters(problem_, observation.point)}};
    if (observation.failed) {
      last_failure_ = evaluated.failure;
      line["failed"] = evaluated.failure;
    } else {
      line["value"] = observation.value;
    }
    if (output_.quiet) return;
    std::cerr << base::JsonText(line) << std::endl;
  }

  const OptimizeProblem& problem_;
  const OptimizeOutput& output_;
  Evaluator evaluator_;
  std::unique_ptr<optimizer::Strategy> strategy_;
  std::optional<OptimizeFolder> folder_;
  std::optional<runners::ProcessGuard> processes_;
  base::InterruptGuard guard_;
  SearchTally tally_;
  std::string last_failure_;
  bool announced_ = false;    // that Ctrl-C was heard
  bool interrupted_ = false;  // which ended the search
};

}  // namespace

OptimizeEnd Optimize(const OptimizeProblem& problem, const std::vector<std::string>& command,
                     const OptimizeOutput& output) {
  return OptimizeLoop(problem, command, output).Run();
}

}  // namespace talus::trials
