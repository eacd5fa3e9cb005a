// What a rebuild of the neighbour list spends its time in: pairs of a cell and its neighbours,
// distances from walls, displacements since the last rebuild.
#pragma once

#include "engine/kernel/shapes.h"
#include "engine/kernel/simd.h"

namespace talus::engine::TALUS_TARGET {

TALUS_INLINE std::int32_t* Append(std::int32_t* to, unsigned bits, std::int64_t from) {
  for (; bits != 0; bits &= bits - 1) {
    *to++ = static_cast<std::int32_t>(from + __builtin_ctz(bits));
  }
  return to;
}

void Search(const CloudView& cloud, const SearchQuery& query, SearchLists& lists) {
  const Vector<Lanes> at{Lanes(cloud.x[query.i]), Lanes(cloud.y[query.i]), Lanes(cloud.z[query.i])};
  const Lanes radius(cloud.radius[query.i]);
  std::int32_t* touching = lists.touching + lists.num_touching;
  std::int32_t* near = lists.near + lists.num_near;
  for (std::int64_t j = query.begin; j < query.end; j += Lanes::kWidth) {
    const Vector<Lanes> offset{Lanes::Load(cloud.x + j) - at.x, Lanes::Load(cloud.y + j) - at.y,
                               Lanes::Load(cloud.z + j) - at.z};
    const Lanes radii = Lanes::Load(cloud.radius + j) + radius;
    const Lanes square = Dot(offset, offset);
    const Lanes reach = radii + Lanes(query.reach);
    const Mask valid = Lanes::Iota() < Lanes(static_cast<double>(query.end - j));
    const unsigned found = Bits(valid & (square < reach * reach));
    if (found == 0) continue;
    const unsigned touches = Bits(valid & (square < radii * radii));
    touching = Append(touching, touches, j);
    near = Append(near, found & ~touches, j);
  }
  lists.num_touching = touching - lists.touching;
  lists.num_near = near - lists.near;
}

// Both maxima over all lanes; a NaN counts as none, the speed limit has caught it before.
Displacements LargestDisplacements(const CloudView& cloud, const double* motion, std::int64_t begin,
                                   std::int64_t end) {
  const std::int32_t index[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  Lanes first(0.0), second(0.0);
  for (std::int64_t at = begin; at < end; at += Lanes::kWidth) {
    const Quads now = LoadQuads(motion + 8 * at, 8, index);
    const Vector<Lanes> moved{now.x - Lanes::Load(cloud.x + at), now.y - Lanes::Load(cloud.y + at),
                              now.z - Lanes::Load(cloud.z + at)};
    const Lanes square = Dot(moved, moved);
    second = Max(second, Min(first, square));
    first = Max(first, square);
  }
  double lanes[2 * Lanes::kWidth] = {};
  first.Store(lanes);
  second.Store(lanes + Lanes::kWidth);
  Displacements found{0, 0};
  for (double square : lanes) {
    if (square > found.largest_squared) {
      found.second_squared = found.largest_squared;
      found.largest_squared = square;
    } else if (square > found.second_squared) {
      found.second_squared = square;
    }
  }
  return found;
}

void WallGaps(const StepView& step, std::int64_t wall, std::int64_t begin, std::int64_t end,
              double* gap) {
  const std::int32_t index[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const WallView view = step.walls[wall];
  for (std::int64_t at = begin; at < end; at += Lanes::kWidth) {
    const Quads q = LoadQuads(step.motion + 8 * at, 8, index);
    const Vector<Lanes> x{q.x, q.y, q.z};
    (Nearest(view, x).distance - q.w).Store(gap + (at - begin));
  }
}

}  // namespace talus::engine::TALUS_TARGET
