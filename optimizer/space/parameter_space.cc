#include "optimizer/space/parameter_space.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "base/nearest.h"
#include "base/random.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "optimizer/space/candidate_table.h"
#include "optimizer/space/point_rows.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

double RoundedTo(double value, int digits) {
  const std::string text = base::ShortNumber(value, digits);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// The way to the unit cube and back costs a table's value its last bits, on a log scale its last
// digits: it is the shortest number that goes to the same place.
double AsWritten(const Parameter& parameter, double unit) {
  constexpr int kFewest = 12, kMost = 17;  // digits
  const double value = parameter.ToNative(unit);
  for (int digits = kFewest; digits < kMost; ++digits) {
    const double shorter = RoundedTo(value, digits);
    if (parameter.ToUnit(shorter) == unit) return shorter;
  }
  return RoundedTo(value, 15);
}

int IndexOf(const std::vector<Parameter>& parameters, const std::string& name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& p) { return p.name == name; });
  return found == parameters.end() ? -1 : static_cast<int>(found - parameters.begin());
}

void CheckConstraint(const LinearConstraint& constraint, const std::vector<Parameter>& parameters,
                     base::Problems& problems) {
  problems.Require(!constraint.terms.empty(), "terms", "needs at least one term");
  problems.Require(std::isfinite(constraint.at_most), "at_most", constraint.at_most,
                   "must be finite");
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  for (std::size_t t = 0; t < constraint.terms.size(); ++t) {
    const std::string path = "terms[" + std::to_string(t) + "]";
    const LinearConstraint::Term& term = constraint.terms[t];
    problems.Require(std::isfinite(term.factor), path + ".factor", term.factor, "must be finite");
    if (IndexOf(parameters, term.parameter) >= 0) continue;
    problems.Add(path + ".parameter", "\"" + term.parameter + "\" is no parameter" +
                                          base::DidYouMean(term.parameter, names));
  }
}

constexpr double kRounding = 1e-9;  // 0.1 + 0.2 is at most 0.3

// Whether the values of the constraint's parameters break it, by more than this share of its
// largest term. Not where `value_of` a parameter's index is not known.
template <class ValueOf>
bool Breaks(const LinearConstraint& constraint, const std::vector<Parameter>& parameters,
            double slack, ValueOf&& value_of) {
  double sum = 0, largest = std::abs(constraint.at_most);
  for (const LinearConstraint::Term& term : constraint.terms) {
    const std::optional<double> value =
        value_of(static_cast<std::size_t>(IndexOf(parameters, term.parameter)));
    if (!value) return false;
    sum += term.factor * *value;
    largest = std::max(largest, std::abs(term.factor * *value));
  }
  return sum > constraint.at_most + slack * largest;
}

std::vector<LinearConstraint>::const_iterator FirstBroken(
    const std::vector<LinearConstraint>& constraints, const std::vector<Parameter>& parameters,
    std::span<const double> native, double slack) {
  return std::ranges::find_if(constraints, [&](const LinearConstraint& c) {
    return Breaks(c, parameters, slack, [&](std::size_t i) { return std::optional(native[i]); });
  });
}

std::string ConstraintText(const LinearConstraint& constraint) {
  std::string text;
  for (const LinearConstraint::Term& term : constraint.terms) {
    const bool minus = term.factor < 0;
    text += text.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
    const double factor = std::abs(term.factor);
    text += (factor == 1 ? "" : base::ShortNumber(factor) + " ") + term.parameter;
  }
  return text + " <= " + base::ShortNumber(constraint.at_most);
}

bool GuessesBreak(const LinearConstraint& constraint, const std::vector<Parameter>& parameters) {
  return Breaks(constraint, parameters, kRounding, [&](std::size_t i) {
    return parameters[i].fixed ? parameters[i].fixed : parameters[i].guess;
  });
}

// What is not guessed stands in the middle or, where constraints forbid that, as near to it as a
// few draws find. Nothing when nothing is guessed.
std::vector<Eigen::VectorXd> Guesses(const ParameterSpace& space) {
  constexpr std::uint64_t kDraws = 1000;
  const std::vector<int> free = space.Free();
  const auto guess_of = [&](std::size_t i) {
    return space.parameters[static_cast<std::size_t>(free[i])].guess;
  };
  Eigen::VectorXd point = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(free.size()), 0.5);
  bool any = false;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!guess_of(i)) continue;
    const Parameter& parameter = space.parameters[static_cast<std::size_t>(free[i])];
    point[static_cast<Eigen::Index>(i)] = parameter.ToUnit(*parameter.guess);
    any = true;
  }
  if (!any) return {};
  if (space.Satisfies(space.ToNative(point))) return {point};
  std::vector<Eigen::VectorXd> nearest;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    base::Random random(0, base::Stream("guess between constraints"), draw);
    Eigen::VectorXd other = point;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const double uniform = random.Uniform();
      if (!guess_of(i)) other[static_cast<Eigen::Index>(i)] = uniform;
    }
    if (!nearest.empty() && (other - point).norm() >= (nearest.front() - point).norm()) continue;
    if (space.Satisfies(space.ToNative(other))) nearest = {other};
  }
  return nearest;
}

bool HasRoom(const ParameterSpace& space) {
  constexpr int kPoints = 100000;
  Eigen::VectorXd point(static_cast<Eigen::Index>(space.Free().size()));
  for (int i = 0; i < kPoints; ++i) {
    base::Random random(0, base::Stream("room between constraints"), static_cast<std::uint64_t>(i));
    for (double& coordinate : point) coordinate = random.Uniform();
    if (space.Satisfies(space.ToNative(point))) return true;
  }
  return false;
}

// Every combination of levels, the last parameter fastest.
Eigen::MatrixXd Combinations(const std::vector<std::vector<double>>& levels) {
  Eigen::Index size = 1;
  for (const auto& one : levels) size *= static_cast<Eigen::Index>(one.size());
  Eigen::MatrixXd rows(size, static_cast<Eigen::Index>(levels.size()));
  Eigen::Index period = size;
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const auto& one = levels[static_cast<std::size_t>(k)];
    period /= static_cast<Eigen::Index>(one.size());
    for (Eigen::Index i = 0; i < size; ++i) {
      rows(i, k) = one[static_cast<std::size_t>(i / period) % one.size()];
    }
  }
  return rows;
}

}  // namespace

void Parameter::Validate(base::Problems& problems) const {
  base::RequireName(problems, "name", name);
  if (fixed) {
    problems.Require(std::isfinite(*fixed), "fixed", *fixed, "must be finite");
    problems.Require(std::isnan(low), "low", low, "has no meaning beside \"fixed\"");
    problems.Require(std::isnan(high), "high", high, "has no meaning beside \"fixed\"");
    problems.Require(!guess, "guess", "has no meaning beside \"fixed\"");
    problems.Require(levels.empty(), "levels", "have no meaning beside \"fixed\"");
    return;
  }
  if (!levels.empty()) return ValidateLevels(problems);
  problems.Require(std::isfinite(low), "low", low, "must be given and finite (or give \"fixed\")");
  problems.Require(std::isfinite(high), "high", high,
                   "must be given and finite (or give \"fixed\")");
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  problems.Require(high > low, "high", high, "must be above low");
  constexpr double kLargest = 1e100, kSmallest = 1e-100, kNarrowest = 1e-12;
  const double largest = std::max(std::abs(low), std::abs(high));
  problems.Require(largest <= kLargest, "high", high, "must not be beyond 1e100, nor low");
  problems.Require(!(high > low) || high - low >= std::max(kSmallest, kNarrowest * largest), "high",
                   high, "is too near to low to be told from it");
  if (scale == Scale::kLog) {
    problems.Require(low > 0, "low", low, "must be positive on a log scale");
  }
  if (guess) {
    problems.Require(*guess >= low && *guess <= high, "guess", *guess, "must lie in [low, high]");
  }
}

void Parameter::ValidateLevels(base::Problems& problems) const {
  problems.Require(std::isnan(low) && std::isnan(high), "levels",
                   "stand in place of low and high: take these away");
  problems.Require(levels.size() >= 2, "levels",
                   "must be two or more; give one value as \"fixed\"");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string path = "levels[" + std::to_string(i) + "]";
    problems.Require(std::isfinite(levels[i]), path, levels[i], "must be finite");
    problems.Require(i == 0 || levels[i] > levels[i - 1], path, levels[i],
                     "must be above the one before");
    problems.Require(scale != Scale::kLog || levels[i] > 0, path, levels[i],
                     "must be positive on a log scale");
  }
  if (!guess) return;
  problems.Require(std::find(levels.begin(), levels.end(), *guess) != levels.end(), "guess", *guess,
                   "must be one of the levels");
}

double Parameter::ToNative(double unit) const {
  if (fixed) return *fixed;
  if (!levels.empty()) {  // exactly, not but for rounding; the nearest as Domain::Snap has it
    return *std::min_element(levels.begin(), levels.end(), [&](double a, double b) {
      return std::abs(ToUnit(a) - unit) < std::abs(ToUnit(b) - unit);
    });
  }
  // Rounding must not leave the range at its ends.
  return std::clamp(range().ToNative(unit), lowest(), highest());
}

void ParameterSpace::Validate(base::Problems& problems) const {
  const auto num_free = Free().size();
  problems.Require(num_free >= 1 && num_free <= kMaxParameters, "parameters",
                   std::to_string(num_free) + " are free, must be 1 to 6");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool first = IndexOf(parameters, parameters[i].name) == static_cast<int>(i);
    problems.Require(first, "parameters[" + std::to_string(i) + "].name",
                     "\"" + parameters[i].name + "\" is there twice");
  }
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    problems.Within("constraints[" + std::to_string(c) + "]",
                    [&] { CheckConstraint(constraints[c], parameters, problems); });
  }
  const bool sound = problems.empty() && num_free >= 1 && num_free <= kMaxParameters;
  problems.Require(!sound || constraints.empty() || HasRoom(*this), "constraints",
                   "leave no room: none of 100000 points of the ranges meets them all");
  if (!sound || !problems.empty()) return;
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    problems.Require(!GuessesBreak(constraints[c], parameters),
                     "constraints[" + std::to_string(c) + "]", "is not met by the guesses");
  }
}

bool ParameterSpace::IsContinuous() const {
  return candidates.empty() &&
         std::ranges::all_of(parameters, [](const Parameter& p) { return p.levels.empty(); });
}

std::vector<int> ParameterSpace::Free() const {
  std::vector<int> free;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].fixed) free.push_back(static_cast<int>(i));
  }
  return free;
}

std::vector<double> ParameterSpace::ToNative(const Eigen::VectorXd& unit) const {
  std::vector<double> native;
  Eigen::Index i = 0;
  for (const Parameter& parameter : parameters) {
    if (parameter.fixed) {
      native.push_back(*parameter.fixed);
      continue;
    }
    const double at = unit[i++];
    native.push_back(candidates.empty() ? parameter.ToNative(at) : AsWritten(parameter, at));
  }
  return native;
}

Eigen::VectorXd ParameterSpace::ToUnit(std::span<const double> native) const {
  const std::vector<int> free = Free();
  Eigen::VectorXd unit(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto p = static_cast<std::size_t>(free[i]);
    unit[static_cast<Eigen::Index>(i)] = parameters[p].ToUnit(native[p]);
  }
  return unit;
}

bool ParameterSpace::Satisfies(std::span<const double> native) const {
  return FirstBroken(constraints, parameters, native, kRounding) == constraints.end();
}

std::optional<std::string> ParameterSpace::BrokenBy(std::span<const double> native,
                                                    double slack) const {
  const auto broken = FirstBroken(constraints, parameters, native, slack);
  if (broken == constraints.end()) return std::nullopt;
  return ConstraintText(*broken);
}

Domain ParameterSpace::MakeDomain() const {
  Domain domain;
  domain.num_parameters = static_cast<int>(Free().size());
  domain.guesses = Guesses(*this);
  if (!constraints.empty()) {
    domain.feasible = [space = *this](const Eigen::VectorXd& unit) {
      return space.Satisfies(space.ToNative(unit));
    };
  }
  AddBeliefs(domain);
  AddLevels(domain);
  if (!candidates.empty()) AddTable(domain);
  return domain;
}

Eigen::MatrixXd ParameterSpace::Inside(const EarlierDraws& draws) const {
  std::vector<const Parameter*> columns;
  for (const std::string& name : draws.names) {
    columns.push_back(&parameters[static_cast<std::size_t>(IndexOf(parameters, name))]);
  }
  Eigen::MatrixXd inside(static_cast<Eigen::Index>(draws.values.size()),
                         static_cast<Eigen::Index>(columns.size()));
  Eigen::Index count = 0;
  for (const std::vector<double>& draw : draws.values) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      inside(count, static_cast<Eigen::Index>(k)) = columns[k]->ToUnit(draw[k]);
    }
    const auto row = inside.row(count).array();
    if ((row >= 0).all() && (row <= 1).all()) ++count;
  }
  return inside.topRows(count);
}

std::vector<Eigen::Index> ParameterSpace::Nuisances() const {
  std::vector<Eigen::Index> nuisances;
  Eigen::Index coordinate = 0;
  for (const int i : Free()) {
    if (parameters[static_cast<std::size_t>(i)].is_nuisance) nuisances.push_back(coordinate);
    ++coordinate;
  }
  return nuisances;
}

void ParameterSpace::AddBeliefs(Domain& domain) const {
  domain.nuisances = Nuisances();
  const std::vector<int> free = Free();
  const auto coordinate_of = [&](const std::string& name) {
    return std::find(free.begin(), free.end(), IndexOf(parameters, name)) - free.begin();
  };
  for (const int i : free) {
    const Parameter& p = parameters[static_cast<std::size_t>(i)];
    const Eigen::Index coordinate = coordinate_of(p.name);
    if (p.prior) domain.prior.Add(coordinate, p.range(), *p.prior);
    if (p.added_at) domain.added.push_back({.coordinate = coordinate, .at = p.ToUnit(*p.added_at)});
  }
  for (const EarlierDraws& draws : earlier) {
    std::vector<Eigen::Index> coordinates;
    for (const std::string& name : draws.names) coordinates.push_back(coordinate_of(name));
    domain.prior.Add(std::move(coordinates), Inside(draws));
  }
}

// Levels of every parameter are a list of candidates, where that is not too long.
void ParameterSpace::AddLevels(Domain& domain) const {
  std::vector<std::vector<double>> levels;
  double num_combinations = 1;
  for (const int i : Free()) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(i)];
    levels.emplace_back();
    for (const double level : parameter.levels) levels.back().push_back(parameter.ToUnit(level));
    num_combinations *= static_cast<double>(levels.back().size());
  }
  if (std::all_of(levels.begin(), levels.end(), [](const auto& one) { return one.empty(); })) {
    return;
  }
  if (num_combinations >= 1 && num_combinations <= kMaxCandidates) {
    const Eigen::MatrixXd all = Combinations(levels);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      if (domain.Contains(all.row(i))) kept.push_back(i);
    }
    if (kept.empty()) throw base::ConfigError("no combination of levels satisfies the constraints");
    domain.candidates = all(kept, Eigen::all);
  } else {
    domain.levels = std::move(levels);
  }
}

bool ParameterSpace::IsAtLevels(const Eigen::VectorXd& unit) const {
  Eigen::Index k = 0;
  for (const int i : Free()) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(i)];
    const double at = unit[k++];
    if (parameter.levels.empty()) continue;
    if (std::ranges::none_of(parameter.levels, [&](double level) {
          return std::abs(parameter.ToUnit(level) - at) <= surrogate::kSamePoint;
        })) {
      return false;
    }
  }
  return true;
}

// Rows outside the ranges are no candidates, nor are those between the levels of a parameter.
void ParameterSpace::AddTable(Domain& domain) const {
  std::vector<std::string> names;
  for (const int i : Free()) names.push_back(parameters[static_cast<std::size_t>(i)].name);
  std::vector<Eigen::VectorXd> kept;
  for (const std::vector<double>& row : ReadCandidateTable(candidates, names)) {
    Eigen::VectorXd unit(static_cast<Eigen::Index>(row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) {
      unit[static_cast<Eigen::Index>(k)] =
          parameters[static_cast<std::size_t>(Free()[k])].ToUnit(row[k]);
    }
    if (domain.Contains(unit) && IsAtLevels(unit) && !IsAmong(unit, kept)) kept.push_back(unit);
  }
  if (kept.empty()) {
    throw base::ConfigError(
        candidates.string() +
        ": has no candidate within the ranges and constraints, at levels where there are some");
  }
  domain.candidates.resize(static_cast<Eigen::Index>(kept.size()), domain.num_parameters);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    domain.candidates.row(static_cast<Eigen::Index>(i)) = kept[i];
  }
  domain.levels.clear();
}

}  // namespace talus::optimizer
