#include "experiments/rigs/phased/regime.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/not_known.h"
#include "base/sphere.h"

namespace talus::rigs {
namespace {

constexpr double kLowestDecade = -12;
constexpr int kBinsADecade = 8;
constexpr int kMostBins = 24 * kBinsADecade;

constexpr double kCellWidth = 4;          // over d
constexpr std::size_t kFewestGrains = 8;  // of a cell, for the nine numbers of L
constexpr double kSolidFraction = 0.6;

struct Cell {
  std::vector<const engine::Particle*> grains;
  double contacts = 0;  // ends of contacts at its grains
  double virial = 0;    // −Σ F·(xⱼ − xᵢ), half of each contact's at either grain [J]
};

using CellPlace = std::array<std::int64_t, 3>;

CellPlace PlaceOf(const base::Vec3& x, double width) {
  const auto at = [&](double c) { return static_cast<std::int64_t>(std::floor(c / width)); };
  return {at(x.x), at(x.y), at(x.z)};
}

Eigen::Vector3d Of(const base::Vec3& a) { return {a.x, a.y, a.z}; }

// γ̇ of what its grains do together; 0 where they lie in a plane and do not tell.
double ShearRate(const Cell& cell) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d speed = Eigen::Vector3d::Zero();
  for (const engine::Particle* grain : cell.grains) {
    place += Of(grain->position);
    speed += Of(grain->velocity);
  }
  const auto count = static_cast<double>(cell.grains.size());
  place /= count;
  speed /= count;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // Σ δx δxᵀ
  Eigen::Matrix3d mixed = Eigen::Matrix3d::Zero();    // Σ δv δxᵀ
  for (const engine::Particle* grain : cell.grains) {
    const Eigen::Vector3d off = Of(grain->position) - place;
    moments += off * off.transpose();
    mixed += (Of(grain->velocity) - speed) * off.transpose();
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(moments);
  const auto pivots = solver.vectorD();
  if (!(pivots.minCoeff() > 1e-3 * pivots.maxCoeff())) return 0;
  const Eigen::Matrix3d gradient = solver.solve(mixed.transpose()).transpose();
  Eigen::Matrix3d rate = 0.5 * (gradient + gradient.transpose());
  rate.diagonal().array() -= rate.trace() / 3;
  return std::sqrt(2 * rate.squaredNorm());
}

std::map<CellPlace, Cell> CellsOf(const FlowingGrains& grains) {
  const double width = kCellWidth * grains.diameter;
  std::map<CellPlace, Cell> cells;
  std::vector<Cell*> cell_of;  // of each particle
  for (const engine::Particle& grain : grains.particles) {
    Cell& cell = cells[PlaceOf(grain.position, width)];
    cell.grains.push_back(&grain);
    cell_of.push_back(&cell);
  }
  const auto index_of = [&](std::int64_t id) {
    const auto found = std::ranges::lower_bound(grains.particles, id, {}, &engine::Particle::id);
    return static_cast<std::size_t>(found - grains.particles.begin());
  };
  for (const engine::ContactInfo& contact : grains.contacts) {
    const std::size_t i = index_of(contact.first);
    const bool is_wall = contact.second < 0;
    const std::size_t j = is_wall ? i : index_of(contact.second);
    const double reach =
        grains.particles[i].radius + (is_wall ? 0 : grains.particles[j].radius) - contact.overlap;
    const double virial = -reach * Dot(contact.force, contact.normal);
    for (const std::size_t end : {i, j}) {  // of a wall both are the grain's
      cell_of[end]->virial += virial / 2;
      cell_of[end]->contacts += is_wall ? 0.5 : 1;
    }
  }
  return cells;
}

}  // namespace

void LogHistogram::Add(double value, double weight) {
  if (!(value > 0) || !(weight > 0)) return;
  const double bin = (std::log10(value) - kLowestDecade) * kBinsADecade;
  const auto index = static_cast<std::size_t>(std::clamp(bin, 0.0, kMostBins - 1.0));
  if (weights.size() <= index) weights.resize(index + 1);
  weights[index] += weight;
}

double LogHistogram::Quantile(double share) const {
  double total = 0;
  for (const double w : weights) total += w;
  if (!(total > 0)) return base::kNotKnown;
  double below = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (below + weights[i] >= share * total && weights[i] > 0) {
      const double inside = (share * total - below) / weights[i];
      return std::pow(10, kLowestDecade + (static_cast<double>(i) + inside) / kBinsADecade);
    }
    below += weights[i];
  }
  return base::kNotKnown;
}

void LookAtFlow(const FlowingGrains& grains, RegimeMemory& memory) {
  ++memory.num_looks;
  for (const auto& [place, cell] : CellsOf(grains)) {
    if (cell.grains.size() < kFewestGrains) continue;
    if (cell.contacts < static_cast<double>(cell.grains.size())) continue;
    double volume = 0;  // [m³]
    for (const engine::Particle* grain : cell.grains) {
      volume += base::SphereVolume(grain->radius) / kSolidFraction;
    }
    const double pressure = cell.virial / (3 * volume);
    if (!(pressure > 0)) continue;
    const double rate = ShearRate(cell);
    const double power = rate * pressure * volume;
    memory.inertial_number.Add(rate * grains.diameter * std::sqrt(grains.density / pressure),
                               power);
    memory.pressure.Add(pressure, power);
    memory.shear_rate.Add(rate, power);
  }
}

std::optional<Regime> RegimeOf(const RegimeMemory& memory) {
  const auto range = [](const LogHistogram& seen) {
    return RegimeRange{seen.Quantile(0.05), seen.Quantile(0.5), seen.Quantile(0.95)};
  };
  if (memory.shear_rate.weights.empty()) return std::nullopt;
  return Regime{.inertial_number = range(memory.inertial_number),
                .pressure = range(memory.pressure),
                .shear_rate = range(memory.shear_rate)};
}

}  // namespace talus::rigs
