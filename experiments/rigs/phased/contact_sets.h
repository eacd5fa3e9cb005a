// Grains that hang together by contacts, and the walls that they reach.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "engine/simulation.h"

namespace talus::rigs {

class ContactSets {
 public:
  // `particles` by id and `contacts`, as Simulation gives them; `contacts` outlive it.
  ContactSets(std::span<const engine::Particle> particles,
              std::span<const engine::ContactInfo> contacts);

  // For each particle, whether it touches the wall.
  std::vector<bool> Touching(int wall) const;
  // For each particle, whether a chain of contacts leads to the wall.
  std::vector<bool> Reaching(int wall) const;
  // For each particle, whether a chain leads to one of the walls and none to the floor, if there is
  // one below them.
  std::vector<bool> Hanging(std::initializer_list<int> walls, std::optional<int> floor = {}) const;

 private:
  std::vector<std::size_t> set_;    // of each particle
  std::vector<std::size_t> first_;  // particle of each contact
  std::span<const engine::ContactInfo> contacts_;
};

}  // namespace talus::rigs
