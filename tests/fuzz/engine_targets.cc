#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/file.h"
#include "base/json_reader.h"
#include "engine/run/run.h"
#include "engine/scene/scene_json.h"
#include "engine/simulation.h"
#include "tests/fuzz/targets.h"

namespace talus::fuzz {
namespace {

// In memory where there is such a folder.
std::filesystem::path ScratchFile(const char* name) {
  const std::filesystem::path memory = "/dev/shm";
  return (std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
         ("talus_fuzz_" + std::to_string(::getpid()) + name);
}

void Json(std::string_view bytes) {
  Expect([&] { base::ParseJson(bytes, "file.json"); });
}

// Read and validated, not built: a million spheres are valid.
void Scene(std::string_view bytes) {
  Expect([&] { base::LoadOptions<engine::SceneSpec>(base::ParseJson(bytes, "scene.json")); });
}

void SizeFile(std::string_view bytes) {
  static const std::filesystem::path file = ScratchFile("sizes.csv");
  Expect([&] {
    base::WriteFileAtomically(file, bytes, base::Outlives::kProgram);
    engine::SizeDistribution sizes;
    sizes.kind = engine::SizeKind::kFile;
    sizes.file = file;
    engine::ReadSizeFile(sizes);
  });
  std::filesystem::remove(file);
}

void Checkpoint(std::string_view bytes) {
  Expect([&] { engine::Unpack(std::string(bytes)); });
  Expect([&] { engine::Simulation::Restore(bytes, 1); });
}

constexpr Target kTargets[] = {
    {"json", Json}, {"scene", Scene}, {"size_file", SizeFile}, {"checkpoint", Checkpoint}};

}  // namespace

std::span<const Target> EngineTargets() { return kTargets; }

}  // namespace talus::fuzz
