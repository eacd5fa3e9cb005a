#include "experiments/trials/optimize/optimize_result_json.h"

#include <vector>

#include "optimizer/search/describe_minimum.h"

namespace talus::trials {
namespace {

using json = nlohmann::ordered_json;

const optimizer::Parameter& Free(const OptimizeProblem& problem, std::size_t i) {
  return problem.space.parameters[static_cast<std::size_t>(problem.space.Free()[i])];
}

json Warnings(const OptimizeProblem& problem, const optimizer::Answer& answer,
              const SearchTally& tally) {
  json texts = json::array();
  const int num_values = tally.num_evaluations - tally.num_failed;
  if (tally.is_constant && num_values > 2) {
    texts.push_back("all " + std::to_string(num_values) +
                    " evaluations gave one value: what is searched may not act on it");
  } else if (tally.num_repeats > 1 && tally.num_equal_repeats == tally.num_repeats) {
    texts.push_back(
        "each of the " + std::to_string(tally.num_repeats) +
        " repeats of a set gave that set's value again: the command may ignore its "
        "seed; where a set has one value, say \"exact\": true, and nothing is repeated");
  }
  if (answer.is_guess) texts.push_back("no evaluation has succeeded: the point is only a guess");
  for (const optimizer::BoundWarning& warning : answer.warnings) {
    const optimizer::Parameter& parameter =
        Free(problem, static_cast<std::size_t>(warning.parameter));
    texts.push_back(
        optimizer::BoundText(parameter.name, warning.is_upper, !parameter.levels.empty()));
  }
  return texts;
}

json PerParameter(const OptimizeProblem& problem, const optimizer::Answer& answer) {
  json all;
  for (std::size_t i = 0; i < answer.credible.size(); ++i) {
    const optimizer::Parameter& parameter = Free(problem, i);
    json one;
    one["low"] = parameter.ToNative(answer.credible[i].low);
    one["high"] = parameter.ToNative(answer.credible[i].high);
    if (i < answer.sobol_first.size()) one["sobol_first"] = answer.sobol_first[i];
    if (i < answer.sobol_total.size()) one["sobol_total"] = answer.sobol_total[i];
    all[parameter.name] = one;
  }
  return all;
}

}  // namespace

json NativeParameters(const OptimizeProblem& problem, const Eigen::VectorXd& point) {
  json native;
  const std::vector<double> values = problem.space.ToNative(point);
  for (std::size_t i = 0; i < values.size(); ++i) {
    native[problem.space.parameters[i].name] = values[i];
  }
  return native;
}

json OptimizeResult(const OptimizeProblem& problem, const optimizer::Answer& answer,
                    const SearchTally& tally, const std::string& stopped) {
  json result{{"recommended", NativeParameters(problem, answer.point)},
              {"predicted_value", answer.predicted_value},
              {"predicted_sd", answer.predicted_sd},
              {"noise_sd", answer.noise_sd},
              {"ranges_90", PerParameter(problem, answer)}};
  // Without a model nothing is known of them, which is not that there is none.
  const bool has_model = answer.correlation.size() > 0;
  result["correlation"] = has_model ? json::array() : json();
  for (const auto row : answer.correlation.rowwise()) {
    result["correlation"].push_back(std::vector<double>(row.begin(), row.end()));
  }
  result["tied_volume"] = answer.tied_volume;
  result["tied"] = has_model ? json::array() : json();
  for (const Eigen::VectorXd& point : answer.tied) {
    result["tied"].push_back(NativeParameters(problem, point));
  }
  if (tally.best) {
    result["best_observed"] = {{"parameters", NativeParameters(problem, tally.best->point)},
                               {"value", tally.best->value}};
  }
  result["evaluations"] = tally.num_evaluations;
  result["failed"] = tally.num_failed;
  result["stopped"] = stopped;
  result["model"] = answer.model;
  result["warnings"] = Warnings(problem, answer, tally);
  return result;
}

}  // namespace talus::trials
