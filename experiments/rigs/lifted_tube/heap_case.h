// One bulk test, by default the lifted-cylinder heap test (docs/physics.md, 7 and 8): all that is
// needed to simulate it.
//
// A campaign's spec embeds the same structs, so that a powder is described in one way everywhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/json/json_file.h"
#include "base/problems.h"
#include "engine/scene/material.h"
#include "experiments/rigs/lifted_tube/device.h"
#include "experiments/rigs/lifted_tube/filling_rule.h"
#include "experiments/rigs/lifted_tube/heap_rules.h"
#include "experiments/rigs/lifted_tube/powder.h"
#include "experiments/rigs/rig_options.h"
#include "imaging/heap/profile.h"

namespace talus::rigs {

struct HeapOutputs {
  bool vtp = true;              // heap.vtp
  bool csv = false;             // heap.csv
  std::vector<double> times{};  // [s], from the start: state_NNNN.vtp as well

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("vtp", self.vtp, {.doc = "write the heap as heap.vtp"});
    visit("csv", self.csv, {.doc = "write the heap as heap.csv"});
    visit("times", self.times,
          {.dimension = base::Dimension::kTime,
           .doc = "states written as state_0000.vtp, … at these times from the start"});
  }
  void Validate(base::Problems& problems) const;
};

// Largest Δt / t_R at which heaps were seen to be the same as at 0.15 (docs/validation.md) [-].
inline constexpr double kHeapRayleighFraction = 0.30;

// The whole of a case.json. Running it gives the same grains anywhere with one build.
struct HeapCase {
  Powder powder;
  std::optional<RigOptions> rig{};  // default: the lifted tube
  Device device;  // of other rigs than the lifted tube: the materials of walls and floor only
  engine::ContactModels models;
  CoarseGraining coarse_graining;
  FillingRule filling;
  HeapRules rules;
  HeapOutputs outputs;
  double gravity = 9.81;                             // [m/s²], > 0, downwards
  double rayleigh_fraction = kHeapRayleighFraction;  // Δt / t_R of the smallest grain [-], <= 0.4
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
    visit(
        "device", self.device,
        {.doc = "of the lifted tube; other rigs take the materials: tube_material for their walls, "
                "plate_material for their floor"});
    visit("models", self.models);
    visit("coarse_graining", self.coarse_graining);
    visit("filling", self.filling, {.doc = "how the powder gets into the tube"});
    visit("rules", self.rules, {.doc = "when each phase ends"});
    visit("outputs", self.outputs);
    visit("gravity", self.gravity,
          {.dimension = Dimension::kAcceleration, .doc = "downwards, > 0"});
    visit("rayleigh_fraction", self.rayleigh_fraction,
          {.doc = "time step over Rayleigh time of the smallest grain, in (0, 0.4]"});
    visit("seed", self.seed);
    visit("frame", self.frame, {.doc = "of profile.png; without it none is written"});
    visit("num_views", self.num_views, {.doc = "silhouettes of the profile over 180 deg, > 0"});
    visit("threads", self.threads, {.doc = "the result does not depend on it, > 0"});
    visit("checkpoint_interval", self.checkpoint_interval,
          {.dimension = Dimension::kTime,
           .doc = "wall-clock time between checkpoints; 0: only when interrupted"});
  }
  void Validate(base::Problems& problems) const;
};

// The lifted tube where none is named.
inline RigKind KindOf(const HeapCase& heap_case) {
  return heap_case.rig ? heap_case.rig->kind : RigKind::kLiftedTube;
}

// Reads, completes (a size file's content moves into the struct) and validates a case; throws one
// ConfigError with everything that is wrong.
HeapCase LoadHeapCase(const std::filesystem::path& path);
HeapCase LoadHeapCase(const base::JsonFile& file);

// The case as a case.json that needs no other file.
std::string HeapCaseText(const HeapCase& heap_case);

// Whether both give the same grains, whatever is drawn or written of them.
bool IsSameRun(const HeapCase& a, const HeapCase& b);

// What the powder and the device mean for the cost, before anything is simulated.
struct HeapSize {
  std::int64_t num_grains = 0;
  double grains = 0;          // the same, however many
  double mean_diameter = 0;   // by volume of the scaled grains (D50) [m]
  double time_step = 0;       // [s]
  double filled_height = 0;   // of a loose filling [m]
  double simulated_time = 0;  // expected, of all phases [s]
};
HeapSize EstimateHeap(const HeapCase& heap_case);

}  // namespace talus::rigs
