#include <string>

#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "engine/run/run.h"
#include "engine/scene/scene_json.h"
#include "engine/simulation.h"
#include "tests/fuzz/targets.h"

namespace talus::fuzz {
namespace {

void Json(std::string_view bytes) {
  Expect([&] { base::ParseJson(bytes, "file.json"); });
}

// Read and validated, not built: a million spheres are valid.
void Scene(std::string_view bytes) {
  Expect([&] { base::LoadOptions<engine::SceneSpec>(base::ParseJson(bytes, "scene.json")); });
}

void SizeFile(std::string_view bytes) {
  Expect([&] {
    engine::SizeDistribution sizes;
    sizes.kind = engine::SizeKind::kFile;
    sizes.file = "sizes.csv";
    engine::ReadSizeText(std::string(bytes), sizes);
  });
}

void SphereFile(std::string_view bytes) {
  Expect([&] {
    const std::vector<engine::NamedMaterial> materials = {{.name = "sand", .material = {}}};
    engine::ReadSphereText(bytes, {.file = "spheres.csv", .material = ""}, materials);
  });
}

// Behind the checksums as well, which damage does not get past.
std::string WithItsChecksum(std::string_view rest) {
  return "talus run 1\n" + base::Hex(base::Checksum(rest)) + "\n" + std::string(rest);
}

void Checkpoint(std::string_view bytes) {
  Expect([&] { engine::Unpack(std::string(bytes)); });
  Expect([&] { engine::Unpack(WithItsChecksum(bytes)); });
  Expect([&] { engine::Simulation::Restore(bytes, 1); });
}

constexpr Target kTargets[] = {{"json", Json},
                               {"scene", Scene},
                               {"size_file", SizeFile},
                               {"sphere_file", SphereFile},
                               {"checkpoint", Checkpoint}};

}  // namespace

std::span<const Target> EngineTargets() { return kTargets; }

}  // namespace talus::fuzz
