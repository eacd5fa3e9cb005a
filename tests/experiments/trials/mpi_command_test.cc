// How the ranks of an engine of one's own are started.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/experiments/command_fixture.h"

namespace talus::trials {
namespace mpi_command_test {

using ::testing::HasSubstr;

// A launcher that starts one process and tells what it was asked for stands first on the PATH.
class MpiCommand : public CommandFixture {
 protected:
  void SetUp() override {
    CommandFixture::SetUp();
    path_ = std::getenv("PATH");
    fs::create_directories(root_ / "bin");
    ::setenv("PATH", ((root_ / "bin").string() + ":" + path_).c_str(), 1);
    Deck("run.sh", "echo x,y,z,r >heap.csv; echo 0,0,1e-3,1e-3 >>heap.csv; echo ran $* >ran\n");
  }
  void TearDown() override {
    ::setenv("PATH", path_.c_str(), 1);
    CommandFixture::TearDown();
  }
  void PutLauncher() {
    const fs::path launcher = root_ / "bin/mpirun";
    std::ofstream(launcher) << "#!/bin/sh\necho \"$*\" >launched; shift 2; exec \"$@\"\n";
    ::chmod(launcher.c_str(), 0755);
  }
  std::string path_;
};

TEST_F(MpiCommand, RanksAreStartedByMpirun) {
  PutLauncher();
  options_.ranks = 3;
  Run();
  EXPECT_EQ(Text("trial/launched"), "-np 3 sh run.sh\n");
  EXPECT_EQ(Text("trial/ran"), "ran\n");
}

TEST_F(MpiCommand, ACommandThatKnowsItsRanksStartsThemItself) {
  PutLauncher();
  options_.ranks = 3;
  options_.command = {"sh", "run.sh", "-n", "{{ ranks }}"};
  Run();
  EXPECT_FALSE(fs::exists(root_ / "trial/launched"));
  EXPECT_EQ(Text("trial/ran"), "ran -n 3\n");
  options_.ranks.reset();
  fs::remove_all(root_ / "trial");
  Run();
  EXPECT_EQ(Text("trial/ran"), "ran -n 1\n");
}

// Each of the ranks would start as many.
TEST_F(MpiCommand, MpirunWithinMpirunIsRefused) {
  PutLauncher();
  options_.ranks = 2;
  options_.command = {"mpirun", "-np", "2", "sh", "run.sh"};
  EXPECT_THAT(CheckErrors(), HasSubstr("command: begins with mpirun"));
  options_.command = {"mpirun", "-np", "{{ ranks }}", "sh", "run.sh"};
  EXPECT_EQ(CheckErrors(), "");
  options_.command = {"mpirun", "-np", "2", "sh", "run.sh"};
  options_.ranks = 1;
  EXPECT_EQ(CheckErrors(), "");
}

TEST_F(MpiCommand, AMissingLauncherIsFoundBeforeAnythingRuns) {
  options_.ranks = 2;
  ::setenv("PATH", (root_ / "bin").c_str(), 1);
  EXPECT_THAT(CheckErrors(), HasSubstr("ranks: mpirun is not found"));
  options_.ranks = 1;
  EXPECT_THAT(CheckErrors(), ::testing::Not(HasSubstr("mpirun")));
}

}  // namespace mpi_command_test
}  // namespace talus::trials
