// Runs `gp` on the noisy problems and prints, as CSV, how good its recommendation is on the way and
// what rules that end a search may look at. stop_rules.py scores such rules.
//
//   search_trace 601-612 [100 [NOISE LEVEL 1]] > trace.csv
//
// Every fourth evaluation from 24 on a row:
//
//   regret   of the recommendation, judged noise-free (README.md)
//   bounds   of the rule that there is: upper bound at the recommendation - lowest lower bound
//   left     E[posterior mean at the recommendation - minimum], over posterior draws
//   gain_k   the knowledge gradient of k evaluations at one place (knowledge_gradient.h)
//   past_k   what the last k evaluations have gained: the mean at the recommendation of then - now
//
// All but the regret in noise standard deviations.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/random.h"
#include "bench/optimizers/problems.h"
#include "optimizer/search/feasibility.h"
#include "optimizer/search/history.h"
#include "optimizer/search/knowledge_gradient.h"
#include "optimizer/search/model_step.h"
#include "optimizer/search/scalar_model.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::bench {
namespace {

constexpr int kFirst = 24;
constexpr int kStep = 4;
constexpr std::array kAhead{1, 4, 16};
constexpr std::array kAgo{4, 8, 16};

// What is left to gain, and what k more evaluations are expected to gain of it.
struct Gains {
  double left = 0;
  std::array<double, kAhead.size()> ahead = {};
};

Gains GainsOf(const optimizer::ModelView& view, const surrogate::GaussianProcess& process) {
  constexpr int kNumDraws = 256;
  const Eigen::MatrixXd minimisers = optimizer::PossibleMinimisers(view);
  const Eigen::VectorXd mean = process.PredictAll(minimisers).mean;
  Eigen::MatrixXd places(minimisers.rows() + 1, minimisers.cols());
  const auto of_one = optimizer::GainsOfValues(process, minimisers);
  places << minimisers, optimizer::MostKnowledge(view, of_one, minimisers).point.transpose();
  const surrogate::Covariances at =
      process.PosteriorCovariances(process.Anchor(minimisers), places);
  Gains gains;
  for (std::size_t j = 0; j < kAhead.size(); ++j) {
    for (Eigen::Index i = 0; i < places.rows(); ++i) {
      const double sd = std::sqrt(at.variance[i] + process.noise_variance() / kAhead[j]);
      gains.ahead[j] =
          std::max(gains.ahead[j], optimizer::ExpectedDropOfMinimum(mean, at.between.col(i) / sd));
    }
  }
  const base::Random random(view.seed, base::Stream("left to gain"));
  const Eigen::MatrixXd draws = process.Draw(minimisers, kNumDraws, random);
  gains.left = (draws.col(0) - draws.rowwise().minCoeff()).mean();
  return gains;
}

class Trace {
 public:
  Trace(const std::string& name, int instance, int noise)
      : problem_(MakeProblem(name, instance)),
        seed_(static_cast<std::uint64_t>(instance)),
        noise_(noise) {
    Vec best;
    Optimum(*problem_, best, lowest_);
  }

  void Run(int budget) {
    optimizer::ScalarFitter fitter(seed_);
    const auto strategy = optimizer::MakeStrategy(
        {.kind = optimizer::StrategyKind::kGp, .stop_multiple = 0}, domain_, nullptr, seed_);
    for (int told = 1; told <= budget; ++told) {
      const Eigen::VectorXd point = strategy->Ask(1, {}).front().point;
      const auto run = 1000 * seed_ + static_cast<std::uint64_t>(told);
      told_.push_back({.point = point,
                       .value = problem_->Noisy({point[0], point[1], point[2]}, run, noise_),
                       .field = {}});
      strategy->Tell(told_.back());
      if (told >= kFirst && told % kStep == 0) Look(fitter);
    }
  }

 private:
  void Look(optimizer::ScalarFitter& fitter) {
    const optimizer::History history = optimizer::MakeHistory(told_, D);
    const optimizer::Feasibility feasibility(history);
    const optimizer::TransformedModel model(
        fitter.Fit(history, false, optimizer::FitFor::kSearch).process);
    const optimizer::ModelView view{.model = model,
                                    .feasibility = feasibility,
                                    .domain = domain_,
                                    .points = history.points,
                                    .searches = {},
                                    .seed = seed_};
    const Eigen::VectorXd best = optimizer::LowestMean(view);
    const optimizer::Moments at = model.Predict(best.transpose());
    const double noise = model.NoiseSd(best);
    const double bounds = at.mean[0] + optimizer::kBoundSds * at.sd[0] -
                          optimizer::LowestBound(view, optimizer::BestEvaluated(view));
    const Gains gains = GainsOf(view, model.process());
    const double regret =
        (problem_->Value({best[0], best[1], best[2]}) - lowest_) / (problem_->Median() - lowest_);
    std::printf("%s,%d,%d,%.6g,%.6g,%.6g", problem_->name.c_str(), problem_->instance,
                history.size(), std::max(0.0, regret), bounds / noise, gains.left / noise);
    for (const double gain : gains.ahead) std::printf(",%.6g", gain / noise);
    for (const int ago : kAgo) {
      const auto then = recommended_.find(history.size() - ago);
      if (then == recommended_.end()) {
        std::printf(",nan");
      } else {
        std::printf(",%.6g", (model.Means(then->second.transpose())[0] - at.mean[0]) / noise);
      }
    }
    std::printf("\n");
    recommended_[history.size()] = best;
  }

  std::unique_ptr<Problem> problem_;
  std::uint64_t seed_;
  int noise_;
  double lowest_ = 0;
  optimizer::Domain domain_{.num_parameters = D};
  std::vector<optimizer::Observation> told_;
  std::map<int, Eigen::VectorXd> recommended_;  // by the evaluations until then
};

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  const std::string instances = argc > 1 ? argv[1] : "1";
  const int budget = argc > 2 ? std::atoi(argv[2]) : 100;
  const int noise = argc > 3 ? std::atoi(argv[3]) : 1;
  const auto dash = instances.find('-');
  const int first = std::atoi(instances.c_str());
  const int last = dash == std::string::npos ? first : std::atoi(instances.c_str() + dash + 1);
  std::printf("problem,instance,evaluations,regret,bounds,left");
  for (const int k : talus::bench::kAhead) std::printf(",gain_%d", k);
  for (const int k : talus::bench::kAgo) std::printf(",past_%d", k);
  std::printf("\n");
  for (int instance = first; instance <= last; ++instance) {
    for (const std::string& name : talus::bench::ProblemNames()) {
      talus::bench::Trace(name, instance, noise).Run(budget);
      std::fflush(stdout);
    }
  }
}
