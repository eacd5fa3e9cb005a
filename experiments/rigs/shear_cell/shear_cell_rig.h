// The shear stress that a powder bears under a lid: a round cell, and a disc with vanes that
// presses with a given stress and turns. The axis is z, the floor z = 0.
//
// With M the torque on the lid and R its radius, τ = 3 M/(2π R³), as if τ were the same at every
// radius. Both lid and floor have vanes, so that the powder shears in itself; the cell's side is
// smooth unless its material is given: real cells are so wide that it counts for little.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/shear_cell/yield_line.h"

namespace talus::rigs {

// The lid at a look.
struct ShearSample {
  int stress = 0;           // which of the case's
  double travel = 0;        // under this stress [m]
  double shear_stress = 0;  // τ [Pa]

  static constexpr base::FieldKey kKeys[] = {{"travel", "travel_m"},
                                             {"shear_stress", "shear_stress_pa"}};
  TALUS_FIELDS(stress, travel, shear_stress);
};

struct ShearCellMemory {
  double closing_time = 0;  // that the lid takes to come down [s]
  std::vector<ShearSample> samples{};

  static constexpr base::FieldKey kKeys[] = {{"closing_time", "closing_time_s"}};
  TALUS_FIELDS(closing_time, samples);
};

class ShearCellRig : public RememberingRig<ShearCellMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kShearStress1},
                                                {Observable::kShearStress2},
                                                {Observable::kShearStress3},
                                                {Observable::kFrictionAngle, true},
                                                {Observable::kCohesion, true}};

  ShearCellRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan grains) const override;
  std::vector<std::string> Warnings(GrainSpan grains) const override;

 private:
  void Close();                    // brings the lid down to the powder
  void Shear(std::size_t stress);  // presses, and turns on
  double ShearStressNow() const;   // [Pa]
  // Mean over a part of the travel under one stress, from and to as shares of it [Pa].
  std::optional<double> MeanStress(std::size_t stress, double from, double to) const;
  std::vector<StressPoint> Points() const;
};

}  // namespace talus::rigs
