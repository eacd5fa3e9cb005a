// The layer that a blade, roller or comb spreads over a build plate, or over a bed of powder in its
// place.
//
// The heap stands before the spreader, behind a gate (spreading_walls.h). A bed is struck off
// level. The gate goes, and the spreader pushes the heap along the plate, one gap above it.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/number_text.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/spreading/layer.h"
#include "experiments/rigs/spreading/spreading_walls.h"

namespace talus::rigs {
namespace {

constexpr double kEnds = 0.15;  // of the plate at either end, which the layer is not read on
constexpr double kPicturePixel = 0.05;  // of the picture from above, in mean diameters
constexpr int kMostAlong = 4000;        // of it along the path

class SpreadingRig : public RememberingRig<NoMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kPackingFraction, true},
                                                {Observable::kThickness, true},
                                                {Observable::kCoverage, true},
                                                {Observable::kRoughness},
                                                {Observable::kLayerMass, true},
                                                {Observable::kMassPerArea},
                                                {Observable::kMassAhead},
                                                {Observable::kSizeDrift}};

  SpreadingRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)),
        first_bed_id_(FirstBedId(c, vessel())) {
    Phase spreading = Lasting("spreading", SpreadingTime(c));
    spreading.begin = [this] { Start(); };
    spreading.end = [this] { Stop(); };
    SetPhases({spreading, Resting("resting", c.rules.heap)},
              TestTime(c, FilledHeight(c, vessel())));
  }

  static Vessel VesselOf(const Case& rig_case) { return SpreadingVessel(rig_case); }
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height) {
    return SpreadingWalls(rig_case, height);
  }

  static void Validate(const Case& c, base::Problems& problems) {
    const SpreadingOptions& o = c.rig.spreading;
    problems.Require(!c.filling.taps, "filling.taps", "are not of this rig: remove them");
    problems.Require(o.length > 5 * LargestDiameter(c), "rig.length", o.length,
                     "must be above five (scaled) grain diameters: a layer is read on it");
    if (o.bed) {
      problems.Require(*o.bed > 2 * LargestDiameter(c), "rig.bed", *o.bed,
                       "in m, must be above two (scaled) grain diameters: less is no bed");
    }
    const double height = FilledHeight(c, VesselOf(c));
    const double diameter = 2 * o.RollerRadius();
    problems.Require(
        o.spreader != Spreader::kRoller || diameter >= height, "rig.roller_diameter", diameter,
        "in m, is below the height of the heap, " + base::ShortNumber(1e3 * height) +
            " mm: powder would run over the roller; take a larger one, less powder or a "
            "longer rig.feed");
    const double higher = height / o.feed;
    problems.Require(
        higher <= 3, "powder.mass", c.powder.mass,
        "in kg, and stands " + base::ShortNumber(higher) +
            " times as high as its platform is long, must be 3 or less; take less powder "
            "or a longer rig.feed");
  }

  static double Width(const Case& c) { return c.rig.spreading.length; }

  static double SpreadingTime(const Case& c) {
    const SpreadingOptions& o = c.rig.spreading;
    return (o.feed + BehindHeap(c) + o.length) / o.speed;
  }

  static double TestTime(const Case& c, double) { return SpreadingTime(c) + kRestTime; }

  // The whole plate from above, the path to the right.
  std::optional<imaging::GrayImage> FromAbove(GrainSpan grains) const override {
    const SpreadingOptions& o = rig_case().rig.spreading;
    const double pixel = std::max(kPicturePixel * MeanDiameter(), o.length / kMostAlong);
    return ImageOf(HeightMapOf(grains, {.to = o.length, .half_width = o.width / 2}, pixel),
                   SpreadingGap(rig_case()));
  }

 protected:
  // Grains whose centres lie below the level of a bed are the bed's.
  std::vector<Reading> Readings(GrainSpan grains) const override {
    const double length = rig_case().rig.spreading.length;
    const LayerWindow window = Window();
    double seen = 0;   // in the window [kg]
    double plate = 0;  // on the whole plate [kg]
    for (const engine::Particle& p : grains) {
      if (p.position.z <= 0) continue;
      if (window.Holds(p)) seen += MassOf({&p, 1});
      if (p.position.x >= 0 && p.position.x <= length) plate += MassOf({&p, 1});
    }
    const double solid = seen / rig_case().powder.material.density;
    const Layer layer = LayerOf(grains, window, MeanDiameter());
    const std::vector<engine::Particle> heap = Heap(grains);
    return {{Observable::kPackingFraction, solid / (window.Area() * SpreadingGap(rig_case()))},
            {Observable::kThickness, layer.thickness},
            {Observable::kCoverage, LayerOf(heap, window, MeanDiameter()).coverage},
            {Observable::kRoughness, layer.roughness},
            {Observable::kLayerMass, plate},
            {Observable::kMassPerArea, seen / window.Area()},
            {Observable::kMassAhead, MassAhead(heap)},
            SizeDrift(heap)};
  }

  std::vector<std::pair<const char*, std::int64_t>> Counts(GrainSpan grains) const override {
    const std::vector<engine::Particle> heap = Heap(grains);
    auto counts = Rig::Counts(heap);
    if (vessel().bed) {
      counts.emplace_back("bed", static_cast<std::int64_t>(grains.size() - heap.size()));
    }
    return counts;
  }

  std::vector<std::string> Warnings(GrainSpan grains) const override {
    const double least = 0.02 * FilledMass();
    if (MassAhead(Heap(grains)) > least) return {};
    const std::string spreader(base::NameOf(rig_case().rig.spreading.spreader));
    return {"the heap was used up before the " + spreader +
            " reached the plate's end: its last part had no powder before the " + spreader +
            "; take more"};
  }

 private:
  void Start() {
    const SpreadingOptions& o = rig_case().rig.spreading;
    MoveSpreader({.time = scene().time(),
                  .velocity = {o.speed, 0, 0},
                  .angular_velocity = {0, -o.turning.value_or(0), 0}});
    const std::vector<engine::Wall> walls = scene().Walls();
    for (std::size_t i = 0; i < walls.size(); ++i) {
      if (IsGate(walls[i])) scene().RemoveWall(static_cast<int>(i));
    }
    if (o.bed) StrikeOffBed();
  }

  void Stop() { MoveSpreader({.time = scene().time()}); }

  void MoveSpreader(const engine::MotionStep& motion) {
    for (int wall = 0; wall < NumSpreaderWalls(rig_case()); ++wall)
      scene().SetMotion(wall, {motion});
  }

  void StrikeOffBed() {
    std::vector<std::int64_t> above;
    for (const engine::Particle& p : view().particles) {
      if (p.id >= first_bed_id_ && p.position.z + p.radius > 0) above.push_back(p.id);
    }
    std::sort(above.begin(), above.end());
    double struck_off = 0;  // of no interest: powder that nobody weighs
    WeighOut(above, struck_off);
  }

  // The grains that are no part of the bed.
  std::vector<engine::Particle> Heap(GrainSpan grains) const {
    std::vector<engine::Particle> heap;
    for (const engine::Particle& p : grains) {
      if (p.id < first_bed_id_) heap.push_back(p);
    }
    return heap;
  }

  // Away from both ends, and from the side walls by a grain where the strip has room.
  LayerWindow Window() const {
    const SpreadingOptions& o = rig_case().rig.spreading;
    const double beside = LargestDiameter(rig_case());
    return {.from = kEnds * o.length,
            .to = (1 - kEnds) * o.length,
            .half_width = o.width > 4 * beside ? o.width / 2 - beside : o.width / 2};
  }

  // Mean diameter by volume in the last third of the window over that in the first.
  Reading SizeDrift(GrainSpan grains) const {
    const LayerWindow window = Window();
    double volume[3] = {};
    double moment[3] = {};
    for (const engine::Particle& p : grains) {
      if (!window.Holds(p)) continue;
      const double place = (p.position.x - window.from) / (window.to - window.from);
      const int third = std::min(2, static_cast<int>(3 * place));
      const double cube = p.radius * p.radius * p.radius;
      volume[third] += cube;
      moment[third] += cube * 2 * p.radius;
    }
    if (!(volume[0] > 0) || !(volume[2] > 0)) {
      return {.observable = Observable::kSizeDrift,
              .undefined = "an end of the layer has no grains"};
    }
    return {Observable::kSizeDrift, (moment[2] / volume[2]) / (moment[0] / volume[0])};
  }

  // What lies ahead of the spreader [kg].
  double MassAhead(GrainSpan grains) const {
    double mass = 0;
    for (const engine::Particle& p : grains) {
      if (p.position.x > rig_case().rig.spreading.length) mass += MassOf({&p, 1});
    }
    return mass;
  }

  std::int64_t first_bed_id_;
};

}  // namespace

const RigEntry kSpreadingRig = EntryFor<SpreadingRig>(RigKind::kSpreading);

}  // namespace talus::rigs
