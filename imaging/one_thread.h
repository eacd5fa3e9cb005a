// OpenCV on one thread: photographs and trials run side by side already (base/parallel_for.h), and
// its own threads would spin between them.
#pragma once

namespace talus::imaging {

// To be called before what OpenCV would spread over threads.
void KeepToOneThread();

}  // namespace talus::imaging
