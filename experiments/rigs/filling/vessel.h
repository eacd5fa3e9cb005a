// What a test's powder is filled into, and the scene with the powder in it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/scene.h"
#include "engine/scene/filling.h"
#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// A funnel that stands still or follows a heap's top; others rise with what they have poured.
struct Funnel {
  double height = 0;     // of its outlet above the vessel's floor, or what lies highest [m]
  double outlet = 0;     // its diameter [m]
  bool follows = false;  // keeps its height above what lies highest below it
};

// More of the same powder beside the vessel, there from the beginning.
struct PowderBed {
  engine::FillRegion region;
  double mass = 0;  // [kg]
};

// An upright tube or box, or a plate.
struct Vessel {
  engine::FillRegion region;
  double area = 0;    // of its cross-section [m²]
  double across = 0;  // the diameter, or the shorter edge [m]
  std::optional<Funnel> funnel{};
  std::optional<PowderBed> bed{};
  std::optional<double> floor{};  // its height, where the region filled begins above it [m]
  bool is_prism = true;           // of one cross-section, which a bed fills to a height

  double Floor() const { return floor.value_or(region.base.z); }
};

// `foot` is the centre of its floor; along x and y [m].
Vessel BoxVessel(const engine::Vec3& foot, double length, double width);

struct FilledScene {
  engine::Scene scene;      // without walls
  engine::Filling filling;  // of the vessel; without the positions, which are in the scene
};

// The first of a bed's grains, which are numbered after the powder's own; beyond all where there is
// none.
std::int64_t FirstBedId(const Case& rig_case, const Vessel& vessel);

// At time 0; without the powder's grains where it is to be poured.
FilledScene FillVessel(const Case& rig_case, const Vessel& vessel);

// The volume of the first grains of a filling, in their order [m³].
double FilledVolume(const Case& rig_case, std::int64_t num_grains);

// How high the powder fills the vessel at the solid fraction of a dense filling [m].
double FilledHeight(const Case& rig_case, const Vessel& vessel);

// "the bed is only 1.2 grains deep: …", where so little is filled in that single grains are what a
// test measures; empty where it is enough, or where the depth says nothing of it (a heap, a layer).
std::string ShallowWarning(const Case& rig_case, const Vessel& vessel);

}  // namespace talus::rigs
