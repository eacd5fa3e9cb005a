// What turns in a packing, as far as anything resists it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/simulation.h"

namespace talus::engine {

// Where the particle with an id is in `particles`, which are by id.
class PlaceOfId {
 public:
  explicit PlaceOfId(std::span<const Particle> particles);
  std::size_t operator()(std::int64_t id) const { return places_[id - first_id_]; }

 private:
  std::int64_t first_id_ = 0;
  std::vector<std::uint32_t> places_;
};

// Each particle's spin, as far as friction or rolling resistance act on it. One with a single
// contact may twist about its normal for ever, which no law resists: that part is left out.
// `particles` and `contacts` as Simulation gives them.
std::vector<Vec3> ResistedSpins(std::span<const Particle> particles,
                                std::span<const ContactInfo> contacts);

}  // namespace talus::engine
