// The masses that a balance shows after a heap test: what lies on the plate, and what has fallen.
#pragma once

#include <algorithm>

namespace talus::rigs {

// In one unit, of mass or of volume.
struct HeapBalance {
  double filled = 0;
  double present = 0;       // still in the scene
  double on_plate = 0;      // the heap
  double fallen_share = 1;  // of what has left the scene; the rest was carried away by the tube
};

// The heap is on the plate; what is neither of it nor carried away has fallen, or is about to.
inline double Fallen(const HeapBalance& b) {
  const double gone = std::max(0.0, b.filled - b.present);
  return gone * b.fallen_share + (b.present - b.on_plate);
}

}  // namespace talus::rigs
