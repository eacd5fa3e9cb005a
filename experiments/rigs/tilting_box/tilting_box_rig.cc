// The angle at which the load of a tilted box slides: gravity turns, which to the grains is the
// same as long as it is slow. x points down the slope. It has slid when its centre of mass has
// moved half a grain along it; the angle is that of the moment when it let go.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"

namespace talus::rigs {
namespace {

constexpr double kSlid = 0.5;  // mean diameters

struct TiltingBoxMemory {
  double start_centre = 0;  // x of the centre of mass when the tilting begins [m]
  double angle = 0;         // at which the load let go; 0 before [rad]
  double mass_left = 0;     // over the lip [kg]
  double left_before = 0;   // … when the tilting begins [kg]

  static constexpr base::FieldKey kKeys[] = {{"start_centre", "start_centre_m"},
                                             {"angle", "angle_rad"},
                                             {"mass_left", "mass_left_kg"},
                                             {"left_before", "left_before_kg"}};
  TALUS_FIELDS(start_centre, angle, mass_left, left_before);
};

class TiltingBoxRig : public RememberingRig<TiltingBoxMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kAngle, true},
                                                {Observable::kMassLeft}};

  TiltingBoxRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
    const TiltingBoxOptions& box = rig_case().rig.tilting_box;
    std::vector<Phase> phases;
    if (box.lip_height) {
      phases.push_back(Resting("opening", c.rules.heap));
      phases.back().begin = [this] { scene().RemoveWall(kGate); };
    }
    phases.push_back(Lasting("tilting", box.largest_angle / box.rate));
    phases.back().filmed = true;
    phases.back().begin = [this] { Tilt(); };
    SetPhases(std::move(phases), TestTime(c, FilledHeight(c, vessel())));
  }

  static Vessel VesselOf(const Case& c) {
    return BoxVessel({}, c.rig.tilting_box.length, c.rig.tilting_box.width);
  }

  static std::vector<engine::Wall> Walls(const Case& c, double height) {
    const TiltingBoxOptions& box = c.rig.tilting_box;
    const double lip = box.lip_height.value_or(0);
    const double gate =
        std::max({1.5 * height, 2 * lip, height + Headroom(c, VesselOf(c), c.filling.taps)});
    const auto across = [&](double low, double high) {
      return engine::Rectangle{.center = {box.length / 2, 0, (low + high) / 2},
                               .normal = {1, 0, 0},
                               .edge = {0, 1, 0},
                               .width = box.width,
                               .height = high - low};
    };
    const auto side = [](engine::Vec3 point, engine::Vec3 normal) {
      return engine::Plane{.point = point, .normal = normal};
    };
    std::vector<engine::Wall> walls{
        {.name = "gate", .shape = across(lip, gate), .material = kWalls},
        {.name = "floor",
         .shape = engine::Rectangle{.center = {}, .width = box.length, .height = box.width},
         .material = kFloor},
        {.name = "end", .shape = side({-box.length / 2, 0, 0}, {1, 0, 0}), .material = kWalls},
        {.name = "front", .shape = side({0, -box.width / 2, 0}, {0, 1, 0}), .material = kWalls},
        {.name = "back", .shape = side({0, box.width / 2, 0}, {0, -1, 0}), .material = kWalls}};
    if (lip > 0) walls.push_back({.name = "lip", .shape = across(0, lip), .material = kWalls});
    return walls;
  }

  static void Validate(const Case& c, base::Problems& problems) {
    if (!c.rig.camera) return;
    const TiltingBoxOptions& box = c.rig.tilting_box;
    const double end = box.largest_angle / box.rate;
    problems.Require(c.rig.camera->LastTime() <= end, "rig.camera",
                     "takes its last picture " + base::ShortNumber(c.rig.camera->LastTime()) +
                         " s after the box has begun to tilt, which it does for " +
                         base::ShortNumber(end) +
                         " s at most; take fewer pictures, or a shorter interval");
  }

  static double Width(const Case& c) { return c.rig.tilting_box.length; }

  // Powders of middling friction slide at 34 to 57 degrees.
  static double TestTime(const Case& c, double) {
    constexpr double kUsualAngle = std::numbers::pi / 4;
    const TiltingBoxOptions& box = c.rig.tilting_box;
    return std::min(kUsualAngle, box.largest_angle) / box.rate + (box.lip_height ? kRestTime : 0);
  }

 protected:
  std::optional<PhaseEnd> Look() override {
    const TiltingBoxOptions& box = rig_case().rig.tilting_box;
    const double beyond = box.length / 2 + 2 * simulation().LargestRadius();
    WeighOut([&](const engine::Particle& p) { return p.position.x > beyond; }, memory().mass_left);
    if (phase_name() != "tilting") return std::nullopt;
    const double slid = Centre() - memory().start_centre;
    if (!(slid > kSlid * MeanDiameter())) return std::nullopt;
    const double angle = box.rate * (simulation().time() - phase_start());
    memory().angle = std::max(angle - LagOf(slid, angle), 1e-9);  // 0: nothing has slid
    return PhaseEnd::kDone;
  }

  std::vector<Reading> Readings(GrainSpan) const override {
    const double angle = memory().angle;
    const double largest = rig_case().rig.tilting_box.largest_angle / base::kDegree;
    Reading slid{Observable::kAngle};
    if (angle > 0) {
      slid.value = angle / base::kDegree;
    } else {
      slid.undefined = "nothing slid up to " + std::to_string(std::lround(largest)) + " deg";
    }
    return {slid, {Observable::kMassLeft, memory().mass_left}};
  }

  // Grains that crumble off an open end move the centre of mass as well as a layer that slides.
  std::vector<std::string> Warnings(GrainSpan) const override {
    constexpr double kFew = 0.05;
    const double share = (memory().mass_left - memory().left_before) / FilledMass();
    if (!(memory().angle > 0) || share <= kFew) return {};
    return {base::ShortNumber(100 * share, 2) +
            " % of the powder fell off the open end before the angle was taken, which is then that "
            "of the end's edge, and goes with the rate: take a longer box, or a rig.lip_height of "
            "a few grains"};
  }

 private:
  // By how much the box turns on from where the powder lets go until it has slid so far [rad]: what
  // lets go at φ is accelerated by g sin(θ - φ)/cos φ, which is g ω t/cos φ at first, and slides
  // s = g ω t³/(6 cos φ). It goes with the third root of the grains' size.
  double LagOf(double slid, double angle) const {
    const double rate = rig_case().rig.tilting_box.rate;
    return rate * std::cbrt(6 * slid * std::cos(angle) / (rig_case().gravity * rate));
  }

  void Tilt() {
    memory().start_centre = Centre();
    memory().left_before = memory().mass_left;
    const double rate = rig_case().rig.tilting_box.rate;
    scene().SetGravityTurns({{.time = scene().time(), .angular_velocity = {0, -rate, 0}}});
  }

  // Centre of mass of all grains along x, those that have left counted at the lip [m].
  double Centre() const {
    const double left = memory().mass_left;
    double mass = left;
    double moment = left * rig_case().rig.tilting_box.length / 2;
    for (const engine::Particle& p : view().particles) {
      const double m = MassOf({&p, 1});
      mass += m;
      moment += m * p.position.x;
    }
    return moment / mass;
  }
};

}  // namespace

const RigEntry kTiltingBoxRig = EntryFor<TiltingBoxRig>(RigKind::kTiltingBox);

}  // namespace talus::rigs
