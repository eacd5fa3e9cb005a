// One bulk test, by default the lifted-cylinder heap test (docs/physics.md, 7 and 8): all that is
// needed to simulate it.
//
// A campaign's spec embeds the same structs, so that a powder is described in one way everywhere.
// rig_list.h validates a case with its rig, load_case.h reads one.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material.h"
#include "engine/scene/pair_spec.h"
#include "engine/scene/size_distribution.h"
#include "experiments/rigs/case/device.h"
#include "experiments/rigs/options/filling_rule.h"
#include "experiments/rigs/options/rig_options.h"
#include "experiments/rigs/options/rules.h"
#include "experiments/rigs/options/wall_material.h"
#include "imaging/heap/profile.h"

namespace talus::rigs {

// The key `material` of a powder. The laws' numbers have usual values, the density of a grain has
// none.
struct GrainMaterial : engine::Material {
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    engine::Material::Visit(self, [&](std::string_view key, auto& field, base::FieldInfo info) {
      info.required = key == "density";
      visit(key, field, info);
    });
  }
};

// What is heaped: the material, the sizes and the mass of a powder.
struct Powder {
  engine::Material material;
  engine::SizeDistribution sizes;  // of the real powder; the scale factor enlarges it
  double mass = 0;                 // [kg], > 0; 0: not given, as a drum's fill stands for it

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    GrainMaterial grain{self.material};
    visit("material", grain, {.required = true, .doc = "of a grain"});
    if constexpr (!std::is_const_v<Self>) self.material = grain;
    visit("sizes", self.sizes, {.required = true, .doc = "diameters of the real powder"});
    visit("mass", self.mass,
          {.dimension = base::Dimension::kMass,
           .doc = "filled, > 0; a drum may have its rig's fill instead"});
  }
  void Validate(base::Problems& problems) const;
};

// Fewer, larger grains (docs/physics.md, C1).
struct CoarseGraining {
  double scale_factor = 1;             // f [-], >= 1: every diameter is multiplied by it
  double surface_energy_exponent = 1;  // p [-], in [0, 3]: γ_used = f^p γ

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor,
          {.doc = "f: every diameter is multiplied by it, mass and device stay; >= 1"});
    visit("surface_energy_exponent", self.surface_energy_exponent,
          {.doc = "p in gamma_used = f^p gamma: 1 cohesive stress over weight, 2 particle Bond "
                  "number, 0 none; in [0, 3]"});
  }
  void Validate(base::Problems& problems) const;
};

struct CaseOutputs {
  bool vtp = true;              // heap.vtp
  bool csv = false;             // heap.csv
  bool film = false;            // film.gif
  std::vector<double> times{};  // [s], from the start: state_NNNN.vtp as well

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("vtp", self.vtp, {.doc = "write the heap as heap.vtp"});
    visit("csv", self.csv, {.doc = "write the heap as heap.csv"});
    visit("film", self.film,
          {.doc = "write film.gif; after an interruption of what was left to simulate"});
    visit("times", self.times,
          {.dimension = base::Dimension::kTime,
           .doc = "states written as state_0000.vtp, … at these times from the start"});
  }
  void Validate(base::Problems& problems) const;
};

inline constexpr std::uint64_t kMostSeeds = 2'147'483'646;  // others' engines take 31 bits
// Largest Δt / t_R at which heaps were seen to be the same as at 0.15 (docs/validation.md) [-].
inline constexpr double kUsualRayleighFraction = 0.30;

// The whole of a case.json. Running it gives the same grains anywhere with one build.
struct Case {
  Powder powder;
  RigOptions rig;
  WallMaterials materials;
  std::vector<engine::PairSpec> pairs{};  // see pairs.h
  engine::ContactModels models;
  CoarseGraining coarse_graining;
  FillingRule filling;
  PhaseRules rules;
  CaseOutputs outputs;
  double gravity = 9.81;                              // [m/s²], > 0, downwards
  double rayleigh_fraction = kUsualRayleighFraction;  // Δt / t_R of the smallest grain [-], <= 0.4
  std::uint64_t seed = 1;
  std::optional<imaging::Frame> frame{};  // of the profile; without it none is written
  int num_views = 16;                     // of the profile over 180°, > 0
  int threads = 1;                        // the result does not depend on it
  double checkpoint_interval = 60;        // wall-clock [s], >= 0; 0: only when interrupted

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("powder", self.powder, {.required = true});
    visit("rig", self.rig, {.doc = "kind of bulk test (docs/rigs.md); default: the lifted tube"});
    Device device = self.DeviceKey();
    visit(
        "device", device,
        {.doc = "of the lifted tube; other rigs take the materials: tube_material for their walls, "
                "plate_material for their floor"});
    if constexpr (!std::is_const_v<Self>) self.SetDevice(device);
    visit("pairs", self.pairs,
          {.doc = "what grains with \"plate\", \"tube\" or \"powder\" state themselves; else it "
                  "follows from the two"});
    visit("models", self.models);
    visit("coarse_graining", self.coarse_graining);
    visit("filling", self.filling, {.doc = "how the powder gets into the tube"});
    visit("rules", self.rules, {.doc = "when each phase ends"});
    visit("outputs", self.outputs);
    visit("gravity", self.gravity,
          {.dimension = Dimension::kAcceleration, .doc = "downwards, > 0"});
    visit(
        "rayleigh_fraction", self.rayleigh_fraction,
        {.doc =
             "time step over Rayleigh time of the smallest grain, in (0, 0.4]; less is taken where "
             "its contacts need it (docs/physics.md, M6 and M7)"});
    visit("seed", self.seed);
    visit("frame", self.frame, {.doc = "of profile.png; without it none is written"});
    visit("num_views", self.num_views, {.doc = "silhouettes of the profile over 180 deg, > 0"});
    visit("threads", self.threads, {.doc = "the result does not depend on it, > 0"});
    visit("checkpoint_interval", self.checkpoint_interval,
          {.dimension = Dimension::kTime,
           .doc = "wall-clock time between checkpoints; 0: only when interrupted"});
  }
  // What needs no knowledge of the rig.
  void Validate(base::Problems& problems) const;

  // Puts the mass in the place of a drum's fill; nothing where there is none.
  void SetMassByFill();

  // The tube and the materials, which share the key `device`.
  Device DeviceKey() const;
  void SetDevice(const Device& device);
};

// What rig.fill would be for the case's mass; nothing where it is no drum.
std::optional<double> FillOf(const Case& rig_case);

// The silhouettes of its image over 180°: one from the front where the heap is not round.
inline int NumViewsOf(const Case& rig_case) {
  return IsRoundHeap(rig_case.rig.kind) ? rig_case.num_views : 1;
}

// Where the heap begins in its image, above the plate: at the rim's top [m].
inline double HeapBase(const Case& rig_case) {
  return rig_case.rig.kind == RigKind::kFunnelHeap ? rig_case.rig.funnel_heap.rim_height : 0;
}

// The frame of its image, a film strip where a camera takes several pictures. The case has one.
imaging::Frame ProfileFrameOf(const Case& rig_case);

// What the powder means for the cost, before anything is simulated.
struct PowderSize {
  std::int64_t num_grains = 0;
  double grains = 0;         // the same, however many
  double mean_diameter = 0;  // by volume of the scaled grains (D50) [m]
  double time_step = 0;      // [s]
};
PowderSize EstimatePowder(const Case& rig_case);

// The diameter of the largest scaled grain [m].
double LargestDiameter(const Case& rig_case);

// The gap of a spreader: the case's, or three D90 of the true powder [m].
double SpreadingGap(const Case& rig_case);

}  // namespace talus::rigs
