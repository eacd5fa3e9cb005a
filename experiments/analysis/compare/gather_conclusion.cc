#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/error.h"
#include "base/text/number_text.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/report/labels.h"
#include "experiments/campaign/answer/campaign_result.h"
#include "experiments/campaign/answer/hold_out.h"
#include "experiments/campaign/verdict.h"
#include "experiments/journal/objective.h"
#include "optimizer/fidelity/experiment_model.h"

namespace talus::analysis {
namespace {

std::vector<std::string> ConditionTexts(const campaign::ResultConditions& c) {
  std::vector<std::string> texts{
      "Young's modulus of the grains " + base::ShortNumber(c.youngs_modulus / 1e6) + " MPa",
      "lift velocity " + base::ShortNumber(c.lift_velocity * 100) + " cm/s",
      "adhesion model " + c.adhesion + ", rolling model " + c.rolling};
  texts.push_back(c.scale_factor == 1
                      ? "grains at their true size"
                      : "grains " + base::ShortNumber(c.scale_factor) +
                            " times their true size, surface energy scaled with exponent " +
                            base::ShortNumber(c.surface_energy_exponent));
  return texts;
}

// A result calls its objective by the key of its value, "sad_mm2" or "aor2_difference_deg".
std::string ObjectiveKey(const std::string& result_key) {
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (result_key == info.ValueKey()) return std::string(info.key);
  }
  throw base::Error("the journal's result is of \"" + result_key + "\", which is not known here");
}

// "sliding friction μ_t"
std::string LongName(const ParameterInfo& parameter) {
  std::string name = parameter.range.name;
  if (name == parameter.symbol) return name;
  std::ranges::replace(name, '_', ' ');
  return name + " " + parameter.symbol;
}

// The two that change together most, where they do so clearly.
void AddTradeOff(const std::vector<std::vector<double>>& correlation,
                 const std::vector<ParameterInfo>& parameters, Conclusion& conclusion) {
  constexpr double kClear = 0.5;
  double most = kClear;
  for (std::size_t i = 0; i < correlation.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(std::abs(correlation[i][j]) >= most)) continue;
      most = std::abs(correlation[i][j]);
      conclusion.traded = {static_cast<int>(j), static_cast<int>(i)};
      conclusion.trade_off = "Higher " + parameters[j].symbol + " goes with " +
                             (correlation[i][j] < 0 ? "lower " : "higher ") + parameters[i].symbol +
                             ": change them together.";
    }
  }
}

bool Has(const campaign::CampaignResult& result, std::initializer_list<campaign::WarningKind> of) {
  return std::ranges::any_of(result.warnings, [&](const campaign::ResultWarning& warning) {
    return std::ranges::find(of, warning.kind) != of.end();
  });
}

bool AsksForSimulations(const campaign::CampaignResult& result) {
  using K = campaign::WarningKind;
  return Has(result, {K::kWorseThanPredicted, K::kWorseThanObserved, K::kPoorModel,
                      K::kExtrapolated, K::kUnlearntScaleFactor});
}

// A range's width is the root of a variance: what the measurements leave open, and the surrogate's
// share of it beside, which more simulations take away.
double WidthWithoutSurrogate(double share, int num_finest) {
  const double caution = optimizer::SurrogateCaution(num_finest);
  return 1 / std::sqrt(1 + caution * caution * share);
}

// Whether the search came to its own end. The alarm says what is missing.
void AddUnsettled(const campaign::CampaignResult& result, Conclusion& conclusion) {
  if (!result.unsettled) return;
  conclusion.more_simulations = result.unsettled->num_more;
  if (result.posterior && result.posterior->fewest_at_finest > 0) {
    conclusion.width_then =
        WidthWithoutSurrogate(result.unsettled->share, result.posterior->fewest_at_finest);
  }
  conclusion.unsettled = "The budget ended the search before its stopping rule did";
  if (std::isfinite(conclusion.more_simulations)) {
    conclusion.unsettled += ": about " + std::to_string(std::llround(conclusion.more_simulations)) +
                            " more simulations would meet it";
    if (std::isfinite(conclusion.width_then)) {
      conclusion.unsettled += " and leave ranges about " +
                              base::ShortNumber(conclusion.width_then, 2) + " times as wide";
    }
  }
  conclusion.unsettled += ".";
}

std::string UseNow(const campaign::CampaignResult& result, const std::string& verdict_kind) {
  using K = campaign::WarningKind;
  if (Has(result, {K::kImplausible})) {
    return "No: no set fits every measurement. Check contact law, plate and set-up first.";
  }
  if (Has(result, {K::kDisagree})) {
    return "No: the tests disagree. Check contact law, plate and set-up of each first.";
  }
  if (verdict_kind.empty()) return "";
  if (verdict_kind != "point") {
    return "For trial runs only: other sets fit as well. Do the first of the next steps before you "
           "rely on one.";
  }
  if (AsksForSimulations(result)) {
    return "For trial runs: more simulations should confirm it first, as the warnings say.";
  }
  if (Has(result, {K::kBound})) return "Not yet: a parameter lies on the end of its range.";
  return "Yes, as one set, for what it holds for (below).";
}

// The report's first line, with symbols beside the names; and what it stands on.
void AddVerdict(const campaign::CampaignResult& result,
                const std::vector<ParameterInfo>& parameters, Conclusion& conclusion) {
  campaign::VerdictBasis basis{.correlation = result.correlation,
                               .sets = result.representative,
                               .region_volume = result.tied_volume};
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    basis.parameters.push_back(parameters[i].range);
    basis.names.push_back(LongName(parameters[i]));
    basis.low.push_back(result.parameters[i].credible_low);
    basis.high.push_back(result.parameters[i].credible_high);
  }
  if (result.posterior) basis.branches = result.posterior->branches;
  if (const auto verdict = campaign::VerdictOf(basis)) {
    conclusion.verdict_kind = std::string(base::NameOf(verdict->kind));
    conclusion.verdict = verdict->text;
  }
  conclusion.representative = result.representative;
  if (!result.posterior) return;
  conclusion.has_posterior = true;
  for (const campaign::ResultBranch& branch : result.posterior->branches) {
    conclusion.branches.push_back(
        {.share = branch.share, .values = branch.values, .low = branch.low, .high = branch.high});
  }
}

}  // namespace

Conclusion ConclusionOf(const std::string& result_json,
                        const std::vector<ParameterInfo>& parameters) {
  const campaign::CampaignResult result = campaign::ParseResult(result_json);
  Conclusion conclusion{.objective = ObjectiveKey(result.objective),
                        .predicted = result.predicted,
                        .predicted_sd = result.predicted_sd,
                        .noise_sd = result.noise_sd,
                        .tied_volume = result.tied_volume,
                        .conditions = ConditionTexts(result.conditions),
                        .model = result.model};
  AddVerdict(result, parameters, conclusion);
  AddTradeOff(result.correlation, parameters, conclusion);
  AddUnsettled(result, conclusion);
  conclusion.use = UseNow(result, conclusion.verdict_kind);
  conclusion.asks_for_simulations = AsksForSimulations(result);
  for (const campaign::ResultWarning& warning : result.warnings)
    conclusion.warnings.push_back(warning.text);
  if (result.held_out) {
    conclusion.held_out = campaign::HeldOutFacts(*result.held_out, result.objective_unit);
    conclusion.held_out.insert(
        conclusion.held_out.begin(),
        "the answer is made without " + result.held_out->name + " and predicts it");
  }
  for (const campaign::ResultParameter& p : result.parameters) {
    conclusion.values.push_back({p.value, p.credible_low, p.credible_high});
    if (std::isnan(p.sobol_total)) continue;
    conclusion.sobol_first.push_back(p.sobol_first);
    conclusion.sobol_total.push_back(p.sobol_total);
  }
  if (!result.confirmed.empty()) {  // the recommended set comes first
    conclusion.confirmed = result.confirmed.front().mean;
    conclusion.num_confirmed = result.confirmed.front().num_trials;
    conclusion.confirmed_profile = result.confirmed.front().profile_sad_mm2.value_or(kUndefined);
  }
  conclusion.confirmed_over_floor = result.confirmed_over_floor.value_or(kUndefined);
  return conclusion;
}

}  // namespace talus::analysis
