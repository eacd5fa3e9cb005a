#include "engine/blow_up.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"

namespace talus::engine {

namespace {

// Energy of a Hertz contact of overlap δ: (8/15) Y* √R* δ^(5/2).
double HertzEnergy(const PairConstants& pair, double r_star, double overlap) {
  return 8.0 / 15.0 * pair.y_star * std::sqrt(r_star) * std::pow(std::max(overlap, 0.0), 2.5);
}

// Work of adhesion when two bodies snap together: the pull over its range and over the overlap at
// which Hertz balances it.
double AdhesionEnergy(const PairConstants& pair, double r_star) {
  const double pull = pair.pull_off * r_star;
  const double balance = std::pow(pull / (pair.normal_stiffness * std::sqrt(r_star)), 2.0 / 3.0);
  return pull * (pair.adhesion_gap + balance);
}

}  // namespace

double ReferenceSpeed(SimulationState& state) {
  const ParticleStore& p = state.particles;
  double speed = state.walls.MaxPrescribedSpeed();
  double largest_inverse_mass = 0, largest_radius = 0, smallest_radius = INFINITY;
  for (std::int64_t i = 0; i < p.num; ++i) {
    speed = std::max(speed, base::Norm(p.Velocity(i)) + p.Radius(i) * base::Norm(p.Spin(i)));
    largest_inverse_mass = std::max(largest_inverse_mass, p.InverseMass(i));
    largest_radius = std::max(largest_radius, p.Radius(i));
    smallest_radius = std::min(smallest_radius, p.Radius(i));
  }
  double overlap = 0;
  for (const ContactInfo& contact : state.Contacts()) overlap = std::max(overlap, contact.overlap);
  double energy = 0;  // the most that one contact may hold [J]
  for (const PairConstants& pair : state.constants) {
    energy = std::max(
        {energy, AdhesionEnergy(pair, largest_radius), HertzEnergy(pair, largest_radius, overlap)});
  }
  const double fall = std::sqrt(base::Norm(state.gravity) * (p.num > 0 ? 2 * largest_radius : 0.0));
  return speed + fall + std::sqrt(2 * energy * largest_inverse_mass);
}

double SpeedLimit(const SimulationState& state) {
  // A list lasts some thousand steps; what is gained by falling meanwhile is in the margin.
  const double fall = base::Norm(state.gravity) * (state.time() + 1e5 * state.dt);
  return 10 * state.reference_speed + 2 * fall;
}

std::string StepText(const SimulationState& state) {
  std::ostringstream text;
  text << "step " << state.step << " (t = " << state.time() << " s): ";
  return text.str();
}

void ThrowBlowUp(const SimulationState& state) {
  const ParticleStore& p = state.particles;
  for (std::int64_t i = 0; i < p.num; ++i) {
    const double speed = base::Norm(p.Velocity(i));
    if (speed <= state.speed_limit) continue;
    std::ostringstream text;
    text << StepText(state) << "sphere " << p.ids[i];
    if (std::isfinite(speed)) {
      text << " has a speed of " << speed << " m/s, beyond the " << state.speed_limit
           << " m/s that gravity, cohesion and walls can give; make the time step smaller";
    } else {
      text << " has a velocity that is not a number";
    }
    throw base::Error(text.str());
  }
  throw base::Error(StepText(state) + "a speed is not a number");
}

}  // namespace talus::engine
