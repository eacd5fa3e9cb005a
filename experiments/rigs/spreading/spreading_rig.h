// The layer that a blade, roller or comb spreads over a build plate, or over a bed of powder in its
// place.
//
// The heap stands before the spreader, behind a gate (spreading_walls.h). A bed is struck off
// level. The gate goes, and the spreader pushes the heap along the plate, one gap above it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/spreading/layer.h"
#include "experiments/rigs/spreading/spreading_walls.h"

namespace talus::rigs {

class SpreadingRig : public RememberingRig<NoMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kPackingFraction, true},
                                                {Observable::kThickness, true},
                                                {Observable::kCoverage, true},
                                                {Observable::kRoughness},
                                                {Observable::kLayerMass, true},
                                                {Observable::kMassAhead},
                                                {Observable::kSizeDrift}};

  SpreadingRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case) { return SpreadingVessel(rig_case); }
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height) {
    return SpreadingWalls(rig_case, height);
  }
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

  // The whole plate from above, the path to the right.
  std::optional<imaging::GrayImage> FromAbove(GrainSpan grains) const override;

 protected:
  std::vector<Reading> Readings(GrainSpan grains) const override;
  std::vector<std::pair<const char*, std::int64_t>> Counts(GrainSpan grains) const override;
  std::vector<std::string> Warnings(GrainSpan grains) const override;

 private:
  void Start();
  void Stop();
  void MoveSpreader(const engine::MotionStep& motion);
  void StrikeOffBed();
  std::vector<engine::Particle> Heap(GrainSpan grains) const;  // without the bed's
  LayerWindow Window() const;
  Reading SizeDrift(GrainSpan grains) const;
  double MassAhead(GrainSpan grains) const;  // of the spreader [kg]

  std::int64_t first_bed_id_;
};

}  // namespace talus::rigs
