// How often the ranges of `gp` hold the optimum in all parameters at once, over eight problems with
// one optimum each. RECORD.md has the table.
//
//   value_coverage [--noise 0|1] [--instances 1-4] [--budgets 30,60,90]
#include <array>
#include <cstdio>
#include <map>
#include <string>

#include "bench/optimizers/arguments.h"
#include "bench/optimizers/problems.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::bench {
namespace {

struct Options {
  int noise = 1;
  int first = 1;
  int last = 4;
  std::vector<int> budgets{30, 60, 90};
};

Options Parse(int argc, char** argv) {
  Options options;
  Arguments arguments(argc, argv);
  arguments.Take("--noise", options.noise);
  arguments.TakeRange("--instances", options.first, options.last);
  arguments.Take("--budgets", options.budgets);
  arguments.End();
  return options;
}

struct Tally {
  int runs = 0;
  int inside = 0;
  double volume = 0;  // of the ranges, a share of the cube
};

void Count(const optimizer::Answer& answer, const Vec& truth, Tally& tally) {
  constexpr double kRounding = 1e-9;
  bool inside = true;
  double volume = 1;
  for (std::size_t k = 0; k < D; ++k) {
    const auto [low, high] = answer.credible[k];
    inside = inside && low - kRounding <= truth[k] && truth[k] <= high + kRounding;
    volume *= high - low;
  }
  ++tally.runs;
  tally.inside += inside ? 1 : 0;
  tally.volume += volume;
}

// Tallies by budget.
std::map<int, Tally> RunOne(const Options& options, const std::string& name, int instance) {
  const auto problem = MakeProblem(name, instance);
  Vec truth;
  double lowest = 0;
  Optimum(*problem, truth, lowest);
  const auto seed = static_cast<std::uint64_t>(instance);
  const auto strategy =
      optimizer::MakeStrategy({.kind = optimizer::StrategyKind::kGp, .stop_multiple = 0},
                              {.num_parameters = D}, nullptr, seed);
  std::map<int, Tally> tallies;
  int told = 0;
  for (const int budget : options.budgets) {
    for (; told < budget; ++told) {
      const Eigen::VectorXd point = strategy->Ask(1, {}).front().point;
      const double value =
          problem->Noisy({point[0], point[1], point[2]},
                         1000 * seed + static_cast<std::uint64_t>(told), options.noise);
      strategy->Tell({.point = point, .value = value});
    }
    Count(strategy->Recommend(), truth, tallies[budget]);
  }
  return tallies;
}

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  std::map<int, Tally> sum;
  for (const std::string& name : ProblemNames()) {
    if (name == "branin3") continue;  // has several optima
    std::printf("%-12s", name.c_str());
    std::map<int, Tally> of_problem;
    for (int instance = options.first; instance <= options.last; ++instance) {
      for (const auto& [budget, tally] : RunOne(options, name, instance)) {
        for (Tally* to : {&of_problem[budget], &sum[budget]}) {
          to->runs += tally.runs;
          to->inside += tally.inside;
          to->volume += tally.volume;
        }
      }
    }
    for (const auto& [budget, tally] : of_problem) {
      std::printf("   %d: %d of %d, volume %.2g", budget, tally.inside, tally.runs,
                  tally.volume / tally.runs);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  for (const auto& [budget, tally] : sum) {
    std::printf("after %d evaluations: inside all ranges in %d of %d, mean volume %.3g\n", budget,
                tally.inside, tally.runs, tally.volume / tally.runs);
  }
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) { return talus::bench::Main(argc, argv); }
