// Runs a strategy on the benchmark problems and prints the solved fractions.
//
//   optimizer_bench [--strategy auto] [--noise 0|1|2|3] [--instances 1-8] [--problems a,b]
//                   [--budgets 30,60,100] [--batch 1] [--csv FILE] [--stop 0.75] [--seeds 20]
//                   [--oracle 0.1]
//
// --stop lets the strategy end a run when less than this times the scatter is left to gain; its
// last recommendation then counts for the larger budgets, and the median end is printed.
// --seeds runs one instance from so many seeds instead, and prints the worst, the median, and the
// median of random search after each of the budgets.
// --oracle replaces every proposal after the tenth by a normal draw of that standard deviation
// about the optimum: what the model makes of evaluations that lie where they should.
//
// r = (f(recommended) - f*) / R is judged noise-free; the score is the share of (problem, instance,
// target) with r <= target over the targets 10^-0.5, 10^-1, …, 10^-4.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"
#include "bench/optimizers/arguments.h"
#include "bench/optimizers/problems.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::bench {
namespace {

struct Options {
  std::string strategy = "auto";  // a kind of strategy
  int noise = 1;
  int first_instance = 1;
  int last_instance = 8;
  std::vector<std::string> problems = ProblemNames();
  std::vector<int> budgets{30, 60, 100};
  int batch = 1;
  double stop_multiple = 0;  // 0: the whole budget is spent, whatever is left to gain
  int num_seeds = 0;         // > 0: compare seeds, not instances
  double oracle = 0;         // > 0: proposals are drawn round the optimum with this sd
  std::string csv;
};

Options Parse(int argc, char** argv) {
  Options options;
  Arguments arguments(argc, argv);
  arguments.Take("--strategy", options.strategy);
  arguments.Take("--noise", options.noise);
  arguments.Take("--batch", options.batch);
  arguments.Take("--csv", options.csv);
  arguments.Take("--stop", options.stop_multiple);
  arguments.Take("--oracle", options.oracle);
  arguments.Take("--seeds", options.num_seeds);
  arguments.Take("--problems", options.problems);
  arguments.TakeRange("--instances", options.first_instance, options.last_instance);
  arguments.Take("--budgets", options.budgets);
  if (options.noise < 0 || options.noise > 3) Arguments::Fail("--noise must be 0, 1, 2 or 3");
  arguments.End();
  return options;
}

struct Result {
  std::string problem;
  int instance = 0;
  std::uint64_t seed = 0;
  int budget = 0;
  int num_used = 0;  // evaluations, at most the budget
  double regret = 0;
};

Vec ToVec(const Eigen::VectorXd& point) { return {point[0], point[1], point[2]}; }

// Images are only shown to the kinds that use them.
std::unique_ptr<optimizer::Strategy> MakeFor(const Options& options, const Problem& problem,
                                             std::uint64_t seed) {
  optimizer::StrategyOptions strategy;
  strategy.stop_multiple = options.stop_multiple;
  bool is_known = false;
  for (const auto& [name, kind] : base::Names<optimizer::StrategyKind>::kList) {
    if (name != options.strategy) continue;
    strategy.kind = kind;
    is_known = true;
  }
  if (!is_known) Arguments::Fail("--strategy: there is no " + options.strategy);
  const optimizer::Domain domain{.num_parameters = D};
  if (!problem.HasImage()) return optimizer::MakeStrategy(strategy, domain, nullptr, seed);
  const Image target = problem.Target();
  const optimizer::FieldObjective field{.width = target.w,
                                        .height = target.h,
                                        .target = target.px,
                                        .sad_scale = 100.0 / (target.w * target.h),
                                        .metric = {}};
  return optimizer::MakeStrategy(strategy, domain, &field, seed);
}

// Regrets of points of one problem, judged noise-free.
class Judge {
 public:
  explicit Judge(const Problem& problem) : problem_(problem) {
    Optimum(problem, optimum_, lowest_);
    scale_ = problem.Median() - lowest_;
  }
  double Regret(const Vec& point) const {
    return std::max(0.0, (problem_.Value(point) - lowest_) / scale_);
  }
  const Vec& optimum() const { return optimum_; }

 private:
  const Problem& problem_;
  Vec optimum_{};
  double lowest_ = 0;
  double scale_ = 1;
};

Eigen::VectorXd NearOptimum(const Judge& judge, double sd, std::uint64_t run) {
  base::Random random(run, base::Stream("oracle"));
  Eigen::VectorXd point(D);
  for (int k = 0; k < D; ++k) {
    const double drawn = judge.optimum()[static_cast<std::size_t>(k)] + sd * random.Normal();
    point[k] = std::clamp(drawn, 0.0, 1.0);
  }
  return point;
}

std::vector<Result> RunOne(const Options& options, const Problem& problem, const Judge& judge,
                           std::uint64_t seed) {
  const auto strategy = MakeFor(options, problem, seed);
  std::vector<Result> results;
  int told = 0;
  for (const int budget : options.budgets) {
    while (told < budget && !strategy->WhyStop()) {
      for (auto& proposal : strategy->Ask(std::min(options.batch, budget - told), {})) {
        ++told;
        const std::uint64_t run = 1000 * seed + static_cast<std::uint64_t>(told);
        if (options.oracle > 0 && told > 10) {
          proposal.point = NearOptimum(judge, options.oracle, run);
        }
        const Vec point = ToVec(proposal.point);
        strategy->Tell({.point = proposal.point,
                        .value = problem.Noisy(point, run, options.noise),
                        .field = problem.MakeImage(point, run, options.noise).px});
      }
    }
    const double regret = judge.Regret(ToVec(strategy->Recommend().point));
    results.push_back({problem.name, problem.instance, seed, budget, told, regret});
  }
  return results;
}

double Solved(double regret) {
  int solved = 0;
  for (int i = 1; i <= 8; ++i) solved += regret <= std::pow(10.0, -0.5 * i) ? 1 : 0;
  return solved / 8.0;
}

void PrintTable(const Options& options, const std::vector<Result>& results) {
  std::printf("%-12s", "");
  for (const int budget : options.budgets) std::printf("%7d", budget);
  std::printf("\n");
  std::vector<std::string> rows = options.problems;
  rows.push_back("all");
  for (const std::string& row : rows) {
    std::printf("%-12s", row.c_str());
    for (const int budget : options.budgets) {
      double sum = 0;
      int count = 0;
      for (const Result& result : results) {
        if (result.budget != budget || (row != "all" && row != result.problem)) continue;
        sum += Solved(result.regret);
        ++count;
      }
      std::printf("%7.3f", sum / count);
    }
    std::printf("\n");
  }
}

// Regret of the luckiest of `budget` random points, which is what random search recommends.
double RandomRegret(const Problem& problem, const Judge& judge, int noise, int budget,
                    std::uint64_t seed) {
  base::Random random(seed, base::Stream("random search"));
  Vec best{};
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= budget; ++i) {
    const Vec point{random.Uniform(), random.Uniform(), random.Uniform()};
    const double value = problem.Noisy(point, 1000 * seed + static_cast<std::uint64_t>(i), noise);
    if (value >= lowest) continue;
    lowest = value;
    best = point;
  }
  return judge.Regret(best);
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void WriteCsv(const Options& options, const std::vector<Result>& results) {
  if (options.csv.empty()) return;
  std::ofstream csv(options.csv);
  csv << "method,problem,instance,seed,noise,budget,regret\n";
  for (const Result& result : results) {
    csv << options.strategy << ',' << result.problem << ',' << result.instance << ',' << result.seed
        << ',' << options.noise << ',' << result.budget << ',' << result.regret << '\n';
  }
}

std::vector<Result> CompareSeeds(const Options& options) {
  std::vector<Result> results;
  std::printf("regrets of %d seeds\n%-12s%8s%10s%10s%16s\n", options.num_seeds, "", "budget",
              "worst", "median", "random, median");
  for (const std::string& name : options.problems) {
    const auto problem = MakeProblem(name, options.first_instance);
    const Judge judge(*problem);  // once: finding the optimum may take longer than a run
    std::map<int, std::vector<double>> regrets;  // by budget
    std::map<int, std::vector<double>> random;
    for (int i = 1; i <= options.num_seeds; ++i) {
      const auto seed = static_cast<std::uint64_t>(i);
      for (const Result& result : RunOne(options, *problem, judge, seed)) {
        results.push_back(result);
        regrets[result.budget].push_back(result.regret);
        random[result.budget].push_back(
            RandomRegret(*problem, judge, options.noise, result.budget, seed));
      }
    }
    for (const auto& [budget, seen] : regrets) {
      std::printf("%-12s%8d%10.2g%10.2g%16.2g\n", name.c_str(), budget,
                  *std::max_element(seen.begin(), seen.end()), Median(seen),
                  Median(random[budget]));
    }
    std::fflush(stdout);
  }
  return results;
}

void PrintStops(const Options& options, const std::vector<Result>& results) {
  std::vector<double> ends;
  for (const Result& result : results) {
    if (result.budget == options.budgets.back()) ends.push_back(result.num_used);
  }
  std::printf("median end after %g evaluations\n", Median(ends));
}

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  if (options.num_seeds > 0) {
    WriteCsv(options, CompareSeeds(options));
    return 0;
  }
  std::vector<Result> results;
  const std::clock_t start = std::clock();
  for (const std::string& name : options.problems) {
    for (int i = options.first_instance; i <= options.last_instance; ++i) {
      const auto problem = MakeProblem(name, i);
      for (Result& result :
           RunOne(options, *problem, Judge(*problem), static_cast<std::uint64_t>(i))) {
        results.push_back(result);
      }
    }
  }
  PrintTable(options, results);
  if (options.stop_multiple > 0) PrintStops(options, results);
  std::printf("%.1f s of processor time\n",
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  WriteCsv(options, results);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) { return talus::bench::Main(argc, argv); }
