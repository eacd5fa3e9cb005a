#include "surrogate/process/covariance.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace talus::surrogate {
namespace covariance_test {

Sites SomeSites(Eigen::Index count, Eigen::VectorXd growth, std::uint64_t seed) {
  base::Random random(seed, base::Stream("some sites"));
  Eigen::MatrixXd columns(3, count);
  for (double& x : columns.reshaped()) x = random.Uniform();
  return {std::move(columns),
          growth.replicate((count + growth.size() - 1) / growth.size(), 1).topRows(count)};
}

class Columns : public ::testing::TestWithParam<Kernel> {};

// Campaigns must not depend on which of the two is asked, so the bits are compared.
TEST_P(Columns, AreThePairsOneByOne) {
  const Eigen::VectorXd length{{0.4, 0.8, 1.3}};
  const Hyperparameters one{.length = length, .signal = 1.3, .trend = 0.6};
  Hyperparameters several = one;
  several.scale = ScaleTerm{.discrepancy = 0.3, .decay = 0.7, .length_ratio = 1.4};
  const Eigen::VectorXd at_target{{0.0}};
  const Eigen::VectorXd mixed{{0.0, 0.4, 1.0, 0.4}};
  for (const Hyperparameters& hyper : {one, several}) {
    const Covariance covariance(GetParam(), hyper);
    for (const Eigen::VectorXd& growth_a : {at_target, mixed}) {
      for (const Eigen::VectorXd& growth_b : {at_target, mixed}) {
        const Sites a = SomeSites(23, growth_a, 1);
        const Sites b = SomeSites(17, growth_b, 2);
        const Eigen::MatrixXd all = covariance.Between(a, b);
        ASSERT_EQ(all.rows(), 23);
        ASSERT_EQ(all.cols(), 17);
        for (Eigen::Index i = 0; i < all.rows(); ++i) {
          for (Eigen::Index j = 0; j < all.cols(); ++j) {
            EXPECT_EQ(all(i, j), covariance.At(a.columns.col(i).data(), b.columns.col(j).data(),
                                               a.growth[i], b.growth[j]));
          }
        }
        EXPECT_EQ(covariance.Among(a), covariance.Between(a, a));
      }
    }
  }
}

// At one length scale: (1 + √5 + 5/3) e^−√5 and e^−½; and a trend of p + p², p =
// (2a − 1)(2b − 1).
TEST(Kernels, HaveTheirPublishedValues) {
  const double a = 0.25, b = 0.75;
  const auto at = [&](Kernel kernel, double signal, double trend) {
    const Hyperparameters hyper{.length = Eigen::VectorXd::Constant(1, 0.5),
                                .signal = signal,
                                .trend = trend,
                                .constant = 0};
    return Covariance(kernel, hyper).At(&a, &b, 0, 0);
  };
  EXPECT_NEAR(at(Kernel::kMatern52, 1, 0), 0.523994, 1e-6);
  EXPECT_NEAR(at(Kernel::kSquaredExponential, 1, 0), 0.606531, 1e-6);
  EXPECT_NEAR(at(Kernel::kMatern52, 2, 0), 4 * 0.523994, 4e-6);
  EXPECT_NEAR(at(Kernel::kMatern52, 0, 3), 9 * (-0.25 + 0.0625), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Kernels, Columns,
                         ::testing::Values(Kernel::kMatern52, Kernel::kSquaredExponential));

}  // namespace covariance_test
}  // namespace talus::surrogate
