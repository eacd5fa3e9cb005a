// What an answer says of the parameters that are searched but not asked for, and the answer without
// them: its verdict, its ranges and its region are of those asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/answer/answer.h"

namespace talus::campaign {

// A nuisance matters where a range would be narrower by this share if it were known.
inline constexpr double kMatters = 0.2;

bool Matters(const ResultParameter& nuisance);

// "restitution: not determined, 0.62 … 0.93, does not matter", by the name that it is given here.
// Determined is what has less than half of its prior's range left.
std::string NuisanceText(const ResultParameter& nuisance, const std::string& name);

// Indices of the parameters that are asked for, ascending.
std::vector<std::size_t> AskedParameters(const Answer& answer);

// The same answer of these parameters alone, wherever it has one entry a parameter.
Answer AskedPart(const Answer& answer);

// Those of a list with one entry a parameter; none of an empty one.
template <class T>
std::vector<T> OnlyThose(const std::vector<std::size_t>& indices, const std::vector<T>& all) {
  std::vector<T> some;
  if (all.empty()) return some;
  for (const std::size_t i : indices) some.push_back(all.at(i));
  return some;
}

// Whether the posterior is about the prior: what is stated of it was known beforehand.
bool IsKnownByPrior(const ResultParameter& parameter);

// The parameter whose prior may keep the answer from where a set would fit; of several the one that
// the posterior has moved farthest, in standard deviations of its prior.
std::optional<std::string> HeldByItsPrior(const Answer& answer);

// Whether its range is no narrower than half of the prior's: the measurements alone did not make
// it.
bool OwesToItsPrior(const ResultParameter& parameter);

}  // namespace talus::campaign
