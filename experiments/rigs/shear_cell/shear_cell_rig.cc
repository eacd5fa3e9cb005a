// The shear stress that a powder bears under a lid: a round cell, and a disc with vanes that
// presses with a given stress and turns. The axis is z, the floor z = 0.
//
// With M the torque on the lid and R its radius, τ = 3 M/(2π R³), as if τ were the same at every
// radius. Both lid and floor have vanes, so that the powder shears in itself; the cell's side is
// smooth unless its friction is given: real cells are so wide that it counts for little.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/number_text.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/phased/spheres.h"
#include "experiments/rigs/phased/surface.h"
#include "experiments/rigs/shear_cell/squeeze.h"
#include "experiments/rigs/shear_cell/yield_line.h"

namespace talus::rigs {
namespace {

// In the order of Walls.
constexpr int kLid = 2;
constexpr int kNumVanes = 12;  // of the lid, which follow it, and of the floor, behind them

constexpr double kVaneHeight = 1.5;  // largest grains
constexpr double kVaneBegin = 0.3;   // of the radius: nearer to the axis they would stand too close
constexpr double kTravel = 20;       // mean diameters
constexpr double kSteadyFrom = 0.5;  // of the travel
constexpr const char* kNotLookedAt =
    "no look fell into the second half of the travel; raise rig.travel or lower rig.speed";
constexpr double kLeastHeight = 7;  // largest grains: vanes above and below, and what shears
// The shear zone is some five grains high: with it I = γ̇ d √(ρ/σ) = (v/5) √(ρ/σ) is the inertial
// number, below which a powder's friction hardly depends on the speed.
constexpr double kShearZone = 5;
constexpr double kMostInertial = 0.05;

constexpr Observable kStresses[] = {Observable::kShearStress1, Observable::kShearStress2,
                                    Observable::kShearStress3};

double VaneHeight(const Case& c) { return kVaneHeight * LargestDiameter(c); }

// Where the moment of an even stress has its arm: ∫ r² dr/∫ r dr.
double Arm(const Case& c) { return c.rig.shear_cell.diameter / 3; }

double TravelOf(const Case& c) {
  return c.rig.shear_cell.travel.value_or(kTravel * EstimatePowder(c).mean_diameter);
}

double ShearingTime(const Case& c) { return TravelOf(c) / c.rig.shear_cell.speed; }

// Said of the speed where one is given, else of the least stress, which may be of kilopascals.
void ValidateInertia(const Case& c, base::Problems& problems) {
  const ShearCellOptions& o = c.rig.shear_cell;
  const double least = o.stresses.front();
  const double inertial = o.speed / kShearZone * std::sqrt(c.powder.material.density / least);
  const bool is_slow = inertial <= kMostInertial;
  const std::string fastest = base::ShortNumber(o.speed * kMostInertial / inertial) + " m/s";
  const std::string stress = base::ShortNumber(least);
  if (o.speed != ShearCellOptions{}.speed) {
    return problems.Require(is_slow, "rig.speed", o.speed,
                            "in m/s, so fast under " + stress +
                                " Pa that inertia adds to the friction; " + fastest + " at most");
  }
  problems.Require(is_slow, "rig.stresses[0]", least,
                   "in Pa, so little that inertia adds to the friction at the lid's " +
                       base::ShortNumber(1e3 * o.speed) + " mm/s; write \"" + stress +
                       " kPa\" if they are in kPa, or give a rig.speed of " + fastest + " at most");
}

// Upright and radial, from `low` to `high` [m].
engine::Wall Vane(const Case& c, const std::string& name, int number, double low, double high) {
  const double radius = c.rig.shear_cell.diameter / 2;
  const double angle = 2 * std::numbers::pi * number / kNumVanes;
  const engine::Vec3 outwards{std::cos(angle), std::sin(angle), 0};
  engine::Vec3 center = (1 + kVaneBegin) / 2 * radius * outwards;
  center.z = (low + high) / 2;
  return {.name = name,
          .shape = engine::Rectangle{.center = center,
                                     .normal = {-outwards.y, outwards.x, 0},
                                     .edge = outwards,
                                     .width = (1 - kVaneBegin) * radius,
                                     .height = high - low},
          .material = kFloor,
          .pivot = engine::Vec3{}};
}

template <class Body>
void ForLidWalls(Body&& body) {
  for (int wall = kLid; wall <= kLid + kNumVanes; ++wall) body(wall);
}

// The lid at a look.
struct ShearSample {
  int stress = 0;           // which of the case's
  double travel = 0;        // under this stress [m]
  double shear_stress = 0;  // τ [Pa]

  static constexpr base::FieldKey kKeys[] = {{"travel", "travel_m"},
                                             {"shear_stress", "shear_stress_pa"}};
  TALUS_FIELDS(stress, travel, shear_stress);
};

struct ShearCellMemory {
  double closing_time = 0;  // that the lid takes to come down [s]
  std::vector<ShearSample> samples{};

  static constexpr base::FieldKey kKeys[] = {{"closing_time", "closing_time_s"}};
  TALUS_FIELDS(closing_time, samples);
};

class ShearCellRig : public RememberingRig<ShearCellMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kShearStress1},
                                                {Observable::kShearStress2},
                                                {Observable::kShearStress3},
                                                {Observable::kFrictionAngle, true},
                                                {Observable::kCohesion, true}};

  ShearCellRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
    Phase closing = Lasting("closing", 0);
    closing.cap = [this] { return memory().closing_time; };
    closing.begin = [this] { Close(); };
    std::vector<Phase> phases{closing};
    for (std::size_t i = 0; i < c.rig.shear_cell.stresses.size(); ++i) {
      Phase shearing = Lasting("shearing " + std::to_string(i + 1), ShearingTime(c));
      shearing.begin = [this, i] { Shear(i); };
      phases.push_back(shearing);
    }
    SetPhases(std::move(phases), TestTime(c, FilledHeight(c, vessel())));
  }

  static Vessel VesselOf(const Case& c) {
    engine::FillRegion region;
    region.diameter = c.rig.shear_cell.diameter;
    region.base = {0, 0, VaneHeight(c)};
    return {.region = region, .area = region.Area(), .across = region.diameter.value(), .floor = 0};
  }

  static std::vector<engine::Wall> Walls(const Case& c, double height) {
    const double radius = c.rig.shear_cell.diameter / 2;
    const double open = OpenLidHeight(c, height);
    const auto disc = [&](double z) { return engine::Disc{.center = {0, 0, z}, .radius = radius}; };
    std::vector<engine::Wall> walls{
        {.name = "floor", .shape = disc(0), .material = kFloor},
        {.name = "side",
         .shape = engine::OpenCylinder{.radius = radius, .length = open},
         .material = kWalls},
        {.name = "lid", .shape = disc(open), .material = kFloor, .pivot = engine::Vec3{}}};
    for (int i = 0; i < kNumVanes; ++i) {
      walls.push_back(Vane(c, "lid vane " + std::to_string(i + 1), i, open - VaneHeight(c), open));
    }
    for (int i = 0; i < kNumVanes; ++i) {
      walls.push_back(Vane(c, "floor vane " + std::to_string(i + 1), i, 0, VaneHeight(c)));
    }
    return walls;
  }

  static void Validate(const Case& c, base::Problems& problems) {
    const ShearCellOptions& o = c.rig.shear_cell;
    problems.Require(!c.filling.taps, "filling.taps", "are not of this rig: remove them");
    const double mean = EstimatePowder(c).mean_diameter;
    problems.Require(!o.travel || *o.travel >= 4 * mean, "rig.travel", o.travel.value_or(0),
                     "must be four (scaled) grain diameters or more, " +
                         base::ShortNumber(4e3 * mean) + " mm: less does not reach a steady state");
    const double height = FilledHeight(c, VesselOf(c));
    problems.Require(height >= kLeastHeight * LargestDiameter(c), "powder.mass", c.powder.mass,
                     "in kg, and fills the cell " + base::ShortNumber(height / LargestDiameter(c)) +
                         " (scaled) grains high, must be seven or more; take more powder or a "
                         "smaller rig.diameter");
    problems.Require(height <= o.diameter, "powder.mass", c.powder.mass,
                     "in kg, and stands " + base::ShortNumber(height / o.diameter) +
                         " times as high as the cell is wide, must be 1 or less; take less powder "
                         "or a larger rig.diameter");
    ValidateInertia(c, problems);
    const double most = o.stresses.back();
    const double bearable = BearableStress(c);
    problems.Require(most <= bearable, "rig.stresses", most,
                     "in Pa, and squashes the grains: they sink " +
                         base::ShortNumber(SqueezeShare(c, most)) +
                         " of their radius into each other on average, above the " +
                         base::ShortNumber(kMaxSqueeze) + " that holds; press with " +
                         base::ShortNumber(bearable) + " Pa at most, or raise youngs_modulus " +
                         base::ShortNumber(most / bearable) + " times");
  }

  static double Width(const Case& c) { return c.rig.shear_cell.diameter; }

  static double TestTime(const Case& c, double) {
    return static_cast<double>(c.rig.shear_cell.stresses.size()) * ShearingTime(c) + kRestTime;
  }

 protected:
  std::optional<PhaseEnd> Look() override {
    for (std::size_t i = 0; i < rig_case().rig.shear_cell.stresses.size(); ++i) {
      if (phase_name() != "shearing " + std::to_string(i + 1)) continue;
      memory().samples.push_back(
          {.stress = static_cast<int>(i),
           .travel = rig_case().rig.shear_cell.speed * (simulation().time() - phase_start()),
           .shear_stress = ShearStressNow()});
    }
    return std::nullopt;
  }

  std::vector<Reading> Readings(GrainSpan) const override {
    const std::vector<double>& stresses = rig_case().rig.shear_cell.stresses;
    std::vector<StressPoint> points;
    std::vector<Reading> all;
    for (std::size_t i = 0; i < std::size(kStresses); ++i) {
      all.push_back({kStresses[i]});
      const auto mean = i < stresses.size() ? MeanStress(i, kSteadyFrom, 1) : std::nullopt;
      if (mean) {
        all.back().value = *mean;
        points.push_back({.normal = stresses[i], .shear = *mean});
      } else {
        all.back().undefined = i < stresses.size() ? kNotLookedAt : "the rig has no such stress";
      }
    }
    Reading angle{Observable::kFrictionAngle};
    Reading cohesion{Observable::kCohesion};
    if (const auto line = YieldLineOf(points)) {
      angle.value = SlopeAngle(line->slope);
      cohesion.value = line->cohesion;
    } else {
      angle.undefined = cohesion.undefined =
          stresses.size() > 1 ? kNotLookedAt : "one normal stress gives no line";
    }
    all.push_back(angle);
    all.push_back(cohesion);
    return all;
  }

  std::vector<std::string> Warnings(GrainSpan) const override {
    constexpr double kSteady = 0.1;  // change from the third to the fourth quarter of the travel
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < rig_case().rig.shear_cell.stresses.size(); ++i) {
      const std::string under = "the shear stress under " +
                                base::ShortNumber(rig_case().rig.shear_cell.stresses[i]) +
                                " Pa was ";
      const auto before = MeanStress(i, kSteadyFrom, 0.75);
      const auto after = MeanStress(i, 0.75, 1);
      if (!before || !after) {
        warnings.push_back(under + "looked at too seldom: " + kNotLookedAt);
        continue;
      }
      if (std::abs(*after - *before) <= kSteady * std::abs(*before + *after) / 2) continue;
      warnings.push_back(under + "not steady: " + base::ShortNumber(*before) + " Pa, then " +
                         base::ShortNumber(*after) + " Pa; raise rig.travel");
    }
    return warnings;
  }

 private:
  // Above the powder that is filled in `height` [m] high, and above what is poured.
  static double OpenLidHeight(const Case& c, double height) {
    const Vessel vessel = VesselOf(c);
    const bool poured = c.filling.kind == FillingKind::kPour;
    const double mouth = poured ? DropHeight(c, vessel) + 3 * LargestDiameter(c) : 0;
    return vessel.region.base.z + height + mouth + VaneHeight(c);
  }

  // Brings the lid down to the powder, as fast as it would fall, and makes the side smooth.
  void Close() {
    const auto& lid = std::get<engine::Disc>(scene().Walls()[kLid].shape);
    const double way =
        std::max(0.0, lid.center.z - VaneHeight(rig_case()) - TopOf(view().particles));
    const double time = std::sqrt(2 * way / rig_case().gravity);
    memory().closing_time = time;
    if (way > 0) {
      const double start = scene().time();
      ForLidWalls([&](int wall) {
        scene().SetMotion(
            wall, {{.time = start, .velocity = {0, 0, -way / time}}, {.time = start + time}});
      });
    }
    const WallMaterial stated = rig_case().materials.walls.value_or(WallMaterial{});
    engine::Material side = MaterialsOf(rig_case())[kWalls];
    side.sliding_friction = stated.sliding_friction.value_or(0);
    side.rolling_friction = stated.rolling_friction.value_or(0);
    scene().SetMaterial(kWalls, side);
  }

  // Presses with the next stress; the lid turns on. It is as heavy as the powder, and damped as a
  // weight on the powder's stiffness is that just does not swing: c = 2 √(k m), k = A dσ/dε/h.
  void Shear(std::size_t stress) {
    const Case& c = rig_case();
    const double normal = c.rig.shear_cell.stresses[stress];
    const double stiffness =
        vessel().area * SqueezedModulus(c, normal) / FilledHeight(c, vessel());  // [N/m]
    engine::Press press{.force = normal * vessel().area,
                        .mass = FilledMass(),
                        .damping = 2 * std::sqrt(stiffness * FilledMass())};
    ForLidWalls([&](int wall) { press.walls.push_back(wall); });
    if (!scene().Presses().empty()) press.speed = scene().Presses().front().speed;
    scene().SetPresses({press});
    if (stress > 0) return;
    const engine::MotionStep turning{.time = scene().time(),
                                     .angular_velocity = {0, 0, c.rig.shear_cell.speed / Arm(c)}};
    ForLidWalls([&](int wall) { scene().SetMotion(wall, {turning}); });
  }

  // From the torque on the lid and its vanes [Pa].
  double ShearStressNow() const {
    const std::vector<engine::WallLoad> loads = simulation().WallLoads();
    double torque = 0;
    ForLidWalls([&](int wall) { torque -= loads[static_cast<std::size_t>(wall)].torque.z; });
    return torque / (vessel().area * Arm(rig_case()));
  }

  // Mean over a part of the travel under one stress, from and to as shares of it [Pa].
  std::optional<double> MeanStress(std::size_t stress, double from, double to) const {
    const double travel = TravelOf(rig_case());
    double sum = 0;
    int count = 0;
    for (const ShearSample& sample : memory().samples) {
      if (sample.stress != static_cast<int>(stress)) continue;
      if (sample.travel <= from * travel || sample.travel > to * travel) continue;
      sum += sample.shear_stress;
      ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
  }
};

}  // namespace

const RigEntry kShearCellRig = EntryFor<ShearCellRig>(RigKind::kShearCell);

}  // namespace talus::rigs
