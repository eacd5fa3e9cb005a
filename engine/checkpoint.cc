// A simulation as bytes: head, then the whole state, the neighbour list with it, so that the run
// goes on with the same sums in the same order.
//
//   "talus-ck"  version  layout  size of the state  checksum of the state  state
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "engine/bytes.h"
#include "engine/simulation.h"
#include "engine/simulation_state.h"

namespace talus::engine {

namespace {

constexpr std::uint32_t kVersion = 7;  // raised with every change of what is written

struct Head {
  char magic[8] = {'t', 'a', 'l', 'u', 's', '-', 'c', 'k'};
  std::uint32_t version = kVersion;
  std::uint32_t layout = 0x01020304u + sizeof(PairBlock) + sizeof(PairConstants) + sizeof(PairRun);
  std::uint64_t size = 0;
  std::uint64_t checksum = 0;
};

// Exactly as many elements as the list has, or as were written.
template <class Archive, class List>
void VisitSize(Archive& archive, List& list) {
  if constexpr (std::is_same_v<Archive, ByteReader>) {
    list.resize(archive.Count(1));
  } else {
    archive(static_cast<std::uint64_t>(list.size()));
  }
}

template <std::size_t k = 0>
void ReadShape(ByteReader& archive, std::uint32_t kind, WallShape& shape) {
  if constexpr (k < std::variant_size_v<WallShape>) {
    if (kind != k) return ReadShape<k + 1>(archive, kind, shape);
    archive(shape.template emplace<k>());
  } else {
    throw base::Error("the checkpoint is damaged");
  }
}
void VisitShape(ByteReader& archive, WallShape& shape) {
  std::uint32_t kind = 0;
  archive(kind);
  ReadShape(archive, kind, shape);
}
void VisitShape(ByteWriter& archive, const WallShape& shape) {
  archive(static_cast<std::uint32_t>(shape.index()));
  std::visit([&](const auto& s) { archive(s); }, shape);
}

// An absent value has no bytes of its own: what would stand there is left to chance.
template <class T>
void VisitOptional(ByteReader& archive, std::optional<T>& value) {
  std::uint8_t present = 0;
  archive(present);
  value.reset();
  if (present != 0) archive(value.emplace());
}
template <class T>
void VisitOptional(ByteWriter& archive, const std::optional<T>& value) {
  archive(static_cast<std::uint8_t>(value.has_value()));
  if (value) archive(*value);
}

template <class Archive>
void VisitWalls(Archive& archive, WallSet& set) {
  std::vector<Wall> walls = set.walls();
  VisitSize(archive, walls);
  for (Wall& wall : walls) {
    archive(wall.name);
    VisitShape(archive, wall.shape);
    archive(wall.material);
    archive(wall.motion);
    VisitOptional(archive, wall.pivot);
    VisitOptional(archive, wall.removal_time);
  }
  std::vector<std::uint8_t> removed = set.removed();
  archive(removed);
  std::vector<Press> presses = set.presses();
  VisitSize(archive, presses);
  for (Press& press : presses) {
    archive(press.walls);
    for (double* value : {&press.force, &press.mass, &press.damping, &press.speed}) archive(*value);
    archive(press.direction);
  }
  if constexpr (std::is_same_v<Archive, ByteReader>)
    set.Restore(std::move(walls), std::move(removed), std::move(presses));
}

template <class Archive, class List>
void VisitPairs(Archive& archive, List& pairs) {
  VisitSize(archive, pairs);
  for (auto& pair : pairs) {
    archive(pair.first);
    archive(pair.second);
    PairProperties::Visit(pair.stated, [&](const char*, auto& value, base::FieldInfo) {
      VisitOptional(archive, value);
    });
  }
}

// Field by field: what stands between the fields is left to chance.
template <class Archive>
void VisitModels(Archive& archive, ContactModels& models) {
  ContactModels::Visit(models, [&](const char*, auto& value, base::FieldInfo) { archive(value); });
}

template <class Archive>
void VisitParticles(Archive& archive, ParticleStore& particles) {
  archive(particles.num);
  archive(particles.motion);
  archive(particles.spin);
  archive(particles.ids);
  archive(particles.materials);
  for (auto* list : {&particles.old_x, &particles.old_y, &particles.old_z, &particles.radius}) {
    archive(*list);
  }
}

template <class Archive>
void VisitList(Archive& archive, ContactList& list) {
  VisitSize(archive, list.chunks());
  for (Chunk& chunk : list.chunks()) {
    archive(chunk.begin);
    archive(chunk.end);
    archive(chunk.window_end);
    archive(chunk.panels);
    archive(chunk.blocks);
    archive(chunk.touching);
    archive(chunk.runs);
  }
  ListCounts counts = list.counts();
  archive(counts);
  if constexpr (std::is_same_v<Archive, ByteReader>) {
    list.Restored(counts);
  }
}

template <class Archive>
void VisitState(Archive& archive, SimulationState& state) {
  archive(state.materials);
  VisitPairs(archive, state.pairs);
  VisitModels(archive, state.models);
  archive(state.gravity);
  archive(state.gravity_turns);
  archive(state.dt);
  archive(state.units);
  archive(state.step);
  archive(state.reference_speed);
  archive(state.speed_limit);
  archive(state.wall_moved);
  archive(state.tuner);
  VisitWalls(archive, state.walls);
  VisitParticles(archive, state.particles);
  VisitList(archive, state.list);
}

Head ReadHead(std::string_view bytes) {
  const Head known;
  Head head;
  if (bytes.size() < sizeof(Head)) throw base::Error("the checkpoint is truncated");
  std::memcpy(&head, bytes.data(), sizeof(Head));
  if (std::memcmp(head.magic, known.magic, sizeof(known.magic)) != 0) {
    throw base::Error("this is not a checkpoint of talus");
  }
  if (head.version != known.version || head.layout != known.layout) {
    throw base::Error("the checkpoint was written by another version of talus (format " +
                      std::to_string(head.version) + ", this is " + std::to_string(known.version) +
                      ")");
  }
  return head;
}

}  // namespace

std::string Simulation::Checkpoint() const {
  state_->RequireUsable();
  ByteWriter counter(nullptr);
  VisitState(counter, *state_);
  Head head;
  head.size = counter.count();
  // A bed's state takes gigabytes: it is written once, where it stays.
  constexpr std::size_t kRoomForPack = std::size_t{1} << 16;
  std::string bytes;
  bytes.reserve(sizeof(Head) + head.size + kRoomForPack);
  bytes.resize(sizeof(Head));
  ByteWriter writer(&bytes);
  VisitState(writer, *state_);
  head.checksum = base::Checksum(std::string_view(bytes).substr(sizeof(Head)));
  std::memcpy(bytes.data(), &head, sizeof(Head));
  return bytes;
}

Simulation Simulation::Restore(std::string_view bytes, int num_threads) {
  base::Problems problems;
  problems.Require(num_threads >= 1, "num_threads", num_threads, "must be at least 1");
  problems.ThrowIfAny();
  const Head head = ReadHead(bytes);
  bytes.remove_prefix(sizeof(Head));
  if (bytes.size() < head.size) throw base::Error("the checkpoint is truncated");
  if (bytes.size() > head.size || base::Checksum(bytes) != head.checksum) {
    throw base::Error("the checkpoint is damaged: its checksum does not match");
  }
  auto state = std::make_unique<SimulationState>();
  ByteReader reader(bytes);
  VisitState(reader, *state);
  if (!reader.AtEnd()) throw base::Error("the checkpoint is damaged");
  state->SetThreads(num_threads);
  state->list.PrepareForces(*state->team);
  state->SetConstants();
  state->particles.single.resize(state->particles.motion.size());
  state->particles.spot.resize(state->particles.motion.size() / 2);
  state->RoundMotion();
  state->walls.SetTime(state->time(), state->dt);
  return Simulation(std::move(state));
}

}  // namespace talus::engine
