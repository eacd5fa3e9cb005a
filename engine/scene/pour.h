// Grains that come into a scene over time, out of the mouth of a funnel.
//
// The funnel itself is not simulated. Where no rate is given, it runs as fast as one of its mouth
// empties, after Beverloo:
//
//   W = 0.58 ρ_b √g (D − 1.4 d)^(5/2)     ρ_b = 0.58 ρ     docs/physics.md, F1 [beverloo1961]
//
// D the mouth's diameter, d the mean one of the grains by volume. The grains leave the mouth at the
// speed at which the stream fills 0.22 of its section, and are placed at random in a slab above
// it, where they touch nothing; those that find no room wait. The mouth may rise with what has
// come, or keep its distance from the heap below it. Everything follows from the seed, from how
// many have come and how far it has risen, so that a run goes on from a checkpoint with the same
// bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "engine/scene/size_distribution.h"
#include "engine/simulation.h"

namespace talus::engine {

// As a scene file states it.
struct PourSpec {
  std::string material;  // name; empty: the first
  SizeDistribution sizes;
  double mass = 0;               // [kg], > 0
  Vec3 mouth;                    // centre of the funnel's mouth [m]
  double mouth_diameter = 0;     // [m], above two of the largest grains
  std::optional<double> rate{};  // [kg/s], > 0; default: Beverloo's
  double scatter = 0;            // largest velocity across the stream [m/s], >= 0
  double start = 0;              // [s], >= 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("material", self.material, {.doc = "name of a material; default: the first"});
    visit("sizes", self.sizes, {.required = true});
    visit("mass", self.mass,
          {.dimension = Dimension::kMass, .required = true, .doc = "of all spheres, > 0"});
    visit("mouth", self.mouth,
          {.dimension = Dimension::kLength,
           .required = true,
           .doc = "centre of the funnel's mouth; spheres appear just above it"});
    visit("mouth_diameter", self.mouth_diameter,
          {.dimension = Dimension::kLength,
           .required = true,
           .doc = "above two diameters of the largest sphere"});
    visit("rate", self.rate,
          {.dimension = Dimension::kMassRate, .doc = "default: as fast as such a funnel empties"});
    visit("scatter", self.scatter,
          {.dimension = Dimension::kVelocity,
           .doc = "largest velocity across the stream, at random, >= 0"});
    visit("start", self.start, {.dimension = Dimension::kTime, .doc = ">= 0"});
  }
  void Validate(base::Problems& problems) const;
};

// What is poured, with everything decided.
struct PourPlan {
  std::vector<double> radii;  // in the order in which they come [m]
  int material = 0;
  double density = 0;  // of a grain [kg/m³]
  Vec3 mouth;          // at first [m]
  double rise = 0;     // of the mouth against gravity, with what has come [m/kg]
  // That the mouth keeps at least from the highest grain which lies below it [m]; it never sinks.
  std::optional<double> clearance{};
  double mouth_diameter = 0;  // [m]
  double rate = 0;            // [kg/s]
  double scatter = 0;         // [m/s]
  double start = 0;           // [s]
  Vec3 gravity;               // [m/s²]; the stream runs along it
  std::uint64_t seed = 1;
  std::int64_t first_id = 0;  // the grain of radii[k] has first_id + k
};

// (F1) [kg/s]. Grains that stand for `scale_factor` times smaller ones come at the rate of those.
double BeverlooRate(const PourPlan& plan, double scale_factor = 1);
double StreamSpeed(const PourPlan& plan);  // at the mouth, (F2) [m/s]

struct PourState {
  std::int64_t num_poured = 0;
  std::int64_t num_batches = 0;
  double lift = 0;  // of the mouth, to keep its clearance [m]

  static constexpr base::FieldKey kKeys[] = {{"lift", "lift_m"}};
  TALUS_FIELDS(num_poured, num_batches, lift);
};

class Pour {
 public:
  explicit Pour(PourPlan plan);

  bool Done(const PourState& state) const;
  double NextTime(const PourState& state) const;  // of the next batch [s]; infinity when done
  double Duration() const;                        // if nothing waits [s]
  double MaxSpeed() const;                        // of a grain at the mouth [m/s]
  double SmallestRadius() const;                  // [m]
  double slab() const { return slab_; }  // height above the mouth in which grains appear [m]

  // Puts in the batches that are due, without those grains that find no room. Call it at the first
  // step at or after NextTime.
  void Advance(Simulation& simulation, PourState& state) const;

  const PourPlan& plan() const { return plan_; }

 private:
  struct Surroundings;
  std::optional<Particle> Place(std::int64_t k, const PourState& state,
                                const Surroundings& around) const;
  Vec3 Down() const;                                    // direction of the stream
  Vec3 Mouth(const PourState& state) const;             // [m]
  double LiftOver(const Simulation& simulation) const;  // that keeps the clearance [m]
  std::vector<Particle> Batch(const Simulation& simulation, const PourState& state) const;
  double Interval() const;  // between two batches [s]

  PourPlan plan_;
  double speed_ = 0;         // at the mouth [m/s]
  double slab_ = 0;          // height of a batch [m]
  std::vector<double> cum_;  // mass of the grains up to each [kg]
};

}  // namespace talus::engine
