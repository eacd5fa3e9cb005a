// The lifted-cylinder heap test (docs/physics.md, 7): the powder settles in the tube, the tube is
// lifted, the heap comes to rest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/rigs/lifted_tube/connectivity.h"
#include "experiments/rigs/phased/rig_entry.h"

namespace talus::rigs {

struct LiftedTubeMemory {
  std::int64_t num_fallen = 0;   // left over the plate's rim
  std::int64_t num_carried = 0;  // taken away by the tube
  double mass_fallen = 0;        // [kg]
  double mass_carried = 0;       // [kg]

  static constexpr base::FieldKey kKeys[] = {{"mass_fallen", "mass_fallen_kg"},
                                             {"mass_carried", "mass_carried_kg"}};
  TALUS_FIELDS(num_fallen, num_carried, mass_fallen, mass_carried);
};

class LiftedTubeRig : public RememberingRig<LiftedTubeMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {
      {Observable::kMassOnPlate},    {Observable::kMassFallen, true},
      {Observable::kNumFallen},      {Observable::kHeight},
      {Observable::kBulkDensity},    {Observable::kReposeAngle1},
      {Observable::kReposeAngle2},   {Observable::kReposeAngle3},
      {Observable::kReposeTriangle}, {Observable::kStaticCohesiveIndex}};

  LiftedTubeRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case) { return rig_case.rig.lifted_tube.plate_diameter; }
  static double TestTime(const Case& rig_case, double filled_height);

  // The grains that a chain of contacts connects with the plate or that are about to land on these
  // or on it, by id.
  std::vector<engine::Particle> Grains() const override;

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan heap) const override;
  std::vector<std::pair<const char*, std::int64_t>> Counts(GrainSpan heap) const override;
  Numbers Conditions() const override;
  std::vector<std::string> Warnings(GrainSpan heap) const override;

 private:
  bool Cleared();
  void DropTube();
  double LiftMaxTime() const;  // [s]
  double TubeEdge() const;     // height of the tube's lower edge [m]

  double leave_height_ = 0;  // below which grains leave the scene [m]
  Connectivity connected_;   // of the view, while the tube is lifted and after
};

// Grains of a scene of this rig that belong to the heap.
std::vector<engine::Particle> GrainsOfHeap(const engine::Simulation& simulation);

}  // namespace talus::rigs
