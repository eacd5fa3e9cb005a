// Another DEM engine: a folder of template files and a command (docs/foreign_engines.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "base/vec3.h"

namespace talus::trials {

// The direction in the engine's own coordinates that points away from the plate.
enum class UpAxis { kX, kY, kZ };
constexpr UpAxis LastOf(UpAxis) { return UpAxis::kZ; }

struct CommandOptions {
  std::optional<std::filesystem::path>
      templates{};                   // a folder; all it holds goes into a trial's folder, filled in
  std::vector<std::string> command;  // run in the trial's folder; may hold placeholders
  std::optional<int> ranks{};        // MPI processes of a trial, >= 1; default: 1
  std::string result = "heap.*";     // file the command leaves, `*` and `?` allowed
  std::optional<double> length_unit{};  // of the result [m]; default: what the file says, else 1 m
  UpAxis up = UpAxis::kZ;
  base::Vec3 plate_center;       // of the plate's top in the engine's coordinates [m]
  std::string templates_hash{};  // of what the folder held when the campaign began

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("templates", self.templates, {.doc = "folder of input files with {{ placeholders }}"});
    visit("command", self.command, {.doc = "program and arguments, run in the trial's folder"});
    visit("ranks", self.ranks,
          {.doc = "MPI processes of a trial, >= 1: `mpirun -np` is put in front of the command "
                  "unless it or a template has {{ ranks }}; default: 1"});
    visit("result", self.result,
          {.doc = "file the command leaves: spheres, or a PNG that is the profile; of several the "
                  "last in natural order"});
    visit("length_unit", self.length_unit,
          {.dimension = kLength, .doc = "one length unit of the result, > 0; default: 1 m"});
    visit("up", self.up, {.doc = "axis of the engine that points away from the plate"});
    visit("plate_center", self.plate_center,
          {.dimension = kLength, .doc = "of the plate's top in the engine's coordinates"});
    visit("templates_hash", self.templates_hash,
          {.doc = "filled in by the program, so that changed templates are noticed"});
  }
  void Validate(base::Problems& problems) const;
  std::filesystem::path ResultPath() const;  // `result`, where "./heap.*" is "heap.*"
  bool operator==(const CommandOptions&) const = default;
};

}  // namespace talus::trials
