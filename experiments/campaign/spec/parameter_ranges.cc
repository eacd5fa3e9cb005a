#include "experiments/campaign/spec/parameter_ranges.h"

#include <cmath>
#include <string_view>

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

// The one parameter that is not of a material: how full a drum is.
constexpr std::string_view kFill = "fill";

base::Dimension DimensionOf(const std::string& property) {
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
  if (name == kFill) {
    problems.Require(value > 0 && value <= 0.6, end, value, "must be positive and at most 0.6");
    return;
  }
  const std::string property = PlaceOf(name).property;
  engine::Material at_end = material;
  engine::Material::Visit(at_end, PropertySetter{property, value});
  base::Problems of_material;
  at_end.Validate(of_material);
  for (const base::Problem& problem : of_material.list()) {
    if (problem.path == property) problems.Add(end, problem.message);
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
                                .fixed = range.fixed});
  });
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

void SetParameter(rigs::Case& rig_case, const std::string& parameter, double value) {
  if (parameter == kFill) {
    rig_case.rig.drum.fill = value;
    return rig_case.SetMassByFill();
  }
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

void ValidateRanges(const ParameterRanges& ranges, const engine::Material& material,
                    base::Problems& problems) {
  int num_free = 0;
  ForEachRange(ranges, [&](const std::string& name, const auto& range) {
    problems.Within(name, [&] {
      if (range.fixed) {
        ValidateEnd(material, name, "fixed", *range.fixed, problems);
        return;
      }
      ++num_free;
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
    });
  });
  problems.Require(num_free >= 1 && num_free <= optimizer::kMaxParameters, "", num_free,
                   "parameters are searched, must be 1 to 6");
}

}  // namespace talus::campaign
