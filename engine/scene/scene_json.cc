#include "engine/scene/scene_json.h"

#include <algorithm>
#include <iterator>

#include "base/json/json_reader.h"
#include "base/json/json_writer.h"
#include "base/replaced.h"

namespace talus::engine {
namespace {

// The solver knows of particles; in the file they are spheres, in order, then those of
// sphere_files, and then those of fills.
constexpr std::string_view kParticles = "particles[";

struct NumSpheres {
  std::size_t stated = 0;
  std::size_t with_files = 0;
};

std::string SphereInFile(const std::string& index, const NumSpheres& num) {
  const std::size_t i = std::stoul(index);
  if (i < num.stated) return "spheres[" + index + "]";
  return i < num.with_files ? "a sphere of sphere_files" : "a sphere of a fill";
}

std::string PathInFile(const std::string& path, const NumSpheres& num) {
  if (!path.starts_with(kParticles)) return path;
  const std::size_t index = std::stoul(path.substr(kParticles.size()));
  if (index >= num.with_files) return "fills";
  if (index >= num.stated) return "sphere_files";
  std::string in_file = "spheres[" + path.substr(kParticles.size());
  constexpr std::string_view kRadius = ".radius";
  if (in_file.ends_with(kRadius)) {
    in_file.replace(in_file.size() - kRadius.size(), kRadius.size(), ".diameter");
  }
  return in_file;
}

base::Problem InFile(base::Problem problem, const NumSpheres& num) {
  std::string& message = problem.message;
  if (const auto at = message.find(kParticles); at != std::string::npos) {
    const auto end = message.find(']', at);
    const auto first = at + kParticles.size();
    message.replace(at, end + 1 - at, SphereInFile(message.substr(first, end - first), num));
  }
  problem.path = PathInFile(problem.path, num);
  if (problem.path == "sphere_files") {
    return {.path = problem.path, .message = "one of their spheres " + problem.Text()};
  }
  if (problem.path != "fills") return problem;
  return {.path = problem.path,
          .message = "a sphere " + problem.Text() +
                     " (is the fill's region inside the walls and free of spheres?)"};
}

// What many spheres of a fill do is said once.
bool IsKnown(const base::Problem& problem, const base::Problems& problems) {
  const std::string message = base::Replaced(problem.message, "; more are not listed", "");
  return std::ranges::any_of(problems.list(), [&](const base::Problem& known) {
    return known.path == problem.path && known.message == message;
  });
}

}  // namespace

LoadedScene LoadScene(const std::filesystem::path& path) {
  return LoadScene(base::ReadJsonFile(path));
}

LoadedScene LoadScene(base::JsonFile file) {
  const std::filesystem::path path = file.path;
  LoadedScene loaded{.spec = base::LoadOptions<SceneSpec>(file), .scene = {}};
  file.root = nullptr;  // a million spheres take a gigabyte
  const std::size_t num_stated = loaded.spec.spheres.size();
  for (FillSpec& fill : loaded.spec.fills) ReadSizeFile(fill.sizes);
  for (PourSpec& pour : loaded.spec.pours) ReadSizeFile(pour.sizes);
  base::Problems problems(path.string(), file.places);
  if (!loaded.spec.sphere_files.empty()) {
    ReadSphereFiles(loaded.spec);
    loaded.spec.Validate(problems);
    problems.ThrowIfAny();
  }
  try {
    loaded.scene = BuildScene(loaded.spec);
    const double dt = TimeStep(loaded.scene);
    for (const Pour& pour : BuildPours(loaded.spec, dt, std::ssize(loaded.scene.particles))) {
      for (std::size_t i = 0; i < loaded.scene.walls.size(); ++i) {
        problems.Within("walls[" + std::to_string(i) + "]", [&] {
          ValidateSpeed(loaded.scene.walls[i], pour.SmallestRadius(), dt, problems);
        });
      }
    }
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(path.string() + ": " + error.what());
  }
  base::Problems found;
  loaded.scene.Validate(found);
  constexpr std::size_t kMost = 50;  // overlapping spheres may be many
  for (std::size_t i = 0; i < std::min(kMost, found.list().size()); ++i) {
    const base::Problem problem =
        InFile(found.list()[i], {.stated = num_stated, .with_files = loaded.spec.spheres.size()});
    if (!IsKnown(problem, problems)) problems.Add(problem);
  }
  if (found.size() > kMost) {
    problems.Add("", std::to_string(found.size() - kMost) + " more problems like these");
  }
  problems.ThrowIfAny();
  return loaded;
}

std::string SceneText(const SceneSpec& spec) { return base::JsonTextWriter::TextOf(spec); }

}  // namespace talus::engine
