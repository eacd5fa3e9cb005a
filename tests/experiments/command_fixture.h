// A folder of templates and the trial that an engine of one's own runs with them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/problems.h"
#include "experiments/trials/engines/command_engine.h"
#include "experiments/trials/simulate/simulate_command.h"
#include "imaging/formats/images/image_file.h"
#include "tests/error_in.h"

namespace talus::trials {

namespace fs = std::filesystem;

inline rigs::Case SmallCase() {
  rigs::Case rig_case;
  rig_case.powder.sizes.kind = engine::SizeKind::kMono;
  rig_case.powder.sizes.diameter = 1e-3;
  rig_case.powder.mass = 1e-4;  // 76 grains
  rig_case.rig.lifted_tube.plate = rigs::PlateKind::kDisc;
  rig_case.frame = imaging::Frame{.width = 40,
                                  .height = 30,
                                  .pixel_size = 5e-4,
                                  .center_x = 20,
                                  .baseline = 25,
                                  .plate_diameter = 0.01};
  return rig_case;
}

class CommandFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() /
            ("talus command " + std::to_string(::getpid()) +  // a blank, as users' folders have
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(root_ / "deck");
    options_.templates = root_ / "deck";
    options_.command = {"sh", "run.sh"};
  }
  void TearDown() override { fs::remove_all(root_); }

  void Deck(const std::string& name, const std::string& text) {
    std::ofstream(root_ / "deck" / name, std::ios::binary) << text;
  }
  std::string Text(const std::string& name) { return base::ReadFile(root_ / name); }

  // The whole trial, as a campaign has it run.
  TrialOutput Run(const rigs::Case& rig_case = SmallCase()) {
    SimulateCommandCase({.heap = rig_case, .engine = options_},
                        {.folder = root_ / "trial", .quiet = true});
    return {.profile = imaging::ReadGrayImage(root_ / "trial/profile.png"), .note = {}};
  }
  std::string FailureOf() {
    return FailureOf([&] { Run(); });
  }
  static std::string FailureOf(const std::function<void()>& action) {
    return ErrorIn<base::Error>(action);
  }
  // A property of the powder, from its default to half of that.
  static SearchedParameter Searched(const std::string& name) {
    SearchedParameter searched{.name = name, .low = SmallCase(), .high = SmallCase()};
    engine::Material::Visit(searched.high.powder.material,
                            [&](std::string_view key, double& value, base::FieldInfo) {
                              if (key == name) value /= 2;
                            });
    return searched;
  }
  std::string CheckErrors(const std::vector<SearchedParameter>& searched = {}) {
    base::Problems problems("spec.json", {});
    return ErrorIn([&] {
      CheckCommand(options_, {.rig_case = SmallCase(), .searched = searched}, problems);
      problems.ThrowIfAny();
    });
  }

  fs::path root_;
  CommandOptions options_;
};

}  // namespace talus::trials
