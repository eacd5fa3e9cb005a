#include "experiments/trials/optimize/evaluator.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "experiments/runners/tool.h"
#include "imaging/formats/image_file.h"

namespace talus::experiments {
namespace {

struct Image {
  std::vector<float> field;
  int width = 0;
};

Image FromFile(const std::filesystem::path& path) {
  const imaging::GrayImage gray = imaging::ReadGrayImage(path);
  Image image{.field = {}, .width = gray.width};
  for (const std::uint8_t pixel : gray.pixels) {
    image.field.push_back(1.0F - static_cast<float>(pixel) / 255.0F);
  }
  return image;
}

Image FromRows(const std::vector<std::vector<double>>& rows) {
  Image image{.field = {}, .width = static_cast<int>(rows.front().size())};
  for (const auto& row : rows) {
    for (const double pixel : row) image.field.push_back(static_cast<float>(pixel));
  }
  return image;
}

std::string Excerpt(const std::string& text) {
  constexpr std::size_t kLongest = 200;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " …";
}

}  // namespace

Evaluator::Evaluator(const OptimizeProblem& problem, std::vector<std::string> command)
    : problem_(problem), command_(std::move(command)) {
  if (!problem.target) return;
  Image target = problem.target->profile.empty() ? FromRows(problem.target->field)
                                                 : FromFile(problem.target->profile);
  const auto num_pixels = static_cast<int>(target.field.size());
  field_ = optimizer::FieldObjective{.width = target.width,
                                     .height = num_pixels / target.width,
                                     .target = std::move(target.field),
                                     .sad_scale = 100.0 / num_pixels,
                                     .metric = {}};
}

std::string Evaluator::InputOf(const Eigen::VectorXd& point, std::uint64_t seed) const {
  const std::vector<double> native = problem_.space.ToNative(point);
  nlohmann::ordered_json input;
  for (std::size_t i = 0; i < native.size(); ++i) {
    input[problem_.space.parameters[i].name] = native[i];
  }
  input["seed"] = seed;
  return input.dump() + "\n";
}

Evaluated Evaluator::Run(const Eigen::VectorXd& point, std::uint64_t seed) const {
  Evaluated evaluated{.observation = {.point = point}, .failure = {}};
  const ToolResult result = RunTool(
      command_, {.time_cap = problem_.time_cap, .output_file = {}, .input = InputOf(point, seed)});
  if (result.status == 127) {
    throw base::Error("the command cannot be run: " + Excerpt(result.errors));
  }
  if (result.ok()) {
    TakeAnswer(result.output, evaluated.observation);
    return evaluated;
  }
  evaluated.observation.failed = true;
  evaluated.failure =
      "exit status " + std::to_string(result.status) + ": " + Excerpt(result.errors);
  return evaluated;
}

void Evaluator::TakeAnswer(const std::string& output, optimizer::Observation& observation) const {
  const auto answer = nlohmann::json::parse(output, nullptr, false);
  const auto wrong = [&](const std::string& what) {
    return base::Error("the command's answer " + what + "; it wrote: " + Excerpt(output));
  };
  if (!answer.is_object()) {
    throw wrong(
        R"(must be one JSON object, {"value": …}, {"profile": "file.png"} or {"field": …})");
  }
  if (answer.contains("value")) {
    if (!answer["value"].is_number()) throw wrong("has a \"value\" that is no number");
    observation.value = answer["value"].get<double>();
    if (!field_) return;
    throw wrong("is a \"value\", but the problem has a target image: take one of them away");
  }
  if (answer.contains("profile") && answer["profile"].is_string()) {
    Image image = FromFile(answer["profile"].get<std::string>());
    return TakeImage(output, std::move(image.field), image.width, observation);
  }
  if (answer.contains("field") && answer["field"].is_array()) {
    std::vector<std::vector<double>> rows;
    try {
      rows = answer["field"].get<std::vector<std::vector<double>>>();
    } catch (const nlohmann::json::exception&) {
      throw wrong("has a \"field\" that is no list of rows of numbers");
    }
    if (rows.empty() || rows.front().empty()) throw wrong("has an empty \"field\"");
    Image image = FromRows(rows);
    return TakeImage(output, std::move(image.field), image.width, observation);
  }
  throw wrong("has neither \"value\", \"profile\" nor \"field\"");
}

void Evaluator::TakeImage(const std::string& output, std::vector<float> image, int width,
                          optimizer::Observation& observation) const {
  if (!field_) {
    throw base::Error(
        "the command returns an image, but the problem has no \"target\" to compare "
        "it with; it wrote: " +
        Excerpt(output));
  }
  if (width != field_->width || image.size() != field_->target.size()) {
    throw base::Error("the command's image has " + std::to_string(width) + " columns and " +
                      std::to_string(image.size()) + " pixels, the target " +
                      std::to_string(field_->width) + " and " +
                      std::to_string(field_->target.size()) + ": make them the same size");
  }
  observation.value = field_->Value(image);
  observation.field = std::move(image);
}

}  // namespace talus::experiments
