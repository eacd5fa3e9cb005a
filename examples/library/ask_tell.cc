// Drives a strategy by ask and tell: minimises a noisy function of two parameters.
#include <talus/base/error.h>
#include <talus/optimizer/strategy/make_strategy.h>

#include <iostream>
#include <random>

namespace optimizer = talus::optimizer;

namespace {

// Your simulation stands here. The point lies in the unit cube; the minimum is at (0.3, 0.7).
double Evaluate(const Eigen::VectorXd& point, std::mt19937_64& random) {
  const double noise = 0.02 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
  return (point - Eigen::Vector2d(0.3, 0.7)).squaredNorm() + noise;
}

}  // namespace

int main() {
  try {
    const optimizer::Domain domain{.num_parameters = 2};
    const optimizer::StrategyOptions options{.kind = optimizer::StrategyKind::kGp};
    const auto strategy = optimizer::MakeStrategy(options, domain, nullptr, 1);

    std::mt19937_64 random(1);
    int num_told = 0;
    while (num_told < 30 && !strategy->WhyStop()) {
      for (const optimizer::Proposal& proposal : strategy->Ask(1, {})) {
        strategy->Tell({.point = proposal.point, .value = Evaluate(proposal.point, random)});
        ++num_told;
      }
    }
    const optimizer::Answer answer = strategy->Recommend();
    std::cout << "after " << num_told << " evaluations: " << answer.point.transpose() << '\n';
    for (const optimizer::Range& range : answer.credible) {
      std::cout << "credible interval: " << range.low << " to " << range.high << '\n';
    }
  } catch (const talus::base::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
