// A trial's heap for ParaView: grains, plate and tube as VTK files, and a state that opens them
// coloured.
#pragma once

#include <filesystem>
#include <optional>

namespace talus::analysis {

struct VtkExport {
  std::filesystem::path campaign;
  std::filesystem::path out;            // folder to write into
  std::optional<std::int64_t> trial{};  // default: one of the recommended set, else the best so far
};

// Writes heap.vtp, a file for each wall, and state.py; returns the state's path. Throws ConfigError
// where the trial has left no spheres.
std::filesystem::path ExportVtk(const VtkExport& request);

}  // namespace talus::analysis
