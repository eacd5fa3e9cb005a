// The answer on one sheet says what it leaves to the page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/analysis/report/page/page.h"
#include "experiments/analysis/report/page/summary.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace summary_page_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(SummaryPage, CountsTheMeasurementsThatItHasNoRoomFor) {
  Evidence evidence = test::MakeSyntheticCampaign();
  evidence.fit.assign(8, {.experiment = "heap", .what = "mass fallen"});
  EXPECT_THAT(SummaryPage(MakeReportData(evidence)), Not(HasSubstr("more on the page")));
  evidence.fit.resize(11);
  EXPECT_THAT(SummaryPage(MakeReportData(evidence)), HasSubstr("and 3 more on the page"));
}

// The second experiment was shown, whether or not it had anything to show.
TEST(SummaryPage, ShowsTheHeapsOfExperimentsThatHaveSome) {
  const Evidence evidence = test::MakeSyntheticCampaign();
  std::vector<Evidence> others(2, evidence);
  for (Evidence& other : others) other.experiments = {"heap", "weighed", "wide plate"};
  others[0].experiment = 1;
  others[0].reference.aehp = {};
  others[1].experiment = 2;
  ReportData data = MakeReportData(evidence, others);
  data.others[0].pictures.clear();
  EXPECT_THAT(SummaryPage(data), HasSubstr("wide plate, simulated"));
}

// The sheet had the smallest region, the page the pair that changes together.
TEST(ClosestPair, IsTheTradedOneAndElseTheSmallestOfSheetAndPage) {
  ReportData data = MakeReportData(test::MakeSyntheticCampaign());
  ASSERT_EQ(data.pairs.size(), 3u);
  data.evidence.answer->correlation = {{1, 0, 0.9}, {0, 1, 0}, {0.9, 0, 1}};
  EXPECT_EQ(ClosestPair(data), 1u);
  EXPECT_EQ(json::parse(PageJson(data))["closest_pair"], 1);
  EXPECT_THAT(SummaryPage(data), HasSubstr(data.evidence.parameters[2].symbol + " ("));
  data.evidence.answer->correlation = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto inside = [](const PairMap& pair) {
    return std::ranges::count_if(pair.value, [](double level) { return level < 0.9; });
  };
  const auto least = std::ranges::min_element(data.pairs, {}, inside);
  EXPECT_EQ(ClosestPair(data), static_cast<std::size_t>(least - data.pairs.begin()));
  data.pairs.clear();
  EXPECT_FALSE(ClosestPair(data).has_value());
}

}  // namespace summary_page_test
}  // namespace talus::analysis
