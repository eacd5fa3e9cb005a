#include "optimizer/space/parameter_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/json/json_reader.h"
#include "optimizer/space/candidate_table.h"
#include "tests/error_in.h"

namespace talus::optimizer {
namespace parameter_space_test {

using ::testing::HasSubstr;

ParameterSpace Load(std::string_view text) {
  return base::LoadOptions<ParameterSpace>(base::ParseJson(text, "space.json"));
}

std::string ErrorOf(std::string_view text) {
  return ErrorIn([&] { Load(text); });
}

constexpr const char* kSpace = R"({
  "parameters": [{"name": "a", "low": -1, "high": 3, "guess": 0},
                 {"name": "b", "fixed": 7},
                 {"name": "c", "low": 1e-6, "high": 1e-2, "scale": "log"}],
  "constraints": [{"terms": [{"parameter": "a"}, {"parameter": "c", "factor": 100}],
                   "at_most": 2}]})";

TEST(ParameterSpace, MapsLinearLogAndFixedParameters) {
  const ParameterSpace space = Load(kSpace);
  const std::vector<double> native = space.ToNative(Eigen::Vector2d(0.25, 0.5));
  ASSERT_EQ(native.size(), 3u);
  EXPECT_DOUBLE_EQ(native[0], 0);
  EXPECT_DOUBLE_EQ(native[1], 7);
  EXPECT_NEAR(native[2], 1e-4, 1e-18);  // middle of four decades; rounding of pow
  // Two roundings of log and pow, far below kSamePoint.
  EXPECT_TRUE(space.ToUnit(native).isApprox(Eigen::Vector2d(0.25, 0.5), 1e-14));
  EXPECT_EQ(space.ToNative(Eigen::Vector2d(1, 1))[2], 1e-2);  // an end is met exactly
}

TEST(ParameterSpace, DomainHasTheGuessAndTheConstraints) {
  const Domain domain = Load(kSpace).MakeDomain();
  EXPECT_EQ(domain.num_parameters, 2);
  ASSERT_EQ(domain.guesses.size(), 1u);
  EXPECT_EQ(domain.guesses[0], Eigen::Vector2d(0.25, 0.5));
  EXPECT_TRUE(domain.Contains(Eigen::Vector2d(0.7, 0.5)));     // 1.8 + 0.01
  EXPECT_FALSE(domain.Contains(Eigen::Vector2d(0.7, 1)));      // 1.8 + 1
  EXPECT_FALSE(domain.Contains(Eigen::Vector2d(-0.01, 0.5)));  // outside the cube
}

TEST(ParameterSpace, ReportsEveryMistakeWithItsPlace) {
  const std::string error = ErrorOf(R"({"parameters": [
    {"name": "a", "low": 1, "high": 1},
    {"name": "b", "low": 0, "high": 1, "scale": "log"},
    {"name": "a", "low": 0, "high": 1, "guess": 2},
    {"name": "gamma", "low": 0}],
    "constraints": [{"terms": [{"parameter": "gama"}], "at_most": 1}]})");
  EXPECT_THAT(error, HasSubstr("parameters[0].high: is 1, must be above low"));
  EXPECT_THAT(error, HasSubstr("parameters[1].low: is 0, must be positive on a log scale"));
  EXPECT_THAT(error, HasSubstr("parameters[2].guess: is 2, must lie in [low, high]"));
  EXPECT_THAT(error, HasSubstr("parameters[3].high"));
  EXPECT_THAT(error, HasSubstr("\"a\" is there twice"));
  EXPECT_THAT(error, HasSubstr("did you mean \"gamma\"?"));
}

TEST(ParameterSpace, AGuessMustMeetTheConstraints) {
  const auto with_guess = [](double guess) {
    return R"({"parameters": [{"name": "a", "low": 0, "high": 1, "guess": )" +
           std::to_string(guess) + R"(}, {"name": "b", "low": 0.01, "high": 0.7, "guess": 0.2},
                                      {"name": "c", "low": 0, "high": 1}],
      "constraints": [{"terms": [{"parameter": "a"}, {"parameter": "b", "factor": -1}], "at_most": 0},
                      {"terms": [{"parameter": "a"}, {"parameter": "c"}], "at_most": 0.1}]})";
  };
  // On the border, but for rounding; nobody has guessed c.
  EXPECT_EQ(ErrorOf(with_guess(0.2)), "");
  EXPECT_THAT(ErrorOf(with_guess(0.6)), HasSubstr("constraints[0]: is not met by the guesses"));
}

// 0.1 + 0.2 is above 0.3, but for rounding.
TEST(ParameterSpace, APointOnAConstraintMeetsIt) {
  const ParameterSpace space = Load(R"({"parameters": [
      {"name": "a", "low": 0, "high": 1, "guess": 0.1},
      {"name": "b", "low": 0, "high": 1, "guess": 0.2}],
    "constraints": [{"terms": [{"parameter": "a"}, {"parameter": "b"}], "at_most": 0.3}]})");
  EXPECT_TRUE(space.Satisfies(std::vector<double>{0.1, 0.2}));
  EXPECT_FALSE(space.Satisfies(std::vector<double>{0.1, 0.2 + 1e-6}));
  EXPECT_EQ(space.MakeDomain().guesses.size(), 1u);
}

// The middle of what is not guessed breaks the constraint; the guess was dropped without a word.
TEST(ParameterSpace, WhatIsNotGuessedMovesBetweenTheConstraints) {
  const ParameterSpace space = Load(R"({"parameters": [
      {"name": "a", "low": 0, "high": 1, "guess": 0.3}, {"name": "b", "low": 0, "high": 1}],
    "constraints": [{"terms": [{"parameter": "a"}, {"parameter": "b"}], "at_most": 0.5}]})");
  const std::vector<Eigen::VectorXd> guesses = space.MakeDomain().guesses;
  ASSERT_EQ(guesses.size(), 1u);
  EXPECT_EQ(guesses[0][0], 0.3);
  EXPECT_LE(guesses[0][1], 0.2);
  EXPECT_GT(guesses[0][1], 0.19);  // the nearest of 1000 draws to 0.5, of which 200 are below 0.2
}

TEST(CandidateTable, SemicolonsSeparateWhereThereAreNoCommas) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "semicolons.csv";
  std::ofstream(path) << "b;a\n1.5;2\n3;4\n";
  EXPECT_EQ(ReadCandidateTable(path, {"a", "b"}),
            (std::vector<std::vector<double>>{{2, 1.5}, {4, 3}}));
  std::ofstream(path) << "a;b\n1,5;2\n";  // and there the comma is the decimals'
  EXPECT_EQ(ReadCandidateTable(path, {"a", "b"}), (std::vector<std::vector<double>>{{1.5, 2}}));
}

// 1e-05 came out as 1.0000000000000003e-05, which is no row of the table.
TEST(CandidateTable, ASetComesOutAsTheTableHasIt) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "written.csv";
  std::ofstream(path) << "a,b\n1e-05,0.1\n3e-4,0.3\n0.0007,0.7\n";
  ParameterSpace space{
      .parameters = {{.name = "a", .low = 1e-6, .high = 1e-3, .scale = Scale::kLog},
                     {.name = "b", .low = 0, .high = 0.9}},
      .candidates = path};
  const Domain domain = space.MakeDomain();
  std::vector<std::vector<double>> sets;
  for (const auto& row : domain.candidates.rowwise())
    sets.push_back(space.ToNative(row.transpose()));
  EXPECT_EQ(sets, (std::vector<std::vector<double>>{{1e-5, 0.1}, {3e-4, 0.3}, {7e-4, 0.7}}));
}

// They were read as the neighbour's numbers, without a word.
TEST(CandidateTable, CellsThatBelongToNoColumnAreRefusedAndQuotedOnesAreOne) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "cells.csv";
  const auto read = [&](const std::string& text) {
    std::ofstream(path) << text;
    return ReadCandidateTable(path, {"a", "b"});
  };
  using Rows = std::vector<std::vector<double>>;
  EXPECT_EQ(read("note,a,b\n\"run 7, \"\"0.9\"\"\",0.1,\"0.2\"\n"), (Rows{{0.1, 0.2}}));
  EXPECT_EQ(read("a,b,,\n0.1,0.2,,\n,,,\n"), (Rows{{0.1, 0.2}}));
  EXPECT_EQ(read("a,b,sieve\n0.1,0.2,5\"\n"), (Rows{{0.1, 0.2}}));  // inches
  EXPECT_EQ(read("\"a\",\"the \"\"b\"\"\",b\n0.1,0.3,0.2\n"), (Rows{{0.1, 0.2}}));
  EXPECT_THAT(ErrorIn([&] { read("a,b\n0,1,0,2\n"); }),
              HasSubstr("cells.csv:2: has 4 cells and the head 2; write decimals with a point"));
  EXPECT_THAT(ErrorIn([&] { read("a,b,a\n1,2,3\n"); }), HasSubstr("two columns \"a\""));
  EXPECT_THAT(ErrorIn([&] { read("a,b\n\"1,2\n"); }), HasSubstr("cells.csv:2: has a quote"));
}

TEST(ParameterSpace, WhatIsFixedHasNoRange) {
  const std::string error =
      ErrorOf(R"({"parameters": [{"name": "a", "fixed": 1, "low": 0, "high": 2, "guess": 1}]})");
  for (const char* key : {"low", "high", "guess"}) {
    EXPECT_THAT(error, HasSubstr("parameters[0]." + std::string(key)));
  }
}

TEST(ParameterSpace, WantsOneToSixFreeParameters) {
  EXPECT_THAT(ErrorOf(R"({"parameters": [{"name": "a", "fixed": 1}]})"), HasSubstr("0 are free"));
  std::string list;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"}) {
    list += std::string(list.empty() ? "" : ",") + R"({"low":0,"high":1,"name":")" + name + "\"}";
  }
  EXPECT_THAT(ErrorOf("{\"parameters\": [" + list + "]}"), HasSubstr("7 are free"));
}

// What is given of a set may break a constraint; what is not known breaks none.
TEST(ParameterSpace, TheConstraintThatIsBrokenIsNamed) {
  ParameterSpace space;
  space.parameters = {{.name = "a", .low = 0, .high = 1}, {.name = "b", .low = 0, .high = 1}};
  space.constraints = {{.terms = {{"b", 1}, {"a", -0.5}}, .at_most = 0}};
  const auto broken = [&](double a, double b, double slack = 1e-9) {
    const std::vector<double> native{a, b};
    return space.BrokenBy(native, slack).value_or("none");
  };
  EXPECT_EQ(broken(0.4, 0.3), "b - 0.5 a <= 0");
  EXPECT_EQ(broken(0.4, 0.1), "none");
  EXPECT_EQ(broken(0.201, 0.101), "b - 0.5 a <= 0");
  EXPECT_EQ(broken(0.201, 0.101, 5e-3), "none");  // 0.1005, typed with three digits
  EXPECT_EQ(broken(std::nan(""), 0.3), "none");
}

}  // namespace parameter_space_test
}  // namespace talus::optimizer
