#include "base/files/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vector>

#include "base/error.h"
#include "base/files/output_folder.h"
#include "tests/peak_memory.h"

namespace talus::base {
namespace file_test {

namespace fs = std::filesystem;

class FileTest : public ::testing::Test {
 protected:
  FileTest() : folder_(fs::temp_directory_path() / ("talus_file_test" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~FileTest() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(FileTest, WrittenBytesAreReadBackAndReplaceTheOldOnes) {
  const std::string bytes("a\0b\n", 4);
  WriteFileAtomically(folder_ / "f", "old and longer");
  WriteFileAtomically(folder_ / "f", bytes);
  EXPECT_EQ(ReadFile(folder_ / "f"), bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, FailedWriteLeavesNothingBehind) {
  fs::create_directories(folder_ / "target");  // rename onto a folder fails
  EXPECT_THROW(WriteFileAtomically(folder_ / "target", "x"), Error);
  EXPECT_THROW(WriteFileAtomically(folder_ / "absent" / "f", "x"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, MissingFileAndFolderAreBadInput) {
  EXPECT_THROW(ReadFile(folder_ / "absent"), ConfigError);
  EXPECT_THROW(ReadFile(folder_), ConfigError);
}

// A pipe that nobody writes to was waited for, and /dev/zero filled the memory.
TEST_F(FileTest, PipesDevicesAndHugeFilesAreBadInput) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(ReadFile(folder_ / "pipe"), ConfigError);
  EXPECT_THROW(ReadFile("/dev/zero"), ConfigError);
  WriteFileAtomically(folder_ / "f", "12345");
  EXPECT_EQ(ReadFile(folder_ / "f", 5), "12345");
  EXPECT_THROW(ReadFile(folder_ / "f", 4), ConfigError);
}

TEST_F(FileTest, TailIsTheLastBytes) {
  WriteFileAtomically(folder_ / "f", "12345");
  EXPECT_EQ(ReadTail(folder_ / "f", 2), "45");
  EXPECT_EQ(ReadTail(folder_ / "f", 9), "12345");
  EXPECT_EQ(ReadTail(folder_ / "absent", 9), "");
}

// A log of 1 GB was read as a whole for its last lines.
TEST_F(FileTest, TheTailOfAHugeFileTakesNoMemory) {
  WriteFileAtomically(folder_ / "log", "");
  fs::resize_file(folder_ / "log", std::uintmax_t{1} << 30);  // takes no room on the disk
  const long before = PeakMegabytes();
  EXPECT_EQ(ReadTail(folder_ / "log", 4096), std::string(4096, '\0'));
  EXPECT_LT(PeakMegabytes() - before, 50);
}

TEST_F(FileTest, OnlyFilesWhoseNamesBeginSoAreRemoved) {
  for (const char* name : {"run_01.png", "run_01.json", "notes.txt", "my_run_01.png"}) {
    WriteFileAtomically(folder_ / name, "x");
  }
  fs::create_directories(folder_ / "run_more");
  RemoveFormerFiles(folder_, "run_");
  RemoveFormerFiles(folder_ / "absent", "run_");
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    left.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(left, testing::UnorderedElementsAre("notes.txt", "my_run_01.png", "run_more"));
}

// The reference value is XXH3's published one for no bytes at all with seed 0.
TEST(Checksum, IsXxh3) { EXPECT_EQ(Hex(Checksum("")), "2d06800538d394c2"); }

}  // namespace file_test
}  // namespace talus::base
