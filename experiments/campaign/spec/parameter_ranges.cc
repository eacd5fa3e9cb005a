#include "experiments/campaign/spec/parameter_ranges.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"

namespace talus::campaign {
namespace {

using base::FieldInfo;

// Calls `use(name, range)` for every range that is given.
template <class Use>
struct GivenRanges {
  Use use;
  template <class Range>
  void operator()(std::string_view name, const std::optional<Range>& range, FieldInfo = {}) {
    if (range) use(std::string(name), *range);
  }
  void operator()(std::string_view, const std::optional<EarlierPosterior>&, FieldInfo = {}) {}
};

template <class Use>
void ForEachRange(const ParameterRanges& ranges, Use use) {
  GivenRanges<Use> visitor{use};
  ParameterRanges::Visit(ranges, visitor);
}

struct PropertyDimension {
  const std::string& property;
  base::Dimension dimension = base::Dimension::kNone;
  void operator()(std::string_view name, double, FieldInfo info = {}) {
    if (name == property) dimension = info.dimension;
  }
};

// What is not of a material.
struct BulkQuantity {
  std::string_view name;
  base::Dimension dimension;
  void (*set)(rigs::Case&, double);
  std::optional<double> (*get)(const rigs::Case&);
};

void SetFill(rigs::Case& c, double fill) {
  if (c.rig.kind != rigs::RigKind::kDrum) return;
  c.rig.drum.fill = fill;
  c.SetMassByFill();
}

// In the order in which they are set: the fill of a drum is what its mass follows from.
constexpr BulkQuantity kBulk[] = {
    {"mass", base::Dimension::kMass, [](rigs::Case& c, double value) { c.powder.mass = value; },
     [](const rigs::Case& c) { return std::optional(c.powder.mass); }},
    {"fill", base::Dimension::kNone, SetFill, rigs::FillOf},
    {"particle_size", base::Dimension::kNone,
     [](rigs::Case& c, double value) { c.powder.sizes = engine::Enlarged(c.powder.sizes, value); },
     [](const rigs::Case&) { return std::optional(1.0); }},
};

const BulkQuantity* BulkOf(std::string_view name) {
  const auto* found = std::ranges::find(kBulk, name, &BulkQuantity::name);
  return found == std::end(kBulk) ? nullptr : found;
}

base::Dimension DimensionOf(const std::string& property) {
  if (const BulkQuantity* bulk = BulkOf(property)) return bulk->dimension;
  PropertyDimension visitor{property};
  const engine::Material material;
  engine::Material::Visit(material, visitor);
  return visitor.dimension;
}

struct PropertySetter {
  std::string_view property;
  double value;
  template <class Field>
  void operator()(std::string_view name, Field& field, FieldInfo = {}) const {
    if constexpr (requires { field = value; }) {
      if (name == property) field = value;
    }
  }
};

// The material with the property at `value` must be one that can be simulated. A wall's other
// properties are those of the powder here, which are valid themselves.
void ValidateEnd(const engine::Material& material, const std::string& name, const char* end,
                 double value, base::Problems& problems) {
  if (name == "fill") {
    problems.Require(value > 0 && value <= 0.6, end, value, "must be positive and at most 0.6");
    return;
  }
  if (IsOfBulk(name)) {
    problems.RequirePositive(end, value);
    return;
  }
  const std::string property = PlaceOf(name).property;
  engine::Material at_end = material;
  engine::Material::Visit(at_end, PropertySetter{property, value});
  base::Problems of_material;
  at_end.Validate(of_material);
  for (const base::Problem& problem : of_material.list()) {
    if (problem.path != property) continue;
    problems.Add({.path = end, .message = problem.message, .value = problem.value});
  }
}

}  // namespace

ParameterRanges UsualRanges(engine::Adhesion adhesion) {
  ParameterRanges ranges;
  ranges.sliding_friction.emplace();
  ranges.sliding_friction->min = 0.001;
  ranges.sliding_friction->max = 0.7;
  ranges.rolling_friction = ranges.sliding_friction;
  if (adhesion != engine::Adhesion::kNone) {
    ranges.surface_energy.emplace();
    ranges.surface_energy->min = 1e-6;
    ranges.surface_energy->max = 40e-5;
    ranges.surface_energy->scale = optimizer::Scale::kLog;
  }
  return ranges;
}

optimizer::ParameterSpace MakeSpace(const ParameterRanges& ranges) {
  optimizer::ParameterSpace space;
  ForEachRange(ranges, [&](const std::string& name, const auto& range) {
    space.parameters.push_back({.name = name,
                                .low = range.min,
                                .high = range.max,
                                .scale = range.scale,
                                .guess = range.guess,
                                .fixed = range.fixed,
                                .is_nuisance = range.nuisance,
                                .added_at = range.added_at});
    if (!range.prior) return;
    space.parameters.back().prior = range.prior->Normal();
    if (!range.prior->from) return;
    space.earlier.push_back({.names = {name}, .values = {}});
    for (const double draw : range.prior->draws) space.earlier.back().values.push_back({draw});
  });
  if (ranges.prior) {
    space.earlier.push_back({.names = ranges.prior->names, .values = ranges.prior->draws});
  }
  return space;
}

ParameterPlace PlaceOf(const std::string& parameter) {
  ParameterPlace place{.property = parameter};
  const auto strip = [&](std::string_view prefix) {
    const bool has = place.property.starts_with(prefix);
    if (has) place.property.erase(0, prefix.size());
    return has;
  };
  if (strip("plate_")) place.body = rigs::kFloor;
  if (strip("tube_")) place.body = rigs::kWalls;
  place.is_pair = strip("pair_");
  return place;
}

std::string UnitOf(const std::string& parameter) {
  return std::string(base::SiUnit(DimensionOf(PlaceOf(parameter).property)));
}

double ParseProperty(const std::string& parameter, const std::string& text) {
  return base::ParseQuantity(text, DimensionOf(PlaceOf(parameter).property));
}

std::optional<double> HeldAt(const optimizer::ParameterSpace& space, const rigs::Case& rig_case,
                             const std::string& parameter) {
  const auto found = std::ranges::find(space.parameters, parameter, &optimizer::Parameter::name);
  if (found != space.parameters.end() && found->fixed) return found->fixed;
  return ParameterOf(rig_case, parameter);
}

bool IsFactor(const std::string& parameter) { return parameter == "particle_size"; }

std::optional<MissingLaw> LawMissingFor(const std::string& parameter,
                                        const engine::ContactModels& models) {
  using engine::Adhesion, engine::Rolling;
  const std::string property = PlaceOf(parameter).property;
  if (property == "surface_energy" && models.adhesion == Adhesion::kNone) {
    return MissingLaw{"has no effect without adhesion", "set models.adhesion"};
  }
  if (property == "hamaker_constant" && models.adhesion != Adhesion::kDmt) {
    return MissingLaw{"has no effect but with models.adhesion \"dmt\"", "set that"};
  }
  if (property == "rolling_friction" && models.rolling == Rolling::kNone) {
    return MissingLaw{"has no effect without a rolling model", "set models.rolling"};
  }
  if (property == "rolling_damping" && models.rolling != Rolling::kEpsd) {
    return MissingLaw{"has no effect but with models.rolling \"epsd\"", "set that"};
  }
  return std::nullopt;
}

bool CanBeMeasuredDirectly(const std::string& parameter) {
  const ParameterPlace place = PlaceOf(parameter);
  return place.body != rigs::kPowder && place.property == "sliding_friction";
}

bool IsOfBulk(const std::string& parameter) { return BulkOf(parameter) != nullptr; }

std::map<std::string, std::string> PriorTexts(const ParameterRanges& ranges) {
  std::map<std::string, std::string> texts;
  ForEachRange(ranges, [&](const std::string& name, const auto& range) {
    if (range.prior) texts.emplace(name, range.prior->Text());
  });
  if (!ranges.prior) return texts;
  for (const std::string& name : ranges.prior->names) {
    texts.emplace(name, "the posterior of " + ranges.prior->from.string());
  }
  return texts;
}

void SetParameter(rigs::Case& rig_case, const std::string& parameter, double value) {
  if (const BulkQuantity* bulk = BulkOf(parameter)) return bulk->set(rig_case, value);
  const auto [body, is_pair, property] = PlaceOf(parameter);
  const PropertySetter set{property, value};
  if (is_pair) {
    engine::PairProperties::Visit(rigs::PairWith(rig_case.pairs, body), set);
  } else if (body == rigs::kPowder) {
    engine::Material::Visit(rig_case.powder.material, set);
  } else {
    auto& wall = body == rigs::kFloor ? rig_case.materials.floor : rig_case.materials.walls;
    if (!wall) wall.emplace();
    rigs::WallMaterial::Visit(*wall, set);
  }
}

std::optional<double> ParameterOf(const rigs::Case& rig_case, const std::string& parameter) {
  if (const BulkQuantity* bulk = BulkOf(parameter)) return bulk->get(rig_case);
  const ParameterPlace place = PlaceOf(parameter);
  std::optional<double> value;
  const auto take = [&](std::string_view name, std::optional<double> known, FieldInfo = {}) {
    if (name == place.property) value = known;
  };
  engine::Material material = rig_case.powder.material;
  const auto& wall =
      place.body == rigs::kFloor ? rig_case.materials.floor : rig_case.materials.walls;
  if (place.body != rigs::kPowder && wall) material = wall->Over(material);
  if (place.is_pair) {
    const engine::PairProperties pair = rigs::StatedWith(rig_case.pairs, place.body);
    engine::PairProperties::Visit(pair, take);
  } else {
    engine::Material::Visit(material, take);
  }
  return value;
}

void ValidateRanges(const ParameterRanges& ranges, const engine::Material& material,
                    base::Problems& problems) {
  int num_free = 0;
  int num_asked = 0;
  ForEachRange(ranges, [&](const std::string& name, const auto& range) {
    problems.Within(name, [&] {
      if (range.fixed) {
        ValidateEnd(material, name, "fixed", *range.fixed, problems);
        problems.Require(!range.prior, "prior",
                         "is of a parameter that is fixed: take one of the two away");
        problems.Require(!range.nuisance, "nuisance",
                         "is searched, and this is fixed: take one of the two away");
        return;
      }
      ++num_free;
      num_asked += range.nuisance ? 0 : 1;
      if (std::isnan(range.min) || std::isnan(range.max)) {
        problems.Add("", "needs min and max, or fixed");
        return;
      }
      problems.Require(range.min < range.max, "min", range.min, "must be below max");
      ValidateEnd(material, name, "min", range.min, problems);
      ValidateEnd(material, name, "max", range.max, problems);
      problems.Require(range.scale == optimizer::Scale::kLinear || range.min > 0, "min", range.min,
                       "must be positive on a log scale");
      if (range.guess) {
        problems.Require(*range.guess >= range.min && *range.guess <= range.max, "guess",
                         *range.guess, "must lie between min and max");
      }
      if (!range.prior) return;
      problems.Within("prior", [&] { range.prior->ValidateIn(range.min, range.max, problems); });
      problems.Require(!ranges.prior, "prior",
                       "stands beside the prior of all parameters together: keep one of the two");
    });
  });
  problems.Require(num_free >= 1 && num_free <= optimizer::kMaxParameters, "",
                   std::to_string(num_free) + " are searched, must be 1 to " +
                       std::to_string(optimizer::kMaxParameters));
  problems.Require(num_free == 0 || num_asked > 0, "",
                   "are all nuisances: nothing is asked for; take \"nuisance\" away from one");
}

}  // namespace talus::campaign
