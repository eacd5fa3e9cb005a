// What a surrogate that knows more would do to the ranges.
#include "optimizer/posterior/expected_narrowing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace talus::optimizer {
namespace expected_narrowing_test {

const Levels kLevels({1}, 1);

// A number that rises with the first of two parameters and knows nothing of the second.
struct Line {
  Posterior Make() const {
    OutputData data;
    base::Random random(5, base::Stream("sets"));
    for (int i = 0; i < 10; ++i) {
      data.points.push_back(Eigen::Vector2d((i + 0.5) / 10, random.Uniform()));
      data.level.push_back(0);
      data.scalars.push_back({2 + data.points.back()[0] + 0.02 * random.Normal()});
    }
    std::vector<ExperimentModel> models;
    models.emplace_back(
        ExperimentModel::Setup{.target = &target, .code = nullptr, .levels = &kLevels}, data,
        nullptr);
    return {std::move(models), {data}};
  }

  ExperimentTarget target{.name = "line", .scalars = {{"height", 2.5, 0.06}}};
  Domain domain{.num_parameters = 2};
};

// All densities of x are of one shape, as wide as √(λ c² V + B): where λ is 0 only B is left. The
// 400 draws tell a width within 5 %, and a drawn error has a slope of its own: what eight samples
// find scatters by 0.06, their mean by 0.02.
TEST(ExpectedNarrowing, ASurrogateThatIsSureLeavesTheMeasurementsError) {
  const Line line;
  const Posterior posterior = line.Make();
  const ExperimentModel& model = posterior.models()[0];
  const Eigen::MatrixXd draws = posterior.Sample(line.domain, 3000, 1, 1).Draws(400, 1);
  const double v = model.Outputs(draws).variance.mean();
  const double b = model.open()[0];
  const double c = model.caution();
  const std::vector<SurrogateAhead> sure{{.left = Eigen::VectorXd::Zero(1)}};
  const double expected = 1 - std::sqrt(b / (c * c * v + b));
  ASSERT_GT(expected, 0.15);
  constexpr int kSamples = 8;
  double found = 0;
  for (std::uint64_t seed = 1; seed <= kSamples; ++seed) {
    const Eigen::MatrixXd drawn = posterior.Sample(line.domain, 3000, 1, seed).Draws(400, seed);
    found += ExpectedNarrowing(posterior, drawn, seed).Of({0}, sure)[0] / kSamples;
  }
  EXPECT_NEAR(found, expected, 0.06);
  // What the output does not know stays as it is.
  EXPECT_LT(ExpectedNarrowing(posterior, draws, 1).Of({1}, sure)[0], 0.1);
}

TEST(ExpectedNarrowing, ASurrogateThatLearnsNothingNarrowsNothing) {
  const Line line;
  const Posterior posterior = line.Make();
  const Eigen::MatrixXd draws = posterior.Sample(line.domain, 3000, 1, 1).Draws(400, 1);
  const std::vector<SurrogateAhead> same{{.left = Eigen::VectorXd::Ones(1)}};
  EXPECT_LT(ExpectedNarrowing(posterior, draws, 1).Of({0, 1}, same).maxCoeff(), 1e-12);
}

}  // namespace expected_narrowing_test
}  // namespace talus::optimizer
