#include "experiments/campaign/answer/campaign_result.h"

#include <cmath>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/number_text.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/hold_out.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/journal/record_json.h"

namespace talus::campaign {
namespace {

std::string Padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string ParameterLines(const CampaignResult& result) {
  std::string text;
  for (const ResultParameter& p : result.parameters) {
    text += "  " + Padded(p.name, 18) + Padded(base::ShortNumber(p.value) + " " + p.unit, 18) +
            "90 % in " + base::ShortNumber(p.credible_low) + " … " +
            base::ShortNumber(p.credible_high) + "\n";
  }
  if (result.parameters.size() > 1) text += "  (90 % for all of them together)\n";
  return text;
}

std::string ExperimentLines(const std::vector<ResultConfirmed>& experiments,
                            const std::string& unit) {
  std::string text;
  for (const ResultConfirmed& e : experiments) {
    text += "    " + Padded(e.name, 16);
    if (std::isfinite(e.mean)) text += base::ShortNumber(e.mean) + unit;
    if (e.over_floor) {
      text += ", its mean profile " + base::ShortNumber(*e.over_floor) + " times the noise floor";
    }
    for (const ResultScalar& s : e.scalars) {
      text += (text.ends_with(' ') ? "" : "; ") + s.name + " " + base::ShortNumber(s.mean) +
              ", measured " + base::ShortNumber(s.measured) + " ± " +
              base::ShortNumber(s.measured_sd);
    }
    text += "\n";
  }
  return text;
}

std::string ConfirmedLines(const CampaignResult& result) {
  const std::string unit = " " + result.objective_unit;
  std::string text;
  for (std::size_t i = 0; i < result.confirmed.size(); ++i) {
    const ResultCandidate& c = result.confirmed[i];
    std::string line = i == 0 ? "  confirmed" : "  candidate " + std::to_string(i + 1);
    text += Padded(line, 20) +
            (std::isfinite(c.mean) ? base::ShortNumber(c.mean) + unit : "by numbers");
    if (std::isfinite(c.standard_error)) text += " ± " + base::ShortNumber(c.standard_error);
    text += " (" + std::to_string(c.num_trials) + " fresh seeds, scale factor " +
            base::ShortNumber(c.scale_factor) + ")";
    if (i > 0) {
      text += " at";
      for (const double value : c.values) text += " " + base::ShortNumber(value);
    }
    text += "\n";
    if (c.experiments) text += ExperimentLines(*c.experiments, unit);
  }
  return text;
}

std::string FloorLine(const CampaignResult& result) {
  if (!result.noise_floor)
    return "  noise floor       not known: the experiment has one run only\n";
  std::string text = "  noise floor       " + base::ShortNumber(*result.noise_floor) +
                     " mm² SAD from run to run of the experiment";
  if (result.confirmed_over_floor) {
    text += "; the mean profile of the confirming runs is at " +
            base::ShortNumber(*result.confirmed_over_floor) + " times that";
  }
  return text + "\n";
}

std::string BranchLine(const ResultBranch& branch) {
  std::string text = "    " + base::ShortNumber(100 * branch.share) + " % at";
  for (const double value : branch.values) text += " " + base::ShortNumber(value);
  return text + "\n";
}

std::string PosteriorLines(const CampaignResult& result) {
  const ResultPosterior& p = *result.posterior;
  std::string text;
  if (p.branches.size() > 1) {
    for (const ResultBranch& branch : p.branches) text += BranchLine(branch);
  }
  for (const ResultStanding& e : p.experiments) {
    text +=
        "  " + Padded(e.name, 18) + "implausibility " + base::ShortNumber(e.implausibility) + "\n";
  }
  if (p.experiments.size() > 1) {
    text += "  tension           " + base::ShortNumber(p.tension, 2) +
            " standard deviations between the experiments\n";
  }
  for (const ResultAlone& a : p.alone) {
    text += "  " + a.name + " alone:";
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      text += (i == 0 ? " " : ", ") + result.parameters[i].name + " " +
              base::ShortNumber(a.values[i]) + " (" + base::ShortNumber(a.low[i]) + " to " +
              base::ShortNumber(a.high[i]) + ")";
    }
    text += "\n";
  }
  return text + "  coverage          of 90 % regions, leave-one-out over " +
         std::to_string(p.num_left_out) + " trials: " + base::ShortNumber(100 * p.raw_coverage) +
         " % raw, " + base::ShortNumber(100 * p.tempered_coverage) + " % tempered\n";
}

}  // namespace

std::string ResultText(const CampaignResult& result) {
  return base::JsonText(base::ToJson(result), 2) + "\n";
}

CampaignResult ParseResult(const std::string& text) {
  // Earlier versions wrote warnings as sentences only, and one unit in lower case.
  auto json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) return journal::ParseRecord<CampaignResult>(text, "the result");
  for (auto& warning : json["warnings"]) {
    if (warning.is_string()) warning = {{"kind", "other"}, {"text", warning}};
  }
  auto& conditions = json["conditions"];
  if (conditions.contains("youngs_modulus_pa")) {
    conditions["youngs_modulus_Pa"] = conditions["youngs_modulus_pa"];
    conditions.erase("youngs_modulus_pa");
  }
  return journal::ParseRecord<CampaignResult>(base::JsonText(json), "the result");
}

std::string ResultSummary(const CampaignResult& r, const std::filesystem::path& folder) {
  std::string text = r.name + ": recommended set\n" + ParameterLines(r);
  if (r.verdict) text += "  verdict           " + r.verdict->text + "\n";
  const bool has_image = std::isfinite(r.predicted);
  if (has_image) {
    text += "  predicted         " + base::ShortNumber(r.predicted) + " " + r.objective_unit +
            " ± " + base::ShortNumber(r.predicted_sd) + "; one simulation scatters by " +
            base::ShortNumber(r.noise_sd) + "\n";
  }
  text += ConfirmedLines(r);
  if (has_image) text += FloorLine(r);
  text += r.posterior ? PosteriorLines(r)
                      : "  tied within noise " + base::ShortNumber(100 * r.tied_volume) +
                            " % of the searched ranges\n";
  if (r.held_out) {
    text += "  held out          " + r.held_out->name + ", which the answer is made without\n";
    for (const std::string& fact : HeldOutFacts(*r.held_out, r.objective_unit)) {
      text += "    " + fact + "\n";
    }
  }
  text += "  stopped because   " + r.stop_reason + "\n";
  if (r.verdict && r.verdict->kind != VerdictKind::kPoint) {
    text +=
        "  next              `talus next DIR` ranks what would narrow it; `talus report DIR` shows "
        "it\n";
  }
  text += "  holds for         scale factor " + base::ShortNumber(r.conditions.scale_factor) +
          ", Y " + base::ShortNumber(r.conditions.youngs_modulus) + " Pa, lift velocity " +
          base::ShortNumber(r.conditions.lift_velocity) + " m/s, adhesion " +
          r.conditions.adhesion + ", rolling " + r.conditions.rolling + "\n";
  text += "  cost              " + std::to_string(r.cost.num_trials) + " simulations (" +
          std::to_string(r.cost.num_failed) + " failed), " + base::ShortNumber(r.cost.core_hours) +
          " core hours, " + base::ShortNumber(r.cost.elapsed / 60) + " min\n";
  text += "  model             " + r.model + "\n";
  for (const ResultWarning& warning : r.warnings) text += "  warning: " + warning.text + "\n";
  return WithFolder(text, folder);
}

}  // namespace talus::campaign
