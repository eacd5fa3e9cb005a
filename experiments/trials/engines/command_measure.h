// What another engine's command has left in a trial's folder, measured.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/journal/records.h"
#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/command_options.h"
#include "imaging/gray_image.h"

namespace talus::trials {

struct Measured {
  std::vector<std::filesystem::path> files{};  // the command's
  imaging::GrayImage profile;
  std::size_t num_spheres = 0;  // in the file
  std::size_t num_grains = 0;   // of the heap
  std::vector<journal::MetricRecord> scalars{};
  std::string doubt{};  // what nobody can have meant, in words
};

// The file that the command has left: the one that was measured here before, if any, else the last
// by name. Throws base::Error where there is none, or none that is clearly meant (FindResult).
std::filesystem::path ResultOf(const CommandOptions& options, const std::filesystem::path& folder);

// Spheres or an image where there is a frame, numbers, or both. Writes profile.png and heap.vtp.
// Throws base::Error that says what is missing or cannot be.
Measured MeasureResult(const CommandOptions& options, const rigs::Case& rig_case,
                       const std::filesystem::path& folder);

}  // namespace talus::trials
