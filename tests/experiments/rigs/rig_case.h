// What the tests of rigs share: a case of each kind, run, and a number that it measured.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"
#include "tests/error_in.h"

namespace talus::rigs {

inline constexpr double kDensity = 2500;  // [kg/m³]

// Grains of 1 mm, soft so that a test takes seconds.
inline Case CaseOf(RigKind kind, double sliding, double rolling, double mass) {
  Case c;
  c.powder.material = {.density = kDensity,
                       .youngs_modulus = 1e6,
                       .restitution = 0.5,
                       .sliding_friction = sliding,
                       .rolling_friction = rolling};
  c.powder.sizes = {.kind = engine::SizeKind::kUniform, .min = 0.9e-3, .max = 1.1e-3};
  c.powder.mass = mass;
  c.rig.kind = kind;
  return c;
}

inline double Value(const Case& c, const Rig& rig, const std::string& name) {
  const auto result = nlohmann::json::parse(rig.ResultText(rig.Grains(), {}));
  EXPECT_TRUE(result["observables"].contains(name)) << result.dump(2);
  EXPECT_EQ(result["kind"], base::NameOf(c.rig.kind));
  return result["observables"].value(name, std::nan(""));
}

inline std::unique_ptr<Rig> Ran(const Case& c) {
  base::Problems problems;
  ValidateCase(c, problems);
  EXPECT_TRUE(problems.empty());
  auto rig = MakeRig(c);
  while (rig->Advance()) {
  }
  return rig;
}

// A drum filmed while it turns.
inline Case Filmed() {
  Case c = CaseOf(RigKind::kDrum, 0.5, 0.1, 0.15e-3);
  c.rig.drum = {.diameter = 0.012, .width = 0.005, .speed = 10, .start_turns = 0.1, .turns = 0.1};
  c.rig.camera = {.frames = 4, .interval = 0.01, .start = 0.005};
  c.frame = imaging::Frame{.width = 130,
                           .height = 130,
                           .pixel_size = 1e-4,
                           .center_x = 65,
                           .baseline = 125,
                           .plate_diameter = 0.012};
  return c;
}

inline std::string ErrorOf(const char* text) {
  return ErrorIn([&] { LoadCase(base::ParseJson(text, "case.json")); });
}

inline std::vector<int> WallMaterialsOf(const Case& c) {
  std::vector<int> list;
  for (const engine::Wall& wall : EntryOf(c).walls(c, 0)) list.push_back(wall.material);
  return list;
}

}  // namespace talus::rigs
