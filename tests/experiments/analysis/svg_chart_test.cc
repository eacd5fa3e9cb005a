// Charts that need no script: those of a search, and of the sheet to print.
#include "experiments/analysis/report/charts/svg_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace talus::analysis {
namespace svg_chart_test {

using testing::HasSubstr;
using testing::Not;

TEST(SvgChart, PutsValuesWhereTheyBelong) {
  SvgChart chart({.title = "x", .low = 1e-6, .high = 1e-2, .log = true},
                 {.title = "y", .low = 0, .high = 10});
  chart.Points({{1e-4, 5}, {1, 5}}, {.width = 4});  // the second is off the axis
  // The plot is 550 by 340 pixels.
  EXPECT_THAT(chart.Text(), HasSubstr("<circle cx=\"275.00\" cy=\"170.00\""));
  EXPECT_EQ(chart.Text().find("<circle"), chart.Text().rfind("<circle"));
}

TEST(SvgChart, IsAnImageWithAName) {
  SvgChart chart({.title = "x < 1"}, {.title = "y"});
  EXPECT_THAT(chart.Text(), HasSubstr("role=\"img\""));
  EXPECT_THAT(chart.Text(), HasSubstr("<title>y over x &lt; 1</title>"));
}

TEST(SvgChart, AnAxisOfNumbersHasNoHalves) {
  SvgChart chart({.title = "batch", .low = 0.5, .high = 2.5, .whole = true}, {.title = "y"});
  EXPECT_THAT(chart.Text(), HasSubstr(">1</text>"));
  EXPECT_THAT(chart.Text(), HasSubstr(">2</text>"));
  EXPECT_THAT(chart.Text(), Not(HasSubstr(">1.5</text>")));
}

TEST(SvgChart, WritesPowersOfTenAsThePageDoes) {
  const std::string chart = SvgChart({.title = "γ (J/m²)", .low = 1e-6, .high = 1e-2, .log = true},
                                     {.title = "cost", .low = 0, .high = 4e6})
                                .Text();
  for (const char* tick :
       {">10⁻⁶<", ">10⁻⁵<", ">10⁻⁴<", ">0.001<", ">0.01<", ">10⁶<", ">3 × 10⁶<"}) {
    EXPECT_THAT(chart, HasSubstr(tick));
  }
  EXPECT_THAT(chart, Not(HasSubstr("e-0")));
}

// Four digits of 1 234 567 and 1 234 577 are the same, and a wide label began outside of the image.
TEST(SvgChart, TicksOfALargeValueThatChangesLittleAreToldApartAndSeen) {
  const std::string chart =
      SvgChart({.title = "x"}, {.title = "value", .low = 1234560, .high = 1234600}).Text();
  EXPECT_THAT(chart, HasSubstr(">1.23457 × 10⁶<"));
  EXPECT_THAT(chart, HasSubstr(">1.23458 × 10⁶<"));
  const auto width = [](const std::string& text) {
    return std::stod(text.substr(text.find("width=\"") + 7));
  };
  const std::string narrow = SvgChart({.title = "x"}, {.title = "y", .low = 0, .high = 1}).Text();
  EXPECT_DOUBLE_EQ(width(narrow), 640);
  // A label has 14 characters of some 8 px, and the title stands beside it.
  EXPECT_GT(width(chart), 640 - 72 + 14 * 8 + 20);
}

// Seven digits of -1 000 000.5 are those of -10⁶, which is written otherwise.
TEST(SvgChart, ATickThatIsRoundedToAPowerOfTenIsToldApartFromIt) {
  const std::string chart =
      SvgChart({.title = "x"}, {.title = "y", .low = -1000001, .high = -999998.5}).Text();
  EXPECT_THAT(chart, HasSubstr(">-1 × 10⁶<"));
  EXPECT_THAT(chart, HasSubstr(">-1000000.5<"));
  EXPECT_THAT(chart, Not(HasSubstr(">-1000000<")));
}

// Only powers of ten were ticks: an axis of less than a decade had one or none.
TEST(SvgChart, AShortLogarithmicAxisHasTicks) {
  const std::string chart = SvgChart({.title = "x", .low = 0.2, .high = 0.9, .log = true},
                                     {.title = "y", .low = 0.31, .high = 0.38, .log = true})
                                .Text();
  for (const char* tick : {">0.2<", ">0.5<", ">0.32<", ">0.34<", ">0.36<"}) {
    EXPECT_THAT(chart, HasSubstr(tick));
  }
}

// 0.3 and the next number: k steps and k + 1 are the same.
TEST(SvgChart, AnAxisAsShortAsTheRoundingOfItsEndsIsDrawn) {
  const std::string chart = SvgChart({.title = "x", .low = 0.3, .high = std::nextafter(0.3, 1)},
                                     {.title = "y", .low = 2, .high = 2})
                                .Text();
  EXPECT_LT(chart.size(), 10000u);
}

}  // namespace svg_chart_test
}  // namespace talus::analysis
