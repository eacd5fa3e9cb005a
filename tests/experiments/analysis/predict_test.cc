// What a campaign predicts of other tests, with drawn heaps in place of simulations.
#include "experiments/analysis/predict/predict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/json/json_reader.h"
#include "engine/scene/scene_spec.h"
#include "experiments/analysis/predict/affordable.h"
#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/analysis/predict/prediction_plan.h"
#include "experiments/analysis/predict/prediction_text.h"
#include "experiments/analysis/predict/scene_engine.h"
#include "experiments/analysis/predict/test_regimes.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace predict_test {

using campaign::FakeEngine;
using campaign::JointView;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class PredictTest : public campaign::CampaignFixture {
 protected:
  void SetUp() override {
    folder_ = Finished(R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 24}, "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)");
    view_.emplace(campaign::ReadJointView(folder_));
  }
  Prediction Run(PredictOptions options, const campaign::FakeEngineOptions& engine = {}) const {
    return Predict(*view_, options,
                   {.runner = campaign::MakeDrawnRunner(view_->spec, view_->folder.root),
                    .engine = std::make_unique<FakeEngine>(engine)});
  }
  fs::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_.path() / name) << text;
    return scratch_.path() / name;
  }
  fs::path Taps(const std::string& more = "") const {
    return Write("taps.json", R"({"powder": {
      "material": {"density": 2500, "youngs_modulus": "5 GPa", "sliding_friction": 0.123},
      "sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.5 g"},
      "rig": {"kind": "tapped_density", "diameter": "10 mm"}, "filling": {"kind": "pour"})" +
                                  more + "}");
  }
  std::string ErrorOf(const PredictOptions& options) const {
    return ErrorIn([&] { Run(options); });
  }
  fs::path folder_;
  std::optional<JointView> view_;
};

// The drawn density is 1550 − 350 μ_r kg/m³, and scatters by 4.
TEST_F(PredictTest, TellsTheParametersFromTheScatterOfARun) {
  const Prediction p = Run({.file = Taps(), .num_draws = 16, .num_seeds = 5});
  ASSERT_EQ(p.numbers.size(), 1u);
  const PredictedNumber& density = p.numbers[0];
  EXPECT_EQ(density.name, "tapped_density_kg_per_m3");
  EXPECT_TRUE(density.is_usual);
  EXPECT_EQ(density.num_defined, 80);
  EXPECT_NEAR(density.run_sd, 4, 1);  // 64 degrees of freedom: ± 0.35
  double mean = 0;
  double square = 0;
  for (const PredictedDraw& draw : p.draws) {
    mean += draw.weight * draw.values[1];
    square += draw.weight * draw.values[1] * draw.values[1];
  }
  EXPECT_NEAR(density.mean, 1550 - 350 * mean, 2);  // 4 / √80, three times
  const double sd = 350 * std::sqrt(square - mean * mean);
  // Bessel's and Student's factors for 16 draws come to 1.1; the draws' means scatter by 4 / √5.
  EXPECT_NEAR(density.parameters_sd, 1.1 * sd, 2);
  EXPECT_LT(density.low, density.mean - sd);
  EXPECT_EQ(p.scale_factor, 1);  // of drawn heaps the finest is affordable
  EXPECT_THAT(p.notes, testing::Contains(HasSubstr("D50 0.4 mm instead of D50 1 mm")));
  EXPECT_THAT(p.notes, testing::Contains(HasSubstr("Pa instead of 5e+09")));
  EXPECT_THAT(p.notes, testing::Not(testing::Contains(HasSubstr("friction"))));  // it is searched
  EXPECT_THAT(PredictionText(p, view_->record.parameters), HasSubstr("% parameters"));
  EXPECT_THAT(base::ReadFile(folder_ / "predict/taps/draws.csv"),
              testing::StartsWith("draw,weight,sliding_friction,rolling_friction,tapped_density"));
}

// The second took the first's folder, and its trials with it.
TEST_F(PredictTest, AnotherCaseOfTheSameFileNameIsRefused) {
  const auto set = [](const fs::path& file) {
    return PredictOptions{.file = file,
                          .num_seeds = 1,
                          .set = {{"sliding_friction", "0.4"}, {"rolling_friction", "0.2"}}};
  };
  const fs::path first = Taps();
  Run(set(first));
  fs::create_directories(scratch_.path() / "elsewhere");
  fs::copy(first, scratch_.path() / "elsewhere/taps.json");
  Run(set(scratch_.path() / "elsewhere/taps.json"));  // a copy is the same case
  Taps(R"(, "gravity": 9.8)");                        // that is edited
  Run(set(first));
  EXPECT_THAT(ErrorOf(set(scratch_.path() / "elsewhere/taps.json")),
              HasSubstr("holds the prediction of another case"));
  fs::rename(first, scratch_.path() / "täps.json");
  Run(set(scratch_.path() / "elsewhere/taps.json"));  // the other is gone
  Run(set(scratch_.path() / "täps.json"));
  EXPECT_TRUE(fs::exists(folder_ /
                         "predict/täps-rolling_friction=0.2,sliding_friction=0.4/prediction.json"));
}

// Coarse grains add 40 kg/m³ for each 1 of the scale factor, ten times the scatter of a run.
TEST_F(PredictTest, SeveralScaleFactorsTellTheOneThatTheAnswerIsFor) {
  const campaign::FakeEngineOptions shifted{.density_by_scale = 40};
  const Prediction p = Run({.file = Taps(), .num_draws = 12, .scale_factors = {2, 1.5}}, shifted);
  EXPECT_EQ(p.num_ended, 12 + 36);  // coarse ones once
  EXPECT_EQ(p.scale_factor, 1.5);
  EXPECT_EQ(p.target, 1);
  const PredictedNumber& density = p.numbers.at(0);
  ASSERT_TRUE(density.surrogate.has_value());
  EXPECT_TRUE(density.surrogate->is_used);
  EXPECT_EQ(density.surrogate->scale_factor, 1);
  EXPECT_LT(density.surrogate->left_out_error, density.surrogate->draws_error);
  double rolling = 0;
  for (const PredictedDraw& draw : p.draws) rolling += draw.weight * draw.values[1];
  // At 1.5 alone it is 20 kg/m³ more. As the shift may bend between the scale factors, 12 of these
  // are taken away, and the interval allows for the rest, but for the mean's own error: 4 from run
  // to run, three runs a draw, of 12 draws.
  const double truth = 1550 - 350 * rolling;
  EXPECT_NEAR(density.mean, truth, 12);
  EXPECT_LT(density.low, truth + 4 / std::sqrt(3 * 12));
  const std::string text = PredictionText(p, view_->record.parameters);
  EXPECT_THAT(text, HasSubstr("scale factors 2 and 1.5: 48 of 48 runs"));
  EXPECT_THAT(text, HasSubstr("at scale factor 1 by a surrogate, which is off by"));
  EXPECT_TRUE(fs::exists(folder_ / "predict/taps/trials/0012_1_at_2/profile.png"));
  // The same again, with what there is.
  const fs::path first = folder_ / "predict/taps/trials/0001_1_at_2/profile.png";
  const auto time = fs::last_write_time(first);
  const Prediction again = Run({.file = Taps(), .as_before = true}, shifted);
  EXPECT_EQ(fs::last_write_time(first), time);
  EXPECT_EQ(again.num_ended, 48);
  EXPECT_EQ(again.numbers[0].mean, density.mean);
}

TEST_F(PredictTest, WhatTheCoreTimeAffordsIsSimulatedFiner) {
  const PredictedCase taps = ReadPredictedCase(*view_, Taps(), {}, 36, 0);
  EXPECT_EQ(taps.rig_case.coarse_graining.scale_factor, 2);
  const double coarse = CoreSecondsAt(*view_, taps.rig_case, 2);
  const double fine = CoreSecondsAt(*view_, taps.rig_case, 1);
  StagesWanted wanted{.num_draws = 12, .num_seeds = 3, .core_time = 36 * coarse + 6.5 * fine};
  const auto stages = PlanStages(*view_, taps, wanted);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].scale_factor, 2);
  EXPECT_EQ(stages[0].num_seeds, 3);
  EXPECT_EQ(stages[1].scale_factor, 1);
  EXPECT_EQ(stages[1].num_draws, 6);
  EXPECT_EQ(RunsOf(stages, 12).size(), 42u);
  EXPECT_EQ(RunsOf(stages, 5).size(), 20u);     // where only five sets differ
  wanted.core_time = 36 * coarse + 3.5 * fine;  // fewer than four show nothing
  EXPECT_EQ(PlanStages(*view_, taps, wanted).size(), 1u);
  // One that is stated stands alone.
  wanted.core_time = 1e6;
  EXPECT_EQ(PlanStages(*view_, ReadPredictedCase(*view_, Taps(), 2, 36, 0), wanted).size(), 1u);
}

TEST_F(PredictTest, GoesOnWhereItWasEnded) {
  const PredictOptions options{.file = Taps(), .num_draws = 4, .num_seeds = 2};
  const Prediction first = Run(options);
  const fs::path trials = folder_ / "predict/taps/trials";
  const auto time = fs::last_write_time(trials / "0001_1/profile.png");
  fs::remove_all(trials / "0003_2");  // as if it had been killed there
  const Prediction second = Run(options);
  EXPECT_EQ(fs::last_write_time(trials / "0001_1/profile.png"), time);
  EXPECT_TRUE(fs::exists(trials / "0003_2/profile.png"));
  EXPECT_EQ(first.numbers[0].by_draw, second.numbers[0].by_draw);
  // More runs of the same draws: those that are there stay.
  const Prediction more = Run({.file = Taps(), .num_draws = 4, .num_seeds = 3});
  EXPECT_EQ(fs::last_write_time(trials / "0001_1/profile.png"), time);
  EXPECT_EQ(more.num_ended, 12);
}

TEST_F(PredictTest, OneSetHasNoUncertaintyOfParameters) {
  const Prediction set =
      Run({.file = Taps(), .set = {{"sliding_friction", "0.4"}, {"rolling_friction", "0.2"}}});
  ASSERT_EQ(set.draws.size(), 1u);
  EXPECT_EQ(set.numbers[0].parameters_sd, 0);
  EXPECT_NEAR(set.numbers[0].mean, 1550 - 350 * 0.2, 5);
  EXPECT_TRUE(fs::exists(folder_ /
                         "predict/taps-rolling_friction=0.2,sliding_friction=0.4/prediction.json"));
  const Prediction best = Run({.file = Taps(), .recommended = true});
  EXPECT_EQ(best.draws[0].values[0], Result(folder_).parameters[0].value);
}

// A campaign that goes on has no answer until it ends again, whatever result.json still says.
TEST_F(PredictTest, AnAnswerThatNoLongerStandsIsNotTaken) {
  journal::Journal::Open(journal::JournalPath(folder_))
      .SetProgress({.state = journal::CampaignState::kInterrupted});
  ASSERT_TRUE(fs::exists(folder_ / "result.json"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .recommended = true}), HasSubstr("has no result yet"));
}

TEST_F(PredictTest, TwoAtOnceDoNotWriteTheSameRuns) {
  const fs::path folder = folder_ / "predict" / "taps";
  fs::create_directories(folder);
  const campaign::CampaignLock other(folder);
  try {
    Run({.file = Taps(), .num_draws = 2, .num_seeds = 1});
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another process"));
  }
  EXPECT_FALSE(fs::exists(folder / "trials"));
}

TEST_F(PredictTest, AMeasuredNumberIsInsideOrAnotherDrawGivesItOrNoneDoes) {
  PredictOptions options{.file = Taps(), .num_draws = 8};
  const auto measured = [&](double density) {
    options.measured = Write("measured.json", R"({"tapped_density": {"value": )" +
                                                  std::to_string(density) + R"(, "sd": 1}})");
    return *Run(options).numbers[0].measured;
  };
  const PredictedNumber number = Run(options).numbers[0];
  EXPECT_TRUE(measured(number.mean).is_inside);
  // The least likely draw lies outside of what all draws predict together, and gives itself.
  const MeasuredThere extreme = measured(*std::ranges::max_element(
      number.by_draw, {}, [&](double draw) { return std::abs(draw - number.mean); }));
  EXPECT_FALSE(extreme.is_inside);
  EXPECT_TRUE(extreme.nearest_is_inside);
  EXPECT_THAT(PredictionText(Run(options), view_->record.parameters),
              Not(HasSubstr("no draw gives it")));
  const MeasuredThere far = measured(1200);
  EXPECT_FALSE(far.is_inside);
  EXPECT_FALSE(far.nearest_is_inside);
  EXPECT_THAT(PredictionText(Run(options), view_->record.parameters),
              HasSubstr("no draw gives it"));
}

TEST_F(PredictTest, AMeasuredImageIsComparedInItsOwnFrameWithoutNewRuns) {
  const fs::path tube = Write("tube.json", R"({"powder": {
      "material": {"density": 2500},
      "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"}})");
  const PredictOptions options{.file = tube, .num_draws = 4, .num_seeds = 3};
  EXPECT_FALSE(Run(options).image.has_value());
  const fs::path ran = folder_ / "predict/tube/trials/0001_1/ran";  // gone when it runs anew
  std::ofstream(ran) << "once";
  imaging::WritePng(scratch_.path() / "seen.png",
                    campaign::DrawHeap(campaign::kTrueSliding, campaign::kTrueRolling, 77));
  PredictOptions compared = options;
  const auto image = [&](const std::string& map) {
    compared.measured = Write("seen.json", R"({"map": ")" + map + R"(", "plate_diameter": "10 mm",
      "frame": {"width_px": 120, "height_px": 80, "pixel_size": "0.1 mm", "center_x_px": 60,
                "baseline_px": 76, "plate_diameter": "10 mm"}})");
    return Run(compared);
  };
  const Prediction near = image("seen.png");
  ASSERT_TRUE(near.image.has_value());
  EXPECT_TRUE(fs::exists(ran));
  EXPECT_TRUE(fs::exists(folder_ / "predict/tube/mean_profile.png"));
  EXPECT_TRUE(fs::exists(folder_ / "predict/tube/most_different.png"));
  imaging::WritePng(scratch_.path() / "far.png", campaign::DrawHeap(0.8, 0.5, 77));
  const Prediction far = image("far.png");
  EXPECT_GT(far.image->sad_mm2, 5 * near.image->sad_mm2);
  EXPECT_EQ(far.image->is_inside, false);
  EXPECT_EQ(far.image->nearest_is_inside, false);
}

TEST_F(PredictTest, WhatContradictsTheCampaignIsRefusedAndNothingIsWritten) {
  EXPECT_THAT(ErrorOf({.file = Taps(R"(, "models": {"rolling": "constant"})")}),
              HasSubstr("models.rolling: is \"constant\", but the set was calibrated with"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .scale_factors = {0.5}}), HasSubstr("--scale: is 0.5"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .scale_factors = {20}}), HasSubstr("at scale factor 20"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .scale_factors = {2, 20}}), HasSubstr("at scale factor 20"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .scale_factors = {2, 2}}), HasSubstr("names one twice"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .scale_factors = {2, 1}, .recommended = true}),
              HasSubstr("--scale: names several"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .core_time = 0}), HasSubstr("--budget: must be positive"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .num_draws = 1}), HasSubstr("--draws: is 1"));
  EXPECT_THAT(ErrorOf({.file = Taps(), .set = {{"sliding_friction", "0.4"}}}),
              HasSubstr("rolling_friction: is missing"));
  EXPECT_THAT(ErrorOf({.file = Taps(),
                       .measured = Write("m.json", R"({"runout": {"value": 0.1, "sd": 0.01}})")}),
              HasSubstr("runout: is not measured by the rig tapped_density"));
  EXPECT_THAT(ErrorOf({.file = Write("none.json", "{}")}), HasSubstr("neither a case"));
  EXPECT_FALSE(fs::exists(folder_ / "predict"));
}

TEST_F(PredictTest, WallsThatTheCampaignHasSearchedAreNotTheCases) {
  const fs::path spec = campaign::WriteFakeSpec(scratch_.path() / "plates_in", "");
  std::string text = base::ReadFile(spec);
  text.replace(text.find("rolling_friction"), 16, "plate_sliding_friction");
  base::WriteFileAtomically(spec, text);
  const fs::path plates = scratch_.path() / "plates";
  campaign::BeginCampaign(spec, plates);
  view_.emplace(campaign::ReadJointView(plates));
  EXPECT_THAT(ErrorOf({.file = Taps(R"(, "device": {"plate_material": {"sliding_friction": 0.3}})"),
                       .set = {{"sliding_friction", "0.4"}, {"plate_sliding_friction", "0.2"}}}),
              HasSubstr("the campaign has calibrated it as plate_sliding_friction"));
}

// How much powder a process takes is its own, whatever the campaign knows of that in its tests.
TEST_F(PredictTest, TheMassIsTheCasesWhereTheCampaignSearchesOrFixesIt) {
  const PredictedCase taps = ReadPredictedCase(*view_, Taps(), {}, 1);
  JointView weighed = *view_;
  for (const auto fixed : {std::optional<double>(), std::optional<double>(1.6e-3)}) {
    weighed.space.parameters = view_->space.parameters;
    weighed.space.parameters.push_back({.name = "mass", .low = 1e-3, .high = 2e-3, .fixed = fixed});
    const rigs::Case predicted = CaseWith(weighed, taps, std::vector{0.3, 0.2, 1.6e-3}, 1);
    EXPECT_EQ(predicted.powder.mass, 0.5e-3);
    EXPECT_EQ(predicted.powder.material.sliding_friction, 0.3);
  }
}

// With one run there is no scatter to judge by, and of one set nothing is said of others.
TEST_F(PredictTest, OneRunOfOneSetIsNoPrediction) {
  const Prediction p =
      Run({.file = Taps(),
           .num_seeds = 1,
           .set = {{"sliding_friction", "0.4"}, {"rolling_friction", "0.2"}},
           .measured = Write("off.json", R"({"tapped_density": {"value": 1300, "sd": 1}})")});
  const std::string text = PredictionText(p, view_->record.parameters);
  EXPECT_THAT(text, HasSubstr("one run does not tell how far others lie"));
  EXPECT_THAT(text, testing::Not(HasSubstr("90 %")));
}

// Six draws once each: the surrogate's noise is its prior's then.
TEST_F(PredictTest, WithoutASecondRunOfASetNothingIsSaidOfScatter) {
  const Prediction p = Run({.file = Taps(), .num_draws = 8, .num_seeds = 1});
  EXPECT_TRUE(std::isnan(p.numbers.at(0).run_sd));
  EXPECT_TRUE(std::isnan(p.numbers.at(0).parameters_share));
  EXPECT_THAT(PredictionText(p, view_->record.parameters), HasSubstr("no set was run twice"));
}

TEST_F(PredictTest, ATestThatAnotherPredictionHasSimulatedIsReadThere) {
  const auto regimes = [&](const fs::path& prediction, double sliding) {
    fs::create_directories(prediction);
    return TestRegimes(
        *view_, {.set = Eigen::Vector2d(sliding, 0.5), .scale_factor = 1, .prediction = prediction},
        {.runner = campaign::MakeDrawnRunner(view_->spec, view_->folder.root),
         .engine = std::make_unique<FakeEngine>(campaign::FakeEngineOptions{})});
  };
  const fs::path predictions = PredictFolder(folder_);
  ASSERT_THAT(*regimes(predictions / "first", 0.5), testing::IsEmpty());  // of drawn heaps
  const auto tests = fs::directory_iterator(predictions / "first/tests");
  const fs::path simulated = begin(tests)->path();
  std::ofstream(simulated / "result.json") << base::WithChecksum(
      R"({"regime": {"inertial_number": [0.1, 0.2, 0.3], "pressure_Pa": [4, 5, 6],
                     "shear_rate_per_s": [7, 8, 9]}})"
      "\n");
  const auto seen = regimes(predictions / "second", 0.5);
  ASSERT_EQ(seen->size(), 1u);
  EXPECT_EQ(seen->front().pressure[1], 5);
  EXPECT_FALSE(fs::exists(predictions / "second/tests"));
  EXPECT_THAT(*regimes(predictions / "third", 0.6), testing::IsEmpty());  // with another set
  EXPECT_TRUE(fs::exists(predictions / "third/tests" / simulated.filename() / "profile.png"));
}

TEST_F(PredictTest, ASceneIsFilledWithTheCampaignsPowder) {
  const fs::path file = Write("pair.json", R"({
    "materials": [{"name": "beads", "density": 1000}, {"name": "steel"}],
    "spheres": [{"diameter": "0.8 mm", "position": [0, 0, "1 mm"]}],
    "walls": [{"shape": "plane", "material": "steel"}], "stop": {"time": "1 ms"}})");
  const PredictedCase scene = ReadPredictedCase(*view_, file, {}, 1);
  EXPECT_EQ(scene.rig_case.coarse_graining.scale_factor, 2);  // 0.8 mm for 0.4 mm
  SceneEngine engine(scene.scene_text);
  const std::vector<double> values{0.31, 0.12};
  engine.Prepare(CaseWith(*view_, scene, values, 9), scratch_.path() / "trial");
  const auto spec = base::LoadOptions<engine::SceneSpec>(
      base::ReadJsonFile(scratch_.path() / "trial/scene.json"));
  EXPECT_EQ(spec.materials[0].name, "beads");
  EXPECT_EQ(spec.materials[0].material.density, view_->spec.powder.material.density);
  EXPECT_EQ(spec.materials[0].material.sliding_friction, 0.31);
  EXPECT_NE(spec.materials[1].material.sliding_friction, 0.31);
  EXPECT_EQ(spec.seed, 9u);
  EXPECT_THROW(ReadPredictedCase(*view_, file, 2, 1), base::ConfigError);
}

// γ grows with the grains of the powder: those of other materials do not count, and a mass filled
// in counts as the volume that it is. 1.5 mg of 2500 kg/m³ are 0.6 mm³ of 0.4 mm; a sphere of 1.2
// mm has 0.9 mm³, one of 1 mm 0.52.
TEST_F(PredictTest, ASceneHasTheScaleFactorOfItsPowdersMedianGrain) {
  const auto scale_factor = [&](const std::string& sphere) {
    const fs::path file = Write("mixed.json", R"({
      "materials": [{"name": "powder"}, {"name": "steel"}],
      "spheres": [{"diameter": ")" + sphere + R"( mm", "position": [0, 0, "9 mm"]},
                  {"diameter": "7 mm", "material": "steel", "position": [0, 0, "15 mm"]}],
      "fills": [{"mass": "1.5 mg", "sizes": {"kind": "mono", "diameter": "0.4 mm"},
                 "region": {"shape": "cylinder", "diameter": "4 mm"}}],
      "walls": [{"shape": "plane", "material": "steel"}], "stop": {"time": "1 ms"}})");
    return ReadPredictedCase(*view_, file, {}, 1).rig_case.coarse_graining.scale_factor;
  };
  ASSERT_EQ(view_->spec.powder.material.density, 2500);
  EXPECT_DOUBLE_EQ(scale_factor("1"), 1);
  EXPECT_DOUBLE_EQ(scale_factor("1.2"), 3);
}

}  // namespace predict_test
}  // namespace talus::analysis
