// What a scene gives over time, as a table: forces on walls, and the mass that has passed sections.
//
//   time_s, num_spheres, for each wall NAME_fx_N … NAME_tz_N_m, for each section NAME_kg, NAME_kg_s
//
// Forces and torques (about the wall's pivot) are those of that moment; a rate is the mean since
// the row before. The whole table is part of the state, so that a restart writes the same file.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene_spec.h"
#include "engine/simulation.h"

namespace talus::engine {

struct SeriesState {
  std::string text{};  // the rows so far
  std::int64_t num_rows = 0;
  double last_time = 0;             // of the last row [s]
  std::vector<double> last_mass{};  // beyond each section then [kg]
  std::vector<double> left_mass{};  // that has left the scene beyond each section [kg]

  TALUS_FIELDS(text, num_rows, last_time, last_mass, left_mass);
};

class Series {
 public:
  explicit Series(const SceneSpec& spec);

  double NextTime(const SeriesState& state) const;  // of a row [s]; infinity without an interval

  // Writes the row that is due, if any.
  void Write(const Simulation& simulation, SeriesState& state) const;

  // A sphere leaves the scene.
  void Leaves(const Particle& p, SeriesState& state) const;

  std::string Head() const;

 private:
  std::vector<double> MassBeyond(const Simulation& simulation, const SeriesState& state) const;
  double Mass(const Particle& p) const;  // [kg]

  OutputSpec outputs_;
  std::vector<std::string> wall_names_;
  std::vector<Material> materials_;
};

}  // namespace talus::engine
