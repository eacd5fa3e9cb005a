#include "engine/run/state_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/files/file.h"

namespace talus::engine {
namespace state_file_test {

std::vector<Particle> Two() {
  return {{.id = 4,
           .material = 1,
           .radius = 0.5,
           .position = {1.0 / 3, 2, -3},
           .velocity = {4, 5, 6},
           .angular_velocity = {7, 8, 9}},
          {.id = 9,
           .material = 0,
           .radius = 0.25,
           .position = {},
           .velocity = {},
           .angular_velocity = {}}};
}

TEST(StateFile, CsvHasSiColumnsAndAllDigits) {
  EXPECT_EQ(CsvOf(Two()),
            "id,type,x_m,y_m,z_m,diameter_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_"
            "per_s,wz_rad_per_s\n"
            "4,1,0.3333333333333333,2,-3,1,4,5,6,7,8,9\n"
            "9,0,0,0,0,0.5,0,0,0,0,0,0\n");
}

// Debian's own Python, which Debian's python3-vtk9 is for.
const std::string kPython = "/usr/bin/python3";

TEST(StateFile, VtkReadsTheVtpBack) {
  if (std::system((kPython + " -c 'import vtkmodules' 2>&-").c_str()) != 0) {
    GTEST_SKIP() << "Debian's python3-vtk9 is not installed";
  }
  const std::filesystem::path folder = ::testing::TempDir();
  base::WriteFileAtomically(folder / "two.vtp", VtpOf(Two(), 1.25));
  base::WriteFileAtomically(folder / "none.vtp", VtpOf({}, 0));
  const std::string command = kPython + (" " TALUS_SOURCE_DIR "/tests/engine/run/read_vtp.py ") +
                              (folder / "two.vtp").string() + " " + (folder / "none.vtp").string() +
                              " > " + (folder / "vtk.txt").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(base::ReadFile(folder / "vtk.txt"),
            "points 2 verts 2 time 1.25\n"
            "x 0.3333333333333333 2.0 -3.0\nx 0.0 0.0 0.0\n"
            "diameter_m [1.0, 0.5]\nvelocity_m_per_s [(4.0, 5.0, 6.0), (0.0, 0.0, 0.0)]\n"
            "angular_velocity_rad_per_s [(7.0, 8.0, 9.0), (0.0, 0.0, 0.0)]\n"
            "type [1, 0]\nid [4, 9]\n"
            "points 0 verts 0 time 0.0\n"
            "diameter_m []\nvelocity_m_per_s []\nangular_velocity_rad_per_s []\ntype []\nid []\n");
}

}  // namespace state_file_test
}  // namespace talus::engine
