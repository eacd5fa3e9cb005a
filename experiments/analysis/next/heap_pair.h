// Two heaps side by side, for people.
#pragma once

#include <filesystem>

#include "imaging/gray_image.h"

namespace talus::analysis {

// Of equal size; makes the folder where it is missing.
void WriteHeapPair(const std::filesystem::path& path, const imaging::GrayImage& left,
                   const imaging::GrayImage& right);

}  // namespace talus::analysis
