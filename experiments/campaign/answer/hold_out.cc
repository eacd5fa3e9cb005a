#include "experiments/campaign/answer/hold_out.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/random.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/campaign/answer/alarm.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {
namespace {

using optimizer::ExperimentModel;

constexpr int kHoldOutDraws = 400;

// Draws of what would be measured: the simulated mean, its uncertainty and the measurement's error.
PredictedNumber NumberOf(const journal::ScalarRecord& scalar, const optimizer::Moments& at,
                         std::uint64_t seed) {
  base::Random random(seed, base::Stream("held out"));
  std::vector<double> draws;
  for (Eigen::Index i = 0; i < at.mean.size(); ++i) {
    draws.push_back(at.mean[i] + std::hypot(at.sd[i], scalar.NormalError()) * random.Normal());
  }
  std::sort(draws.begin(), draws.end());
  const auto quantile = [&](double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(draws.size() - 1));
    return rigs::Possible(scalar.name, draws[rank]);
  };
  const double mean = at.mean.mean();
  const double variance = (at.mean.array() - mean).square().mean() + at.sd.array().square().mean();
  return {.name = scalar.name,
          .mean = mean,
          .sd = std::sqrt(variance),
          .low = quantile(0.05),
          .high = quantile(0.95),
          .measured = scalar.value,
          .measured_sd = scalar.standard_error};
}

std::string AnswerLine(const JointView& view, const PartialAnswer& answer) {
  const auto one = [&](std::size_t i) {
    const journal::ParameterRecord& p = view.record.parameters[i];
    return p.name + " " + base::ShortNumber(answer.values[i]) + " (" +
           base::ShortNumber(answer.low[i]) + " to " + base::ShortNumber(answer.high[i]) + ")" +
           (p.unit.empty() ? "" : " " + p.unit);
  };
  return base::JoinedUpTo(answer.values.size(), ", ", one) + "; region " +
         base::ShortNumber(100 * answer.region_volume) + " % of the ranges";
}

nlohmann::ordered_json AnswerJson(const JointView& view, const PartialAnswer& answer) {
  nlohmann::ordered_json json{{"experiments", answer.experiments}};
  for (std::size_t i = 0; i < answer.values.size(); ++i) {
    json["parameters"].push_back({{"name", view.record.parameters[i].name},
                                  {"value", answer.values[i]},
                                  {"credible_low", answer.low[i]},
                                  {"credible_high", answer.high[i]}});
  }
  json["region_90_volume_fraction"] = answer.region_volume;
  return json;
}

}  // namespace

HeldOut HoldOut(const JointView& view, const std::string& name) {
  const int held = view.IndexOf(name);
  std::vector<int> others = view.All();
  std::erase(others, held);
  if (others.empty()) {
    throw base::ConfigError("\"" + name +
                            "\": is the campaign's only experiment; `talus "
                            "add-experiment` gives it a second one");
  }
  const auto of_others = StrategyOf(view, others);
  HeldOut result{.others = AnswerOf(view, *of_others, others),
                 .predicted = {.name = name},
                 .objective_unit = std::string(journal::InfoOf(view.spec.objective).unit)};
  const auto alone = StrategyOf(view, {held});
  if (!alone->CanModel()) throw base::Error("too few trials of \"" + name + "\" to predict it");
  const optimizer::Posterior& posterior = alone->Model();
  const ExperimentModel& model = posterior.models().front();
  const Eigen::VectorXd& answer = result.others.point;
  const Eigen::MatrixXd draws = of_others->Sample().Draws(kHoldOutDraws, view.spec.seed);
  ResultHeldOut& predicted = result.predicted;
  predicted.implausibility = posterior.Implausibility(0, answer);
  predicted.least_implausibility = predicted.implausibility;
  const Eigen::VectorXd levels = of_others->CredibleLevels(draws).value();
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (levels[i] > optimizer::kRegionLevel) continue;
    predicted.least_implausibility = std::min(
        predicted.least_implausibility, posterior.Implausibility(0, draws.row(i).transpose()));
  }
  if (model.has_image()) {
    const optimizer::Moments at = model.Objective(answer.transpose());
    predicted.predicted = at.mean[0];
    predicted.predicted_sd = at.sd[0];
  }
  const auto scalars = model.Scalars(draws);
  const auto& measured = view.record.experiments[static_cast<std::size_t>(held)].scalars;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    predicted.numbers.push_back(NumberOf(measured[s], scalars[s], view.spec.seed));
  }
  return result;
}

std::vector<PartialAnswer> AnswersAlone(const JointView& view) {
  std::vector<PartialAnswer> answers;
  for (const int e : view.All()) {
    const auto strategy = StrategyOf(view, {e});
    if (strategy->CanModel()) answers.push_back(AnswerOf(view, *strategy, {e}));
  }
  return answers;
}

std::vector<std::string> HeldOutFacts(const ResultHeldOut& h, const std::string& objective_unit) {
  if (std::isnan(h.implausibility)) {
    return {"not predicted: there is no posterior yet; more simulations make one (" +
            ResumeCommand(kMoreSimulations) + ")"};
  }
  std::vector<std::string> facts;
  if (std::isfinite(h.predicted)) {
    facts.push_back("image: the predicted one differs from that of " + h.name + " by " +
                    base::ShortNumber(h.predicted) + " ± " + base::ShortNumber(h.predicted_sd) +
                    " " + objective_unit);
  }
  for (const PredictedNumber& n : h.numbers) {
    const auto shown = [&](double value) { return rigs::ShownNumber(n.name, value); };
    facts.push_back(rigs::SpokenName(n.name) + ": predicted " + shown(n.mean) + " ± " +
                    shown(n.sd) + ", measured " + shown(n.measured) + " ± " + shown(n.measured_sd) +
                    "; " + (n.IsInside() ? "inside " : "outside ") + shown(n.low) + " to " +
                    shown(n.high));
  }
  facts.push_back("implausibility " + base::ShortNumber(h.implausibility) + ", " +
                  base::ShortNumber(h.least_implausibility) +
                  " at the best set of the others' region");
  return facts;
}

std::string HeldOutText(const JointView& view, const HeldOut& h) {
  std::string text = "  held out          " + h.predicted.name + "\n  others answer     " +
                     AnswerLine(view, h.others) + "\n";
  for (const std::string& fact : HeldOutFacts(h.predicted, h.objective_unit)) {
    text += "  " + fact + "\n";
  }
  return text;
}

std::string HeldOutJson(const JointView& view, const HeldOut& h) {
  const ResultHeldOut& predicted = h.predicted;
  nlohmann::ordered_json json{{"held_out", predicted.name},
                              {"others", AnswerJson(view, h.others)},
                              {"implausibility", predicted.implausibility},
                              {"least_implausibility", predicted.least_implausibility},
                              {"objective_unit", h.objective_unit}};
  if (std::isfinite(predicted.predicted)) {
    json["predicted_objective"] = predicted.predicted;
    json["predicted_objective_sd"] = predicted.predicted_sd;
  }
  json["numbers"] = base::ToJson(predicted.numbers);
  return base::JsonText(json, 2) + "\n";
}

std::string AloneText(const JointView& view, const std::vector<PartialAnswer>& answers) {
  std::string text;
  for (const int e : view.All()) {
    const std::string& name = view.NameOf(e);
    const auto found = std::find_if(
        answers.begin(), answers.end(),
        [&](const PartialAnswer& answer) { return answer.experiments.front() == name; });
    text += "  " + name + " alone: " +
            (found == answers.end() ? "too few trials to answer" : AnswerLine(view, *found)) + "\n";
  }
  return text;
}

std::string AloneJson(const JointView& view, const std::vector<PartialAnswer>& answers) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const PartialAnswer& answer : answers) json.push_back(AnswerJson(view, answer));
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::campaign
