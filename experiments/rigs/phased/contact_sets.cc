#include "experiments/rigs/phased/contact_sets.h"

#include <numeric>

#include "engine/run/resisted_spins.h"

namespace talus::rigs {
namespace {

// Sets that are merged pair by pair, with path halving.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::size_t Find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Merge(std::size_t i, std::size_t j) { parent_[Find(i)] = Find(j); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

ContactSets::ContactSets(std::span<const engine::Particle> particles,
                         std::span<const engine::ContactInfo> contacts)
    : set_(particles.size()), contacts_(contacts) {
  const engine::PlaceOfId place_of(particles);
  Sets sets(particles.size());
  first_.reserve(contacts.size());
  for (const engine::ContactInfo& contact : contacts) {
    first_.push_back(place_of(contact.first));
    if (contact.second >= 0) sets.Merge(first_.back(), place_of(contact.second));
  }
  for (std::size_t i = 0; i < set_.size(); ++i) set_[i] = sets.Find(i);
}

std::vector<bool> ContactSets::Touching(int wall) const {
  std::vector<bool> touching(set_.size(), false);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].second == -1 - wall) touching[first_[k]] = true;
  }
  return touching;
}

std::vector<bool> ContactSets::Reaching(int wall) const {
  const std::vector<bool> touching = Touching(wall);
  std::vector<bool> set_reaches(set_.size(), false);
  for (std::size_t i = 0; i < set_.size(); ++i) {
    if (touching[i]) set_reaches[set_[i]] = true;
  }
  std::vector<bool> reaching(set_.size());
  for (std::size_t i = 0; i < set_.size(); ++i) reaching[i] = set_reaches[set_[i]];
  return reaching;
}

std::vector<bool> ContactSets::Hanging(std::initializer_list<int> walls,
                                       std::optional<int> floor) const {
  const std::vector<bool> stands = floor ? Reaching(*floor) : std::vector<bool>(set_.size(), false);
  std::vector<bool> hangs(set_.size(), false);
  for (const int wall : walls) {
    const std::vector<bool> reaches = Reaching(wall);
    for (std::size_t i = 0; i < hangs.size(); ++i) {
      if (reaches[i] && !stands[i]) hangs[i] = true;
    }
  }
  return hangs;
}

}  // namespace talus::rigs
