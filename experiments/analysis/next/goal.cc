#include "experiments/analysis/next/goal.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/joined.h"
#include "experiments/analysis/predict/predict.h"
#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/rigs/rig_list.h"

namespace talus::analysis {
namespace {

struct GoalNumber {
  std::string key;     // "angle"
  std::string metric;  // "angle_deg"
  bool is_usual = false;
};

std::vector<GoalNumber> NumbersOf(const rigs::Case& rig_case) {
  std::vector<GoalNumber> numbers;
  for (const rigs::RigObservable& o : rigs::EntryOf(rig_case).observables) {
    numbers.push_back({.key = rigs::InfoOf(o.observable).key,
                       .metric = rigs::MetricName(o.observable),
                       .is_usual = o.usual});
  }
  return numbers;
}

// Those of a scene are known once it was simulated.
std::vector<GoalNumber> NumbersOf(const Prediction& prediction) {
  std::vector<GoalNumber> numbers;
  for (const PredictedNumber& number : prediction.numbers) {
    numbers.push_back({.key = number.name, .metric = number.name, .is_usual = number.is_usual});
  }
  return numbers;
}

std::string NameOfGoal(const std::vector<GoalNumber>& numbers, const GoalRequest& request) {
  const std::string all = base::Joined(numbers, ", ", &GoalNumber::key);
  if (!request.observable.empty()) {
    const auto named = std::ranges::find_if(numbers, [&](const GoalNumber& number) {
      return number.key == request.observable || number.metric == request.observable;
    });
    if (named != numbers.end()) return named->metric;
    throw base::ConfigError(request.file.string() + ": has no observable \"" + request.observable +
                            "\"; it has " + all);
  }
  const auto is_usual = [](const GoalNumber& number) { return number.is_usual; };
  if (std::ranges::count_if(numbers, is_usual) == 1) {
    return std::ranges::find_if(numbers, is_usual)->metric;
  }
  throw base::ConfigError(request.file.string() + ": has several observables, " + all +
                          "; name the one that counts, as in --observable " + numbers.front().key);
}

}  // namespace

Goal SimulateGoal(const campaign::JointView& view, const GoalRequest& request,
                  campaign::CampaignParts parts) {
  // A wrong name costs no simulation.
  const PredictedCase process = ReadPredictedCase(view, request.file, {}, 1);
  const bool is_scene = !process.scene_text.empty();
  std::string name = is_scene ? "" : NameOfGoal(NumbersOf(process.rig_case), request);
  const Prediction prediction =
      Predict(view, {.file = request.file, .as_before = true}, std::move(parts));
  if (is_scene) name = NameOfGoal(NumbersOf(prediction), request);
  const auto number = std::ranges::find(prediction.numbers, name, &PredictedNumber::name);
  const auto surrogate = number == prediction.numbers.end()
                             ? std::nullopt
                             : NumberSurrogate::Fit(prediction, *number, view.space);
  if (!surrogate) {
    const std::string& why =
        number == prediction.numbers.end() ? prediction.failure : number->undefined;
    throw base::Error(
        request.file.string() + ": fewer than " + std::to_string(NumberSurrogate::kFewest) +
        " of " + std::to_string(prediction.draws.size()) + " draws give \"" + name + "\"" +
        (why.empty() ? "" : ", the last without: " + why) + "; what it goes with is not known");
  }
  return {.process = prediction.name,
          .number = name,
          .surrogate = *surrogate,
          .scale_factor = prediction.target,
          .num_draws = static_cast<int>(prediction.draws.size()),
          .num_runs = prediction.num_runs,
          .core_time = prediction.core_time};
}

}  // namespace talus::analysis
