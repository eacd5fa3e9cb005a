// Every reader over its corpus: the good files that fuzzing starts from, and what it has found.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "base/files/file.h"
#include "base/random.h"
#include "tests/fuzz/targets.h"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = TALUS_SOURCE_DIR "/tests/fuzz/corpus";

std::vector<Target> AllTargets() {
  std::vector<Target> all;
  for (const auto list : {ImagingTargets(), EngineTargets(), ExperimentTargets()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

class Corpus : public testing::TestWithParam<Target> {};

std::vector<std::string> FilesOf(const Target& target) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(kCorpus / target.name)) {
    files.push_back(base::ReadFile(entry.path()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST_P(Corpus, EveryFileIsReadOrRefused) {
  const auto files = FilesOf(GetParam());
  ASSERT_FALSE(files.empty());
  for (const std::string& bytes : files) EXPECT_NO_THROW(GetParam().run(bytes));
}

// Not a search, only a guard where there is no fuzzer: cut, with bytes changed, and with a part
// doubled.
TEST_P(Corpus, DamagedFilesAreReadOrRefused) {
  const auto files = FilesOf(GetParam());
  ASSERT_FALSE(files.empty());
  for (const std::string& good : files) {
    for (std::uint64_t round = 0; round < 200 && !good.empty(); ++round) {
      base::Random random(1, base::Stream("damage"), round);
      std::string bytes = good;
      const std::size_t place = random.Below(bytes.size());
      if (round % 4 == 0) bytes.resize(place);
      if (round % 4 == 1) bytes.insert(place, bytes.substr(place / 2, 1 + random.Below(64)));
      for (std::uint64_t change = random.Below(4); change > 0 && !bytes.empty(); --change) {
        bytes[random.Below(bytes.size())] = static_cast<char>(random.Below(256));
      }
      EXPECT_NO_THROW(GetParam().run(bytes)) << "round " << round;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus, testing::ValuesIn(AllTargets()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(CorpusFolder, HasATargetForEachOfItsFolders) {
  std::set<std::string> names;
  for (const Target& target : AllTargets()) names.emplace(target.name);
  for (const auto& entry : fs::directory_iterator(kCorpus)) {
    EXPECT_TRUE(names.contains(entry.path().filename())) << entry.path();
  }
}

TEST(CorpusFolder, HasAFolderForEachTarget) {
  for (const Target& target : AllTargets()) {
    EXPECT_TRUE(fs::is_directory(kCorpus / target.name)) << target.name;
  }
}

}  // namespace
}  // namespace talus::fuzz
