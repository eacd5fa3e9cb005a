#include "experiments/campaign/answer/answer_summary.h"

#include <algorithm>
#include <cmath>

#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/num_characters.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/answer/hold_out.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {
namespace {

std::string Padded(std::string text, std::size_t width) {
  const std::size_t size = base::NumCharacters(text);
  if (size < width) text.append(width - size, ' ');
  return text;
}

// "  (prior 0.35 ± 0.05, 90 % in 0.27 … 0.43)"
std::string PriorText(const ResultParameter& p) {
  if (!p.prior) return "";
  return "  (prior " + p.prior->text + ", 90 % in " + base::ShortNumber(p.prior->low) + " … " +
         base::ShortNumber(p.prior->high) + ")";
}

std::string RangeText(const ResultParameter& p) {
  if (!std::isfinite(p.credible_low)) return "no range without a model";
  return "90 % in " + base::ShortNumber(p.credible_low) + " … " +
         base::ShortNumber(p.credible_high);
}

std::string ParameterLines(const Answer& result) {
  std::string text;
  std::size_t width = 18;
  for (const ResultParameter& p : result.parameters) width = std::max(width, p.name.size() + 2);
  bool is_known = true;
  for (const ResultParameter& p : result.parameters) {
    if (p.nuisance) continue;
    is_known = is_known && std::isfinite(p.credible_low);
    text += "  " + Padded(p.name, width) + Padded(base::ShortNumber(p.value) + " " + p.unit, 18) +
            RangeText(p) + PriorText(p) + "\n";
  }
  if (is_known && AskedParameters(result).size() > 1) text += "  (90 % for all of them together)\n";
  for (const ResultParameter& p : result.parameters) {
    if (p.nuisance) text += "  nuisance          " + NuisanceText(p, p.name) + PriorText(p) + "\n";
  }
  return text;
}

// "predicted 0.36 mm² ± 0.025, confirmed 0.398 mm²", both of the mean heap where there are images;
// of an angle "predicted 1.2 ° off ± 0.4, confirmed 1.5 ° off".
std::string ObjectiveText(const Answer& answer, const ResultExperiment& experiment,
                          const ResultConfirmed* confirmed) {
  const std::string unit = DistanceUnit(answer);
  const ResultStanding* standing = StandingOf(answer, experiment.name);
  std::string text;
  if (standing != nullptr && std::isfinite(standing->predicted)) {
    text = "predicted " + base::ShortNumber(standing->predicted) + unit + " ± " +
           base::PlainNumber(standing->predicted_sd, 2);
  }
  if (confirmed == nullptr || !std::isfinite(confirmed->mean)) return text;
  text += (text.empty() ? "" : ", ") + std::string("confirmed ") +
          base::ShortNumber(ComparableOf(answer, *confirmed)) + unit;
  if (MinimisesSad(answer) && confirmed->over_floor) {
    text += " (" + base::PlainNumber(*confirmed->over_floor, 2) + " times the noise floor of " +
            base::PlainNumber(*experiment.noise_floor, 2) + ")";
  }
  return text;
}

std::string NumbersText(const ResultExperiment& experiment, const ResultStanding* standing,
                        const ResultConfirmed* confirmed) {
  std::string text;
  for (std::size_t i = 0; i < experiment.numbers.size(); ++i) {
    const ResultNumber& n = experiment.numbers[i];
    text += (text.empty() ? "" : "; ") + rigs::SpokenName(n.name);
    if (standing != nullptr && i < standing->numbers.size() &&
        std::isfinite(standing->numbers[i].predicted)) {
      text += " predicted " + rigs::ShownNumber(n.name, standing->numbers[i].predicted) + " ± " +
              rigs::ShownError(n.name, standing->numbers[i].predicted_sd, 2) + ",";
    }
    if (confirmed != nullptr) {
      const ResultScalar& simulated = confirmed->scalars.at(i);
      text += " " +
              (simulated.undefined ? "has no value (" + *simulated.undefined + ")"
                                   : "confirmed " + rigs::ShownNumber(n.name, simulated.mean)) +
              ",";
    }
    text += " measured " + rigs::ShownNumber(n.name, n.value) + " ± " +
            rigs::ShownError(n.name, n.standard_error);
  }
  return text;
}

// "; model error 2.3 times the run-to-run scatter, learnt", where it was not stated.
std::string ModelErrorText(const ResultStanding& standing) {
  constexpr double kTold = 0.3;  // less of the prior's sd taken away: the prior decides
  if (standing.model_error_told == 0) return "";
  return "; model error " + base::PlainNumber(standing.model_error, 2) +
         " times the run-to-run scatter" +
         (standing.model_error_told < kTold ? ", as its prior says: this test alone cannot tell"
                                            : ", learnt");
}

// The recommended set at each experiment.
std::string ExperimentLines(const Answer& answer) {
  std::string text;
  for (const ResultExperiment& e : answer.experiments) {
    const ResultConfirmed* confirmed = ConfirmedOf(answer, e.name);
    const std::string objective = ObjectiveText(answer, e, confirmed);
    const ResultStanding* standing = StandingOf(answer, e.name);
    const std::string numbers = NumbersText(e, standing, confirmed);
    std::string line = objective + (objective.empty() || numbers.empty() ? "" : "; ") + numbers;
    if (line.empty()) line = "not simulated again";
    text += "  " + Padded(e.name + "  ", 18) + line;
    if (standing != nullptr) {
      text += "; implausibility " + ImplausibilityText(*standing) + ModelErrorText(*standing);
    }
    text += "\n";
  }
  return text;
}

// "candidate 2", "an end 1": each role counted by itself.
std::string NameOfCandidate(const Answer& answer, std::size_t index) {
  const CandidateRole role = answer.confirmed[index].role;
  if (role == CandidateRole::kRecommended) return "confirmed";
  const auto last = answer.confirmed.begin() + static_cast<std::ptrdiff_t>(index) + 1;
  const auto number =
      std::ranges::count(answer.confirmed.begin(), last, role, &ResultCandidate::role);
  return role == CandidateRole::kEnd ? "an end " + std::to_string(number)
                                     : "candidate " + std::to_string(number + 1);
}

// "sliding_friction 0.31, rolling_friction 0.12"
std::string ValuesText(const Answer& answer, const std::vector<double>& values) {
  return base::JoinedUpTo(values.size(), ", ", [&](std::size_t k) {
    return answer.parameters[k].name + " " + base::ShortNumber(values[k], 4);
  });
}

// The farthest first.
std::string MissesText(const Answer& answer, const ResultCandidate& candidate) {
  std::string text;
  for (const MeasurementFit& fit : DistancesOf(answer, candidate)) {
    if (fit.off > 1) text += (text.empty() ? "" : ", ") + SpokenOf(fit);
  }
  return text;
}

std::string ConfirmedLines(const Answer& answer) {
  std::string text;
  for (std::size_t i = 0; i < answer.confirmed.size(); ++i) {
    const ResultCandidate& c = answer.confirmed[i];
    const bool is_answer = c.role == CandidateRole::kRecommended;  // whose values stand above
    const auto num_seeds =
        std::ranges::max_element(c.experiments, {}, &ResultConfirmed::num_trials)->num_trials;
    text += Padded("  " + NameOfCandidate(answer, i), 20) + "with " +
            base::Counted(num_seeds, "fresh seed") + " at scale factor " +
            base::ShortNumber(c.scale_factor);
    if (!is_answer) text += ": " + ValuesText(answer, c.values);
    for (const ResultConfirmed& e : c.experiments) {
      const double value = ComparableOf(answer, e);
      if (!is_answer && std::isfinite(value)) {
        text += "; " + e.name + " " + base::ShortNumber(value) + DistanceUnit(answer);
      }
    }
    if (!is_answer && Misses(answer, c)) text += "; misses " + MissesText(answer, c);
    text += "\n";
  }
  return text;
}

std::string BranchLine(const Answer& answer, const ResultBranch& branch) {
  return "    " + base::ShortNumber(100 * branch.share) + " % at " +
         ValuesText(answer, branch.values) + "\n";
}

std::string PosteriorLines(const Answer& result) {
  const ResultPosterior& p = *result.posterior;
  std::string text;
  if (p.branches.size() > 1) {
    for (const ResultBranch& branch : p.branches) text += BranchLine(result, branch);
  }
  if (p.experiments.size() > 1 && std::isfinite(p.tension)) {
    text += "  tension           " + base::PlainNumber(p.tension, 2) +
            " standard deviations between the experiments\n";
  }
  for (const ResultAlone& a : p.alone) {
    const auto one = [&](std::size_t i) {
      return result.parameters[i].name + " " + base::ShortNumber(a.values[i]) + " (" +
             base::ShortNumber(a.low[i]) + " to " + base::ShortNumber(a.high[i]) + ")";
    };
    text += "  " + a.name + " alone: " + base::JoinedUpTo(a.values.size(), ", ", one) + "\n";
  }
  return text + "  coverage          of 90 % regions, leave-one-out over " +
         std::to_string(p.num_left_out) + " trials: " + base::ShortNumber(100 * p.raw_coverage) +
         " % raw, " + base::ShortNumber(100 * p.tempered_coverage) + " % tempered\n";
}

// The laws of another engine are its deck's.
std::string LawsText(const ResultConditions& c) {
  const std::string scale = "scale factor " + base::ShortNumber(c.scale_factor);
  if (!c.command.empty()) return scale + ", the deck of \"" + c.command + "\" and its laws";
  return scale + ", Y " + base::ShortNumber(c.youngs_modulus / 1e6) + " MPa, adhesion " +
         c.adhesion + ", rolling " + c.rolling;
}

}  // namespace

std::string AnswerSummary(const Answer& r, const std::filesystem::path& folder) {
  std::string text = r.name + ": recommended set\n" + ParameterLines(r);
  if (r.verdict) text += "  verdict           " + r.verdict->text + "\n";
  text += ExperimentLines(r) + ConfirmedLines(r);
  if (r.posterior) text += PosteriorLines(r);
  if (r.held_out) {
    text += "  held out          " + r.held_out->name + ", which the answer is made without\n";
    for (const std::string& fact : HeldOutFacts(*r.held_out, r.objective_unit)) {
      text += "    " + fact + "\n";
    }
  }
  // Where the budget ended it, the alarm says so.
  if (!r.unsettled) text += "  stopped because   " + r.stop.Text() + "\n";
  if (r.verdict && r.verdict->kind != VerdictKind::kPoint) {
    text +=
        "  next              `talus next DIR` ranks what would narrow it; `talus report DIR` shows "
        "it\n";
  }
  text += "  holds for         " + LawsText(r.conditions) + "\n";
  for (const ResultDevice& device : r.conditions.devices) {
    const bool says_it = device.text.starts_with(device.experiment + ":");  // "funnel heap: …"
    text += "                    " + (says_it ? "" : device.experiment + ", ") + device.text + "\n";
  }
  text += "  cost              " + base::Counted(r.cost.num_trials, "simulation") + " (" +
          std::to_string(r.cost.num_failed) + " failed), " + base::ShortNumber(r.cost.core_hours) +
          " core hours, " + base::DurationText(r.cost.elapsed) + " elapsed\n";
  text += ReusedLines(r.reused);
  text += "  model             " + r.model + "\n";
  for (const Alarm& alarm : r.warnings) text += "  warning: " + AlarmText(alarm) + "\n";
  return WithFolder(text, folder);
}

}  // namespace talus::campaign
