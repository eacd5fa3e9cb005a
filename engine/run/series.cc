#include "engine/run/series.h"

#include <algorithm>
#include <limits>

#include "base/text/number_text.h"

namespace talus::engine {
namespace {

void AppendField(std::string& text, double value) { text += "," + base::ExactNumber(value); }

// "plate", or "plate_2" where that heads columns already: walls of one name are of one kind.
std::string Unused(const std::string& name, const std::vector<std::string>& used) {
  std::string unused = name;
  for (int count = 2; std::ranges::find(used, unused) != used.end(); ++count) {
    unused = name + "_" + std::to_string(count);
  }
  return unused;
}

}  // namespace

Series::Series(const SceneSpec& spec) : outputs_(spec.outputs) {
  for (const WallSpec& wall : spec.walls) {
    const std::string number = std::to_string(wall_names_.size());
    wall_names_.push_back(Unused(wall.name.empty() ? "wall" + number : wall.name, wall_names_));
  }
  for (const NamedMaterial& material : spec.materials) materials_.push_back(material.material);
}

double Series::NextTime(const SeriesState& state) const {
  if (!outputs_.interval) return std::numeric_limits<double>::infinity();
  return static_cast<double>(state.num_rows) * *outputs_.interval;
}

std::string Series::Head() const {
  std::string head = "time_s,num_spheres";
  for (const std::string& wall : wall_names_) {
    for (const char* column : {"_fx_N", "_fy_N", "_fz_N", "_tx_N_m", "_ty_N_m", "_tz_N_m"}) {
      head += "," + wall + column;
    }
  }
  for (const SectionSpec& section : outputs_.sections) {
    head += "," + section.name + "_kg," + section.name + "_kg_s";
  }
  return head + "\n";
}

double Series::Mass(const Particle& p) const {
  return SphereMass(materials_[static_cast<std::size_t>(p.material)], p.radius);
}

std::vector<double> Series::MassBeyond(const Simulation& simulation,
                                       const SeriesState& state) const {
  const auto& sections = outputs_.sections;
  std::vector<double> mass = state.left_mass;
  mass.resize(sections.size(), 0.0);
  if (sections.empty()) return mass;
  for (const Particle& p : simulation.Particles()) {
    for (std::size_t s = 0; s < sections.size(); ++s) {
      if (sections[s].IsBeyond(p.position)) mass[s] += Mass(p);
    }
  }
  return mass;
}

void Series::Leaves(const Particle& p, SeriesState& state) const {
  const auto& sections = outputs_.sections;
  state.left_mass.resize(sections.size(), 0.0);
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (sections[s].IsBeyond(p.position)) state.left_mass[s] += Mass(p);
  }
}

void Series::Write(const Simulation& simulation, SeriesState& state) const {
  if (NextTime(state) > simulation.time()) return;
  std::string row = base::ExactNumber(simulation.time());
  row += "," + std::to_string(simulation.num_particles());
  for (const WallLoad& load : simulation.WallLoads()) {
    for (const Vec3& v : {load.force, load.torque}) {
      for (const double value : {v.x, v.y, v.z}) AppendField(row, value);
    }
  }
  const std::vector<double> mass = MassBeyond(simulation, state);
  const double since = simulation.time() - state.last_time;
  state.last_mass.resize(mass.size(), 0.0);
  for (std::size_t s = 0; s < mass.size(); ++s) {
    AppendField(row, mass[s]);
    AppendField(row, state.num_rows > 0 ? (mass[s] - state.last_mass[s]) / since : 0.0);
  }
  state.text += row + "\n";
  state.last_mass = mass;
  state.last_time = simulation.time();
  // An interval far below the step has too many rows to count them one by one.
  const double due = std::min(simulation.time() / *outputs_.interval, 1e15);
  state.num_rows = std::max(state.num_rows + 1, static_cast<std::int64_t>(due));
  // The quotient may round down by one.
  while (due < 1e15 && NextTime(state) <= simulation.time()) ++state.num_rows;
}

}  // namespace talus::engine
