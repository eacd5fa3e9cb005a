// Two heaps side by side, for people.
#pragma once

#include <filesystem>

#include "imaging/gray_image.h"

namespace talus::analysis {

// Two images of equal size side by side; makes the folder where it is missing.
void WriteHeapPair(const std::filesystem::path& path, const imaging::GrayImage& left,
                   const imaging::GrayImage& right);

}  // namespace talus::analysis
