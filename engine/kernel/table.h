// The kernels of one instruction set. Included last by kernel_<set>.cc, which names TALUS_TARGET.
#pragma once

#include "engine/kernel/forces.h"
#include "engine/kernel/integrate.h"
#include "engine/kernel/search.h"

namespace talus::engine::TALUS_TARGET {

// One row of the table for each normal law, one column for each rolling law.
template <class Normal, class... Rollings>
constexpr void FillRow(ForcesFunction* row, LawList<Rollings...>) {
  ((*row++ = Forces<Normal, Rollings>), ...);
}
template <class... Normals>
constexpr void FillRows(KernelTable& table, LawList<Normals...>) {
  int row = 0;
  (FillRow<Normals>(table.forces[row++], RollingLaws{}), ...);
}

constexpr KernelTable MakeTable(const char* name) {
  KernelTable table{};
  table.name = name;
  table.width = Lanes::kWidth;
  FillRows(table, NormalLaws{});
  table.integrate = Integrate;
  table.round_motion = RoundMotion;
  table.search = Search;
  table.displacements = LargestDisplacements;
  table.wall_gaps = WallGaps;
  return table;
}

}  // namespace talus::engine::TALUS_TARGET
