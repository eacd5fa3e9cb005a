// Whether the photographs of a run, one behind the other, are of several heaps although their names
// say they are views of one.
//
// From heap to heap powder is weighed, filled in and lifted: minutes pass, and the plate is put
// back a little elsewhere. From view to view the plate only turns. So one step between neighbours
// stands out, of these in turn: the time of exposure (EXIF, or the date and time in the name), the
// number in the name, the plate's place, the outline. Nothing is said unless the large steps stand
// clearly apart from the others and leave two photographs at least of each heap.
#pragma once

#include <optional>

#include "imaging/photos/experiment.h"
#include "imaging/photos/photo_warning.h"

namespace talus::imaging {

// The doubt, at the first photograph of the second heap; nothing where the run looks like one heap.
std::optional<PhotoWarning> DoubtOfOneHeap(const MeasuredRun& run);

}  // namespace talus::imaging
