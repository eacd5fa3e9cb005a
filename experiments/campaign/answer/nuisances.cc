#include "experiments/campaign/answer/nuisances.h"

#include <cmath>

#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {
namespace {

constexpr double kPulled = 1;        // standard deviations of a prior: from then on it may hold
constexpr double kNarrow = 1.0 / 3;  // of the searched range: such a prior holds without a pull
constexpr double kDetermined = 0.5;  // of the prior's 90 % range

double PriorWidth(const ResultParameter& p) {
  if (!p.prior) return optimizer::kRegionLevel;  // of a flat one, that share of its range
  return p.Range().ToUnit(p.prior->high) - p.Range().ToUnit(p.prior->low);
}

// A prior may keep the answer from where a set would fit: one that the answer pulls at, or a narrow
// one, which heavy tails give in to so that nothing is pulled.
bool MayHold(const ResultParameter& p) {
  if (!p.prior) return false;
  return std::abs(p.prior->offset) >= kPulled || PriorWidth(p) < kNarrow;
}

}  // namespace

bool Matters(const ResultParameter& nuisance) {
  return nuisance.nuisance && nuisance.nuisance->narrowing >= kMatters;
}

std::string NuisanceText(const ResultParameter& p, const std::string& name) {
  if (!std::isfinite(p.credible_low)) return name + ": no range without a model";
  const bool determined = p.Width() < kDetermined * PriorWidth(p);
  const std::string shown = rigs::PrettyUnit(p.unit);
  const std::string unit = shown.empty() ? "" : " " + shown;
  std::string text = name + ": " + (determined ? "determined, " : "not determined, ") +
                     base::ShortNumber(p.credible_low, 3) + " … " +
                     base::ShortNumber(p.credible_high, 3) + unit + ", ";
  if (!Matters(p)) return text + "does not matter";
  return text + "matters: measure it (the range of " + p.nuisance->of_range + " would be " +
         base::InPercent(p.nuisance->narrowing) + " % narrower)";
}

bool IsKnownByPrior(const ResultParameter& p) {
  constexpr double kSameWidth = 0.9;  // of the prior's
  constexpr double kSameMean = 0.5;   // of the prior's standard deviation
  if (!p.prior) return false;
  return p.Width() >= kSameWidth * PriorWidth(p) && std::abs(p.prior->offset) <= kSameMean;
}

bool OwesToItsPrior(const ResultParameter& p) {
  return p.prior && p.Width() >= kDetermined * PriorWidth(p);
}

std::optional<std::string> HeldByItsPrior(const Answer& answer) {
  const ResultParameter* farthest = nullptr;
  for (const ResultParameter& p : answer.parameters) {
    if (!MayHold(p)) continue;
    if (farthest != nullptr && std::abs(p.prior->offset) <= std::abs(farthest->prior->offset)) {
      continue;
    }
    farthest = &p;
  }
  if (farthest == nullptr) return std::nullopt;
  return farthest->name;
}

std::vector<std::size_t> AskedParameters(const Answer& answer) {
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < answer.parameters.size(); ++i) {
    if (!answer.parameters[i].nuisance) asked.push_back(i);
  }
  return asked;
}

Answer AskedPart(const Answer& answer) {
  const std::vector<std::size_t> asked = AskedParameters(answer);
  Answer part = answer;
  part.parameters = OnlyThose(asked, answer.parameters);
  for (std::vector<double>& set : part.representative) set = OnlyThose(asked, set);
  if (!part.correlation.empty()) part.correlation = OnlyThose(asked, answer.correlation);
  for (std::vector<double>& row : part.correlation) row = OnlyThose(asked, row);
  if (!part.posterior) return part;
  for (ResultBranch& branch : part.posterior->branches) {
    branch.values = OnlyThose(asked, branch.values);
    branch.low = OnlyThose(asked, branch.low);
    branch.high = OnlyThose(asked, branch.high);
  }
  return part;
}

}  // namespace talus::campaign
