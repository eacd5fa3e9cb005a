// The layer that a blade spreads over a build plate. x runs along the blade's path, its origin
// where the plate begins; z = 0 is the plate's top.
//
// The heap stands on a platform at the height of the blade's edge, behind a gate. The gate goes,
// and the blade pushes the heap over the platform and along the plate, one gap below its edge.
#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"
#include "experiments/rigs/spreading/layer.h"

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

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

  // The gap of the case, or three D90 of the true powder [m].
  static double GapOf(const Case& rig_case);

 protected:
  std::vector<Reading> Readings(GrainSpan grains) const override;
  std::vector<std::string> Warnings(GrainSpan grains) const override;

 private:
  void Start();
  void Stop();
  LayerWindow Window() const;
  Reading SizeDrift(GrainSpan grains) const;
  double MassAhead(GrainSpan grains) const;  // of the blade [kg]
};

}  // namespace talus::rigs
