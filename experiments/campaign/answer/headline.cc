#include "experiments/campaign/answer/headline.h"

#include <algorithm>
#include <cmath>

#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {
namespace {

// Share of the searched range [-] from which on a parameter is not determined at all.
constexpr double kOpen = 0.8;

// The answer with what the sentences call its parameters.
struct Told {
  const Answer& answer;
  const std::vector<std::string>& names;

  const ResultParameter& at(std::size_t i) const { return answer.parameters[i]; }
};

// Three digits: a headline is no table.
std::string Short(double value) { return base::ShortNumber(value, 3); }

std::string Percent(double share) { return base::InPercent(share) + " %"; }

// Wide, and no other parameter tells it.
bool IsOpen(const Answer& answer, std::size_t i) {
  const auto pair = TiedPair(answer.correlation);
  return answer.parameters[i].Width() >= kOpen &&
         !(pair && (pair->first == i || pair->second == i));
}

std::string ShownUnitAfter(const ResultParameter& p) {
  const std::string unit = rigs::PrettyUnit(p.unit);
  return unit.empty() ? "" : " " + unit;
}

std::string EndsText(const ResultParameter& p) {
  return Short(p.credible_low) + " to " + Short(p.credible_high) + ShownUnitAfter(p);
}

std::string RangeText(const Told& told, std::size_t i) {
  return told.names[i] + " in " + EndsText(told.at(i));
}

// "(sliding friction 0.3, surface energy 0.002 J/m²)"
std::string ToldSetText(const Told& told, const std::vector<double>& values) {
  return "(" +
         base::JoinedUpTo(values.size(), ", ",
                          [&](std::size_t i) {
                            return told.names[i] + " " + Short(values[i]) +
                                   ShownUnitAfter(told.at(i));
                          }) +
         ")";
}

// The alarms that leave nothing to be said of ranges.
std::string MissText(const Answer& answer) {
  if (HasAlarm(answer, {AlarmKind::kImplausible})) {
    return "No set fits every measurement: the ranges are of the sets that miss least.";
  }
  if (HasAlarm(answer, {AlarmKind::kDisagree})) {
    return "The tests disagree: no set fits all of them as well as each alone is fitted.";
  }
  if (HasAlarm(answer, {AlarmKind::kMisses})) {
    return "The recommended set misses a measurement: the ranges are of the sets that miss least.";
  }
  if (HasAlarm(answer, {AlarmKind::kConfirmationFailed})) {
    return "The recommended set could not be simulated again: the ranges are of what the model "
           "expects.";
  }
  if (HasAlarm(answer, {AlarmKind::kSearchMisses})) {
    return "The recommended set misses a measurement, and the search is not done: the ranges are "
           "provisional until it has found what fits.";
  }
  return "";
}

std::string OpenText(const Told& told, bool any_fits) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < told.names.size(); ++i) {
    if (IsOpen(told.answer, i)) open.push_back(told.names[i]);
  }
  if (open.empty()) return "";
  return "The measurements do not determine " + base::Listed(open) +
         ": nearly every searched value " + (any_fits ? "fits." : "is as likely.");
}

std::string KnownText(const Told& told) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < told.names.size(); ++i) {
    const ResultParameter& p = told.at(i);
    if (p.Width() >= kWideRange || IsKnownByPrior(p)) continue;
    known.push_back(told.names[i] + " " + Short(p.value) + ShownUnitAfter(p) +
                    " (90 %: " + EndsText(p) + (OwesToItsPrior(p) ? ", its prior counted)" : ")"));
  }
  return known.empty() ? "" : "They determine " + base::Listed(known) + ".";
}

// What was known beforehand is no finding.
std::string PriorText(const Told& told) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < told.names.size(); ++i) {
    const ResultParameter& p = told.at(i);
    if (!IsKnownByPrior(p) || IsOpen(told.answer, i)) continue;
    known.push_back(told.names[i] + " (" + p.prior->text + ")");
  }
  if (known.empty()) return "";
  return "The measurements add nothing to what " +
         std::string(known.size() == 1 ? "the prior says" : "the priors say") + " of " +
         base::Listed(known) + ".";
}

std::string SeparateText(const Told& told) {
  const std::vector<ResultBranch>& branches = told.answer.posterior->branches;
  std::string text = "They allow " + std::to_string(branches.size()) + " separate answers";
  for (std::size_t b = 0; b < branches.size(); ++b) {
    text += (b == 0 ? ": " : ", ") + Percent(branches[b].share) + " of the region round " +
            ToldSetText(told, branches[b].values);
  }
  return text;
}

std::string CurveText(const Told& told) {
  // What is known given the other: the narrower of the two.
  auto [given, known] = *TiedPair(told.answer.correlation);
  if (told.at(known).Width() > told.at(given).Width()) std::swap(given, known);
  const auto& sets = told.answer.representative;
  std::string text =
      "They determine " + told.names[known] + " given " + told.names[given] + ", not both: ";
  if (sets.size() < 2) return text + RangeText(told, given) + ", " + RangeText(told, known);
  return text + "sets from " + ToldSetText(told, sets.front()) + " to " +
         ToldSetText(told, sets.back()) + " fit equally";
}

std::string RegionText(const Told& told) {
  std::vector<std::string> wide;
  for (std::size_t i = 0; i < told.names.size(); ++i) {
    if (told.at(i).Width() < kWideRange || IsOpen(told.answer, i)) continue;
    wide.push_back(RangeText(told, i) + " (" + Percent(std::min(1.0, told.at(i).Width())) +
                   " of its searched range)");
  }
  return "They leave a region, not a point" + (wide.empty() ? "" : ": " + base::Listed(wide));
}

// "Not asked for: restitution e: not determined, 0.62 … 0.93, does not matter."
std::string NuisancesText(const Answer& answer, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < answer.parameters.size(); ++i) {
    const ResultParameter& p = answer.parameters[i];
    if (p.nuisance) text += (text.empty() ? "Not asked for: " : "; ") + NuisanceText(p, names[i]);
  }
  return text.empty() ? text : text + ".";
}

std::string KindText(const Told& told, VerdictKind kind) {
  switch (kind) {
    case VerdictKind::kSeparate:
      return SeparateText(told);
    case VerdictKind::kCurve:
      return CurveText(told);
    case VerdictKind::kRegion:
      return RegionText(told);
    case VerdictKind::kPoint:
      break;
  }
  return "That is a point";
}

// "the shape of "heap" and AOR 1 of "funnel heap"": farther off than a fit is, but few simulations
// may be by chance.
std::string LeftOpen(const Answer& answer) {
  std::vector<std::string> open;
  for (const MeasurementFit& fit : FitsOf(answer)) {
    const bool is_judged = !std::isnan(fit.off);  // and is no fit, or it would be met
    if (fit.meets == Meets::kUnknown && is_judged && !IsHeldOut(answer, fit.experiment)) {
      open.push_back(SpokenOf(fit));
    }
  }
  return base::Listed(open);
}

std::string FitText(const Answer& answer) {
  if (ConfirmedSet(answer) == nullptr) {
    return "By the model sets fit every measurement; no simulation has confirmed one.";
  }
  const std::string open = LeftOpen(answer);
  if (open.empty()) return "Sets are found that fit every measurement.";
  return "By the model sets fit every measurement; the few simulations that should confirm one do "
         "not tell for " +
         open + ".";
}

}  // namespace

std::optional<VerdictKind> VerdictKindOf(const Answer& all) {
  if (!all.posterior) return std::nullopt;
  const Answer answer = AskedPart(all);
  if (answer.posterior->branches.size() > 1) return VerdictKind::kSeparate;
  const auto wide = [](const ResultParameter& p) { return p.Width() >= kWideRange; };
  if (std::ranges::none_of(answer.parameters, wide)) return VerdictKind::kPoint;
  const auto pair = TiedPair(answer.correlation);
  const bool is_curve =
      pair && (wide(answer.parameters[pair->first]) || wide(answer.parameters[pair->second]));
  return is_curve ? VerdictKind::kCurve : VerdictKind::kRegion;
}

std::vector<std::string> Headline(const Answer& all, const std::vector<std::string>& all_names) {
  const auto kind = VerdictKindOf(all);
  if (!kind) return {};
  const Answer answer = AskedPart(all);
  const std::vector<std::string> names = OnlyThose(AskedParameters(all), all_names);
  const Told told{.answer = answer, .names = names};
  const std::string miss = MissText(answer);
  std::vector<std::string> sentences{miss.empty() ? FitText(answer) : miss,
                                     OpenText(told, miss.empty()), KnownText(told),
                                     PriorText(told)};
  // Sets that miss have no kind of fit.
  if (miss.empty()) {
    const std::string volume = Percent(answer.posterior->region_volume);
    sentences.push_back(KindText(told, *kind) + "; the joint 90 % region fills " +
                        (volume.starts_with("less") ? "" : "about ") + volume +
                        " of the searched ranges.");
  }
  sentences.push_back(NuisancesText(all, all_names));
  if (const double share = answer.posterior->surrogate_narrowing; IsProvisional(share)) {
    sentences.push_back("The region is " + ProvisionalText(share) + ".");
  }
  std::erase(sentences, "");
  return sentences;
}

std::string HeadlineText(const Answer& answer) {
  std::vector<std::string> names;
  for (const ResultParameter& p : answer.parameters) names.push_back(p.name);
  return base::Joined(Headline(answer, names), " ");
}

}  // namespace talus::campaign
