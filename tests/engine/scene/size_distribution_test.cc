#include "engine/scene/size_distribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "base/error.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace size_distribution_test {

using ::testing::HasSubstr;

double Volume(double d) { return std::numbers::pi / 6 * d * d * d; }

double Sum(const std::vector<double>& diameters) {
  double sum = 0;
  for (const double d : diameters) sum += Volume(d);
  return sum;
}

SizeDistribution LogNormal() {  // sigma = ln(111/45) / (2 × 1.645): D5 = 45 µm, D95 = 111 µm
  return {.kind = SizeKind::kLogNormal, .median = 70.7e-6, .sigma = 0.2745};
}
SizeDistribution Curve() {
  return {.kind = SizeKind::kCumulative,
          .diameters = {30e-6, 45e-6, 70e-6, 111e-6, 130e-6},
          .shares = {0, 5, 50, 95, 100}};
}

TEST(SizeCurve, LogNormalByVolumeHasItsQuantiles) {
  const SizeCurve curve(LogNormal());
  // The cut at three standard deviations moves D5 and D95 inwards by 0.3 %.
  EXPECT_NEAR(curve.VolumeQuantile(0.05), 45e-6, 0.2e-6);
  EXPECT_NEAR(curve.VolumeQuantile(0.50), 70.7e-6, 0.01e-6);
  EXPECT_NEAR(curve.VolumeQuantile(0.95), 111e-6, 0.4e-6);
  // Hatch–Choate: the number median lies lower by exp(3σ²). The cut-offs, which are symmetric for
  // the volume only, move it by about 1 %.
  EXPECT_NEAR(curve.NumberQuantile(0.5), 70.7e-6 * std::exp(-3 * 0.2745 * 0.2745), 0.6e-6);
}

TEST(SizeCurve, UniformByNumberAndByVolumeDifferAsTheirIntegralsSay) {
  SizeDistribution sizes{.kind = SizeKind::kUniform, .min = 1e-3, .max = 2e-3};
  // 2e-8: the curve is straight within its cells, which are 0.5 % wide.
  // By volume: share of the grains below x is (1 - x⁻²)/(1 - 1/4) for x in [1, 2]; half at x² =
  // 8/5.
  EXPECT_NEAR(SizeCurve(sizes).NumberQuantile(0.5), std::sqrt(1.6) * 1e-3, 2e-8);
  sizes.by = Weighting::kNumber;
  // By number: share of the volume below x is (x⁴ - 1)/15; half at x⁴ = 8.5.
  EXPECT_NEAR(SizeCurve(sizes).VolumeQuantile(0.5), std::pow(8.5, 0.25) * 1e-3, 2e-8);
  EXPECT_NEAR(SizeCurve(sizes).mean_volume(), Volume(1e-3) * 15.0 / 4, 1e-5 * Volume(1e-3));
}

struct Drawn {
  const char* name;
  SizeDistribution sizes;
  double volume;  // [m³]
};
class Drawing : public ::testing::TestWithParam<Drawn> {};

TEST_P(Drawing, MeetsTheVolumeToWithinOneGrainAndFollowsTheCurve) {
  const SizeCurve curve(GetParam().sizes);
  const std::vector<double> diameters = DrawDiameters(curve, GetParam().volume);
  EXPECT_LT(std::abs(Sum(diameters) - GetParam().volume), curve.mean_volume());
  ASSERT_GT(diameters.size(), 2000u);
  for (const double q : {0.05, 0.5, 0.95}) {
    // Quantiles of thousands of grains; the coarse end is the sparsest. Random numbers in place of
    // stratified ones are off by several per cent.
    EXPECT_NEAR(SampleVolumeQuantile(diameters, q) / curve.VolumeQuantile(q), 1, 0.005) << q;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Kinds, Drawing,
    ::testing::Values(
        Drawn{"mono", {.kind = SizeKind::kMono, .diameter = 1e-3}, 4000.3 * Volume(1e-3)},
        Drawn{"uniform",
              {.kind = SizeKind::kUniform, .by = Weighting::kNumber, .min = 8e-4, .max = 12e-4},
              5000 * Volume(1e-3)},
        Drawn{"normal",
              {.kind = SizeKind::kNormal, .mean = 1e-3, .standard_deviation = 2e-4},
              5000 * Volume(1e-3)},
        Drawn{"log_normal", LogNormal(), 5000 * Volume(70e-6)},
        Drawn{"cumulative", Curve(), 5000 * Volume(70e-6)},
        Drawn{"classes",
              {.kind = SizeKind::kClasses,
               .diameters = {30e-6, 60e-6, 90e-6, 120e-6},
               .shares = {1, 0, 2}},
              9000 * Volume(100e-6)}),
    [](const auto& tested) { return tested.param.name; });

TEST(SizeCurve, CutOffsRemoveWhatLiesBeyondThem) {
  SizeDistribution sizes = Curve();
  sizes.min = 45e-6;
  sizes.max = 111e-6;
  const SizeCurve curve(sizes);
  EXPECT_EQ(curve.smallest(), 45e-6);
  EXPECT_EQ(curve.largest(), 111e-6);
  EXPECT_NEAR(curve.VolumeQuantile(0.5), 70e-6, 1e-9);  // 5 % are gone on either side
}

std::string ProblemsOf(const SizeDistribution& sizes) {
  base::Problems problems;
  sizes.Validate(problems);
  return problems.Text();
}

TEST(SizeDistribution, EveryProblemIsNamed) {
  EXPECT_EQ(ProblemsOf(LogNormal()), "");
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kMono}), HasSubstr("diameter: is missing"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kMono, .diameter = -1}), HasSubstr("positive"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kMono, .diameter = std::nan("")}),
              HasSubstr("positive"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kUniform, .min = 2, .max = 1}), HasSubstr("max"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kNormal, .mean = 1, .standard_deviation = 0.5}),
              HasSubstr("min: "));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kClasses, .diameters = {1, 2}, .shares = {1, 1}}),
              HasSubstr("one value less"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kCumulative, .diameters = {2, 1}, .shares = {0, 1}}),
              HasSubstr("diameters[1]"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kCumulative, .diameters = {1, 2}, .shares = {1, 1}}),
              HasSubstr("must not all be the same"));
  EXPECT_THAT(ProblemsOf({.kind = SizeKind::kFile}), HasSubstr("file"));
}

SizeDistribution ReadText(const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
  std::ofstream(path) << text;
  SizeDistribution sizes{.kind = SizeKind::kFile, .file = path};
  ReadSizeFile(sizes);
  return sizes;
}

TEST(SizeFile, CumulativeWithSemicolonsDecimalCommasAndLatinMicro) {
  const SizeDistribution sizes = ReadText(
      "Sample;Ti64 lot 3\r\nMeasured;12,3 g\r\n\r\nSize (\xB5m);% Volume In;% Volume Under\r\n"
      "20,0;0,0;0,0\r\n30,0;5,5;0,0\r\n60,0;44,5;5,5\r\n90,0;50,0;50,0\r\n120,0;0,0;100,0\r\n");
  EXPECT_EQ(sizes.kind, SizeKind::kCumulative);
  EXPECT_FALSE(sizes.file.has_value());
  EXPECT_EQ(sizes.diameters.size(), 4u);  // the empty class from 20 to 30 µm is dropped
  EXPECT_NEAR(SizeCurve(sizes).VolumeQuantile(0.5), 90e-6, 1e-9);
  EXPECT_NEAR(SizeCurve(sizes).VolumeQuantile(0.055), 60e-6, 1e-9);
}

TEST(SizeFile, DifferentialWithTabsLowerEdgesAndNumberWeights) {
  const SizeDistribution sizes = ReadText(
      "File name:\tx.ls\nChannel Diameter (Lower)\tDiff. Number\num\t%\n10\t25\n20\t75\n40\t0\n");
  EXPECT_EQ(sizes.kind, SizeKind::kClasses);
  EXPECT_EQ(sizes.by, Weighting::kNumber);
  EXPECT_THAT(sizes.diameters,
              ::testing::ElementsAre(::testing::DoubleEq(10e-6), ::testing::DoubleEq(20e-6),
                                     ::testing::DoubleEq(40e-6)));
  EXPECT_NEAR(SizeCurve(sizes).NumberQuantile(0.25), 20e-6, 1e-9);
}

TEST(SizeFile, CommasAndMillimetresCoarseEndFirst) {
  const SizeDistribution sizes = ReadText("d [mm],Q3 [%]\n2.0,100\n1.0,50\n0.5,0\n");
  EXPECT_EQ(sizes.kind, SizeKind::kCumulative);
  EXPECT_NEAR(SizeCurve(sizes).VolumeQuantile(0.5), 1e-3, 1e-8);
}

// D50 of 450 µm was read as a class of 50 %.
TEST(SizeFile, PercentilesAreOfWhatIsFiner) {
  for (const char* title : {"%Tile", "Percentile", "% tile"}) {
    const SizeDistribution sizes =
        ReadText(std::string(title) + ",Size(um)\n10,320\n30,400\n50,450\n90,600\n");
    EXPECT_EQ(sizes.kind, SizeKind::kCumulative) << title;
    EXPECT_NEAR(SizeCurve(sizes).VolumeQuantile(0.5), 450e-6, 1e-9) << title;
  }
}

// What lies on the 0.5 sieve is 0.5 to 0.7 mm, which was taken for 0.45 to 0.59.
TEST(SizeFile, OnASieveLiesWhatIsCoarserThanItsMesh) {
  for (const char* titles :
       {"Sieve size (mm),Weight %", "Mesh (mm),Retained (%)", "Opening (mm),Mass retained (g)"}) {
    const SizeDistribution sizes =
        ReadText(std::string(titles) + "\n0.7,0\n0.5,60\n0.4,30\n0.3,10\nPan,0\n");
    EXPECT_EQ(sizes.shares, (std::vector<double>{10, 30, 60})) << titles;
    const SizeCurve curve(sizes);
    EXPECT_NEAR(curve.VolumeQuantile(0.1), 0.4e-3, 1e-8) << titles;
    EXPECT_NEAR(curve.VolumeQuantile(0.5), 0.5e-3 + 0.2e-3 / 6, 1e-8) << titles;
    EXPECT_NEAR(curve.VolumeQuantile(0.9), 0.7e-3 - 0.2e-3 / 6, 1e-8) << titles;
  }
  EXPECT_EQ(ReadText("Sieve (mm),%\n0.3,0\n0.4,10\n0.5,40\n0.7,100\n").kind, SizeKind::kCumulative);
}

TEST(SizeFile, ThePanHoldsTheFinestClass) {
  for (const char* pan : {"0", "Pan"}) {
    const SizeDistribution sizes =
        ReadText("Opening (mm),Sieve no.,Retained (g)\n0.8,20,40\n0.4,40,50\n" + std::string(pan) +
                 ",0,10\n");
    EXPECT_EQ(sizes.shares, (std::vector<double>{10, 50, 40})) << pan;
    EXPECT_NEAR(sizes.diameters.front(), 0.2e-3, 1e-12) << pan;
  }
}

TEST(SizeFile, WhatAllCoarserSievesRetainedIsNoClass) {
  const auto error = [](const std::string& text) { return ErrorIn([&] { ReadText(text); }); };
  for (const char* title : {"Cum. retained (%)", "Retained (%)"}) {
    EXPECT_THAT(error("Sieve (mm)," + std::string(title) + "\n0.7,0\n0.5,60\n0.4,90\n0.3,100\n"),
                HasSubstr("has only a cumulative share of what is coarser"))
        << title;
  }
}

// Words of a head were taken for those of the titles below.
TEST(SizeFile, AHeadAboveTheTitlesDoesNotChangeThem) {
  EXPECT_EQ(
      ReadText("Powder;class A\nSize (um);Volume (%)\n200;10\n400;50\n600;90\n800;100\n").kind,
      SizeKind::kCumulative);
  const std::string rows = "\n200;10\n400;40\n600;40\n800;10\n";
  const SizeDistribution plain = ReadText("Size (um);Volume" + rows);
  EXPECT_EQ(ReadText("Sieve fraction;200-800 um\nSize (um);Volume" + rows).diameters,
            plain.diameters);
}

TEST(SizeFile, TablesOfSievesAreReadAsTheyAreWritten) {
  const std::vector<double> shares{10, 30, 50, 10};
  for (const char* table :
       {"Maschenweite (um);R\u00fcckstand (%)\n800;0\n600;10\n400;50\n200;30\nBoden;10\n",
        "Sieve (um),Empty (g),Retained "
        "(g)\n800,500,0\n600,400,10\n400,300,50\n200,300,30\n<200,200,10\n",
        "Mesh No;Aperture (um);Volume In "
        "%\n20;800;0\n30;600;10\n40;400;50\n70;200;30\n0;-200;10\n"}) {
    EXPECT_EQ(ReadText(table).shares, shares) << table;
    EXPECT_NEAR(SizeCurve(ReadText(table)).VolumeQuantile(0.4), 400e-6, 1e-9) << table;
  }
  const SizeDistribution upper = ReadText("Upper sieve (mm),Mass (g)\n0.8,40\n0.4,50\nPan,10\n");
  EXPECT_EQ(upper.shares, (std::vector<double>{60, 40}));
}

// 150 shares of a curve that happen to add up to a hundred.
TEST(SizeFile, ACurveStaysOneWhateverItsSum) {
  std::string text = "Size (um),share\n";
  for (int i = 0; i <= 150; ++i) {
    text += std::to_string(100 + 5 * i) + "," + std::to_string(0.997 * std::sqrt(i / 150.0)) + "\n";
  }
  EXPECT_EQ(ReadText(text).kind, SizeKind::kCumulative);
}

// A narrow powder, all in one class, was taken for a curve from 400 to 500 µm.
TEST(SizeFile, ClassesThatRiseToAHundredAreNoCurve) {
  for (const char* table :
       {"Diff. Volume %\n300,0\n400,0\n500,100\n", "Volume %\n300,0\n400,0\n500,100\n",
        "Frequency\n300,0\n400,0\n500,100\n"}) {
    const SizeDistribution sizes = ReadText("Size (um)," + std::string(table));
    EXPECT_EQ(sizes.kind, SizeKind::kClasses) << table;
    ASSERT_EQ(sizes.diameters.size(), 2u) << table;
    EXPECT_NEAR(sizes.diameters[0], std::sqrt(400e-6 * 500e-6), 1e-12) << table;
    EXPECT_NEAR(sizes.diameters[1], 500e-6 * std::sqrt(500.0 / 400), 1e-12) << table;
  }
  EXPECT_EQ(ReadText("Size (um),Diff. %\n1,1\n2,30\n3,100\n").kind, SizeKind::kClasses);
  EXPECT_EQ(ReadText("Size (um),%\n1,1\n2,30\n3,100\n").kind, SizeKind::kCumulative);
}

// "Undersize" was taken for the diameter, and q3, a density, for Q3.
TEST(SizeFile, ColumnsAreToldByTheWordsOfTheirTitles) {
  const SizeDistribution undersize = ReadText("Undersize [%],Sieve [mm]\n0,1\n50,2\n100,3\n");
  EXPECT_EQ(undersize.kind, SizeKind::kCumulative);
  EXPECT_NEAR(SizeCurve(undersize).VolumeQuantile(0.5), 2e-3, 1e-8);
  const SizeDistribution both =
      ReadText("x [um],q3(x) [1/um],Q3(x) [%]\n10,0.1,0\n20,0.3,40\n30,0.1,90\n");
  EXPECT_EQ(both.kind, SizeKind::kCumulative);
  EXPECT_EQ(both.shares, (std::vector<double>{0, 40, 90}));
  EXPECT_EQ(ReadText("d (mm);% less than d\n1;10\n2;60\n3;90\n").kind, SizeKind::kCumulative);
}

TEST(SizeFile, TheUnitIsThatOfTheTitles) {
  const auto error = [](const std::string& text) { return ErrorIn([&] { ReadText(text); }); };
  EXPECT_THAT(error("Instrument: 300 mm lens\nSize,% under\n1,0\n2,100\n"),
              HasSubstr("in which unit"));
  const SizeDistribution sizes = ReadText("Volume diameter (um),% under\n1,0\n2,100\n");
  EXPECT_NEAR(sizes.diameters.back(), 2e-6, 1e-15);
}

// They were taken for two columns each.
TEST(SizeFile, DecimalCommasBetweenCommasAreRefused) {
  const auto error = [](const std::string& text) { return ErrorIn([&] { ReadText(text); }); };
  EXPECT_THAT(error("Size (um),Volume (%)\n12,5,10,5\n20,5,89,5\n"),
              HasSubstr("line 2: has 4 fields below 2 titles; decimal commas are likely"));
}

// "1,250" of a spreadsheet became a count of 1.25 beside 980, and its class was gone.
TEST(SizeFile, CommasBetweenThousandsAreRefused) {
  const auto error = [](const std::string& text) { return ErrorIn([&] { ReadText(text); }); };
  for (const char* text : {"d (mm),Count (number)\n0.5,980\n0.7,\"1,250\"\n0.9,\"1,100\"\n",
                           "d (mm);Count (number)\n0.5;\"1,250\"\n0.7;1,100\n0.9;700\n"}) {
    EXPECT_THAT(error(text), HasSubstr("has a comma between thousands; write 1250")) << text;
  }
  // Decimals all the same.
  EXPECT_EQ(ReadText("d (mm);Q3 (%)\n0,500;0,125\n0,700;50,125\n1,250;100\n").diameters.size(), 3u);
}

// They were taken away one by one, in time that grew as the square: minutes for a million.
TEST(SizeFile, AMillionEmptyClassesAreDroppedAtOnce) {
  std::string text = "size (um),% in class\n";
  for (int i = 1; i <= 1000000; ++i) text += std::to_string(i) + ",0\n";
  const SizeDistribution sizes = ReadText(text + "1000001,40\n1000002,60\n1000003,0\n");
  EXPECT_THAT(sizes.shares, ::testing::ElementsAre(40, 60));
  EXPECT_EQ(sizes.diameters.size(), 3u);
}

// Blank lines part nothing; below another title another table begins; the last edge has no class.
TEST(SizeFile, BlankLinesAndEmptyFieldsEndNoTable) {
  const SizeDistribution sizes = ReadText(
      "lower (um);vol % in;n\n50;<0.1;1\n70;-;1\n100;10;3\n\n200;30;5\n300;;7\n400;60;2\n500\nD50 "
      "(um);D90 (um)\n210;390\n");
  EXPECT_EQ(sizes.shares, (std::vector<double>{10, 30, 0, 60}));
  EXPECT_NEAR(sizes.diameters[2], 300e-6, 1e-12);
}

TEST(SizeFile, OfMoreThanSixteenMebibytesIsRefused) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "large.csv";
  std::ofstream(path) << "size (um),% in class\n10,50\n20,50\n";
  SizeDistribution sizes{.kind = SizeKind::kFile, .file = path};
  EXPECT_NO_THROW(ReadSizeFile(sizes));
  std::filesystem::resize_file(path, 17u << 20);
  sizes = {.kind = SizeKind::kFile, .file = path};
  EXPECT_THROW(ReadSizeFile(sizes), base::ConfigError);
}

TEST(SizeFile, WhatCannotBeReadIsNamedWithItsRemedy) {
  const auto error = [](const std::string& text) { return ErrorIn([&] { ReadText(text); }); };
  EXPECT_THAT(error("size,% under\n1,0\n2,100\n"), HasSubstr("in which unit"));
  EXPECT_THAT(error("nothing here"), HasSubstr("has no table"));
  EXPECT_THAT(error("size (um),% over\n1,100\n2,0\n"), HasSubstr("coarser"));
  EXPECT_THAT(error("x (um),q3 [1/um]\n1,0.4\n2,0.6\n"), HasSubstr("density"));
  EXPECT_THAT(error("size (um),% under\n1,50\n2,40\n3,100\n"), HasSubstr("shares[1]"));
  // A line without a share is refused, not skipped, and so is a second table.
  EXPECT_THAT(error("size (um),% under\n1,20\n2\n3,60\n4,100\n"),
              HasSubstr("line 3: has no share"));
  EXPECT_THAT(error("size (um),% under,n\n1,20,3\n2,n/a,4\n3,60,3\n4,100,1\n"),
              HasSubstr("line 3: its share is not a number"));
  EXPECT_THAT(error("size (um),% under\n1,20\n2,60\n3,100\n\n1,5\n2,9\n"),
              HasSubstr("line 6: a second table begins without a title"));
  EXPECT_THAT(error("\xFF\xFE"
                    "s"),
              HasSubstr("UTF-16"));
  SizeDistribution missing{.kind = SizeKind::kFile, .file = "/nowhere/x.csv"};
  EXPECT_THROW(ReadSizeFile(missing), base::ConfigError);
}

// Thirty grains of a wide distribution hold none of its coarse end.
TEST(LostSizes, AreSaidWhereTheDrawnD90IsBelowTheCurvesByATwentieth) {
  const SizeCurve curve({.kind = SizeKind::kLogNormal, .median = 1e-3, .sigma = 0.7});
  int num_said = 0;
  for (const double count : {30.0, 100.0, 1000.0, 1e5}) {
    const double volume = count * curve.mean_volume();
    const double drawn = SampleVolumeQuantile(DrawDiameters(curve, volume), 0.9);
    const bool is_said = !LostSizes(curve, volume).empty();
    EXPECT_EQ(is_said, drawn < 0.95 * curve.VolumeQuantile(0.9)) << count;
    num_said += is_said ? 1 : 0;
  }
  EXPECT_GT(num_said, 0);
  EXPECT_LT(num_said, 4);
}

}  // namespace size_distribution_test
}  // namespace talus::engine
