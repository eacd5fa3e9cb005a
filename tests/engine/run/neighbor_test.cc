// The neighbour search against looking at every pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "base/error.h"
#include "engine/kernel/dispatch.h"
#include "engine/neighbor/contact_list.h"
#include "engine/neighbor/grid.h"
#include "engine/neighbor/pair_search.h"
#include "engine/neighbor/sphere_index.h"
#include "tests/engine/cloud.h"

namespace talus::engine {
namespace neighbor_test {

using Pairs = std::set<std::pair<std::int64_t, std::int64_t>>;

struct NamedCloud {
  const char* name;
  std::vector<double> rows;  // x, y, z of each point
};

std::vector<double> Points(int count, auto&& point) {
  std::vector<double> rows;
  for (int i = 0; i < count; ++i) {
    base::Random random(7, base::Stream("neighbor_test"), i);
    const Vec3 p = point(random, i);
    rows.insert(rows.end(), {p.x, p.y, p.z});
  }
  return rows;
}

// The reach is 1 in all of them.
std::vector<NamedCloud> Clouds() {
  const auto cube = [](base::Random& random, double size) {
    return Vec3{random.Uniform(0, size), random.Uniform(0, size), random.Uniform(0, size)};
  };
  return {
      {"random", Points(800, [&](auto& r, int) { return cube(r, 9); })},
      {"flat", Points(800,
                      [&](auto& r, int) {
                        return Vec3{r.Uniform(0, 30), r.Uniform(0, 30), 0};
                      })},
      {"clustered", Points(600,
                           [&](auto& r, int i) {
                             return cube(r, 2) + 50.0 * Vec3{double(i % 5), 0, 0};
                           })},
      {"one point", Points(50,
                           [](auto&, int) {
                             return Vec3{1, 2, 3};
                           })},
      {"line", Points(300,
                      [](auto&, int i) {
                        return Vec3{0, 0.5 * i, 0};
                      })},
      {"lattice at the reach",
       Points(1000,
              [](auto&, int i) {
                return Vec3{double(i % 10), double(i / 10 % 10), double(i / 100)};
              })},
      {"far outliers",
       Points(800, [&](auto& r, int i) { return i % 100 == 0 ? 1e6 * cube(r, 1) : cube(r, 9); })},
      {"negative and far from the origin", Points(800,
                                                  [&](auto& r, int) {
                                                    return cube(r, 9) + Vec3{-1e4, -1e5, 3};
                                                  })},
      {"single", Points(1,
                        [](auto&, int) {
                          return Vec3{1, 2, 3};
                        })},
      {"none", {}}};
}

Pairs Near(const std::vector<double>& rows, auto&& for_each_candidate) {
  Pairs pairs;
  for_each_candidate([&](std::int64_t i, std::int64_t j) {
    double square = 0;
    for (int c = 0; c < 3; ++c) square += std::pow(rows[3 * i + c] - rows[3 * j + c], 2);
    if (square < 1) {
      EXPECT_TRUE(pairs.insert(std::minmax(i, j)).second) << "twice";
    }
  });
  return pairs;
}

TEST(Grid, FindsWhatLookingAtEveryPairFinds) {
  for (const NamedCloud& cloud : Clouds()) {
    SCOPED_TRACE(cloud.name);
    const auto count = static_cast<std::int64_t>(cloud.rows.size() / 3);
    std::vector<std::int32_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    Grid grid;
    Team team(2);
    grid.Build(cloud.rows.data(), 3, all, 1.0, team);
    ASSERT_EQ(static_cast<std::int64_t>(grid.order().size()), count);
    const Pairs found = Near(cloud.rows, [&](auto&& candidate) {
      for (std::int64_t k = 0; k < count; ++k) {
        for (const IndexRange& range : grid.LaterNeighbors(k)) {
          for (std::int64_t m = range.begin; m < range.end; ++m) {
            candidate(grid.order()[k], grid.order()[m]);
          }
        }
      }
    });
    const Pairs expected = Near(cloud.rows, [&](auto&& candidate) {
      for (std::int64_t i = 0; i < count; ++i) {
        for (std::int64_t j = i + 1; j < count; ++j) candidate(i, j);
      }
    });
    EXPECT_EQ(found, expected);
  }
}

// A cell that must stay small: far outliers may not make the search quadratic.
TEST(Grid, OutliersDoNotMakeTheCellsLarge) {
  const NamedCloud cloud = Clouds()[6];
  std::vector<std::int32_t> all(cloud.rows.size() / 3);
  std::iota(all.begin(), all.end(), 0);
  Grid grid;
  Team team(1);
  grid.Build(cloud.rows.data(), 3, all, 1.0, team);
  std::int64_t candidates = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (const IndexRange& range : grid.LaterNeighbors(static_cast<std::int64_t>(k))) {
      candidates += std::max<std::int64_t>(range.end - range.begin, 0);
    }
  }
  EXPECT_LT(candidates, 60 * static_cast<std::int64_t>(all.size()));  // all pairs: 400 each
}

Pairs TouchingPairs(const Simulation& simulation) {
  Pairs pairs;
  const auto p = simulation.Particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      const double radii = p[i].radius + p[j].radius;
      if (base::Norm(p[j].position - p[i].position) < radii) pairs.insert({p[i].id, p[j].id});
    }
  }
  return pairs;
}

// Spheres that cross a tenth of their radius every few steps, in a closed box; each state is
// compared, so a contact that is found one step late would show.
TEST(ContactList, MissesNothingWhenSpheresMoveFast) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.particles = testing::Cloud({.per_side = 5, .speed = 4});
  scene.walls = testing::Box(5 * 2.1e-3);
  Simulation simulation(scene);
  std::size_t seen = 0;
  for (int step = 0; step < 400; ++step) {
    simulation.Advance(1);
    Pairs listed;
    for (const ContactInfo& c : simulation.Contacts()) {
      if (c.second >= 0) listed.insert({c.first, c.second});
    }
    ASSERT_EQ(listed, TouchingPairs(simulation)) << step;
    seen += listed.size();
  }
  EXPECT_GT(seen, 1000u);
  EXPECT_GT(simulation.Statistics().num_rebuilds, 10);
}

// Spheres at random, most of them small: radii from 1 to `ratio` mm with density r⁻³, as in a
// powder with much fine grain.
std::vector<Particle> SpheresUpTo(double ratio) {
  std::vector<Particle> spheres;
  for (int i = 0; i < 1200; ++i) {
    base::Random random(3, base::Stream("sizes"), i);
    const double share = random.Uniform(0, 1);
    const double radius = 1e-3 / std::sqrt(1 - share * (1 - 1 / (ratio * ratio)));
    const auto any = [&] { return random.Uniform(0, 0.06); };
    spheres.push_back({.id = i, .radius = radius, .position = {any(), any(), any()}});
  }
  return spheres;
}

// Each once, by the one that comes first. From a ratio of about six on, large ones are looked up
// in lists.
TEST(PairSearch, FindsEveryPairOnceWhateverTheSizes) {
  constexpr double kReach = 2e-4;
  for (const double ratio : {1.0, 3.0, 5.0, 10.0, 30.0}) {
    for (const KernelTable* kernels : AvailableKernels()) {
      SCOPED_TRACE(::testing::Message() << ratio << ", " << kernels->name);
      ParticleStore store;
      store.Assign(SpheresUpTo(ratio), std::vector<Material>{testing::Glass()});
      std::vector<std::int32_t> all(store.num);
      std::iota(all.begin(), all.end(), 0);
      PairSearch search;
      Team team(2);
      search.Sort(store, all, kReach, team);
      store.Reorder(search.order(), team);
      search.NoteLarge(store);
      Pairs touching, near, expected_touching, expected_near;
      for (std::int64_t i = 0; i < store.num; ++i) {
        NearSpheres found;
        search.FindLater(*kernels, store, i, found);
        for (const std::int32_t j : found.touching) EXPECT_TRUE(touching.insert({i, j}).second);
        for (const std::int32_t j : found.near) EXPECT_TRUE(near.insert({i, j}).second);
        for (std::int64_t j = i + 1; j < store.num; ++j) {
          const double gap =
              base::Norm(store.Position(j) - store.Position(i)) - store.Radius(i) - store.Radius(j);
          if (gap < kReach) (gap < 0 ? expected_touching : expected_near).insert({i, j});
        }
      }
      EXPECT_EQ(touching, expected_touching);
      EXPECT_EQ(near, expected_near);
      EXPECT_GT(near.size(), 20u);
    }
  }
}

TEST(SphereIndex, FindsEveryPairWhateverTheSizes) {
  for (const double ratio : {1.0, 3.0, 30.0}) {
    SCOPED_TRACE(ratio);
    const std::vector<Particle> spheres = SpheresUpTo(ratio);
    const auto touch = [&](std::size_t i, std::size_t j) {
      return base::Norm(spheres[i].position - spheres[j].position) <
             spheres[i].radius + spheres[j].radius;
    };
    const SphereIndex index(spheres);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      std::vector<std::size_t> found, expected;
      index.VisitNear(spheres[i].position, spheres[i].radius, [&](std::int32_t j) {
        if (touch(i, j)) found.push_back(j);
      });
      for (std::size_t j = 0; j < spheres.size(); ++j) {
        if (touch(i, j)) expected.push_back(j);
      }
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected) << i;
    }
  }
}

// 27 000 grains and one sphere that is 24 times larger: with one grid a grain would look at half of
// the others, as at the start of a scene it once did.
TEST(SphereIndex, LooksAtFewWhereOneSphereIsLarge) {
  std::vector<Particle> spheres = testing::Cloud({.per_side = 30});
  spheres.push_back({.id = -1, .radius = 24e-3, .position = {0.03, 0.03, 0.1}});
  const SphereIndex index(spheres);
  std::size_t num_looks = 0;
  for (const Particle& p : spheres) {
    index.VisitNear(p.position, p.radius, [&](std::int32_t) { ++num_looks; });
  }
  EXPECT_LT(num_looks, 60 * spheres.size());
}

// The first 14 of 28 chunks hold 640 pairs each, a quarter of which touch, and the others 16.
TEST(ContactList, SharesAreByWorkFromTheFirstStepAfterARestart) {
  ContactList list;
  list.chunks().resize(28);
  for (std::int64_t c = 0; c < 28; ++c) {
    Chunk& chunk = list.chunks()[c];
    chunk.begin = kBlock * c;
    chunk.end = chunk.window_end = kBlock * (c + 1);
    const std::int64_t num_blocks = c < 14 ? 40 : 1;
    chunk.blocks.resize(num_blocks);
    chunk.touching.assign(num_blocks, 0x1111);
    chunk.runs = {{.first_block = 0, .num_pairs = kBlock * num_blocks, .constants = 0, .wall = -1}};
  }
  list.Restored({.pairs = 5, .touching = 3});
  EXPECT_EQ(list.counts().pairs, 5);
  EXPECT_EQ(list.chunks()[0].counts.pairs, 640);
  EXPECT_EQ(list.chunks()[0].counts.touching, 160);
  Team team(2);
  list.PrepareForces(team);
  EXPECT_EQ(list.shares().Of(0).end, 8);
}

// One sphere that is small and fast among large ones at rest; sizes 1 : 8.
TEST(ContactList, FindsSmallSpheresAmongLargeOnes) {
  Scene scene = testing::EmptySpace(testing::Glass());
  for (const Particle& p : testing::Cloud({.per_side = 4, .speed = 0})) {
    scene.particles.push_back(p);
    scene.particles.push_back({.id = 1000 + p.id,
                               .radius = 1.2e-4,
                               .position = p.position + Vec3{1.05e-3, 1.05e-3, 1.05e-3},
                               .velocity = {3, 1, 2}});
  }
  Simulation simulation(scene);
  for (int step = 0; step < 300; ++step) {
    simulation.Advance(1);
    Pairs listed;
    for (const ContactInfo& c : simulation.Contacts()) listed.insert({c.first, c.second});
    ASSERT_EQ(listed, TouchingPairs(simulation)) << step;
  }
}

// The skin is at most 0.6 radii of the smallest sphere, also of one that comes after a larger: else
// it passes the disc between two lists.
TEST(ContactList, ASmallSphereThatComesLaterGoesThroughNoWallUnseen) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.materials[0].youngs_modulus = 6e4;
  scene.time_step = 2e-6;
  scene.particles = {{.id = 0, .radius = 0.01, .position = {0.1, 0, 0}}};
  scene.walls = {{.name = "disc", .shape = Disc{.center = {}, .radius = 0.01}}};
  Simulation simulation(scene);
  const std::vector<Particle> small{
      {.id = 1, .radius = 1e-4, .position = {0, 0, 1e-3}, .velocity = {0, 0, -4.5}}};
  simulation.Add(small);
  EXPECT_LE(simulation.Statistics().skin, 0.6e-4);
  EXPECT_THROW(simulation.Advance(300), base::Error);  // seen, as the law cannot hold it
}

// Deeper than the centre of the smaller no law is meant for: half of both radii would be five of
// it.
TEST(ContactList, ASmallSphereDeepInALargeOneEndsTheRun) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.materials[0].youngs_modulus = 6e4;
  scene.time_step = 1e-6;
  scene.particles = {
      {.id = 0, .radius = 2e-3, .position = {0, 0, 0}},
      {.id = 1, .radius = 2e-4, .position = {0, 0, 2.25e-3}, .velocity = {0, 0, -15}}};
  Simulation simulation(scene);
  EXPECT_THROW(simulation.Advance(100), base::Error);
}

}  // namespace neighbor_test
}  // namespace talus::engine
