#include "optimizer/space/parameter_space.h"

#include <algorithm>
#include <cmath>

#include "base/nearest.h"
#include "base/random.h"

namespace talus::optimizer {
namespace {

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
    const std::string near = base::Nearest(term.parameter, names);
    problems.Add(path + ".parameter",
                 "\"" + term.parameter + "\" is no parameter" +
                     (near.empty() ? std::string() : "; did you mean \"" + near + "\"?"));
  }
}

// The centre of the cube where no guess is given, nothing when there is none at all.
std::vector<Eigen::VectorXd> Guesses(const ParameterSpace& space) {
  const std::vector<int> free = space.Free();
  Eigen::VectorXd point = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(free.size()), 0.5);
  bool any = false;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Parameter& parameter = space.parameters[static_cast<std::size_t>(free[i])];
    if (!parameter.guess) continue;
    point[static_cast<Eigen::Index>(i)] = parameter.ToUnit(*parameter.guess);
    any = true;
  }
  if (!any || !space.Satisfies(space.ToNative(point))) return {};
  return {point};
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

}  // namespace

void Parameter::Validate(base::Problems& problems) const {
  problems.Require(!name.empty(), "name", "must not be empty");
  if (fixed) {
    problems.Require(std::isfinite(*fixed), "fixed", *fixed, "must be finite");
    problems.Require(!guess, "guess", "has no meaning beside \"fixed\"");
    return;
  }
  problems.Require(std::isfinite(low), "low", low, "must be given and finite (or give \"fixed\")");
  problems.Require(std::isfinite(high), "high", high,
                   "must be given and finite (or give \"fixed\")");
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  problems.Require(high > low, "high", high, "must be above low");
  if (scale == Scale::kLog) {
    problems.Require(low > 0, "low", low, "must be positive on a log scale");
  }
  if (guess) {
    problems.Require(*guess >= low && *guess <= high, "guess", *guess, "must lie in [low, high]");
  }
}

double Parameter::ToNative(double unit) const {
  if (fixed) return *fixed;
  const double value =
      scale == Scale::kLog ? low * std::pow(high / low, unit) : low + unit * (high - low);
  return std::clamp(value, low, high);  // rounding must not leave the range at its ends
}

double Parameter::ToUnit(double native) const {
  return scale == Scale::kLog ? std::log(native / low) / std::log(high / low)
                              : (native - low) / (high - low);
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
    native.push_back(parameter.fixed ? *parameter.fixed : parameter.ToNative(unit[i++]));
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
  return std::all_of(constraints.begin(), constraints.end(), [&](const LinearConstraint& c) {
    double sum = 0;
    for (const LinearConstraint::Term& term : c.terms) {
      sum += term.factor * native[static_cast<std::size_t>(IndexOf(parameters, term.parameter))];
    }
    return sum <= c.at_most;
  });
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
  return domain;
}

}  // namespace talus::optimizer
