// The parameters to be found: names, ranges and scales, what is known of them beforehand, and the
// map between them and the unit cube (scale.h).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "base/problems.h"
#include "optimizer/space/domain.h"
#include "optimizer/space/prior.h"
#include "optimizer/space/scale.h"

namespace talus::optimizer {

struct Parameter {
  std::string name;
  double low = base::kNotKnown;
  double high = base::kNotKnown;
  Scale scale = Scale::kLinear;
  std::optional<double> guess = {};  // in [low, high]: tried first
  std::optional<double> fixed = {};  // held at this value and not searched; needs no range
  std::vector<double> levels = {};   // the only values, ascending; in place of low and high
  // What only a posterior uses.
  std::optional<NormalPrior> prior = {};  // none: uniform on the scale
  bool is_nuisance = false;               // searched, but not asked for
  // That evaluations were made at before the parameter was searched; Domain::added.
  std::optional<double> added_at = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "how the simulation calls it"});
    visit("low", self.low, {.doc = "smallest value; needed unless fixed"});
    visit("high", self.high, {.doc = "largest value, > low; needed unless fixed"});
    visit("scale", self.scale, {.doc = "log spreads trials evenly over decades; needs low > 0"});
    visit("guess", self.guess, {.doc = "a value thought to be good, tried first"});
    visit("fixed", self.fixed, {.doc = "holds the parameter at this value"});
    visit("levels", self.levels,
          {.doc = "the only values it may take, ascending; in place of low and high"});
  }
  void Validate(base::Problems& problems) const;

  double lowest() const { return levels.empty() ? low : levels.front(); }
  double highest() const { return levels.empty() ? high : levels.back(); }
  ScaledRange range() const { return {.low = lowest(), .high = highest(), .scale = scale}; }
  double ToNative(double unit) const;
  double ToUnit(double native) const { return range().ToUnit(native); }

 private:
  void ValidateLevels(base::Problems& problems) const;
};

// Σ factor value ≤ at_most, in native values.
struct LinearConstraint {
  struct Term {
    std::string parameter;
    double factor = 1;

    template <class Self, class Visitor>
    static void Visit(Self& self, Visitor&& visit) {
      visit("parameter", self.parameter, {.required = true, .doc = "name of a parameter"});
      visit("factor", self.factor);
    }
  };
  std::vector<Term> terms;
  double at_most = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("terms", self.terms, {.required = true, .doc = "the sum of factor times value …"});
    visit("at_most", self.at_most, {.required = true, .doc = "… is at most this"});
  }
};

// Equally likely draws of an earlier posterior, native values.
struct EarlierDraws {
  std::vector<std::string> names;           // of parameters that are searched
  std::vector<std::vector<double>> values;  // one draw a row, in their order
};

struct ParameterSpace {
  std::vector<Parameter> parameters;
  std::vector<LinearConstraint> constraints = {};
  std::filesystem::path candidates = {};   // CSV table of the only points; none when empty
  std::vector<EarlierDraws> earlier = {};  // priors of several parameters together

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("parameters", self.parameters, {.required = true, .doc = "1 to 6 free parameters"});
    visit("constraints", self.constraints, {.doc = "linear inequalities between parameters"});
    visit("candidates", self.candidates,
          {.doc = "a CSV table of the only points there are; its head names the parameters"});
  }
  void Validate(base::Problems& problems) const;

  // Indices into `parameters` of those that are searched; the i-th is coordinate i of the cube.
  std::vector<int> Free() const;
  // Coordinates of those that are searched and not asked for, ascending.
  std::vector<Eigen::Index> Nuisances() const;

  // Whether any point may be evaluated: there are neither levels nor a table.
  bool IsContinuous() const;

  // One value a parameter, the fixed ones among them, in the order of `parameters`.
  std::vector<double> ToNative(const Eigen::VectorXd& unit) const;
  Eigen::VectorXd ToUnit(std::span<const double> native) const;

  bool Satisfies(std::span<const double> native) const;
  // The first constraint that values break by more than this share of its largest term,
  // "rolling_friction - 0.5 sliding_friction <= 0"; nothing where they break none, or a value is
  // NaN: not known.
  std::optional<std::string> BrokenBy(std::span<const double> native, double slack) const;

  // Draws in the unit cube, one a row, those alone that lie inside it.
  Eigen::MatrixXd Inside(const EarlierDraws& draws) const;

  // The domain of a strategy. Holds a copy of this space, so it may outlive it. Reads the table of
  // candidates; throws base::ConfigError when that cannot be used.
  Domain MakeDomain() const;

 private:
  void AddBeliefs(Domain& domain) const;
  void AddLevels(Domain& domain) const;
  void AddTable(Domain& domain) const;
  bool IsAtLevels(const Eigen::VectorXd& unit) const;  // of parameters that have some
};

}  // namespace talus::optimizer
