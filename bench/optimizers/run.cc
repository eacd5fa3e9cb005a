// Runs a strategy on the benchmark problems and prints the solved fractions.
//
//   optimizer_bench [--strategy surrogate] [--noise 0|1|2] [--instances 1-8] [--problems a,b]
//                   [--budgets 30,60,100] [--batch 1] [--csv FILE]
//
// r = (f(recommended) - f*) / R is judged noise-free; the score is the share of (problem, instance,
// target) with r <= target over the targets 10^-0.5, 10^-1, …, 10^-4.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "bench/optimizers/problems.h"
#include "optimizer/make_strategy.h"

namespace talus::bench {
namespace {

struct Options {
  std::string strategy = "surrogate";  // a kind of strategy
  int noise = 1;
  int first_instance = 1;
  int last_instance = 8;
  std::vector<std::string> problems = ProblemNames();
  std::vector<int> budgets{30, 60, 100};
  int batch = 1;
  std::string csv;
};

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Options Parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string key = argv[i];
    const std::string value = argv[i + 1];
    if (key == "--strategy") options.strategy = value;
    if (key == "--noise") options.noise = std::stoi(value);
    if (key == "--batch") options.batch = std::stoi(value);
    if (key == "--csv") options.csv = value;
    if (key == "--problems") options.problems = Split(value);
    if (key == "--instances") {
      const auto dash = value.find('-');
      options.first_instance = std::stoi(value);
      options.last_instance =
          dash == std::string::npos ? options.first_instance : std::stoi(value.substr(dash + 1));
    }
    if (key == "--budgets") {
      options.budgets.clear();
      for (const std::string& part : Split(value)) options.budgets.push_back(std::stoi(part));
    }
  }
  return options;
}

struct Result {
  std::string problem;
  int instance = 0;
  int budget = 0;
  double regret = 0;
};

Vec ToVec(const Eigen::VectorXd& point) { return {point[0], point[1], point[2]}; }

// Images are only shown to the kinds that use them.
std::unique_ptr<optimizer::Strategy> MakeFor(const Options& options, const Problem& problem,
                                             std::uint64_t seed) {
  optimizer::StrategyOptions strategy;
  strategy.stop_multiple = 0;  // the whole budget is spent, whatever is left to gain
  for (const auto& [name, kind] : base::Names<optimizer::StrategyKind>::kList) {
    if (name == options.strategy) strategy.kind = kind;
  }
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

std::vector<Result> RunOne(const Options& options, const std::string& name, int instance) {
  const auto problem = MakeProblem(name, instance);
  Vec best;
  double lowest = 0;
  Optimum(*problem, best, lowest);
  const double scale = problem->Median() - lowest;
  const auto seed = static_cast<std::uint64_t>(instance);
  const auto strategy = MakeFor(options, *problem, seed);
  std::vector<Result> results;
  int told = 0;
  for (const int budget : options.budgets) {
    while (told < budget) {
      for (const auto& proposal : strategy->Ask(std::min(options.batch, budget - told), {})) {
        ++told;
        const std::uint64_t run = 1000 * seed + static_cast<std::uint64_t>(told);
        const double value = problem->Noisy(ToVec(proposal.point), run, options.noise);
        strategy->Tell({.point = proposal.point,
                        .value = value,
                        .field = problem->MakeImage(ToVec(proposal.point), run, options.noise).px});
      }
    }
    const double value = problem->Value(ToVec(strategy->Recommend().point));
    results.push_back({name, instance, budget, std::max(0.0, (value - lowest) / scale)});
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

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  std::vector<Result> results;
  const std::clock_t start = std::clock();
  for (const std::string& name : options.problems) {
    for (int i = options.first_instance; i <= options.last_instance; ++i) {
      for (Result& result : RunOne(options, name, i)) results.push_back(result);
    }
  }
  PrintTable(options, results);
  std::printf("%.1f s of processor time\n",
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  if (!options.csv.empty()) {
    std::ofstream csv(options.csv);
    csv << "method,problem,instance,noise,budget,regret\n";
    for (const Result& result : results) {
      csv << options.strategy << ',' << result.problem << ',' << result.instance << ','
          << options.noise << ',' << result.budget << ',' << result.regret << '\n';
    }
  }
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) { return talus::bench::Main(argc, argv); }
