#include "experiments/analysis/sensitivity/moves.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/nearest.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "engine/laws/material_pair.h"
#include "experiments/campaign/spec/parameter_names.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/load_case.h"
#include "experiments/trials/engines/case_values.h"

namespace talus::analysis {
namespace {

using campaign::ParameterPlace;

// A parameter that makes the mass of a drum's powder; it is moved as the mass.
constexpr const char* kFill = "fill";

// What campaign::SetParameter sets, as it stands; of a pair that does not state it, as it follows
// from the two materials. 0 where the case says nothing of it.
double ValueOf(const rigs::Case& c, const std::string& parameter) {
  if (const auto stated = campaign::ParameterOf(c, parameter)) return *stated;
  const ParameterPlace place = campaign::PlaceOf(parameter);
  if (!place.is_pair) return 0;
  const engine::Material& powder = c.powder.material;
  const auto& wall = place.body == rigs::kFloor ? c.materials.floor : c.materials.walls;
  const engine::Material own = wall.value_or(rigs::WallMaterial()).Over(powder);
  const engine::PairProperties pair = engine::Joined(powder, own, {});
  double value = 0;
  engine::PairProperties::Visit(
      pair, [&](std::string_view key, const std::optional<double>& field, base::FieldInfo = {}) {
        if (key == place.property) value = field.value_or(0);
      });
  return value;
}

// Whether it, or a wall's property whose place its pair would take, is searched.
bool IsSearched(const campaign::JointView& view, const std::string& parameter) {
  const ParameterPlace place = campaign::PlaceOf(parameter);
  return std::ranges::any_of(view.space.Free(), [&](int i) {
    const std::string& name = view.space.parameters[static_cast<std::size_t>(i)].name;
    const ParameterPlace searched = campaign::PlaceOf(name);
    return name == parameter ||
           (place.is_pair && searched.body == place.body && searched.property == place.property);
  });
}

std::string ProblemsOf(const std::string& what, const rigs::Case& rig_case) {
  base::Problems problems(what, {});
  base::TreeValidator(problems).Check(rig_case);
  if (problems.empty()) rigs::ValidateCase(rig_case, problems);
  return problems.Text();
}

// By which another engine's templates may take it: the parameter's own or what it changes.
void AddPlaceholders(const campaign::JointView& view, const rigs::Case& c, Move& move) {
  move.placeholders = {move.name};
  if (view.spec.engine.kind != campaign::EngineKind::kCommand) return;
  rigs::Case moved = c;
  move.apply(moved);
  if (!ProblemsOf(move.name, moved).empty()) return;
  move.placeholders = trials::PlaceholdersOf(move.name, c, moved);
}

using Change = double (*)(double);

// A parameter by what the change makes of it, in each experiment of what it is there.
void AddParameter(const campaign::JointView& view, const rigs::Case& c, const std::string& name,
                  Change change, std::vector<Move>& moves) {
  const double from = ValueOf(c, name);
  if (IsSearched(view, name) || from == 0) return;
  const std::string unit = campaign::UnitOf(name);
  moves.push_back({.name = name,
                   .from = base::WithUnit(from, unit),
                   .to = base::WithUnit(change(from), unit),
                   .apply = [name, change](rigs::Case& moved) {
                     campaign::SetParameter(moved, name, change(ValueOf(moved, name)));
                   }});
  AddPlaceholders(view, c, moves.back());
}

// A tenth either way of grains that are all alike; else every diameter's ratio to the median to the
// power 1.25.
void Widen(engine::SizeDistribution& sizes) {
  constexpr double kEitherWay = 0.1;
  constexpr double kPower = 1.25;
  constexpr int kPoints = 24;
  const engine::SizeCurve curve(sizes);
  const double median = curve.VolumeQuantile(0.5);
  engine::SizeDistribution wide{.by = engine::Weighting::kVolume};
  if (curve.smallest() == curve.largest()) {
    wide.kind = engine::SizeKind::kUniform;
    wide.min = (1 - kEitherWay) * median;
    wide.max = (1 + kEitherWay) * median;
  } else {
    wide.kind = engine::SizeKind::kCumulative;
    for (int i = 0; i <= kPoints; ++i) {
      const double share = static_cast<double>(i) / kPoints;
      const double diameter = median * std::pow(curve.VolumeQuantile(share) / median, kPower);
      if (!wide.diameters.empty() && diameter <= wide.diameters.back()) continue;
      wide.diameters.push_back(diameter);
      wide.shares.push_back(share);
    }
  }
  sizes = wide;
}

void AddPowder(const campaign::JointView& view, const rigs::Case& c, std::vector<Move>& moves) {
  constexpr double kMoreMass = 1.05;
  const bool alike = c.powder.sizes.kind == engine::SizeKind::kMono;
  moves.push_back({.name = "sizes",
                   .from = alike ? "one diameter" : "as given",
                   .to = alike ? "10 % either way" : "a quarter wider",
                   .apply = [](rigs::Case& moved) { Widen(moved.powder.sizes); },
                   .placeholders = {"grains", "num_grains", "smallest_diameter", "mean_diameter",
                                    "largest_diameter"}});
  if (IsSearched(view, kFill) || IsSearched(view, "mass")) return;
  moves.push_back({.name = "mass",
                   .from = base::WithUnit(1e3 * c.powder.mass, "g"),
                   .to = base::WithUnit(1e3 * kMoreMass * c.powder.mass, "g"),
                   .apply = [](rigs::Case& moved) { moved.powder.mass *= kMoreMass; },
                   .placeholders = {"grains", "mass", "num_grains"}});
}

// The filling that it does not have, where its rig takes that one: a drum is filled densely only.
void FillOtherwise(rigs::Case& c) {
  const bool is_dense = c.filling.kind == rigs::FillingKind::kDense;
  rigs::Case other = c;
  other.filling = {.kind = is_dense ? rigs::FillingKind::kPour : rigs::FillingKind::kDense};
  if (ProblemsOf("filling", other).empty()) c = std::move(other);
}

void AddHandling(const rigs::Case& c, std::vector<Move>& moves) {
  constexpr double kFaster = 1.5;
  if (c.rig.kind == rigs::RigKind::kLiftedTube) {
    const double speed = c.rig.lifted_tube.lift_velocity;
    moves.push_back({.name = "lift_velocity",
                     .from = base::WithUnit(1e3 * speed, "mm/s"),
                     .to = base::WithUnit(1e3 * kFaster * speed, "mm/s"),
                     .apply =
                         [](rigs::Case& moved) {
                           if (moved.rig.kind != rigs::RigKind::kLiftedTube) return;
                           moved.rig.lifted_tube.lift_velocity *= kFaster;
                         },
                     .placeholders = {"lift_velocity", "lifted_time", "end_time"}});
  }
  const rigs::FillingKind from = c.filling.kind;
  rigs::Case other = c;
  FillOtherwise(other);
  if (other.filling.kind == from) return;
  moves.push_back({.name = "filling",
                   .from = std::string(base::NameOf(from)),
                   .to = std::string(base::NameOf(other.filling.kind)),
                   .apply = FillOtherwise});
}

// The other of two choices of a contact law.
template <class Option>
Move Other(const std::string& name, Option engine::ContactModels::*part, Option from, Option to) {
  return {.name = name,
          .from = std::string(base::NameOf(from)),
          .to = std::string(base::NameOf(to)),
          .apply = [part, to](rigs::Case& moved) { moved.models.*part = to; }};
}

void AddLaws(const rigs::Case& c, std::vector<Move>& moves) {
  using engine::JkrRollingLimit, engine::JkrSlidingSpring;
  const engine::ContactModels& models = c.models;
  if (models.rolling == engine::Rolling::kEpsd) {
    const double from = models.full_mobilisation_damping;
    const double to = from < 0.5 ? 1 : 0;
    moves.push_back(
        {.name = "full_mobilisation_damping",
         .from = base::ShortNumber(from),
         .to = base::ShortNumber(to),
         .apply = [to](rigs::Case& moved) { moved.models.full_mobilisation_damping = to; },
         .placeholders = {"full_mobilisation_damping"}});
  }
  if (models.adhesion != engine::Adhesion::kJkr) return;
  const bool net = models.jkr_rolling_limit == JkrRollingLimit::kNetForce;
  moves.push_back(Other("jkr_rolling_limit", &engine::ContactModels::jkr_rolling_limit,
                        models.jkr_rolling_limit,
                        net ? JkrRollingLimit::kFromPullOff : JkrRollingLimit::kNetForce));
  const bool kept = models.jkr_sliding_spring == JkrSlidingSpring::kKept;
  moves.push_back(Other("jkr_sliding_spring", &engine::ContactModels::jkr_sliding_spring,
                        models.jkr_sliding_spring,
                        kept ? JkrSlidingSpring::kShortened : JkrSlidingSpring::kKept));
}

}  // namespace

std::vector<Move> UsualMoves(const campaign::JointView& view, const rigs::Case& c) {
  std::vector<Move> moves;
  AddParameter(
      view, c, "restitution", [](double e) { return e > 0.6 ? e - 0.3 : e + 0.3; }, moves);
  if (c.models.rolling == engine::Rolling::kEpsd) {
    AddParameter(
        view, c, "rolling_damping", [](double eta) { return 0.5 * eta; }, moves);
  }
  AddParameter(
      view, c, "youngs_modulus", [](double y) { return 2 * y; }, moves);
  for (const char* pair : {"plate_pair_sliding_friction", "tube_pair_sliding_friction"}) {
    AddParameter(
        view, c, pair, [](double mu) { return 0.8 * mu; }, moves);
  }
  AddPowder(view, c, moves);
  AddHandling(c, moves);
  AddLaws(c, moves);
  return moves;
}

std::vector<Move> UsualMoves(const campaign::JointView& view,
                             const std::vector<rigs::Case>& experiments) {
  std::vector<Move> moves;
  for (const rigs::Case& c : experiments) {
    for (Move& move : UsualMoves(view, c)) {
      if (std::ranges::find(moves, move.name, &Move::name) == moves.end()) {
        moves.push_back(std::move(move));
      }
    }
  }
  return moves;
}

namespace {

// A test of another mass is moved by the same ratio.
std::function<void(rigs::Case&)> MoveBy(const std::string& name, double from, double to) {
  if (campaign::IsFactor(name)) {
    return [=](rigs::Case& moved) { campaign::SetParameter(moved, name, to / from); };
  }
  return [=](rigs::Case& moved) {
    const double own = ValueOf(moved, name);
    const bool by_ratio = campaign::IsOfBulk(name) && own != from && from > 0;
    campaign::SetParameter(moved, name, by_ratio ? own * to / from : to);
  };
}

}  // namespace

Move MoveTo(const campaign::JointView& view, const rigs::Case& c, const std::string& name,
            const std::string& text) {
  std::vector<std::string> known = campaign::ParameterNames();
  std::erase(known, kFill);
  if (name == kFill) throw base::ConfigError(name + ": is moved as the mass; write mass=…");
  if (std::ranges::find(known, name) == known.end()) {
    throw base::ConfigError(name + ": is no parameter" + base::DidYouMean(name, known) +
                            "; there are " + base::Joined(known, ", "));
  }
  if (IsSearched(view, name)) {
    throw base::ConfigError(name + ": is searched, and its value the answer; name something fixed");
  }
  if (const auto missing = campaign::LawMissingFor(name, view.spec.models)) {
    throw base::ConfigError(name + ": " + missing->why);
  }
  double to = 0;
  try {
    to = campaign::ParseProperty(name, text);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(name + ": " + error.what());
  }
  const double from = campaign::HeldAt(view.space, c, name).value_or(ValueOf(c, name));
  if (from == to) {
    throw base::ConfigError(name + ": is " + text + " in the campaign already; name another value");
  }
  const std::string unit = campaign::UnitOf(name);
  Move move{.name = name,
            .from = base::WithUnit(from, unit),
            .to = base::WithUnit(to, unit),
            .apply = MoveBy(name, from, to)};
  AddPlaceholders(view, c, move);
  if (const std::string why = WhyNotMoved(move, c); !why.empty()) throw base::ConfigError(why);
  return move;
}

std::string WhyNotMoved(const Move& move, rigs::Case rig_case) {
  move.apply(rig_case);
  return ProblemsOf(move.name + " " + move.to, rig_case);
}

}  // namespace talus::analysis
