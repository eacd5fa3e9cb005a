// A step allocates nothing, and no memory left is an error: this program counts what asks for
// memory.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <ostream>

#include "base/error.h"
#include "tests/engine/cloud.h"

namespace {

std::atomic<std::int64_t> num_allocations = 0;
std::atomic<bool> others_get_none = false;
thread_local bool is_main = false;

void* Count(std::size_t size, std::size_t alignment) {
  ++num_allocations;
  if (others_get_none && !is_main) throw std::bad_alloc();
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, whole)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// The forms for arrays and without exceptions call these.
// Out of line, or GCC sees a pointer of operator new freed.
void* operator new(std::size_t size) { return Count(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return Count(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace talus::engine {
namespace {

struct Counted {
  std::int64_t steps = 0;
  std::int64_t rebuilds = 0;
  std::int64_t allocations_in_rebuilds = 0;
  std::int64_t allocations_between = 0;
};

Counted Watch(Simulation& simulation, std::int64_t num_steps) {
  Counted counted;
  std::int64_t rebuilds = simulation.Statistics().num_rebuilds;
  for (; counted.steps < num_steps; ++counted.steps) {
    const std::int64_t before = num_allocations;
    simulation.Advance(1);
    const std::int64_t allocations = num_allocations - before;
    const std::int64_t now = simulation.Statistics().num_rebuilds;
    (now == rebuilds ? counted.allocations_between : counted.allocations_in_rebuilds) +=
        allocations;
    counted.rebuilds += now - rebuilds;
    rebuilds = now;
  }
  return counted;
}

// Two chunks of spheres without losses in a closed box, so that the list is made anew all the time
// and the contacts come and go about the same number.
struct Threading {
  int threads;
  std::int64_t steps;
};
void PrintTo(const Threading& t, std::ostream* out) { *out << t.threads << " threads"; }
class Allocation : public ::testing::TestWithParam<Threading> {
 protected:
  Scene LivelyBox() const {
    Material material = testing::Glass();
    material.restitution = 1;
    material.sliding_friction = 0;
    material.surface_energy = 1e-6;
    Scene scene = testing::EmptySpace(material);
    scene.models = {.adhesion = Adhesion::kDmt, .rolling = Rolling::kEpsd};
    scene.particles = testing::Cloud({.per_side = 13, .spacing = 2.02e-3, .speed = 0.5});
    scene.walls = testing::Box(13 * 2.02e-3);
    scene.num_threads = GetParam().threads;
    return scene;
  }
};

TEST_P(Allocation, NoneInAStepNorInARebuildOnceTheListsHaveRoom) {
  Simulation simulation(LivelyBox());
  const std::int64_t at_start = num_allocations;
  ASSERT_GT(at_start, 0) << "the counting operator new is not used";
  simulation.Advance(2 * GetParam().steps);
  const Counted counted = Watch(simulation, GetParam().steps);
  EXPECT_GT(counted.rebuilds, GetParam().steps / 50);
  EXPECT_EQ(counted.allocations_between, 0);
  EXPECT_EQ(counted.allocations_in_rebuilds, 0) << counted.rebuilds << " rebuilds";
}
// On a busy machine two threads wait for each other a long time.
INSTANTIATE_TEST_SUITE_P(Threads, Allocation,
                         ::testing::Values(Threading{1, 2000}, Threading{2, 300}));

// While it lives, only the thread that made it gets memory.
class NoMemoryForOthers {
 public:
  NoMemoryForOthers() {
    is_main = true;
    others_get_none = true;
  }
  ~NoMemoryForOthers() { others_get_none = false; }
};

Scene TwoThreads() {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.particles = testing::Cloud({.per_side = 13});  // two chunks and more
  scene.num_threads = 2;
  return scene;
}

TEST(OutOfMemory, OfAnotherThreadEndsTheCallNotTheProgram) {
  const NoMemoryForOthers none;
  EXPECT_THROW(Simulation simulation(TwoThreads()), std::bad_alloc);
}

TEST(OutOfMemory, LeavesASimulationThatSaysItCannotBeUsed) {
  Simulation simulation(TwoThreads());
  std::vector<Particle> more = testing::Cloud({.per_side = 18});  // beyond the room of the lists
  for (Particle& p : more) {
    p.id += simulation.num_particles();
    p.position.x += 1;
  }
  {
    const NoMemoryForOthers none;
    EXPECT_THROW(simulation.Add(more), std::bad_alloc);
  }
  EXPECT_THROW(simulation.Advance(1), base::Error);
  EXPECT_THROW(simulation.Particles(), base::Error);
}

}  // namespace
}  // namespace talus::engine
