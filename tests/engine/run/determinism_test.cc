// Same input, same bits: whatever the threads, the stops in between, and the restarts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/files/file.h"
#include "engine/kernel/dispatch.h"
#include "tests/engine/cloud.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace determinism_test {

using ::testing::HasSubstr;

// Falls into a tube, part of it leaves over the rim of the base: every kind of contact, sorting,
// and chunks whose pairs reach into the next one.
Scene Busy(int per_side) {
  Material material = testing::Glass();
  material.surface_energy = 1e-4;
  Material wall = material;
  wall.restitution = 0.5;
  Scene scene = testing::EmptySpace(material);
  scene.materials.push_back(wall);
  scene.models = {.adhesion = Adhesion::kDmt, .rolling = Rolling::kEpsd};
  scene.gravity = {0, 0, -9.81};
  scene.particles = testing::Cloud({.per_side = per_side, .spacing = 1.95e-3, .speed = 0.3});
  const double middle = per_side * 0.975e-3;
  scene.walls = {
      {.name = "base",
       .shape = SolidCylinder{.base = {middle, middle, -2e-3}, .radius = middle, .length = 2e-3},
       .material = 1},
      {.name = "tube",
       .shape =
           OpenCylinder{.base = {middle, middle, 0}, .radius = 1.6 * middle + 1e-3, .length = 0.1},
       .material = 1,
       .motion = {{.time = 1e-3, .velocity = {0, 0, 0.5}}}}};
  return scene;
}

void ExpectSameBitsForAllThreads(Scene scene, std::int64_t num_steps) {
  std::string one;
  for (const int threads : {1, 2, 3, 5}) {
    scene.num_threads = threads;
    Simulation simulation(scene);
    simulation.Advance(num_steps);
    const std::string bits = simulation.Checkpoint();
    if (threads == 1) one = bits;
    EXPECT_TRUE(bits == one) << threads << " threads";
    EXPECT_GT(simulation.Statistics().num_rebuilds, 2);
  }
}

TEST(Determinism, ThreadsDoNotChangeTheBits) {
  ExpectSameBitsForAllThreads(Busy(16),
                              200);  // 4096 spheres, four chunks, more threads than chunks
}

// One large sphere makes the cells large: a layer of them holds more spheres than a chunk, and
// forces reach over several chunks.
TEST(Determinism, ThreadsDoNotChangeTheBitsWhereChunksReachFar) {
  Scene scene = Busy(22);
  scene.particles.push_back({.id = static_cast<std::int64_t>(scene.particles.size()),
                             .radius = 5e-3,
                             .position = {0.02, 0.02, 0.06}});
  ExpectSameBitsForAllThreads(scene, 60);
}

// Spheres that fall alone above the others: one member has the chunks below, others most of those
// above.
TEST(Determinism, ThreadsDoNotChangeTheBitsWhereChunksDifferInWork) {
  Scene scene = Busy(16);
  const std::vector<Particle> packed = scene.particles;
  for (Particle p : testing::Cloud({.per_side = 26, .spacing = 4e-3, .speed = 0.3})) {
    p.id += static_cast<std::int64_t>(packed.size());
    p.position.z += 0.11;  // above the tube
    scene.particles.push_back(p);
  }
  ExpectSameBitsForAllThreads(scene, 80);
}

// So many spheres that a chunk is cut into panels, in clouds too far apart to meet: each must move
// like the cloud alone. Their places round off at 3 m instead of 2 cm, 150 times as coarsely; what
// that does to the overlaps is far below a millionth of the speed, and a lost or doubled pair is
// not.
TEST(Determinism, CloudsInALargeSceneMoveLikeOneAloneWithAllThreads) {
  Scene one = Busy(10);
  one.walls.clear();
  one.gravity = {0, 0, 0};
  Scene many = one;
  const auto size = static_cast<std::int64_t>(one.particles.size());
  for (int copy = 1; copy < 50; ++copy) {
    for (Particle p : one.particles) {
      p.id += size * copy;
      p.position.x += 0.06 * copy;
      many.particles.push_back(p);
    }
  }
  Simulation alone(one);
  alone.Advance(60);
  const std::vector<Particle> expected = alone.Particles();
  std::string bits;
  for (const int threads : {1, 2}) {
    many.num_threads = threads;
    Simulation simulation(many);
    simulation.Advance(60);
    const std::vector<Particle> found = simulation.Particles();
    double largest = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Vec3 off = found[i].velocity - expected[i % expected.size()].velocity;
      largest = std::max(largest, base::Norm(off));
    }
    EXPECT_LT(largest, 1e-6 * alone.MaxSpeed());
    if (threads == 1) bits = simulation.Checkpoint();
    EXPECT_TRUE(simulation.Checkpoint() == bits);
    EXPECT_GT(simulation.Contacts().size(), found.size() / 10);
  }
}

TEST(Determinism, LookingAndStoppingInBetweenChangesNothing) {
  const Scene scene = Busy(6);
  Simulation straight(scene), watched(scene);
  straight.Advance(600);
  for (int k = 0; k < 60; ++k) {
    watched.Advance(10);
    watched.Particles();
    watched.Contacts();
    watched.Energies();
    watched.Checkpoint();
  }
  EXPECT_TRUE(straight.Checkpoint() == watched.Checkpoint());
}

TEST(Checkpoint, ARestartedRunEndsWithTheSameBits) {
  Simulation straight(Busy(11));  // 1331 spheres
  straight.Advance(300);
  const std::string saved = straight.Checkpoint();
  straight.Advance(400);
  for (const int threads : {1, 2}) {
    Simulation restarted = Simulation::Restore(saved, threads);
    EXPECT_EQ(restarted.step(), 300);
    EXPECT_TRUE(restarted.Checkpoint() == saved);
    restarted.Advance(400);
    EXPECT_TRUE(restarted.Checkpoint() == straight.Checkpoint());
  }
  EXPECT_GT(straight.Statistics().num_rebuilds, 3);
}

TEST(Checkpoint, IsRestoredWithOneThreadAtLeast) {
  const std::string saved = Simulation(Busy(2)).Checkpoint();
  EXPECT_THROW(Simulation::Restore(saved, 0), base::ConfigError);
  EXPECT_THROW(Simulation::Restore(saved, -1), base::ConfigError);
}

std::string RestoreError(const std::string& bytes) {
  return ErrorIn<base::Error>([&] { Simulation::Restore(bytes); });
}

TEST(Checkpoint, TruncatedDamagedAndForeignTextsAreRefused) {
  Simulation simulation(Busy(3));
  const std::string saved = simulation.Checkpoint();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{40}, saved.size() - 1}) {
    EXPECT_THAT(RestoreError(saved.substr(0, size)), HasSubstr("truncated")) << size;
  }
  for (const std::size_t at : {std::size_t{33}, saved.size() / 2, saved.size() - 1}) {
    std::string damaged = saved;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_THAT(RestoreError(damaged), HasSubstr("damaged")) << at;
  }
  EXPECT_THAT(RestoreError(saved + "x"), HasSubstr("damaged"));
  EXPECT_THAT(RestoreError(std::string(100, 'x')), HasSubstr("not a checkpoint"));
  std::string newer = saved;
  newer[8] = static_cast<char>(newer[8] + 1);
  EXPECT_THAT(RestoreError(newer), HasSubstr("another version"));
}

class Kernels : public ::testing::Test {
 protected:
  void TearDown() override { unsetenv("TALUS_SIMD"); }
};

// Instruction sets round differently: a fused multiplication here, a reciprocal root there. One
// oblique impact of 60 steps keeps the differences near 6e-8 of the speeds, grown by the steps.
TEST_F(Kernels, AgreeOnACollisionToRoundOff) {
  for (const ContactModels& models : testing::AllModels()) {
    SCOPED_TRACE(testing::NameOf(models));
    Scene scene = Busy(1);
    scene.models = models;
    scene.walls.clear();
    scene.particles = {
        {.id = 0, .radius = 1e-3, .position = {0, 0, 0.02}, .velocity = {0.2, 0.1, 0}},
        {.id = 1,
         .radius = 7e-4,
         .position = {1.7e-3 - 1e-7, 0, 0.02},
         .angular_velocity = {9, 9, 9}}};
    std::vector<std::vector<Particle>> results;
    for (const KernelTable* kernels : AvailableKernels()) {
      setenv("TALUS_SIMD", kernels->name, 1);
      Simulation simulation(scene);
      simulation.Advance(60);
      EXPECT_STREQ(simulation.Statistics().kernels, kernels->name);
      results.push_back(simulation.Particles());
    }
    for (const auto& result : results) {
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(base::Norm(result[i].velocity - results[0][i].velocity), 1e-7);
        EXPECT_LT(1e-3 * base::Norm(result[i].angular_velocity - results[0][i].angular_velocity),
                  1e-7);
      }
    }
  }
}

// What moves, as bytes.
std::string BitsOf(const Simulation& simulation) {
  std::string bits;
  for (const Particle& p : simulation.Particles()) {
    for (const Vec3& v : {p.position, p.velocity, p.angular_velocity}) {
      for (const double x : {v.x, v.y, v.z}) {
        bits.append(reinterpret_cast<const char*>(&x), sizeof(x));
      }
    }
  }
  return bits;
}

// Every law in a busy scene, whose walls turn or do not: those that turn have kernels of their own.
std::string ChecksumOfAllLaws(bool walls_turn) {
  std::string bits;
  for (const Adhesion adhesion : {Adhesion::kNone, Adhesion::kDmt, Adhesion::kJkr}) {
    for (const Rolling rolling :
         {Rolling::kNone, Rolling::kConstant, Rolling::kViscous, Rolling::kEpsd, Rolling::kEpsd2}) {
      Scene scene = Busy(4);
      scene.models = {.adhesion = adhesion, .rolling = rolling};
      if (walls_turn) {
        for (Wall& wall : scene.walls) wall.motion = {{.time = 0, .angular_velocity = {0, 5, 20}}};
      }
      Simulation simulation(scene);
      simulation.Advance(200);
      bits += BitsOf(simulation);
    }
  }
  return base::Hex(base::Checksum(bits));
}

// A product that two sums share is fused into one of them at the compiler's choice, so that a new
// branch in a law, or a function taken out of it, moves the bits of every scene. A change that
// means to move all scenes puts its own checksums here.
//
// They hold for one compiler without further flags: another fuses elsewhere. The first guess of a
// root with AVX-512 is the processor's; its bits are known of Intel's.
TEST_F(Kernels, GiveTheBitsThatTheyGaveBefore) {
#if defined(__clang__) || defined(__FMA__) || defined(__SANITIZE_ADDRESS__) || \
    defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
  GTEST_SKIP() << "the stored bits are of GCC's optimised code for no processor in particular";
#endif
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "the stored bits are of processors with FMA";
  if (std::string_view(__VERSION__) != "12.2.0") {
    GTEST_SKIP() << "the stored bits are of GCC 12.2.0; this is " << __VERSION__;
  }
  struct Stored {
    const char* at_rest;
    const char* turning;
  };
  const std::map<std::string, Stored> stored = {
      {"avx512", {"34efb94f84b7aa4b", "7864bba16e98069f"}},
      {"avx2", {"a20209fdd53a93c5", "880da5ea0e658fcb"}},
      {"sse2", {"e63834a6d2ef6cda", "150460105ab113c3"}}};
  for (const KernelTable* kernels : AvailableKernels()) {
    if (kernels->name == std::string("avx512") && !__builtin_cpu_is("intel")) continue;
    setenv("TALUS_SIMD", kernels->name, 1);
    EXPECT_EQ(ChecksumOfAllLaws(false), stored.at(kernels->name).at_rest) << kernels->name;
    EXPECT_EQ(ChecksumOfAllLaws(true), stored.at(kernels->name).turning) << kernels->name;
  }
}

TEST_F(Kernels, AnUnknownInstructionSetIsAnErrorThatNamesTheKnownOnes) {
  setenv("TALUS_SIMD", "mmx", 1);
  EXPECT_THROW(Simulation simulation(Busy(1)), base::ConfigError);
}

}  // namespace determinism_test
}  // namespace talus::engine
