#include "experiments/trials/optimize/evaluator.h"

#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/json/json_text.h"
#include "experiments/runners/exit_status.h"
#include "experiments/runners/process_guard.h"
#include "experiments/runners/tool.h"
#include "experiments/trials/optimize/optimize_result_json.h"

namespace talus::trials {
namespace {

constexpr std::size_t kLongest = 200;  // bytes of an excerpt

bool IsInsideCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string Beginning(const std::string& text) {
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while (end > 0 && IsInsideCharacter(text[end])) --end;
  return text.substr(0, end) + " …";
}

// What is printed on standard error says at its end what was wrong.
std::string Ending(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  if (text.size() <= kLongest) return text;
  std::size_t begin = text.size() - kLongest;
  while (begin < text.size() && IsInsideCharacter(text[begin])) ++begin;
  return "… " + text.substr(begin);
}

std::string FailureOf(const runners::ToolResult& result) {
  const std::optional<int> signal = runners::SignalOf(result.status);
  const std::string end =
      signal ? runners::SignalText(*signal) : "exit status " + std::to_string(result.status);
  const std::string said = Ending(result.errors);
  return end + (said.empty() ? "" : ": " + said);
}

}  // namespace

AnswerImage TargetImage(const OptimizeTarget& target) {
  return target.profile.empty() ? FromRows(target.field, "target.field")
                                : ReadAnswerImage(target.profile);
}

Evaluator::Evaluator(const OptimizeProblem& problem, std::vector<std::string> command)
    : problem_(problem), command_(std::move(command)) {
  if (runners::FindProgram(command_.front(), {}).empty()) {
    throw base::ConfigError(
        "COMMAND: \"" + command_.front() +
        "\" is not found, or not executable; give its path, or name one that is on "
        "the PATH");
  }
  if (!problem.target) return;
  AnswerImage target = TargetImage(*problem.target);
  const auto num_pixels = static_cast<int>(target.field.size());
  field_ = optimizer::FieldObjective{.width = target.width,
                                     .height = num_pixels / target.width,
                                     .target = std::move(target.field),
                                     .sad_scale = 100.0 / num_pixels,
                                     .metric = {}};
}

std::string Evaluator::InputOf(const Eigen::VectorXd& point, std::uint64_t seed) const {
  nlohmann::ordered_json input = NativeParameters(problem_, point);
  input["seed"] = seed;
  return base::JsonText(input) + "\n";
}

Evaluated Evaluator::Run(const Eigen::VectorXd& point, std::uint64_t seed, const std::string& mark,
                         const std::function<bool()>& is_stopped) const {
  Evaluated evaluated{.observation = {.point = point}, .failure = {}};
  const runners::ToolResult result = runners::RunTool(command_, {.time_cap = problem_.time_cap,
                                                                 .output_file = {},
                                                                 .input = InputOf(point, seed),
                                                                 .mark = mark,
                                                                 .is_stopped = is_stopped});
  runners::KillMarked(mark);
  if (!result.started) throw base::Error("the command cannot be run: " + Ending(result.errors));
  if (result.ok()) {
    const std::string wrong = TakeAnswer(result.output, evaluated.observation);
    if (wrong.empty()) return evaluated;
    evaluated.failure = "the command's answer " + wrong + "; it wrote: " + Beginning(result.output);
  } else {
    evaluated.failure = FailureOf(result);
  }
  evaluated.observation.failed = true;
  return evaluated;
}

std::string Evaluator::TakeAnswer(const std::string& output,
                                  optimizer::Observation& observation) const {
  const auto answer = nlohmann::json::parse(output, nullptr, false);
  if (!answer.is_object()) {
    return R"(must be one JSON object and nothing else, {"value": …}, {"profile": "file.png"} or )"
           R"({"field": …})";
  }
  if (answer.contains("value")) {
    if (!answer["value"].is_number()) return "has a \"value\" that is no number";
    if (field_) return "is a \"value\", but the problem has a target image: take one of them away";
    observation.value = answer["value"].get<double>();
    if (std::abs(observation.value) <= optimizer::kLargestValue) return "";
    return "has a \"value\" beyond 1e100, which no search can work with";
  }
  try {
    if (answer.contains("profile")) {
      return TakeImage(ReadAnswerImage(answer["profile"].get<std::string>()), observation);
    }
    if (answer.contains("field")) {
      const auto rows = answer["field"].get<std::vector<std::vector<double>>>();
      return TakeImage(FromRows(rows, "\"field\""), observation);
    }
  } catch (const nlohmann::json::exception&) {
    return "has a \"profile\" that is no file name or a \"field\" that is no list of rows of "
           "numbers";
  } catch (const base::ConfigError& error) {
    return std::string("has an image that cannot be used: ") + error.what();
  }
  return "has neither \"value\", \"profile\" nor \"field\"";
}

std::string Evaluator::TakeImage(AnswerImage image, optimizer::Observation& observation) const {
  if (!field_) return "is an image, but the problem has no \"target\" to compare it with";
  if (image.width != field_->width || image.field.size() != field_->target.size()) {
    return "is an image of " + std::to_string(image.width) + " columns and " +
           std::to_string(image.field.size()) + " pixels, the target has " +
           std::to_string(field_->width) + " and " + std::to_string(field_->target.size()) +
           ": make them the same size";
  }
  observation.value = field_->Value(image.field);
  observation.field = std::move(image.field);
  return "";
}

}  // namespace talus::trials
