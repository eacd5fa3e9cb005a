#include "experiments/analysis/search/search_folder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<SearchParameter> ParametersOf(const Json& problem) {
  std::vector<SearchParameter> parameters;
  for (const Json& one : problem.at("parameters")) {
    if (one.contains("fixed") && !one["fixed"].is_null()) continue;
    SearchParameter parameter{.name = one.at("name").get<std::string>(),
                              .log = one.value("scale", "linear") == "log"};
    const auto levels = one.value("levels", std::vector<double>{});
    if (levels.empty()) {
      parameter.low = one.at("low").get<double>();
      parameter.high = one.at("high").get<double>();
    } else {
      const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
      parameter.low = *low;
      parameter.high = *high;
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

SearchEvaluation EvaluationOf(const Json& line, const std::vector<SearchParameter>& parameters) {
  SearchEvaluation evaluation{.number = line.at("evaluation").get<int>()};
  for (const SearchParameter& parameter : parameters) {
    evaluation.values.push_back(line.at("parameters").at(parameter.name).get<double>());
  }
  if (line.contains("failed")) {
    evaluation.failure = line["failed"].get<std::string>();
  } else {
    evaluation.value = line.at("value").get<double>();
  }
  return evaluation;
}

// A line that is being written, or that a kill has cut off, is none. One made again replaces the
// first.
std::vector<SearchEvaluation> ReadEvaluations(const fs::path& path,
                                              const std::vector<SearchParameter>& parameters) {
  const std::string text = base::ReadFile(path);
  const std::size_t end = text.rfind('\n');
  std::istringstream lines(text.substr(0, end == std::string::npos ? 0 : end));
  std::map<int, SearchEvaluation> by_number;
  int line_number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++line_number;
    try {
      const auto whole = base::IfWhole(line + "\n");
      if (!whole) {
        throw base::ConfigError(path.string() + ":" + std::to_string(line_number) +
                                ": is damaged: it does not match its checksum; take the line away, "
                                "the same `talus optimize` makes it again");
      }
      SearchEvaluation evaluation = EvaluationOf(Json::parse(*whole), parameters);
      by_number.insert_or_assign(evaluation.number, std::move(evaluation));
    } catch (const Json::exception&) {
      throw base::ConfigError(path.string() + ":" + std::to_string(line_number) +
                              ": is no evaluation; take the line away");
    }
  }
  std::vector<SearchEvaluation> evaluations;
  for (auto& [number, evaluation] : by_number) evaluations.push_back(std::move(evaluation));
  return evaluations;
}

double NumberAt(const Json& object, const char* key) {
  const bool there = object.is_object() && object.contains(key) && object.at(key).is_number();
  return there ? object.at(key).get<double>() : std::nan("");
}

Json At(const Json& object, const std::string& key) {
  return object.is_object() && object.contains(key) ? object.at(key) : Json(nullptr);
}

SearchAnswer AnswerOf(const Json& result, const std::vector<SearchParameter>& parameters) {
  SearchAnswer answer{
      .predicted_value = NumberAt(result, "predicted_value"),
      .predicted_sd = NumberAt(result, "predicted_sd"),
      .noise_sd = NumberAt(result, "noise_sd"),
      .tied_volume = NumberAt(result, "tied_volume"),
      .num_evaluations = result.value("evaluations", std::numeric_limits<int>::max()),
      .stopped = result.value("stopped", ""),
      .model = result.value("model", ""),
      .warnings = result.value("warnings", std::vector<std::string>{})};
  for (const SearchParameter& parameter : parameters) {
    const Json range = At(At(result, "ranges_90"), parameter.name);
    answer.parameters.push_back(
        {.recommended = NumberAt(result.at("recommended"), parameter.name.c_str()),
         .low = NumberAt(range, "low"),
         .high = NumberAt(range, "high"),
         .sobol_first = NumberAt(range, "sobol_first"),
         .sobol_total = NumberAt(range, "sobol_total")});
  }
  return answer;
}

}  // namespace

bool IsSearchFolder(const fs::path& folder) {
  return fs::exists(folder / "problem.json") && fs::exists(folder / "evaluations.jsonl");
}

SearchFolder ReadSearchFolder(const fs::path& folder) {
  SearchFolder search{.name = base::FolderName(folder)};
  const fs::path problem_path = folder / "problem.json";
  try {
    const std::string bytes = base::ReadFile(problem_path);
    const std::string text = base::CheckedText(bytes, problem_path.string()).value_or(bytes);
    const Json problem = Json::parse(text).at("problem");
    search.parameters = ParametersOf(problem);
    search.most_evaluations = problem.at("evaluations").get<int>();
  } catch (const Json::exception&) {
    throw base::ConfigError(problem_path.string() +
                            ": is damaged; run the same `talus optimize` again in another folder");
  }
  search.evaluations = ReadEvaluations(folder / "evaluations.jsonl", search.parameters);
  const fs::path result_path = folder / "result.json";
  if (!fs::exists(result_path)) return search;
  const auto result = base::IfWhole(base::ReadFile(result_path));
  try {
    if (result) search.answer = AnswerOf(Json::parse(*result), search.parameters);
  } catch (const Json::exception&) {
  }
  if (search.answer) {  // of fewer than were made, where the problem has come to allow fewer
    std::erase_if(search.evaluations, [&](const SearchEvaluation& one) {
      return one.number > search.answer->num_evaluations;
    });
  } else {
    throw base::ConfigError(result_path.string() +
                            ": is damaged; the same `talus optimize` writes it anew");
  }
  return search;
}

}  // namespace talus::analysis
