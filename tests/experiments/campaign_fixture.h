// What the tests of campaigns with drawn heaps begin with, and ask of a campaign afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "tests/experiments/fake_heap.h"
#include "tests/experiments/finished_campaigns.h"
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
  // The same, finished. What several tests begin with is run once a program, and copied; so its
  // spec is not this test's to edit.
  std::filesystem::path Finished(const std::string& more, const FakeEngineOptions& engine = {},
                                 const std::string& name = "run") const {
    static FinishedCampaigns<std::pair<std::string, FakeEngineOptions>> campaigns;
    campaigns.Copy({more, engine}, scratch_.path() / name, [&](const std::filesystem::path& in) {
      BeginCampaign(WriteFakeSpec(in / "in", more), in / "run");
      EXPECT_EQ(RunFake(in / "run", engine), CampaignEnd::kFinished);
    });
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
