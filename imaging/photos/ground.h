// What powder stands on in photographs.
#pragma once

namespace talus::imaging {

enum class Ground {
  kPlate,  // what is beside it is no powder of the test
  kFloor   // all of the frame's width, as of a column that has collapsed
};

}  // namespace talus::imaging
