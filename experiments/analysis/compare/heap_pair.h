// Two heaps of one test with what tells them apart, for people.
#pragma once

#include <filesystem>

#include "imaging/color_image.h"
#include "imaging/gray_image.h"
#include "imaging/heap/profile.h"

namespace talus::analysis {

// The two heaps side by side, cut to where they are, and their signed difference: red where only
// the first has powder, blue where only the second has; with their SAD and the place where they
// differ most. Both have one frame.
imaging::ColorImage DrawHeapPair(const imaging::Profile& first, const imaging::Profile& second);

// … into a PNG; makes the folder where it is missing.
void WriteHeapDifference(const std::filesystem::path& path, const imaging::Profile& first,
                         const imaging::Profile& second);

// Two images of equal size side by side, where no frame says where they stand.
void WriteHeapPair(const std::filesystem::path& path, const imaging::GrayImage& left,
                   const imaging::GrayImage& right);

}  // namespace talus::analysis
