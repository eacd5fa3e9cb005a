// One evaluation by somebody else's command: parameters as JSON on its standard input, a value or
// an image as JSON on its standard output.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/trials/optimize/answer_image.h"
#include "experiments/trials/optimize/optimize_problem.h"
#include "optimizer/outputs/field_objective.h"

namespace talus::trials {

struct Evaluated {
  optimizer::Observation observation;
  std::string failure;  // why, when it failed
};

// Throws base::ConfigError when it cannot be used.
AnswerImage TargetImage(const OptimizeTarget& target);

class Evaluator {
 public:
  // Reads the target; throws base::ConfigError when it cannot be used. `command[0]` is looked up on
  // the PATH.
  Evaluator(const OptimizeProblem& problem, std::vector<std::string> command);

  // The objective of images; null when there is no target.
  const optimizer::FieldObjective* field() const { return field_ ? &*field_ : nullptr; }

  // What the command reads: {"mu_t": 0.3, …, "seed": 17}, one line.
  std::string InputOf(const Eigen::VectorXd& point, std::uint64_t seed) const;

  // An exit status other than 0, the time cap and an answer that makes no sense are failures, which
  // are results. What the command has started carries `mark`, see process_guard.h, and has ended
  // when this returns; it is ended once `is_stopped`. Throws base::Error only when the command
  // cannot be started.
  Evaluated Run(
      const Eigen::VectorXd& point, std::uint64_t seed, const std::string& mark,
      const std::function<bool()>& is_stopped = [] { return false; }) const;

 private:
  // What is wrong with the answer, in words; empty when it was taken.
  std::string TakeAnswer(const std::string& output, optimizer::Observation& observation) const;
  std::string TakeImage(AnswerImage image, optimizer::Observation& observation) const;

  const OptimizeProblem& problem_;
  std::vector<std::string> command_;
  std::optional<optimizer::FieldObjective> field_;
};

}  // namespace talus::trials
