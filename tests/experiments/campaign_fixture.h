// What the tests of campaigns with drawn heaps begin with, and ask of a campaign afterwards.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <list>
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
  // The same, finished. What several tests begin with is run once a program, and copied.
  std::filesystem::path Finished(const std::string& more,
                                 const FakeEngineOptions& engine = {}) const {
    static std::list<FinishedCampaign> finished;
    auto found = std::find_if(finished.begin(), finished.end(), [&](const FinishedCampaign& f) {
      return f.more == more && f.engine == engine;
    });
    if (found == finished.end()) {
      const std::string purpose = "_finished" + std::to_string(finished.size());
      found = finished.emplace(finished.end(), more, engine, purpose);
    }
    std::filesystem::copy(found->folder.path() / "run", scratch_.path() / "run",
                          std::filesystem::copy_options::recursive);
    return scratch_.path() / "run";
  }
  static std::vector<journal::TrialRecord> Trials(const std::filesystem::path& folder) {
    return journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Trials();
  }
  static Answer Result(const std::filesystem::path& folder) {
    return ParseAnswer(base::ReadFile(folder / "result.json"));
  }
  ScratchFolder scratch_;

 private:
  struct FinishedCampaign {
    FinishedCampaign(const std::string& members, const FakeEngineOptions& options,
                     const std::string& purpose)
        : more(members), engine(options), folder(purpose) {
      BeginCampaign(WriteFakeSpec(folder.path() / "in", more), folder.path() / "run");
      RunFake(folder.path() / "run", engine);
    }
    std::string more;
    FakeEngineOptions engine;
    ScratchFolder folder;
  };
};

}  // namespace talus::campaign
