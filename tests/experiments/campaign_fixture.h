// What the tests of campaigns with drawn heaps begin with, and ask of a campaign afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "tests/experiments/fake_heap.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::campaign {

class CampaignFixture : public ::testing::Test {
 protected:
  // `more` are further members of the spec.
  std::filesystem::path Begin(const std::string& more, const std::string& name = "run") const {
    const std::filesystem::path spec = WriteFakeSpec(scratch_.path() / (name + "_in"), more);
    BeginCampaign(spec, scratch_.path() / name);
    return scratch_.path() / name;
  }
  static std::vector<journal::TrialRecord> Trials(const std::filesystem::path& folder) {
    return journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Trials();
  }
  static Answer Result(const std::filesystem::path& folder) {
    return ParseAnswer(base::ReadFile(folder / "result.json"));
  }
  ScratchFolder scratch_;
};

}  // namespace talus::campaign
