// Scenes as JSON files (docs/scene.md).
#pragma once

#include <filesystem>
#include <string>

#include "base/json/json_file.h"
#include "engine/scene/scene_spec.h"

namespace talus::engine {

struct LoadedScene {
  SceneSpec spec;  // complete: a size file's content has moved into it
  Scene scene;
};

// Reads, builds and validates a scene; throws one ConfigError with everything that is wrong, by
// JSON path and line: what the solver refuses (overlaps, the time step) too.
LoadedScene LoadScene(const std::filesystem::path& path);
LoadedScene LoadScene(base::JsonFile file);

// The spec as a scene.json that needs no other file.
std::string SceneText(const SceneSpec& spec);

}  // namespace talus::engine
