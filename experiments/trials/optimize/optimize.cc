#include "experiments/trials/optimize/optimize.h"

#include <algorithm>
#include <fstream>
#include <future>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/interrupt.h"
#include "experiments/trials/optimize/evaluator.h"

namespace talus::experiments {
namespace {

using json = nlohmann::ordered_json;

// Nothing has worked by then: the command is wrong, not the parameters.
constexpr int kHopeless = 8;

class Loop {
 public:
  Loop(const OptimizeProblem& problem, const std::vector<std::string>& command,
       const OptimizeOutput& output)
      : problem_(problem),
        output_(output),
        evaluator_(problem, command),
        strategy_(optimizer::MakeStrategy(problem.strategy, problem.space.MakeDomain(),
                                          evaluator_.field(), problem.seed)) {
    if (output.log.empty()) return;
    log_.open(output.log, std::ios::trunc);
    if (!log_) throw base::ConfigError(output.log.string() + ": cannot be written");
  }

  std::string Run() {
    std::string stopped;
    while (stopped.empty()) {
      const int left = problem_.evaluations - num_told_;
      const auto batch = strategy_->Ask(std::min(problem_.workers, left), {});
      EvaluateAndTell(batch);
      stopped = WhyStop(batch.empty());
    }
    return Result(stopped).dump(2) + "\n";
  }

 private:
  std::string WhyStop(bool nothing_left) {
    if (guard_.Asked() != base::Interrupt::kNone) return "interrupted";
    if (num_told_ >= problem_.evaluations) return "all evaluations are used";
    if (nothing_left) return "the strategy has no more points";
    return strategy_->StopReason().value_or("");
  }

  // Told in the order of asking, whichever ends first, so that a run can be repeated.
  void EvaluateAndTell(const std::vector<optimizer::Proposal>& batch) {
    std::vector<std::future<Evaluated>> running;
    for (const optimizer::Proposal& proposal : batch) {
      const auto number = static_cast<std::uint64_t>(num_told_) + running.size() + 1;
      running.push_back(std::async(std::launch::async, [this, point = proposal.point, number] {
        return evaluator_.Run(point, problem_.seed * 1000003 + number);
      }));
    }
    for (auto& one : running) one.wait();
    for (auto& one : running) Tell(one.get());
    if (num_told_ >= kHopeless && num_failed_ == num_told_) {
      throw base::Error("the first " + std::to_string(num_told_) +
                        " evaluations have all failed, the last with " + last_failure_);
    }
  }

  void Tell(const Evaluated& evaluated) {
    const optimizer::Observation& observation = evaluated.observation;
    strategy_->Tell(observation);
    ++num_told_;
    if (observation.failed) {
      ++num_failed_;
      last_failure_ = evaluated.failure;
    } else if (num_told_ - num_failed_ == 1 || observation.value < best_value_) {
      best_value_ = observation.value;
      best_point_ = observation.point;
    }
    json line{{"evaluation", num_told_}, {"parameters", Native(observation.point)}};
    if (observation.failed) {
      line["failed"] = evaluated.failure;
    } else {
      line["value"] = observation.value;
    }
    if (log_.is_open()) log_ << line.dump() << std::endl;
    if (!output_.quiet) std::cerr << line.dump() << std::endl;
  }

  json Native(const Eigen::VectorXd& point) const {
    json native;
    const std::vector<double> values = problem_.space.ToNative(point);
    for (std::size_t i = 0; i < values.size(); ++i) {
      native[problem_.space.parameters[i].name] = values[i];
    }
    return native;
  }

  const optimizer::Parameter& Free(std::size_t i) const {
    return problem_.space.parameters[static_cast<std::size_t>(problem_.space.Free()[i])];
  }

  // Strategies know parameters by number only.
  std::string WithNames(std::string text) const {
    for (std::size_t i = 0; i < problem_.space.Free().size(); ++i) {
      const std::string number = "parameter " + std::to_string(i);
      const auto place = text.find(number);
      if (place != std::string::npos) text.replace(place, number.size(), Free(i).name);
    }
    return text;
  }

  json PerParameter(const optimizer::Answer& answer) const {
    json all;
    for (std::size_t i = 0; i < answer.credible.size(); ++i) {
      json one;
      one["low"] = Free(i).ToNative(answer.credible[i].low);
      one["high"] = Free(i).ToNative(answer.credible[i].high);
      if (i < answer.sobol_first.size()) one["sobol_first"] = answer.sobol_first[i];
      if (i < answer.sobol_total.size()) one["sobol_total"] = answer.sobol_total[i];
      all[Free(i).name] = one;
    }
    return all;
  }

  json Result(const std::string& stopped) {
    const optimizer::Answer answer = strategy_->Recommend();
    json result{{"recommended", Native(answer.point)},
                {"predicted_value", answer.predicted_value},
                {"predicted_sd", answer.predicted_sd},
                {"noise_sd", answer.noise_sd},
                {"ranges_90", PerParameter(answer)}};
    result["correlation"] = json::array();
    for (const auto row : answer.correlation.rowwise()) {
      result["correlation"].push_back(std::vector<double>(row.begin(), row.end()));
    }
    result["tied_volume"] = answer.tied_volume;
    result["tied"] = json::array();
    for (const Eigen::VectorXd& point : answer.tied) result["tied"].push_back(Native(point));
    if (num_told_ > num_failed_) {
      result["best_observed"] = {{"parameters", Native(best_point_)}, {"value", best_value_}};
    }
    result["evaluations"] = num_told_;
    result["failed"] = num_failed_;
    result["stopped"] = stopped;
    result["model"] = answer.model;
    result["warnings"] = json::array();
    for (const std::string& warning : answer.warnings) {
      result["warnings"].push_back(WithNames(warning));
    }
    return result;
  }

  const OptimizeProblem& problem_;
  const OptimizeOutput& output_;
  Evaluator evaluator_;
  std::unique_ptr<optimizer::Strategy> strategy_;
  std::ofstream log_;
  base::InterruptGuard guard_;
  int num_told_ = 0;
  int num_failed_ = 0;
  double best_value_ = 0;
  Eigen::VectorXd best_point_;
  std::string last_failure_;
};

}  // namespace

std::string Optimize(const OptimizeProblem& problem, const std::vector<std::string>& command,
                     const OptimizeOutput& output) {
  return Loop(problem, command, output).Run();
}

}  // namespace talus::experiments
