#include "imaging/one_thread.h"

#include <opencv2/core/utility.hpp>

namespace talus::imaging {

void KeepToOneThread() { [[maybe_unused]] static const bool done = (cv::setNumThreads(1), true); }

}  // namespace talus::imaging
