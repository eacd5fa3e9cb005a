// The several ranges of one parameter.
#include "experiments/analysis/report/views/width_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/analysis/report/page/page.h"
#include "tests/experiments/synthetic_campaign.h"

namespace talus::analysis {
namespace width_views_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// The synthetic valley is a normal of 0.18 along and 0.02 across: in two dimensions its joint 90 %
// region reaches to 2.15 standard deviations, a range for both at once to some 1.8, and across it
// 3.3 · 0.02 · 1.3 holds 90 %, more where the valley bends. Each is 0.699 wide in the unit cube.
TEST(WidthViews, SeveralRangesOfAParameterStandBesideEachOtherAndSayWhatTheyAre) {
  Evidence evidence = test::MakeSyntheticCampaign({.num_parameters = 2});
  evidence.answer->posterior->alone = {
      {.name = "heap", .values = {0.3, 0.2}, .low = {0.1, 0.05}, .high = {0.6, 0.4}}};
  const std::vector<WidthView> views = WidthViews(evidence, PosteriorPairs(evidence));
  ASSERT_EQ(views.size(), 4u);
  const auto width = [&](std::size_t view) {
    return evidence.parameters[0].range.ToUnit(views[view].high[0]) -
           evidence.parameters[0].range.ToUnit(views[view].low[0]);
  };
  EXPECT_EQ(views[0].low[0], evidence.answer->parameters[0].credible_low);
  EXPECT_GT(width(1), 1.05 * width(0));
  EXPECT_LT(width(1), 1.4 * width(0));
  EXPECT_LT(width(2), 0.35 * width(0));
  EXPECT_GT(width(2), 3 * 0.02);
  EXPECT_EQ(views[3].title, "heap alone");
  EXPECT_EQ(views[3].high[1], 0.4);
  for (const WidthView& view : views) EXPECT_GT(view.means.size(), 30u) << view.title;
  const json page = json::parse(PageJson(MakeReportData(evidence)))["headline"]["widths"];
  EXPECT_EQ(page.size(), 4u);
  EXPECT_TRUE(WidthViews(test::MakeSyntheticCampaign({.num_trials = 12}), {}).empty());  // no model
}

// By a few draws the shadow was narrower than the figure that it names.
TEST(WidthViews, TheShadowReachesAsFarAsTheFiguresShow) {
  Evidence evidence = test::MakeSyntheticCampaign();
  const std::vector<PairMap> pairs = PosteriorPairs(evidence);
  const Eigen::MatrixXd few = evidence.model->draws.topRows(12);
  evidence.model->draws = few;
  const WidthView by_draws = WidthViews(evidence, {})[1];
  const WidthView shown = WidthViews(evidence, pairs)[1];
  const PairMap& pair = pairs.front();
  const std::size_t columns = pair.x_edges.size() - 1;
  double low = pair.x_edges.back();
  for (std::size_t c = 0; c < pair.value.size(); ++c) {
    if (pair.value[c] < 0.9) low = std::min(low, pair.x_edges[c % columns]);
  }
  EXPECT_LE(shown.low[0], low);
  EXPECT_LT(shown.low[0], by_draws.low[0]);
  EXPECT_GT(shown.high[0], by_draws.high[0]);
}

TEST(WidthViews, OfANuisanceTheRangeIsSaidToBeByItself) {
  Evidence evidence = test::MakeSyntheticCampaign();
  EXPECT_THAT(WidthViews(evidence, {})[0].means, HasSubstr("all parameters at once"));
  evidence.parameters[2].range.is_nuisance = true;
  EXPECT_THAT(WidthViews(evidence, {})[0].means, HasSubstr("of one not asked for, by itself"));
  // No figure shows it: its shadow is that of the draws.
  const WidthView shadow = WidthViews(evidence, PosteriorPairs(evidence))[1];
  EXPECT_LT(shadow.low[2], shadow.high[2]);
}

}  // namespace width_views_test
}  // namespace talus::analysis
