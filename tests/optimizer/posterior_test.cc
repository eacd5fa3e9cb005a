// The joint posterior of several tests: what a test that is held out, or weighs less, counts for.
#include "optimizer/posterior/posterior.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace talus::optimizer {
namespace posterior_test {

// One number, 2 + slope · x₀ with a scatter of 0.02, of 24 sets; measured in the middle.
class OneNumber {
 public:
  OneNumber(double slope, double weight)
      : target_{.name = "test", .scalars = {{"a", 2 + 0.5 * slope, 0.02}}} {
    target_.weight = weight;
    base::Random random(3, base::Stream("sets"));
    for (int i = 0; i < 24; ++i) {
      data_.points.push_back(Eigen::Vector2d(random.Uniform(), random.Uniform()));
      data_.level.push_back(0);
      data_.scalars.push_back({2 + slope * data_.points.back()[0] + 0.02 * random.Normal()});
    }
  }
  ExperimentModel Model() const {
    return {{.target = &target_, .code = nullptr, .levels = &levels_}, data_, nullptr};
  }
  const OutputData& data() const { return data_; }

 private:
  Levels levels_{{1}, 1};
  ExperimentTarget target_;
  OutputData data_;
};

Eigen::MatrixXd Some() {
  Eigen::MatrixXd points(5, 2);
  points << 0.5, 0.5, 0.51, 0.2, 0.49, 0.9, 0.3, 0.3, 0.8, 0.1;
  return points;
}

// Neither its misfit, nor its correlation with the other, nor its failures.
TEST(Posterior, ATestThatIsHeldOutChangesNothing) {
  const OneNumber first(1, 1), held_out(-1, 0);
  std::vector<ExperimentModel> one, two;
  one.push_back(first.Model());
  two.push_back(first.Model());
  two.push_back(held_out.Model());
  const Posterior alone(std::move(one), {first.data()});
  Posterior both(std::move(two), {first.data(), held_out.data()});
  EXPECT_EQ(both.LogDensity(Some()), alone.LogDensity(Some()));
  EXPECT_EQ(both.temper(), alone.temper());
  Eigen::VectorXd worked = Eigen::VectorXd::Ones(5);
  worked[0] = 0;
  both.CountSuccesses(1, SuccessModel(Some(), worked));
  EXPECT_EQ(both.LogSuccess(Some()), Eigen::VectorXd::Zero(5));
}

// Log of the standard deviations included. Near what was measured the misfit is quadratic.
TEST(Posterior, AWeightMultipliesTheWholeLogDensity) {
  const OneNumber whole(1, 1), half(1, 0.5);
  std::vector<ExperimentModel> one, two;
  one.push_back(whole.Model());
  two.push_back(half.Model());
  const Posterior a(std::move(one), {whole.data()}), b(std::move(two), {half.data()});
  const Eigen::MatrixXd near = Some().topRows(3);
  const Eigen::VectorXd of_whole = a.LogDensity(near), of_half = b.LogDensity(near);
  for (int i = 1; i < 3; ++i) {
    EXPECT_NEAR(of_half[i] - of_half[0], 0.5 * (of_whole[i] - of_whole[0]), 1e-12);
  }
}

TEST(LevelGrowth, IsNoneAtTheTargetAndOneAtTheCoarsest) {
  const Levels levels({3, 1, 2}, 1);
  EXPECT_EQ(levels.growth(0), 1);
  EXPECT_EQ(levels.growth(1), 0.5);
  EXPECT_EQ(levels.growth(2), 0);
}

}  // namespace posterior_test
}  // namespace talus::optimizer
