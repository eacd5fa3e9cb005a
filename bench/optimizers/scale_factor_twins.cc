// Twin calibrations with coarse levels on synthetic heaps: does the joint 90 % region hold the
// truth, how large is it, and how far is the recommended set? The same core seconds are spent with
// all scale factors, and with one alone. bench/optimizers/README.md says what came out.
//
//   scale_factor_twins [--first 1] [--last 20] [--core-time 100] [--factors 2,1.5,1] [--target 0]
//                  [--useless yes] [--tests 1]
//
// A heap at scale factor f costs f⁻⁴ core seconds, is that of parameters displaced by 0.08 (f - 1),
// and scatters more, as measured on heaps of three grain sizes (docs/validation.md). --useless: a
// coarse heap is that of other parameters altogether, and tells nothing of the true one. --tests 2:
// a second heap of the same parameters, which another instance makes.
#include <cstdio>
#include <ctime>
#include <map>
#include <sstream>
#include <string>

#include "bench/optimizers/problems.h"
#include "bench/optimizers/scale_factor_heaps.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::bench {
namespace {

constexpr double kSolved = 0.1;  // distance of the answer from the truth, unit cube

struct Options {
  int first = 1;
  int last = 20;
  double core_time = 100;
  std::vector<double> factors{2, 1.5, 1};
  double target = 0;
  bool useless = false;
  int tests = 1;
};

Options Parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string key = argv[i];
    if (key == "--first") options.first = std::stoi(argv[i + 1]);
    if (key == "--last") options.last = std::stoi(argv[i + 1]);
    if (key == "--core-time") options.core_time = std::stod(argv[i + 1]);
    if (key == "--target") options.target = std::stod(argv[i + 1]);
    if (key == "--useless") options.useless = true;
    if (key == "--tests") options.tests = std::stoi(argv[i + 1]);
    if (key != "--factors") continue;
    options.factors.clear();
    std::stringstream list(argv[i + 1]);
    for (std::string one; std::getline(list, one, ',');) options.factors.push_back(std::stod(one));
  }
  return options;
}

// Folded often enough that near places are as far apart as any.
Vec Scrambled(const Vec& x) {
  Vec scrambled = x;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double folded = 17 * x[k] + 5 * x[(k + 1) % x.size()];
    scrambled[k] = folded - std::floor(folded);
  }
  return scrambled;
}

Image Heap(const Problem& problem, const Vec& x, double factor, std::uint64_t run, bool useless) {
  if (!useless || factor == 1) return HeapAt(problem, x, factor, run);
  return problem.MakeImage(Scrambled(x), run, NoiseLevel(factor));
}

optimizer::ExperimentTarget Photographed(const Problem& problem, const Vec& truth, int instance) {
  std::vector<Image> heaps;
  for (int heap = 0; heap < kHeaps; ++heap) {
    const auto run = static_cast<std::uint64_t>(900'000 + 1000 * instance + heap);
    heaps.push_back(HeapAt(problem, truth, 1, run));
  }
  return TargetOf(heaps);
}

struct Tally {
  int covered = 0;
  int solved = 0;
  double volume = 0;
  double distance = 0;
  double simulations = 0;
};

void Calibrate(const Options& options, int instance, Tally& tally) {
  constexpr int kOtherTest = 5000;  // between the instances of the tests
  const Vec truth = TwinTruth(instance);
  std::vector<std::unique_ptr<Problem>> problems;
  std::vector<optimizer::ExperimentTarget> targets;
  for (int test = 0; test < options.tests; ++test) {
    problems.push_back(MakeProblem("heap", instance + kOtherTest * test));
    targets.push_back(Photographed(*problems.back(), truth, instance + kOtherTest * test));
  }
  const auto seed = static_cast<std::uint64_t>(instance);
  optimizer::PosteriorStrategy strategy(
      {.scale_factors = options.factors, .target = options.target, .seed = seed},
      {.num_parameters = D}, targets);
  double spent = 0;
  int told = 0;
  std::map<double, double> spent_at;  // core seconds, by scale factor
  for (; spent < options.core_time; ++told) {
    const optimizer::Proposal p = strategy.AskAt(1, {}).front();
    const double cost = HeapCost(p.scale_factor);
    spent += cost;
    spent_at[p.scale_factor] += cost;
    const auto test = static_cast<std::size_t>(p.experiment);
    const Image image = Heap(*problems[test], {p.point[0], p.point[1], p.point[2]}, p.scale_factor,
                             1000 * seed + static_cast<std::uint64_t>(told), options.useless);
    strategy.Tell({.point = p.point,
                   .experiment = p.experiment,
                   .scale_factor = p.scale_factor,
                   .cost = cost,
                   .value = targets[test].image.Value(image.px),
                   .field = image.px});
  }
  const optimizer::Answer answer = strategy.Recommend();
  const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(truth.data(), D);
  const auto standing = strategy.Consider(at);
  const double distance = (answer.point - at).norm();
  std::printf(
      "%3d: level %.2f, volume %.4f, distance %.3f, branches %zu, temper %.2f, raw %.2f, "
      "implausibility %.2f, %d simulations",
      instance, standing->credible_level, answer.posterior->region_volume, distance,
      answer.posterior->branches.size(), answer.posterior->temper, answer.posterior->raw_coverage,
      answer.posterior->experiments[0].implausibility, told);
  for (const auto& [factor, seconds] : spent_at) std::printf(", %.1f s at %g", seconds, factor);
  std::printf("\n");
  std::fflush(stdout);
  tally.covered += standing->credible_level <= 0.9 ? 1 : 0;
  tally.solved += distance < kSolved ? 1 : 0;
  tally.volume += answer.posterior->region_volume;
  tally.distance += distance;
  tally.simulations += told;
}

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  const std::clock_t start = std::clock();
  Tally tally;
  for (int instance = options.first; instance <= options.last; ++instance) {
    Calibrate(options, instance, tally);
  }
  const int count = options.last - options.first + 1;
  std::printf(
      "covered %d of %d, solved %d, mean volume %.4f, mean distance %.3f, mean simulations %.0f, "
      "%.0f s of "
      "processor time\n",
      tally.covered, count, tally.solved, tally.volume / count, tally.distance / count,
      tally.simulations / count, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) { return talus::bench::Main(argc, argv); }
