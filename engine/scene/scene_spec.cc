#include "engine/scene/scene_spec.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/random.h"
#include "base/text/number_text.h"
#include "engine/bodies/wall_motion.h"
#include "engine/scene/scene_pairs.h"

namespace talus::engine {
namespace {

// Single collisions stay accurate; heaps take rigs::kUsualRayleighFraction.
constexpr double kSceneRayleighFraction = 0.15;
constexpr double kDensest = 0.64;  // solid fraction of a random packing of equal spheres

template <class T>
void RequireMaterials(const SceneSpec& spec, const std::vector<T>& list, const std::string& key,
                      base::Problems& problems) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (MaterialIndex(spec, list[i].material) < 0) {
      problems.Add(key + "[" + std::to_string(i) + "].material",
                   "\"" + list[i].material + "\" is not the name of a material");
    }
  }
}

// Why grains of this volume cannot be drawn; empty when they can.
std::string BadMass(double volume, const SizeCurve& curve) {
  const double num_grains = volume / curve.mean_volume();
  if (num_grains < 0.5) return "is less than half of one grain; check the units";
  return TooManyGrains(num_grains);
}

// Before a grain is drawn: what cannot fit would be tried for ever.
void RequireRoom(const FillSpec& fill, double volume, const SizeCurve& curve,
                 base::Problems& problems) {
  const FillRegion& region = fill.region;
  problems.Require(curve.largest() <= region.Narrowest(), "region", region.Narrowest(),
                   "must be wider than the largest grain");
  problems.Require(!region.height || curve.largest() <= *region.height, "region",
                   region.height.value_or(0), "must be higher than the largest grain");
  problems.Require(volume <= kDensest * region.Area() * region.height.value_or(1e300), "mass",
                   fill.mass,
                   "must be less: its grains alone take above 64 % of the "
                   "region's volume; enlarge the region, or leave its height out");
  // A column like that has its mass in another unit, most often, and takes minutes to fill.
  constexpr double kMostWidths = 100;
  const double height = volume / (fill.solid_fraction * region.Area());
  problems.Require(region.height || height <= kMostWidths * region.Widest(), "mass", fill.mass,
                   "in kg, which stands " + base::ShortNumber(height) + " m high in a region of " +
                       base::ShortNumber(1e3 * region.Widest()) +
                       " mm: one of mass, density and region has another unit; where all are "
                       "right, give region.height");
  const std::string bad_mass = BadMass(volume, curve);
  problems.Require(bad_mass.empty(), "mass", bad_mass);
}

// The remedy where the grains still overlap.
void AddUnfilled(const FillSpec& fill, base::Problems& problems) {
  if (fill.region.height) {
    problems.Add("region", "is too small for the mass; enlarge it or leave its height out");
  } else {
    problems.Add("solid_fraction",
                 std::string("was not reached without overlaps; give a lower one") +
                     (fill.solid_fraction > FillSpec().solid_fraction ? ", such as 0.55" : ""));
  }
}

void AddFill(const SceneSpec& spec, std::size_t index, Scene& scene) {
  const FillSpec& fill = spec.fills[index];
  const int material = MaterialIndex(spec, fill.material);
  const double density = spec.materials[static_cast<std::size_t>(material)].material.density;
  const SizeCurve curve(fill.sizes);
  base::Problems problems;
  problems.Within("fills[" + std::to_string(index) + "]",
                  [&] { RequireRoom(fill, fill.mass / density, curve, problems); });
  problems.ThrowIfAny();
  std::vector<double> radii = DrawDiameters(curve, fill.mass / density);
  for (double& r : radii) r /= 2;
  // Two like fills differ.
  const std::uint64_t seed = base::Random(spec.seed, base::Stream("fills"), index).Next();
  radii = Shuffled(std::move(radii), seed);
  const FillRequest request{
      .region = fill.region, .solid_fraction = fill.solid_fraction, .seed = seed};
  const Filling filling = Fill(radii, request);
  if (filling.max_overlap > request.max_overlap) {
    problems.Within("fills[" + std::to_string(index) + "]", [&] { AddUnfilled(fill, problems); });
    problems.ThrowIfAny();
  }
  const auto is_outside = [&](const Vec3& p) { return spec.domain && !spec.domain->Contains(p); };
  if (std::ranges::any_of(filling.positions, is_outside)) {
    throw base::ConfigError("fills[" + std::to_string(index) +
                            "].region: reaches out of the domain, where grains vanish");
  }
  for (std::size_t i = 0; i < radii.size(); ++i) {
    scene.particles.push_back({.id = static_cast<std::int64_t>(scene.particles.size()),
                               .material = material,
                               .radius = radii[i],
                               .position = filling.positions[i],
                               .velocity = {},
                               .angular_velocity = {}});
  }
}

void RequireMouths(const SceneSpec& spec) {
  for (std::size_t i = 0; i < spec.pours.size(); ++i) {
    const double largest = SizeCurve(spec.pours[i].sizes).largest();
    if (spec.pours[i].mouth_diameter > 2 * largest) continue;
    throw base::ConfigError("pours[" + std::to_string(i) +
                            "].mouth_diameter: must be above two diameters of the largest sphere");
  }
}

// From when on gravity turns [s].
double FirstTurn(const SceneSpec& spec) {
  for (const TurnSpec& turn : spec.gravity_turns) {
    if (Norm(turn.angular_velocity) > 0) return turn.time;
  }
  return INFINITY;
}

// Whether the grains appear within it: in a column as wide as the mouth, and a slab high.
bool Holds(const DomainSpec& domain, const Pour& pour) {
  const PourPlan& plan = pour.plan();
  const Vec3 up = -1 / Norm(plan.gravity) * plan.gravity;
  const double radius = plan.mouth_diameter / 2;
  const auto across = [&](double along) {
    return radius * std::sqrt(std::max(0.0, 1 - along * along));
  };
  const Vec3 wide{across(up.x), across(up.y), across(up.z)};
  const Vec3 top = plan.mouth + pour.slab() * up;
  return domain.Contains(plan.mouth - wide) && domain.Contains(plan.mouth + wide) &&
         domain.Contains(top - wide) && domain.Contains(top + wide);
}

// The grains fall through nothing unseen, and along the gravity that they were planned for.
void RequireGoodStream(const SceneSpec& spec, std::size_t index, double time_step,
                       const Pour& pour) {
  base::Problems problems;
  problems.Within("pours[" + std::to_string(index) + "]", [&] {
    const double most = kMostLater * pour.SmallestRadius() / time_step;
    const bool scatters = std::numbers::sqrt2 * pour.plan().scatter > most;
    problems.Require(pour.MaxSpeed() <= most, scatters ? "scatter" : "rate",
                     scatters ? "moves grains by more than half of their radius in a time step: "
                                "give less"
                              : "makes a stream in which grains move by more than half of their "
                                "radius in a time step: pour less at a time, or by a wider mouth");
    problems.Require(pour.plan().start + pour.Duration() <= FirstTurn(spec), "start",
                     "pours when gravity_turns has begun, but along the gravity of the start: end "
                     "it before");
    problems.Require(
        !spec.domain || Holds(*spec.domain, pour), "mouth",
        "puts grains in up to " + base::ShortNumber(1e3 * pour.slab()) +
            " mm above it and across its whole width, and some of that lies outside the "
            "domain, where grains vanish: widen the domain, or lower the mouth");
  });
  problems.ThrowIfAny();
}

// The step must suit what is there and what comes.
void SetTimeStep(const SceneSpec& spec, Scene& scene) {
  scene.time_step = spec.time_step.value_or(0);
  scene.rayleigh_fraction = spec.rayleigh_fraction.value_or(kSceneRayleighFraction);
  if (spec.pours.empty()) return;
  RequireMouths(spec);
  const double rayleigh = PouredRayleighTime(spec);
  if (scene.time_step > kMaxRayleighFraction * rayleigh) {
    throw base::ConfigError(
        "time_step: exceeds 0.4 Rayleigh times of the smallest poured sphere, " +
        std::to_string(kMaxRayleighFraction * rayleigh * 1e6) + " us");
  }
  if (scene.time_step > 0) return;
  scene.time_step = scene.rayleigh_fraction * rayleigh;
  if (!scene.particles.empty()) {
    Scene now = scene;
    now.time_step = 0;
    scene.time_step = std::min(scene.time_step, TimeStep(now));
  }
}

// Whether it may head a column of series.csv.
bool IsColumnName(const std::string& name) {
  return name.find_first_of(",\"\n\r") == std::string::npos;
}

// Walls without a name are numbered.
void ValidateColumns(const SceneSpec& scene, base::Problems& problems) {
  if (!scene.outputs.interval) return;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    problems.Require(IsColumnName(scene.walls[i].name), "walls[" + std::to_string(i) + "].name",
                     "must not have commas, quotes or line breaks: it heads columns of series.csv");
  }
  std::set<std::string> sections;
  for (std::size_t i = 0; i < scene.outputs.sections.size(); ++i) {
    problems.Require(sections.insert(scene.outputs.sections[i].name).second,
                     "outputs.sections[" + std::to_string(i) + "].name",
                     "is that of another section: it heads columns of series.csv");
  }
}

}  // namespace

int MaterialIndex(const SceneSpec& spec, const std::string& name) {
  if (name.empty()) return 0;
  for (std::size_t i = 0; i < spec.materials.size(); ++i) {
    if (spec.materials[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

double PouredRayleighTime(const SceneSpec& spec) {
  double smallest = INFINITY;
  for (const PourSpec& pour : spec.pours) {
    const auto material = static_cast<std::size_t>(MaterialIndex(spec, pour.material));
    const double radius = SizeCurve(pour.sizes).smallest() / 2;
    smallest = std::min(smallest, RayleighTime(spec.materials[material].material, radius));
  }
  return smallest;
}

void SphereSpec::Validate(base::Problems& problems) const {
  problems.RequirePositive("diameter", diameter);
  problems.Require(base::IsFinite(position), "position", "must be finite");
  problems.Require(base::IsFinite(velocity), "velocity", "must be finite");
  problems.Require(base::IsFinite(angular_velocity), "angular_velocity", "must be finite");
}

void FillSpec::Validate(base::Problems& problems) const {
  problems.RequirePositive("mass", mass);
  problems.Require(solid_fraction > 0 && solid_fraction <= 0.6, "solid_fraction", solid_fraction,
                   "must be in (0, 0.6]");
}

void StopSpec::Validate(base::Problems& problems) const {
  problems.RequirePositive("time", time);
  problems.RequirePositive("steps", steps);
  problems.RequirePositive("energy_fraction", energy_fraction);
  problems.RequirePositive("hold_time", hold_time);
  problems.Require(energy_fraction || hold_time == StopSpec{}.hold_time, "hold_time",
                   "is of energy_fraction, which is not given");
  problems.Require(time || steps, "", "must have time or steps, so that the run ends");
}

void SectionSpec::Validate(base::Problems& problems) const {
  problems.Require(!name.empty() && IsColumnName(name), "name",
                   "must not be empty or have commas, quotes or line breaks");
  problems.Require(base::IsFinite(position), "position", "must be finite");
  problems.Require(base::IsFinite(direction) && Norm(direction) > 0, "direction",
                   "must be finite and not zero");
}

void OutputSpec::Validate(base::Problems& problems) const {
  problems.RequirePositive("interval", interval);
  problems.Require(interval || sections.empty(), "sections", "need outputs.interval");
  for (std::size_t i = 0; i < times.size(); ++i) {
    problems.Require(times[i] >= 0 && (i == 0 || times[i] > times[i - 1]),
                     "times[" + std::to_string(i) + "]", times[i],
                     "must not be negative, and above the one before");
  }
}

void DomainSpec::Validate(base::Problems& problems) const {
  problems.Require(base::IsFinite(low) && base::IsFinite(high), "", "must be finite");
  problems.Require(low.x < high.x && low.y < high.y && low.z < high.z, "low",
                   "must be below high in each coordinate");
}

bool DomainSpec::Contains(const Vec3& point) const {
  return point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y &&
         point.z >= low.z && point.z <= high.z;
}

namespace {

void ValidateMaterials(const SceneSpec& spec, base::Problems& problems) {
  constexpr std::size_t kMostMaterials = 100;  // each pair of them has its constants
  problems.Require(!spec.materials.empty() && spec.materials.size() <= kMostMaterials, "materials",
                   "must have 1 to 100 entries");
  for (std::size_t i = 0; i < std::min(spec.materials.size(), kMostMaterials); ++i) {
    const int first = MaterialIndex(spec, spec.materials[i].name);
    problems.Require(first == static_cast<int>(i) && !spec.materials[i].name.empty(),
                     "materials[" + std::to_string(i) + "].name", "must be given once, not empty");
  }
}

void ValidatePours(const SceneSpec& spec, base::Problems& problems) {
  for (std::size_t i = 0; i < spec.pours.size(); ++i) {
    const std::string pour = "pours[" + std::to_string(i) + "]";
    problems.Require(!spec.domain || spec.domain->Contains(spec.pours[i].mouth), pour + ".mouth",
                     "is outside the domain");
    problems.Require(!spec.stop.time || spec.pours[i].start < *spec.stop.time, pour + ".start",
                     spec.pours[i].start, "must be before stop.time, or nothing is poured");
  }
}

void ValidateTaps(const SceneSpec& spec, base::Problems& problems) {
  for (std::size_t i = 0; i < spec.walls.size(); ++i) {
    if (!spec.walls[i].taps || !(spec.walls[i].taps->height > 0)) continue;
    const std::string taps = "walls[" + std::to_string(i) + "].taps";
    problems.Require(Norm(spec.gravity) > 0, taps, "need gravity, by which the wall falls");
    if (!(Norm(spec.gravity) > 0)) break;
    const double least =
        TapDuration({.height = spec.walls[i].taps->height, .gravity = spec.gravity});
    problems.Require(
        !(spec.walls[i].taps->interval <= least), taps + ".interval", spec.walls[i].taps->interval,
        "must be above the time of a lift and a fall, " + base::ShortNumber(least) + " s");
  }
}

}  // namespace

void SceneSpec::Validate(base::Problems& problems) const {
  ValidateMaterials(*this, problems);
  ValidatePairs(*this, problems);
  ValidateColumns(*this, problems);
  RequireMaterials(*this, spheres, "spheres", problems);
  RequireMaterials(*this, sphere_files, "sphere_files", problems);
  RequireMaterials(*this, fills, "fills", problems);
  RequireMaterials(*this, pours, "pours", problems);
  RequireMaterials(*this, walls, "walls", problems);
  problems.Require(!spheres.empty() || !sphere_files.empty() || !fills.empty() || !pours.empty(),
                   "", "must have spheres, sphere_files, fills or pours");
  problems.Require(pours.empty() || Norm(gravity) > 0, "pours", "need gravity");
  std::vector<TurnStep> turns;
  for (const TurnSpec& turn : gravity_turns) turns.push_back({turn.time, turn.angular_velocity});
  ValidateTurns(turns, "gravity_turns", problems);
  for (std::size_t i = 0; domain && i < spheres.size(); ++i) {
    problems.Require(domain->Contains(spheres[i].position),
                     "spheres[" + std::to_string(i) + "].position", "is outside the domain");
  }
  ValidatePours(*this, problems);
  ValidateTaps(*this, problems);
  problems.Require(base::IsFinite(gravity), "gravity", "must be finite");
  problems.Require(!stop.energy_fraction || Norm(gravity) > 0, "stop.energy_fraction",
                   "compares the energy with m g d, which is 0 without gravity; end by time or "
                   "steps instead");
  for (std::size_t i = 0; stop.time && i < outputs.times.size(); ++i) {
    problems.Require(!(outputs.times[i] > *stop.time), "outputs.times[" + std::to_string(i) + "]",
                     outputs.times[i], "must not be after stop.time");
  }
  problems.RequirePositive("time_step", time_step);
  problems.Require(!time_step || !rayleigh_fraction, "rayleigh_fraction",
                   "decides the time step, and so does time_step; keep one of them");
  problems.Require(threads >= 1, "threads", threads, "must be at least 1");
  problems.Require(checkpoint_interval >= 0 && std::isfinite(checkpoint_interval),
                   "checkpoint_interval", checkpoint_interval, "must not be negative");
}

void ReadSphereFiles(SceneSpec& spec) {
  for (const SphereFileSpec& file : spec.sphere_files) {
    std::vector<SphereSpec> spheres = ReadSphereFile(file, spec.materials);
    std::move(spheres.begin(), spheres.end(), std::back_inserter(spec.spheres));
  }
  spec.sphere_files.clear();
}

Scene BuildScene(const SceneSpec& spec) {
  Scene scene;
  for (const NamedMaterial& material : spec.materials) scene.materials.push_back(material.material);
  scene.pairs = BuildPairs(spec);
  scene.models = spec.models;
  for (const SphereSpec& sphere : spec.spheres) {
    scene.particles.push_back({.id = static_cast<std::int64_t>(scene.particles.size()),
                               .material = MaterialIndex(spec, sphere.material),
                               .radius = sphere.diameter / 2,
                               .position = sphere.position,
                               .velocity = sphere.velocity,
                               .angular_velocity = sphere.angular_velocity});
  }
  for (std::size_t i = 0; i < spec.fills.size(); ++i) AddFill(spec, i, scene);
  for (const WallSpec& wall : spec.walls) {
    scene.walls.push_back(wall.Build(MaterialIndex(spec, wall.material), spec.gravity));
  }
  scene.gravity = spec.gravity;
  for (const TurnSpec& turn : spec.gravity_turns) {
    scene.gravity_turns.push_back({turn.time, turn.angular_velocity});
  }
  SetTimeStep(spec, scene);
  scene.num_threads = spec.threads;
  return scene;
}

std::vector<Pour> BuildPours(const SceneSpec& spec, double time_step, std::int64_t num_spheres) {
  std::vector<Pour> pours;
  for (std::size_t i = 0; i < spec.pours.size(); ++i) {
    const PourSpec& pour = spec.pours[i];
    const int material = MaterialIndex(spec, pour.material);
    const double density = spec.materials[static_cast<std::size_t>(material)].material.density;
    const std::uint64_t seed = base::Random(spec.seed, base::Stream("pours"), i).Next();
    const SizeCurve curve(pour.sizes);
    const std::string bad_mass = BadMass(pour.mass / density, curve);
    if (!bad_mass.empty()) {
      throw base::ConfigError("pours[" + std::to_string(i) + "].mass: " + bad_mass);
    }
    std::vector<double> radii = DrawDiameters(curve, pour.mass / density);
    for (double& r : radii) r /= 2;
    PourPlan plan{.radii = Shuffled(std::move(radii), seed),
                  .material = material,
                  .density = density,
                  .mouth = pour.mouth,
                  .mouth_diameter = pour.mouth_diameter,
                  .rate = 0,
                  .scatter = pour.scatter,
                  .start = pour.start,
                  .gravity = spec.gravity,
                  .seed = seed,
                  .first_id = num_spheres};
    plan.rate = pour.rate.value_or(BeverlooRate(plan));
    num_spheres += static_cast<std::int64_t>(plan.radii.size());
    pours.emplace_back(std::move(plan));
    RequireGoodStream(spec, i, time_step, pours.back());
  }
  return pours;
}

}  // namespace talus::engine
