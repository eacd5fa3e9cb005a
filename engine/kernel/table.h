// The kernels of one instruction set. Included last by kernel_<set>.cc, which names TALUS_TARGET.
#pragma once

#include "engine/kernel/forces.h"
#include "engine/kernel/integrate.h"
#include "engine/kernel/search.h"

namespace talus::engine::TALUS_TARGET {

template <class... Row>
constexpr void FillRow(ForcesFunction* row, LawList<Row...>) {
  ((*row++ = Forces<Row>), ...);
}
template <class... Rows>
constexpr void FillRows(KernelTable& table, LawList<Rows...>) {
  int row = 0;
  (FillRow(table.forces[row++], Rows{}), ...);
}

constexpr KernelTable MakeTable(const char* name) {
  KernelTable table{};
  table.name = name;
  table.width = Lanes::kWidth;
  FillRows(table, LawRows{});
  table.integrate = Integrate;
  table.round_motion = RoundMotion;
  table.search = Search;
  table.displacements = LargestDisplacements;
  table.wall_gaps = WallGaps;
  return table;
}

}  // namespace talus::engine::TALUS_TARGET
