// What another engine leaves in a trial's folder, made comparable with the experiment.
#pragma once

#include <filesystem>
#include <vector>

#include "base/sphere.h"
#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/command_options.h"

namespace talus::trials {

// The file that `engine.result` means: of several the last in natural order (heap_9 < heap_10).
// One of before `started`, a file of the trial's start, is none of this trial, where it lies
// elsewhere or was copied here with its former time, a minute old or more. Throws base::Error, with
// the end of the log, when there is none.
std::filesystem::path FindResult(const CommandOptions& engine, const std::filesystem::path& folder,
                                 const std::filesystem::path& started);

// Takes away what an earlier attempt has left under that name.
void RemoveResults(const CommandOptions& engine, const std::filesystem::path& folder);

// Takes away what an attempt that did not end has left under any name: a command may fail on it,
// such as `mkdir post`. Hidden files are the runner's, and stay.
void RemoveFormer(const std::filesystem::path& folder);

// Whether a file of this name, relative to the trial's folder, would be taken for the result.
bool IsResultName(const CommandOptions& engine, const std::filesystem::path& name);

// Whether a trial's heap.vtp is the engine's own file; it is ours where the result is another.
bool HasLeftHeapVtp(const CommandOptions& engine, const std::filesystem::path& folder);

// Turned so that up is z, and moved so that the plate's centre is the origin.
std::vector<base::Sphere> OnOurPlate(const CommandOptions& engine,
                                     std::vector<base::Sphere> spheres);

// The spheres of a file that the engine has left, so turned and moved [m].
std::vector<base::Sphere> ReadOnOurPlate(const CommandOptions& engine,
                                         const std::filesystem::path& file);

// Those of them that its image shows: what lies on a lifted tube's plate, from the base of the heap
// upwards.
std::vector<base::Sphere> ShownOf(const rigs::Case& rig_case, std::vector<base::Sphere> spheres);

// The diameter of the plate that its image shows [m].
double ShownPlate(const rigs::Case& rig_case);

// The heap of a trial's heap.vtp, whichever engine has left it, as its image shows it [m]. Throws
// base::Error, or a ConfigError of its case.json, where one of them cannot be read.
std::vector<base::Sphere> HeapOfTrial(const std::filesystem::path& folder);

// Whether "heap_9" comes before "heap_10".
bool NaturalLess(const std::string& a, const std::string& b);

}  // namespace talus::trials
