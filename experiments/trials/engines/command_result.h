// What another engine leaves in a trial's folder, made comparable with the experiment.
#pragma once

#include <filesystem>
#include <vector>

#include "base/sphere.h"
#include "experiments/rigs/lifted_tube/heap_case.h"
#include "experiments/trials/engines/command_options.h"

namespace talus::experiments {

// The file that `engine.result` means: of several the last in natural order (heap_9 < heap_10).
// Throws base::Error, with the end of the log, when there is none.
std::filesystem::path FindResult(const CommandOptions& engine, const std::filesystem::path& folder);

// Takes away what an earlier attempt has left under that name.
void RemoveResults(const CommandOptions& engine, const std::filesystem::path& folder);

// Turned so that up is z, and moved so that the plate's centre is the origin.
std::vector<base::Sphere> OnOurPlate(const CommandOptions& engine,
                                     std::vector<base::Sphere> spheres);

// Whether "heap_9" comes before "heap_10".
bool NaturalLess(const std::string& a, const std::string& b);

}  // namespace talus::experiments
