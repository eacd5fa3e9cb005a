// Several scale factors in one spec: what it means, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/json/json_file.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/plan/estimate.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "tests/error_in.h"

namespace talus::campaign {
namespace scale_factors_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// 10 mm of plate over 0.2 mm grains: 50 across at true size.
CampaignSpec Read(const std::string& members) {
  return ReadCampaignSpec(base::ParseJson(R"({
    "experiment": {"map": "map.png", "plate_diameter": "10 mm"},
    "powder": {"material": {"density": 2500},
               "sizes": {"kind": "mono", "diameter": "0.2 mm"}, "mass": "0.5 g"},
    )" + members + "}",
                                          "/folder/powder.json"));
}

std::string ErrorOf(const std::string& members) {
  return ErrorIn([&] { Read(members); });
}

TEST(ScaleFactors, TheSmallestIsTheTargetUnlessTheSpecAsksForLess) {
  const CampaignSpec several = Read(R"("coarse_graining": {"scale_factors": [1.5, 3, 2]})");
  EXPECT_THAT(several.coarse_graining.Levels(), ElementsAre(3, 2, 1.5));
  EXPECT_EQ(several.coarse_graining.Target(), 1.5);
  EXPECT_EQ(several.coarse_graining.scale_factor, 1.5);  // of the confirmation
  const CampaignSpec beyond = Read(R"("coarse_graining": {"scale_factor": 2, "target": 1})");
  EXPECT_EQ(beyond.coarse_graining.Target(), 1);
}

TEST(ScaleFactors, TheSpecReadsBackWithThem) {
  const std::string text = SpecText(Read(R"("coarse_graining": {"scale_factors": [3, 2]})"));
  EXPECT_EQ(SpecText(ParseSpecText(text)), text);
  // A spec without the keys is written as before they were known.
  const std::string plain = SpecText(Read(R"("seed": 1)"));
  for (const char* key : {"scale_factors", "target", "core_time", "experiments"}) {
    EXPECT_EQ(plain.find(std::string("\"") + key), std::string::npos) << key;
  }
}

TEST(ScaleFactors, WhatCannotBeIsRefusedWithItsPlace) {
  const auto graining = [](const std::string& keys) {
    return ErrorOf("\"coarse_graining\": {" + keys + "}");
  };
  EXPECT_THAT(graining(R"("scale_factors": [2, 0.5])"),
              HasSubstr("coarse_graining.scale_factors[1]: is 0.5, must be 1 or more"));
  EXPECT_THAT(graining(R"("scale_factors": [2, 3, 2])"),
              HasSubstr("coarse_graining.scale_factors[2]: is 2, stands there twice"));
  EXPECT_THAT(graining(R"("scale_factors": [])"), HasSubstr("coarse_graining.scale_factors: is"));
  EXPECT_THAT(graining(R"("scale_factors": [2, 3], "target": 2.5)"),
              HasSubstr("coarse_graining.target: is 2.5, must not be larger than the smallest"));
  EXPECT_THAT(graining(R"("scale_factors": [2, 3], "scale_factor": 4)"),
              HasSubstr("coarse_graining.scale_factor: stands beside scale_factors"));
  EXPECT_THAT(graining(R"("scale_factors": [1, 6])"),
              HasSubstr("coarse_graining: leaves 8.33 grains across the plate of \"heap\" at scale "
                        "factor 6"));
  EXPECT_EQ(graining(R"("scale_factors": [1, 5])"), "");  // ten across
  EXPECT_THAT(ErrorOf(R"("coarse_graining": {"scale_factors": [1, 2]},
                         "strategy": {"kind": "lhs"})"),
              HasSubstr("strategy.kind: must be \"auto\""));
}

std::string ErrorOfExperiments(const std::string& list, const std::string& more = "") {
  return ErrorIn([&] {
    ReadCampaignSpec(base::ParseJson(R"({
      "powder": {"material": {"density": 2500},
                 "sizes": {"kind": "mono", "diameter": "0.2 mm"}, "mass": "0.5 g"},)" +
                                         more + "\"experiments\": [" + list + "]}",
                                     "/folder/powder.json"));
  });
}

TEST(Experiments, WhatCannotBeIsRefusedWithItsPlace) {
  const std::string heap = R"({"name": "heap", "map": "m.png", "plate_diameter": "10 mm")";
  EXPECT_EQ(ErrorOfExperiments(heap + "}"), "");
  EXPECT_THAT(ErrorOfExperiments(heap + "}, " + heap + "}"),
              HasSubstr("experiments[1].name: \"heap\" stands there twice"));
  EXPECT_THAT(ErrorOfExperiments(R"({"name": "heap", "plate_diameter": "10 mm"})"),
              HasSubstr("experiments[0]: has no data: give photos, runs or a map"));
  EXPECT_THAT(ErrorOfExperiments(heap + R"(, "mass_fallen": {"value": "21 mg"}})"),
              HasSubstr("experiments[0].mass_fallen.sd: is missing"));
  EXPECT_THAT(ErrorOfExperiments(heap + R"(, "mass_fallen": {"value": "21 mg", "sd": 0}})"),
              HasSubstr("experiments[0].mass_fallen.sd: is 0, must be positive"));
  EXPECT_THAT(ErrorOfExperiments(heap + R"(, "device": {"plate_diameter": "30 mm"}})"),
              HasSubstr("experiments[0].plate_diameter: is 0.01 (\"10 mm\"), is not the device's"));
  EXPECT_THAT(ErrorOfExperiments(""), HasSubstr("experiments: is empty"));
  EXPECT_THAT(ErrorOfExperiments(heap + "}", R"("experiment": {"map": "m.png",
                                                "plate_diameter": "10 mm"},)"),
              HasSubstr("experiments: stands beside experiment"));
}

TEST(Experiments, EachHasItsOwnDeviceOrTheCampaigns) {
  const CampaignSpec spec = ReadCampaignSpec(base::ParseJson(R"({
    "powder": {"material": {"density": 2500},
               "sizes": {"kind": "mono", "diameter": "0.2 mm"}, "mass": "0.5 g"},
    "device": {"lift_velocity": "2 cm/s"},
    "experiments": [
      {"name": "heap", "map": "m.png", "plate_diameter": "10 mm"},
      {"name": "wide", "map": "w.png", "plate_diameter": "30 mm",
       "device": {"plate_diameter": "30 mm", "lift_velocity": "5 cm/s"},
       "mass_fallen": {"value": "21 mg", "sd": "2 mg"}}]})",
                                                             "/folder/powder.json"));
  EXPECT_EQ(TypicalCase(spec, 0, 1).rig.lifted_tube.lift_velocity, 0.02);
  EXPECT_EQ(TypicalCase(spec, 1, 1).rig.lifted_tube.plate_diameter, 0.03);
  const auto scalars = ScalarsOf(ExperimentsOf(spec)[1]);
  ASSERT_EQ(scalars.size(), 1u);
  EXPECT_EQ(scalars[0].metric, "mass_fallen_kg");
  EXPECT_DOUBLE_EQ(scalars[0].value, 21e-6);
  EXPECT_DOUBLE_EQ(scalars[0].standard_error, 2e-6);
  EXPECT_EQ(SpecText(ParseSpecText(SpecText(spec))), SpecText(spec));
}

TEST(ScaleFactors, CoreTimeTakesThePlaceOfANumberOfSimulations) {
  const CampaignSpec spec = Read(R"("budget": {"core_time": "16 min"})");
  EXPECT_EQ(spec.budget.core_time, 960);
  EXPECT_EQ(spec.budget.simulations, 0);
  const CampaignSpec both = Read(R"("budget": {"core_time": "16 min", "simulations": 40})");
  EXPECT_EQ(both.budget.simulations, 40);
  EXPECT_THAT(ErrorOf(R"("budget": {"core_time": 0})"), HasSubstr("budget.core_time: is 0"));
}

journal::TrialRecord Trial(double scale_factor, journal::TrialStatus status, double cpu_s) {
  journal::TrialRecord trial;
  trial.scale_factor = scale_factor;
  trial.status = status;
  trial.cpu_s = cpu_s;
  return trial;
}

TEST(CoreTime, RunningTrialsCountByWhatOthersOfTheirSizeTook) {
  const CampaignSpec spec = Read(R"("coarse_graining": {"scale_factors": [2, 1]})");
  CoreTime time(spec);
  const std::vector<journal::TrialRecord> trials{Trial(2, journal::TrialStatus::kOk, 10),
                                                 Trial(2, journal::TrialStatus::kFailed, 14),
                                                 Trial(2, journal::TrialStatus::kRunning, 0)};
  EXPECT_DOUBLE_EQ(time.Of(trials), 10 + 14 + 12);
  // The time of another size goes by grain steps. f⁻³ grains times f⁻¹ steps, but for rounding to
  // whole grains.
  std::vector<journal::TrialRecord> finer = trials;
  finer[2].scale_factor = 1;
  EXPECT_NEAR(time.Of(finer), 24 + 12 * 16, 0.5);
  // One of a journal that was lost waits to be told again, and took what it took.
  std::vector<journal::TrialRecord> kept = trials;
  kept[2].finished_utc = "2026-12-01T00:07:48Z";
  kept[2].cpu_s = 11;
  EXPECT_DOUBLE_EQ(time.Of(kept), 10 + 14 + 11);
  // Before any has ended: by the speed of a usual core.
  const std::vector<journal::TrialRecord> first{Trial(2, journal::TrialStatus::kRunning, 0)};
  EXPECT_DOUBLE_EQ(CoreTime(spec).Of(first), GrainStepsOf(spec, 0, 2) / kUsualSpeed);
}

TEST(Estimate, SaysForEachScaleFactorWhatATrialTakesAndTheBudgetBuys) {
  const CampaignSpec spec = Read(R"("coarse_graining": {"scale_factors": [4, 2]},
                                    "budget": {"core_time": "16 min"})");
  const CampaignEstimate estimate = EstimateCampaign(spec);
  ASSERT_EQ(estimate.trials.size(), 2u);
  EXPECT_NEAR(estimate.trials[1].core_seconds / estimate.trials[0].core_seconds, 16, 0.2);
  const std::string text = EstimateText(spec, estimate);
  EXPECT_THAT(text, HasSubstr("scale factor 4: 746 grains of 0.8 mm"));
  EXPECT_THAT(text, HasSubstr("scale factor 2: 5968 grains of 0.4 mm"));
  EXPECT_THAT(text, HasSubstr("16 min of core time buy"));
  EXPECT_THAT(text, HasSubstr("to choose trials"));
  EXPECT_TRUE(EstimateWarnings(spec, estimate).empty());
}

TEST(Estimate, WarnsOfABudgetThatBuysFewOfTheFinestTrials) {
  const CampaignSpec spec = Read(R"("coarse_graining": {"scale_factors": [4, 2]},
                                    "budget": {"core_time": "16 min"})");
  CampaignEstimate estimate = EstimateCampaign(spec);
  estimate.trials[1].core_seconds = 16 * 60 / 9.5;
  ASSERT_EQ(EstimateWarnings(spec, estimate).size(), 1u);
  EXPECT_THAT(EstimateWarnings(spec, estimate).front(),
              HasSubstr("buys only 9 simulations of each experiment at scale factor 2"));
  estimate.trials[1].core_seconds = 16 * 60 / 10.5;
  EXPECT_TRUE(EstimateWarnings(spec, estimate).empty());
}

TEST(Estimate, AWallClockEndsTheSearch) {
  const auto estimated = [](const std::string& wall_clock) {
    return Read(R"("coarse_graining": {"scale_factor": 4}, "workers": 1,
                   "budget": {"simulations": 200)" +
                wall_clock + "}");
  };
  const CampaignSpec spec = estimated("");
  const CampaignEstimate all = EstimateCampaign(spec);
  EXPECT_TRUE(EstimateWarnings(spec, all).empty());
  const double limit = 3 * all.trials[0].core_seconds;
  const CampaignSpec limited = estimated(", \"wall_clock\": " + std::to_string(limit));
  const CampaignEstimate few = EstimateCampaign(limited);
  // The speed is measured anew: as often as not it is half as high beside other work.
  EXPECT_LT(few.campaign_time, all.campaign_time / 2);
  ASSERT_EQ(EstimateWarnings(limited, few).size(), 1u);
  EXPECT_THAT(EstimateWarnings(limited, few).front(),
              HasSubstr("budget.wall_clock ends the search"));
}

// A design of 4 d + 4 sets at the coarsest, then 3 at each finer one.
TEST(Estimate, WarnsOfABudgetThatEndsBeforeTheFinestTrials) {
  const auto warnings = [](int simulations) {
    const CampaignSpec spec = Read(R"("coarse_graining": {"scale_factors": [4, 3, 2]},
                                      "budget": {"simulations": )" +
                                   std::to_string(simulations) + "}");
    return EstimateWarnings(spec, EstimateCampaign(spec));
  };
  const auto least =
      static_cast<int>(4 * SpaceOf(Read(R"("seed": 1)")).parameters.size() + 4 + 3 * 2);
  ASSERT_EQ(warnings(least - 1).size(), 1u);
  EXPECT_EQ(warnings(least - 1).front(),
            std::to_string(least - 1) +
                " simulations end before 3 sets of each experiment are simulated at scale factor "
                "2, and the answer rests on coarser grains: give it " +
                std::to_string(least) + " at least, or leave that scale factor out");
  EXPECT_TRUE(warnings(least).empty());
}

// 60 simulations are 15 sets of four, and twelve of a design are at the coarsest: none was left.
TEST(Estimate, WhatABudgetReachesIsCountedInSets) {
  const auto warnings = [](int simulations) {
    const CampaignSpec spec =
        Read(R"("coarse_graining": {"scale_factors": [4, 3, 2]}, "replicates": 4,
                "budget": {"simulations": )" +
             std::to_string(simulations) + "}");
    return EstimateWarnings(spec, EstimateCampaign(spec));
  };
  const auto least =
      4 * static_cast<int>(4 * SpaceOf(Read(R"("seed": 1)")).parameters.size() + 4 + 3 * 2);
  ASSERT_EQ(warnings(least - 4).size(), 1u);
  EXPECT_THAT(warnings(least - 4).front(),
              testing::HasSubstr("give it " + std::to_string(least) + " at least"));
  EXPECT_TRUE(warnings(least).empty());
}

// Ten by threes are twelve, and a set that was begun gets all of them.
TEST(Estimate, ReplicatesAreCounted) {
  const auto count = [](const std::string& replicates) {
    return EstimateCampaign(Read(R"("coarse_graining": {"scale_factor": 4}, "workers": 1,
        "confirm": {"candidates": 0}, "budget": {"simulations": 10}, )" +
                                 replicates))
        .num_trials;
  };
  EXPECT_EQ(count(R"("replicates": 1)"), 10);
  EXPECT_EQ(count(R"("replicates": 3)"), 12);
  EXPECT_EQ(count(R"("replicates": 3, "noise": {"replicates": 4})"), 10);
}

// Three of each test by two sets are twelve, and were counted as those of two tests of two tests.
TEST(Estimate, ConfirmsEachSetByEveryTestOnce) {
  const auto estimate = [](const char* confirm) {
    const CampaignSpec spec = Read(std::string(R"("coarse_graining": {"scale_factor": 4},
        "budget": {"simulations": 2}, "workers": 1, )") +
                                   confirm);
    return std::pair(spec, EstimateCampaign(spec));
  };
  const auto [spec, confirms] = estimate(
      R"("confirm": {"candidates": 2, "replicates": 3, "ends": false, "scale_factor": 2})");
  const auto [bare, none] = estimate(R"("confirm": {"candidates": 0})");
  ASSERT_EQ(confirms.confirming.size(), 1u);
  EXPECT_EQ(confirms.num_trials, 2 + 6);
  EXPECT_TRUE(none.confirming.empty());
  const double search = 2 * confirms.trials[0].core_seconds;
  EXPECT_NEAR(confirms.campaign_time - confirms.proposal_time,
              search + 6 * confirms.confirming[0].core_seconds, 1e-9 * search);
  // They are the longest, and would meet the cap that those of the search do not.
  CampaignSpec capped = spec;
  capped.trial_time_cap =
      (confirms.trials[0].core_seconds + confirms.confirming[0].core_seconds) / 2;
  EXPECT_THAT(EstimateWarnings(spec, confirms), ElementsAre(HasSubstr("within the first design")));
  EXPECT_THAT(EstimateWarnings(capped, confirms),
              ElementsAre(HasSubstr("at scale factor 2: a trial takes about"),
                          HasSubstr("within the first design")));
}

// 4 d + 4 sets of two parameters, at the only scale factor.
TEST(Estimate, WarnsOfABudgetThatEndsWithinTheFirstDesign) {
  const auto warnings = [](int simulations) {
    const CampaignSpec spec =
        Read(R"("coarse_graining": {"scale_factor": 4}, "budget": {"simulations": )" +
             std::to_string(simulations) + "}");
    return EstimateWarnings(spec, EstimateCampaign(spec));
  };
  EXPECT_THAT(warnings(11),
              ElementsAre("11 simulations end within the first design, 12 sets of each experiment, "
                          "and none is chosen by what the others have told: give it 12 at least, "
                          "better twice as many"));
  EXPECT_THAT(warnings(1), ElementsAre(HasSubstr("1 simulation ends within")));
  EXPECT_THAT(warnings(12), ElementsAre());
}

// Steps go with √Y: at 1 GPa ten times as many as in the middle, 10 MPa.
TEST(Estimate, TrialsAtTheEndsOfTheRangesCountWhereTheseSetTheCost) {
  CampaignSpec spec = Read(R"("coarse_graining": {"scale_factor": 4}, "workers": 1,
      "confirm": {"candidates": 0}, "budget": {"simulations": 20}, "parameters": {
        "sliding_friction": {"min": 0.1, "max": 0.9},
        "youngs_modulus": {"min": "0.1 MPa", "max": "1 GPa", "scale": "log"}})");
  const CampaignEstimate estimate = EstimateCampaign(spec);
  const TrialEstimate& trial = estimate.trials.at(0);
  EXPECT_NEAR(trial.at_ends, 10, 0.1);
  EXPECT_NEAR(estimate.campaign_time - estimate.proposal_time, 20 * trial.MostCoreSeconds(),
              1e-9 * estimate.campaign_time);
  EXPECT_THAT(
      EstimateText(spec, estimate),
      HasSubstr("a trial in the middle of the ranges, up to 10 times as much at their ends"));
  EXPECT_THAT(EstimateWarnings(spec, estimate), ElementsAre());
  spec.trial_time_cap = 3 * trial.core_seconds;
  EXPECT_THAT(
      EstimateWarnings(spec, estimate),
      ElementsAre(HasSubstr(" at the ends of the ranges, and fails at the trial_time_cap")));
  const CampaignSpec frictions = Read(R"("coarse_graining": {"scale_factor": 4})");
  const CampaignEstimate usual = EstimateCampaign(frictions);
  EXPECT_EQ(usual.trials.at(0).at_ends, 1);
  EXPECT_EQ(EstimateText(frictions, usual).find("the ranges"), std::string::npos);
}

// As `talus status` counts it.
TEST(Estimate, WhatFollowsTheAnswerIsAShareOfItsCoreTime) {
  const auto estimated = [](const std::string& shares) {
    return EstimateCampaign(Read(R"("coarse_graining": {"scale_factor": 4}, "workers": 1,
        "confirm": {"candidates": 0}, "budget": {"simulations": 20)" +
                                 shares + "}"));
  };
  const CampaignEstimate both = estimated(R"(, "sensitivity_share": 0.05}, "next": {"share": 0.2)");
  EXPECT_NEAR(both.afterwards, 0.25 * 20 * both.trials.at(0).core_seconds, 1e-9 * both.afterwards);
  EXPECT_EQ(estimated(R"(}, "next": {"share": 0)").afterwards, 0);
}

// Twelve trials of the design at the largest scale factor, each a sixteenth of the finest: all
// counted as the finest there was time for one or two.
TEST(Estimate, AWallClockBuysTheDesignAtItsOwnCost) {
  const std::string members = R"("coarse_graining": {"scale_factors": [4, 2]}, "workers": 1,
                                 "budget": {"simulations": 200)";
  const CampaignEstimate all = EstimateCampaign(Read(members + "}"));
  const double limit = 24 * all.trials.at(0).core_seconds;
  const CampaignEstimate few =
      EstimateCampaign(Read(members + ", \"wall_clock\": " + std::to_string(limit) + "}"));
  // The speed is measured anew: as often as not it is half as high beside other work.
  EXPECT_GT(few.num_in_wall_clock.value(), 6);
}

TEST(Estimate, EachExperimentHasItsOwnSpeed) {
  CampaignSpec spec = Read(R"("coarse_graining": {"scale_factor": 4})");
  std::vector<ExperimentSpec> two(2, ExperimentsOf(spec).front());
  two[1].name = "again";
  spec.experiment.reset();
  spec.experiments = two;
  const TrialEstimates estimate = EstimateTrials(spec);
  ASSERT_EQ(estimate.grain_steps_per_s.size(), 2u);
  EXPECT_DOUBLE_EQ(estimate.trials.at(1).core_seconds,
                   estimate.trials[1].grain_steps / estimate.grain_steps_per_s[1]);
}

TEST(Estimate, OneSimulationIsOne) {
  const CampaignSpec spec =
      Read(R"("coarse_graining": {"scale_factors": [4, 2]}, "budget": {"simulations": 1})");
  const CampaignEstimate estimate = EstimateCampaign(spec);
  EXPECT_THAT(EstimateText(spec, estimate), HasSubstr("; 1 simulation takes "));
  EXPECT_EQ(EstimateText(spec, estimate).find("to choose trials"), std::string::npos);
  EXPECT_THAT(EstimateWarnings(spec, estimate), ElementsAre(HasSubstr("1 simulation ends before")));
}

}  // namespace scale_factors_test
}  // namespace talus::campaign
