#include "experiments/rigs/load_case.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/json/json_reader.h"
#include "base/text/number_text.h"
#include "engine/bodies/particle.h"
#include "engine/bodies/wall_motion.h"
#include "engine/scene.h"
#include "engine/scene/filling.h"
#include "experiments/rigs/case/time_step.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/lifted_tube/expected_heap.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/rig_list.h"

namespace talus::rigs {
namespace {

// Said of the rate where there is one, else of the mass, which most often has another unit.
void ValidatePouringTime(const Case& c, const Vessel& vessel, base::Problems& problems) {
  constexpr double kLongest = 60;  // what no funnel needs for a laboratory's powder [s]
  const engine::Pour pour = MakePour(c, vessel);
  const std::string seconds =
      base::ShortNumber(pour.Duration(), 3) + " s, above the 60 s that are simulated";
  const std::string rate = base::ShortNumber(c.powder.mass / kLongest);
  const bool is_short = pour.Duration() <= kLongest;
  if (c.filling.rate) {
    return problems.Require(is_short, "filling.rate", pour.plan().rate,
                            "in kg/s, pours for " + seconds + "; raise it to " + rate + " or more");
  }
  problems.Require(
      is_short, "powder.mass", c.powder.mass,
      "in kg, which runs out of a mouth of " + base::ShortNumber(1e3 * MouthDiameter(c, vessel)) +
          " mm in " + seconds + "; write \"" + base::ShortNumber(c.powder.mass) +
          " g\" if it is in grams, or give a filling.rate of " + rate + " kg/s or more");
}

// A grain that sinks too deeply into what it falls on would be pressed through the floor.
void ValidatePour(const Case& c, const Vessel& vessel, base::Problems& problems) {
  const double mouth = MouthDiameter(c, vessel);
  const bool fits =
      mouth < vessel.across && (!c.filling.mouth_diameter || mouth > 2 * LargestDiameter(c));
  problems.Require(mouth < vessel.across, "filling.mouth_diameter", mouth,
                   c.rig.kind == RigKind::kLiftedTube ? "must be below device.tube_inner_diameter"
                                                      : "must be below the width of the vessel");
  problems.Require(!c.filling.mouth_diameter || mouth > 2 * LargestDiameter(c),
                   "filling.mouth_diameter", mouth, "must be above two (scaled) grain diameters");
  if (fits) ValidatePouringTime(c, vessel, problems);
  if (!problems.empty()) return;
  const double share = ImpactShare(c, vessel);
  if (share <= kMaxImpactShare) return;
  // (δ/R)^(5/2) goes with v²/E, and v² nearly with the height.
  const double ratio = std::pow(share / kMaxImpactShare, 2.5);
  problems.Add(vessel.funnel ? "rig.height" : "filling.drop_height",
               "lets grains sink " + base::ShortNumber(share) +
                   " of their radius into each other or into a wall, above the " +
                   base::ShortNumber(kMaxImpactShare) + " that holds; raise youngs_modulus " +
                   base::ShortNumber(ratio) + " times, " +
                   (vessel.funnel ? "or lower the funnel or filling.rate"
                                  : "lower drop_height or rate, or fill with kind dense"));
}

// A bed that falls comes down on its floor as its lowest grains do, or harder. From much higher
// than any tapping device lets it fall it leaps out of its vessel, and a heap of nothing came out.
void ValidateTaps(const Case& c, const TapRule& taps, const std::string& place,
                  base::Problems& problems) {
  constexpr double kHighest = 0.05;  // [m]
  constexpr double kLongest = 1000;  // [s]
  const std::string path = place + ".height";
  const double lasts = engine::TapDuration({.height = taps.height, .gravity = {0, 0, -c.gravity}});
  problems.Require(
      taps.interval > lasts, place + ".interval", taps.interval,
      "must be above three times the time of the fall, " + base::ShortNumber(lasts) + " s");
  const double share = BlowShare(c, 2 * c.gravity * taps.height);
  const double ratio = std::pow(share / kMaxImpactShare, 2.5);
  problems.Require(
      share <= kMaxImpactShare, path, taps.height,
      "in m, and lets grains sink " + base::ShortNumber(share) +
          " of their radius into the floor, above the " + base::ShortNumber(kMaxImpactShare) +
          " that holds; tap from " + base::ShortNumber(1e3 * taps.height / ratio) +
          " mm at most, or raise youngs_modulus " + base::ShortNumber(ratio) + " times");
  problems.Require(taps.height <= kHighest, path, taps.height,
                   "in m, must be at most 0.05: tapping devices let it fall by 3 to 14 mm, and "
                   "from higher the powder leaps out of its vessel");
  problems.Require(taps.count * taps.interval <= kLongest, place + ".count", taps.count,
                   "of " + base::ShortNumber(taps.interval) + " s each, must take 1000 s at most");
}

// The mass of a bed of powder beside the vessel, over that of the powder itself.
double BedShare(const Case& c, const Vessel& vessel) {
  return vessel.bed ? vessel.bed->mass / c.powder.mass : 0;
}

// Rigs whose powder runs until it rests: later there is nothing to film.
void ValidateLastPicture(const Case& c, base::Problems& problems) {
  if (!c.rig.camera || c.rig.kind != RigKind::kColumnCollapse) return;
  problems.Require(c.rig.camera->LastTime() <= c.rules.heap.max_time, "rig.camera",
                   "takes its last picture " + base::ShortNumber(c.rig.camera->LastTime()) +
                       " s after the gate has opened, and the test ends after " +
                       base::ShortNumber(c.rules.heap.max_time) +
                       " s at the latest (rules.heap.max_time); take it earlier");
}

// The keys of the length that the grains must fit into.
struct LengthFinder {
  double length;
  std::vector<std::string> keys{};

  void operator()(std::string_view name, double value, const base::FieldInfo& info = {}) {
    if (info.dimension == base::Dimension::kLength && value == length) keys.emplace_back(name);
  }
  template <class Other>
  void operator()(std::string_view, const Other&, const base::FieldInfo& = {}) {}
};

// "rig.diameter", or the rig itself where its vessel is as wide as none of its keys, or as several.
std::string PathOfWidth(const Case& c, double across) {
  if (c.rig.kind == RigKind::kLiftedTube) return "device.tube_inner_diameter";
  LengthFinder finder{.length = across};
  RigOptions::Visit(c.rig, finder);
  return finder.keys.size() == 1 ? "rig." + finder.keys.front() : "rig";
}

// A filling that stands fifty times as high as its vessel is wide has its mass in another unit,
// most often.
void ValidateHeight(const Case& c, const Vessel& vessel, base::Problems& problems) {
  constexpr double kMostWidths = 50;
  const double height = FilledHeight(c, vessel);
  const double in_grams = 1e-3 * height / vessel.across;
  const bool is_usual = in_grams > 0.1 && in_grams <= kMostWidths;
  problems.Require(
      height <= kMostWidths * vessel.across, "powder.mass", c.powder.mass,
      "in kg, which stands " + base::ShortNumber(height) + " m high in a vessel of " +
          base::ShortNumber(1e3 * vessel.across) + " mm" +
          (is_usual ? "; write \"" + base::ShortNumber(c.powder.mass) +
                          " g\" for grams, or give this test a mass or a vessel of its own"
                    : ": one of mass, density and vessel has another unit"));
}

// A wall that a rig moves out of itself; gates rise within themselves, drums and lids turn so.
struct MovingSurface {
  const char* name = "";
  const char* key = "";  // of its speed
  double speed = 0;      // [m/s]
};

std::optional<MovingSurface> MovingSurfaceOf(const Case& c) {
  if (c.rig.kind == RigKind::kLiftedTube) {
    return MovingSurface{"tube", "device.lift_velocity", c.rig.lifted_tube.lift_velocity};
  }
  if (c.rig.kind != RigKind::kSpreading) return std::nullopt;
  return MovingSurface{"spreader", "rig.speed", c.rig.spreading.speed};
}

// So fast it could pass a grain unseen: the engine refuses such a motion, which begins after the
// filling. Δt goes with R and with 1/√E, and its share of the Rayleigh time grows with E at most to
// what the case asks for.
void ValidateSurfaceSpeed(const Case& c, base::Problems& problems) {
  constexpr double kWithin = 0.98;  // what is said holds when it has been rounded
  const std::optional<MovingSurface> surface = MovingSurfaceOf(c);
  if (!surface) return;
  const double fraction = StepFraction(c);
  const double moves = surface->speed * fraction * engine::RayleighTime(c.powder.material, 1);
  const double share = kWithin * engine::kMostLater / moves;
  const double stiffer = c.rayleigh_fraction / (share * fraction);
  problems.Require(
      moves <= engine::kMostLater, surface->key, surface->speed,
      "in m/s, moves the " + std::string(surface->name) + " by " + base::ShortNumber(moves) +
          " radii of the smallest grain in a time step, above the " +
          base::ShortNumber(engine::kMostLater) + " that holds; lower it to " +
          base::ShortNumber(share * surface->speed, 3) + " m/s, raise youngs_modulus " +
          base::ShortNumber(stiffer * stiffer, 3) + " times, or lower rayleigh_fraction to " +
          base::ShortNumber(share * fraction, 3));
}

void ValidateWithRig(const Case& c, base::Problems& problems) {
  const RigEntry& entry = EntryOf(c);
  const Vessel vessel = entry.vessel(c);
  const PowderSize size = EstimatePowder(c);
  const std::string too_many = engine::TooManyGrains(size.grains * (1 + BedShare(c, vessel)));
  problems.Require(too_many.empty(), "powder.mass", too_many);
  problems.Require(size.num_grains >= 1, "powder.mass", c.powder.mass,
                   "is less than one grain; the coarse graining may be too strong");
  const double least = 3 * LargestDiameter(c);
  const double factor = c.coarse_graining.scale_factor;
  problems.Require(least < vessel.across, PathOfWidth(c, vessel.across), vessel.across,
                   "must be above three (scaled) grain diameters, " +
                       base::ShortNumber(1e3 * least) + " mm" +
                       (factor > 1 ? " at scale factor " + base::ShortNumber(factor) : ""));
  if (problems.empty()) ValidateHeight(c, vessel, problems);
  entry.validate(c, problems);
  ValidateSurfaceSpeed(c, problems);
  ValidateLastPicture(c, problems);
  if (c.filling.taps) ValidateTaps(c, *c.filling.taps, "filling.taps", problems);
  if (c.rig.kind == RigKind::kTappedDensity) {
    ValidateTaps(c, c.rig.tapped_density.taps, "rig.taps", problems);
  }
  if (problems.empty() && c.filling.kind == FillingKind::kPour) ValidatePour(c, vessel, problems);
}

// How far a column runs out, about: twice its height. 0 of other rigs, and of what is no column.
double Runout(const Case& c) {
  constexpr double kSolidFraction = 0.55;
  if (c.rig.kind != RigKind::kColumnCollapse) return 0;
  const ColumnCollapseOptions& o = c.rig.column_collapse;
  const double height =
      c.powder.mass / (c.powder.material.density * kSolidFraction * o.length * o.width);
  return std::isfinite(height) && height > 0 ? 2 * height : 0;
}

// Height of the powder's top once it is filled in [m]; 0 of what is no case yet.
double FilledTop(const Case& c) {
  const Vessel vessel = EntryOf(c).vessel(c);
  const double top = vessel.region.base.z + FilledHeight(c, vessel);
  return std::isfinite(top) ? top : 0;
}

// A picture as wide as the rig's and as high as its powder, with a margin, for a camera that was
// given none.
imaging::Frame UsualFrame(const Case& c) {
  constexpr int kPixels = 480;
  constexpr double kMargin = 1.2;
  constexpr double kAbove = (1 + 1 / kMargin) / 2;  // of the picture, above the baseline
  const double width = EntryOf(c).width(c);
  const double wide = kMargin * (width + 2 * Runout(c));
  const double high = 1.1 * FilledTop(c) / kAbove;
  return {.width = kPixels,
          .height = kPixels,
          .pixel_size = std::max(wide, high) / kPixels,
          .center_x = kPixels / 2.0,
          .baseline = kPixels * kAbove,
          .plate_diameter = width};
}

}  // namespace

CaseSize EstimateCase(const Case& c) {
  const RigEntry& entry = EntryOf(c);
  const Vessel vessel = entry.vessel(c);
  CaseSize size{EstimatePowder(c)};
  size.filled_height = FilledHeight(c, vessel);
  const double test_time = entry.test_time(c, size.filled_height);
  const bool poured = c.filling.kind == FillingKind::kPour;
  const double pouring = poured ? MakePour(c, vessel).Duration() : 0;
  size.simulated_time = pouring + SimulatedTime(c, test_time);
  // Half of the grains are there while they are poured. Those that leave the plate do so late in
  // the test: they are there for most of it, and hardly when the heap comes to rest.
  const ExpectedHeap heap = c.rig.kind == RigKind::kLiftedTube ? ExpectHeap(c) : ExpectedHeap{};
  const double lifting = test_time - heap.rest_time;
  const double time = size.simulated_time - pouring / 2 -
                      (1 - heap.share) * (0.15 * lifting + 0.9 * heap.rest_time);
  size.grain_time =
      (time + BedShare(c, vessel) * size.simulated_time) * static_cast<double>(size.num_grains);
  return size;
}

void ValidateCase(const Case& c, base::Problems& problems) {
  c.Validate(problems);
  if (problems.empty()) ValidateWithRig(c, problems);
}

void CompleteCase(Case& rig_case) {
  engine::ReadSizeFile(rig_case.powder.sizes);
  rig_case.SetMassByFill();
  if (rig_case.rig.camera && !rig_case.frame) rig_case.frame = UsualFrame(rig_case);
}

Case LoadCase(const std::filesystem::path& path) { return LoadCase(base::ReadJsonFile(path)); }

Case LoadCase(const base::JsonFile& file) { return Completed(base::LoadOptions<Case>(file), file); }

Case Completed(Case rig_case, const base::JsonFile& file) {
  CompleteCase(rig_case);
  base::Problems problems(file.path.string(), file.places);
  ValidateCase(rig_case, problems);
  problems.ThrowIfAny();
  return rig_case;
}

}  // namespace talus::rigs
