// `talus resume --search`: a parameter that is searched from now on.
#include "experiments/campaign/add_parameter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/campaign/answer/nuisances.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace add_parameter_test {

using ::testing::HasSubstr;

// Heaps; the drawn ones do not depend on the restitution.
constexpr const char* kHeaps = R"(, "budget": {"simulations": 20}, "workers": 1,
    "confirm": {"candidates": 1, "replicates": 2}, "coarse_graining": {"scale_factor": 2})";

class AddedParameters : public CampaignFixture {
 protected:
  std::string ErrorOf(const std::filesystem::path& folder, const std::string& search) const {
    Console console(folder / "campaign.log", Console::Output::kQuiet);
    ResumeOptions options;
    options.search = {search};
    return ErrorIn([&] { OpenCampaign(folder, options, console); });
  }
};

ResumeOptions Search(const std::string& text) {
  ResumeOptions options;
  options.search = {text};
  return options;
}

// The folder's `material` leaves the restitution at its default.
TEST_F(AddedParameters, LeaveTheTrialsWhereTheyWere) {
  const auto folder = Finished(kHeaps);
  const auto before = Trials(folder);
  const double restitution = engine::Material().restitution;
  ASSERT_EQ(RunFake(folder, {}, Search("restitution=0.3..0.95")), CampaignEnd::kFinished);
  const auto after = Trials(folder);
  ASSERT_GE(after.size(), before.size() + 16);
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(after[i].native.size(), 3u);
    EXPECT_EQ(after[i].native[0], before[i].native[0]);
    EXPECT_EQ(after[i].native[1], before[i].native[1]);
    EXPECT_EQ(after[i].native[2], restitution);
    EXPECT_EQ(after[i].Metric("sad_mm2"), before[i].Metric("sad_mm2"));
    EXPECT_EQ(after[i].finish_order, before[i].finish_order);
  }
  // The first of the new ones are all over its range.
  double low = 1;
  double high = 0;
  for (std::size_t i = before.size(); i < before.size() + 8; ++i) {
    low = std::min(low, after[i].native[2]);
    high = std::max(high, after[i].native[2]);
  }
  EXPECT_LT(low, 0.45);
  EXPECT_GT(high, 0.8);
  const Answer answer = Result(folder);
  ASSERT_EQ(answer.parameters.size(), 3u);
  ASSERT_TRUE(answer.parameters[2].nuisance);
  EXPECT_FALSE(Matters(answer.parameters[2]));
  EXPECT_NEAR(answer.parameters[0].value, kTrueSliding, 0.06);
}

// An edited budget must not lose what the command line has added, nor a journal that is made anew.
TEST_F(AddedParameters, OutliveAnEditedSpecAndALostJournal) {
  const auto folder = Begin(std::string(kHeaps) + R"(, "posterior": {"stop_share": 0})");
  ASSERT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  ASSERT_EQ(RunFake(folder, {}, Search("restitution=0.3..0.95")), CampaignEnd::kFinished);
  const auto spec = scratch_.path() / "run_in" / "spec.json";
  std::string text = base::ReadFile(spec);
  text.replace(text.find("\"simulations\": 20"), 17, "\"simulations\": 50");
  std::ofstream(spec) << text;
  std::filesystem::remove(journal::JournalPath(folder));
  ASSERT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Result(folder).parameters.size(), 3u);
  const auto trials = Trials(folder);
  EXPECT_GT(trials.size(), 50u);  // and those that confirm
  EXPECT_EQ(trials.back().native.size(), 3u);
}

// Its own rule was switched off for all that was left of the budget.
TEST_F(AddedParameters, LetASearchThatHasNotEndedEndByItsRule) {
  const auto folder = Begin(kHeaps);
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  const BudgetOptions budget =
      OpenCampaign(folder, Search("restitution=0.3..0.95"), console).spec.budget;
  EXPECT_EQ(budget.simulations, 36);
  EXPECT_EQ(budget.min_simulations, 16);
}

TEST_F(AddedParameters, MustBeOneTheTrialsAgreeIn) {
  const auto folder = Finished(kHeaps);
  const std::string table = TrialTable(folder);
  EXPECT_THAT(ErrorOf(folder, "sliding_friction=0.1..0.9"), HasSubstr("is searched already"));
  EXPECT_THAT(ErrorOf(folder, "restitution"), HasSubstr("write NAME=LOW..HIGH"));
  EXPECT_THAT(ErrorOf(folder, "restitutio=0.3..0.9"), HasSubstr("did you mean \"restitution\""));
  EXPECT_THAT(ErrorOf(folder, "restitution=0.98..1"), HasSubstr("the range must hold"));
  EXPECT_THAT(ErrorOf(folder, "restitution=0.3..1.5"), HasSubstr("must be in (0, 1]"));
  EXPECT_THAT(ErrorOf(folder, "mass=0.4 parsec..0.6 g"), HasSubstr("does not fit here"));
  EXPECT_THAT(ErrorOf(folder, "fill=0.2..0.4"), HasSubstr("has no value in the trials so far"));
  // The plate follows the powder's friction, which differs from trial to trial.
  EXPECT_THAT(ErrorOf(folder, "plate_sliding_friction=0..0.9"),
              HasSubstr("is not the same in all trials"));
  EXPECT_EQ(TrialTable(folder), table);
}

// Every case says that it is 1, and the trials with larger grains were told as such.
TEST_F(AddedParameters, AFixedFactorIsWhereItWasFixed) {
  const std::filesystem::path spec = WriteFakeSpec(scratch_.path() / "fixed_in", kHeaps);
  std::string text = base::ReadFile(spec);
  text.insert(text.find("\"sliding_friction\""), R"("particle_size": {"fixed": 1.2}, )");
  std::ofstream(spec) << text;
  const std::filesystem::path folder = scratch_.path() / "fixed";
  BeginCampaign(spec, folder);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_THAT(ErrorOf(folder, "particle_size=0.8..1.1"), HasSubstr("the range must hold 1.2"));
}

// A grid of one parameter's levels could not go on with two, and a local search stayed where it was
// in the new one.
TEST_F(AddedParameters, AreForCampaignsThatLookAtTheNewRange) {
  const auto folder = Begin(std::string(kHeaps) + R"(, "strategy": {"kind": "nelder_mead"})");
  ASSERT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const std::string kept = base::ReadFile(folder / "campaign.json");
  EXPECT_THAT(ErrorOf(folder, "restitution=0.3..0.95"),
              HasSubstr("strategy.kind must be \"auto\", and is \"nelder_mead\""));
  EXPECT_EQ(base::ReadFile(folder / "campaign.json"), kept);
}

}  // namespace add_parameter_test
}  // namespace talus::campaign
