// The dynamic angle of repose in a turning drum: the mean slope of the middle half of the surface,
// over a given number of turns. The axis is y, the drum's lowest point z = 0; it carries the grains
// towards -x. Front and back are the floor where its material or its pair with the powder is
// stated, else as the side.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/sample.h"
#include "base/text/number_text.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr double kBoxWidth = 1.2;       // of the box that is filled, in radii
constexpr double kBoxFloor = 0.2;       // its floor above the lowest point, in radii
constexpr double kBoxHeight = 1.6;      // in radii
constexpr double kStill = 0.01;         // grain diameters that nobody sees move
constexpr double kFirstRise = 1.0 / 6;  // of a turn, in which any powder goes with its drum
constexpr double kLump = 0.5;           // of the drum's turns, made by the centre of mass

struct DrumMemory {
  std::vector<double> angles{};  // of the surface at each look [deg]
  int num_carried = 0;           // looks at which powder hangs from the shell in its place
  int num_looks = 0;             // after the first rise
  double turned = 0;             // turning of the centre of mass over the drum's, summed over looks

  static constexpr base::FieldKey kKeys[] = {{"angles", "angles_deg"}};
  TALUS_FIELDS(angles, num_carried, num_looks, turned);
};

class DrumRig : public RememberingRig<DrumMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {
      {Observable::kAngle, true}, {Observable::kAngleSd}, {Observable::kCohesiveIndex}};

  DrumRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
    const DrumOptions& drum = rig_case().rig.drum;
    const double turn = 2 * std::numbers::pi / drum.speed;
    Phase starting = Lasting("starting", drum.start_turns * turn);
    starting.begin = [this] { Turn(); };
    Phase turning = Lasting("turning", drum.turns * turn);
    turning.filmed = true;
    SetPhases({starting, turning}, TestTime(c, FilledHeight(c, vessel())));
  }

  static Vessel VesselOf(const Case& c) {
    const double radius = c.rig.drum.diameter / 2;
    Vessel vessel = BoxVessel({0, 0, kBoxFloor * radius}, kBoxWidth * radius, c.rig.drum.width);
    vessel.floor = 0;
    vessel.is_prism = false;
    return vessel;
  }

  static std::vector<engine::Wall> Walls(const Case& c, double) {
    const DrumOptions& drum = c.rig.drum;
    const double radius = drum.diameter / 2;
    const bool stated = c.materials.floor || StatedWith(c.pairs, kFloor).Any();
    const int covers = stated ? kFloor : kWalls;
    const auto lid = [&](double y) {
      return engine::Disc{.center = {0, y, radius}, .normal = {0, 1, 0}, .radius = radius};
    };
    const engine::OpenCylinder side{.base = {0, -drum.width / 2, radius},
                                    .axis = {0, 1, 0},
                                    .radius = radius,
                                    .length = drum.width};
    return {{.name = "side", .shape = side, .material = kWalls},
            {.name = "front", .shape = lid(-drum.width / 2), .material = covers},
            {.name = "back", .shape = lid(drum.width / 2), .material = covers}};
  }

  static void Validate(const Case& c, base::Problems& problems) {
    problems.Require(!c.filling.taps, "filling.taps", "are not of this rig: remove them");
    problems.Require(c.filling.kind == FillingKind::kDense, "filling.kind",
                     "must be \"dense\": a closed drum is not poured into");
    const DrumOptions& drum = c.rig.drum;
    const double froude = drum.speed * drum.speed * drum.diameter / 2 / c.gravity;
    problems.Require(froude < 1, "rig.speed", drum.speed,
                     "in rad/s, so fast that the powder turns with the drum: ω²R/g is " +
                         base::ShortNumber(froude) + ", must be below 1");
    const double framed = c.frame ? c.frame->plate_diameter : drum.diameter;
    problems.Require(std::abs(framed - drum.diameter) <= 1e-6 * drum.diameter,
                     "frame.plate_diameter", framed,
                     "is another than the drum's diameter, rig.diameter");
    if (c.rig.camera) {
      const double measured = drum.turns * 2 * std::numbers::pi / drum.speed;
      problems.Require(
          c.rig.camera->LastTime() <= (1 + 1e-9) * measured, "rig.camera",
          "takes its last picture " + base::ShortNumber(c.rig.camera->LastTime()) +
              " s after start_turns, when the drum has ended: its turns take " +
              base::ShortNumber(measured) + " s; raise rig.turns to " +
              base::ShortNumber(RoundedUp(drum.turns * c.rig.camera->LastTime() / measured), 3) +
              " or more, or take fewer pictures");
      const double series = c.rig.camera->LastTime() - c.rig.camera->FirstTime();
      const double turned = drum.speed * drum.diameter / 2 * series;
      problems.Require(c.rig.camera->num_frames() == 1 || turned > kStill * LargestDiameter(c),
                       "rig.camera.interval",
                       "is so short that nothing moves: from the first picture to the last the "
                       "drum turns by " +
                           base::ShortNumber(1e3 * turned, 2) +
                           " mm, less than a hundredth of a grain");
    }
    const double most = kBoxHeight * c.rig.drum.diameter / 2;
    const double filled = FilledHeight(c, VesselOf(c)) * LooserBy(c);
    // Rounded down to the digits that are shown, so that it is taken.
    const double exact = 1e3 * c.powder.mass * most / filled;  // [g]
    const double digit = std::pow(10, std::floor(std::log10(exact)) - 2);
    const double most_mass = digit * std::floor(exact / digit);
    problems.Require(filled < most, "powder.mass", c.powder.mass,
                     "is too much for the drum: it is filled to six tenths at most, here some " +
                         base::ShortNumber(most_mass, 3) + " g");
  }

  // To three digits, so that what is advised is taken.
  static double RoundedUp(double value) {
    const double digit = std::pow(10, std::floor(std::log10(value)) - 2);
    return digit * std::ceil(value / digit);
  }

  // Few grains from front to back stand looser: 6 % higher where they are a sixth of the drum's
  // width, 13 % where a third.
  static double LooserBy(const Case& c) {
    return 1 + 0.4 * EstimatePowder(c).mean_diameter / c.rig.drum.width;
  }

  static double Width(const Case& c) { return c.rig.drum.diameter; }

  static double TestTime(const Case& c, double) {
    const DrumOptions& drum = c.rig.drum;
    return (drum.start_turns + drum.turns) * 2 * std::numbers::pi / drum.speed + kRestTime;
  }

 protected:
  std::optional<PhaseEnd> Look() override {
    if (phase_name() != "turning") return std::nullopt;
    const std::vector<engine::Particle>& grains = view().particles;
    if (Turned() >= kFirstRise) {
      ++memory().num_looks;
      memory().turned += TurningOfBed(grains);
    }
    const auto along = [](const auto& p) { return p.position.x; };
    const double low = MassQuantile(grains, 0.02, along);
    const double high = MassQuantile(grains, 0.98, along);
    const SurfaceStrips strips{
        .from = low + (high - low) / 4, .to = high - (high - low) / 4, .width = MeanDiameter()};
    if (HangsFromShell(SurfaceOf(grains, strips))) {
      ++memory().num_carried;
    } else if (const auto slope = SlopeOf(SurfaceOf(WithoutClinging(grains), strips))) {
      memory().angles.push_back(SlopeAngle(-*slope));
    }
    return std::nullopt;
  }

  std::vector<Reading> Readings(GrainSpan) const override {
    const std::vector<double>& angles = memory().angles;
    Reading angle{Observable::kAngle};
    Reading spread{Observable::kAngleSd};
    if (std::cmp_greater(memory().num_carried, angles.size())) {
      angle.undefined = spread.undefined =
          "the drum carries the powder round: it hangs from the shell above the surface";
      return {angle, spread};
    }
    if (angles.size() < 2) {
      angle.undefined = spread.undefined = "the surface has too few grains across";
      return {angle, spread};
    }
    if (IsLump()) {
      angle.undefined = spread.undefined = "the powder turns with the drum as one lump";
      return {angle, spread};
    }
    const base::Sample sample = base::SampleOf(angles);
    return {{Observable::kAngle, sample.mean}, {Observable::kAngleSd, sample.Sd()}};
  }

 private:
  // Turns of the drum since it began.
  double Turned() const {
    const DrumOptions& drum = rig_case().rig.drum;
    const double measured = simulation().time() - phase_start();
    return drum.start_turns + measured * drum.speed / (2 * std::numbers::pi);
  }

  // At first, and between two avalanches, a powder rises with its drum, too, but not as far as
  // this.
  bool IsLump() const {
    const DrumOptions& drum = rig_case().rig.drum;
    const double looked_at = drum.turns - std::max(0.0, kFirstRise - drum.start_turns);
    return looked_at >= kFirstRise && memory().turned > kLump * memory().num_looks;
  }

  // How fast the centre of mass goes round the axis, over the drum's speed: on average nothing
  // where powder flows back, 1 where the drum takes it along.
  double TurningOfBed(GrainSpan grains) const {
    const DrumOptions& drum = rig_case().rig.drum;
    double mass = 0, x = 0, z = 0, vx = 0, vz = 0;
    for (const engine::Particle& p : grains) {
      const double m = MassOf({&p, 1});
      mass += m;
      x += m * p.position.x;
      z += m * (p.position.z - drum.diameter / 2);
      vx += m * p.velocity.x;
      vz += m * p.velocity.z;
    }
    const double square = x * x + z * z;
    return square > 0 ? (z * vx - x * vz) / square / drum.speed : 0;
  }

  // Whether most of what is highest lies at the upper half of the shell, within a grain. A powder
  // that flows is there in none of the middle half's strips, one that clings in nearly all.
  bool HangsFromShell(const std::vector<SurfacePoint>& surface) const {
    const auto at_shell = std::ranges::count_if(
        surface, [&](const SurfacePoint& p) { return p.top > Shell(p.x) - MeanDiameter(); });
    return std::cmp_greater(2 * at_shell, surface.size());
  }

  // A few grains that the shell carries over the surface are none of it.
  std::vector<engine::Particle> WithoutClinging(std::vector<engine::Particle> grains) const {
    std::erase_if(grains, [&](const engine::Particle& p) {
      return p.position.z + p.radius > Shell(p.position.x) - MeanDiameter();
    });
    return grains;
  }

  // Height of the shell's upper half over a place [m].
  double Shell(double x) const {
    const double radius = rig_case().rig.drum.diameter / 2;
    return radius + std::sqrt(std::max(0.0, radius * radius - x * x));
  }

  void Turn() {
    const engine::MotionStep motion{.time = scene().time(),
                                    .angular_velocity = {0, rig_case().rig.drum.speed, 0}};
    for (int wall = 0; wall < 3; ++wall) scene().SetMotion(wall, {motion});
  }
};

}  // namespace

const RigEntry kDrumRig = EntryFor<DrumRig>(RigKind::kDrum);

}  // namespace talus::rigs
