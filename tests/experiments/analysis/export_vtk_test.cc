#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "experiments/analysis/export/paraview.h"
#include "tests/error_in.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::analysis {
namespace export_vtk_test {

using testing::HasSubstr;

// Another trial was advised where none could have spheres: a deck that leaves numbers alone.
TEST(ExportVtk, AnotherTrialIsAdvisedWhereOneHasSpheres) {
  const ScratchFolder scratch;
  const auto refused = [&] {
    return ErrorIn([&] {
      ExportVtk({.campaign = scratch.path(), .out = scratch.path() / "vtk", .trial = 1});
    });
  };
  EXPECT_THAT(refused(), HasSubstr("no trial here has left spheres"));
  std::filesystem::create_directories(scratch.path() / "trials/0002");
  std::ofstream(scratch.path() / "trials/0002/heap.vtp") << "x";
  EXPECT_THAT(refused(), HasSubstr("--trial names another trial"));
}

}  // namespace export_vtk_test
}  // namespace talus::analysis
