// Twin calibrations with coarse levels on synthetic heaps: does the joint 90 % region hold the
// truth, how large is it, and how far is the recommended set? The same core seconds are spent with
// all scale factors, and with one alone. bench/optimizers/README.md says what came out.
//
//   scale_factor_twins [--first 1] [--last 20] [--core-time 100] [--factors 2,1.5,1] [--target 0]
//                  [--useless yes] [--tests 1] [--nuisances 0] [--until-stop yes] [--stop-share
//                  0.1] [--again yes] [--look yes] [--begun 1]
//
// A heap at scale factor f costs f⁻⁴ core seconds, is that of parameters displaced by 0.08 (f - 1),
// and scatters more, as measured on heaps of three grain sizes (docs/validation.md). --useless: a
// coarse heap is that of other parameters altogether, and tells nothing of the true one. --tests 2:
// a second heap of the same parameters, which another instance makes. --nuisances: so many more
// parameters are searched, known beforehand within 0.2, each of which displaces the others by up to
// 0.3 over its range, in another direction in each test. --until-stop: the search may end by itself
// before the core time is spent. --again: half as many simulations again are made afterwards, and
// what they do to the ranges is held against what was expected. --look: the region is looked at
// every ten simulations, and a powder's line says after how many core seconds it stays within 1.5
// times its final size. --begun: so many simulations have begun before the first of them is told,
// as with (begun + 1) / 2 workers (docs/campaigns.md, Several workers).
#include <cstdio>
#include <ctime>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/random.h"
#include "bench/optimizers/arguments.h"
#include "bench/optimizers/problems.h"
#include "bench/optimizers/scale_factor_heaps.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::bench {
namespace {

constexpr int kLook = 10;                // simulations between two looks at the region
constexpr double kNuisanceSd = 0.2;      // of its prior, unit cube
constexpr double kNuisanceEffect = 0.3;  // displacement over a nuisance's range, unit cube
constexpr double kWithin = 1.5;          // of the region's final volume
constexpr double kSolved = 0.1;          // distance of the answer from the truth, unit cube

struct Options {
  int first = 1;
  int last = 20;
  double core_time = 100;
  std::vector<double> factors{2, 1.5, 1};
  double target = 0;
  bool useless = false;
  int tests = 1;
  int nuisances = 0;
  bool until_stop = false;
  double stop_share = 0.1;
  bool again = false;
  bool look = false;
  int begun = 1;
};

Options Parse(int argc, char** argv) {
  Options options;
  Arguments arguments(argc, argv);
  arguments.Take("--first", options.first);
  arguments.Take("--last", options.last);
  arguments.Take("--core-time", options.core_time);
  arguments.Take("--factors", options.factors);
  arguments.Take("--target", options.target);
  arguments.Take("--useless", options.useless);
  arguments.Take("--tests", options.tests);
  arguments.Take("--nuisances", options.nuisances);
  arguments.Take("--until-stop", options.until_stop);
  arguments.Take("--stop-share", options.stop_share);
  arguments.Take("--again", options.again);
  arguments.Take("--look", options.look);
  arguments.Take("--begun", options.begun);
  arguments.End();
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

// The parameters that a heap of this test shows where these are the set and the nuisances.
Vec Displaced(const Eigen::VectorXd& point, int instance) {
  Vec x{point[0], point[1], point[2]};
  for (Eigen::Index n = D; n < point.size(); ++n) {
    base::Random random(static_cast<std::uint64_t>(instance), base::Stream("nuisance"),
                        static_cast<std::uint64_t>(n));
    Eigen::Vector3d direction(random.Normal(), random.Normal(), random.Normal());
    direction *= kNuisanceEffect * (point[n] - 0.5) / direction.norm();
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = std::clamp(x[k] + direction[static_cast<Eigen::Index>(k)], 0.0, 1.0);
    }
  }
  return x;
}

// The set, and what the nuisances really are.
Eigen::VectorXd Truth(int instance, int num_nuisances) {
  const Vec asked = TwinTruth(instance);
  Eigen::VectorXd truth(D + num_nuisances);
  truth.head(D) = Eigen::Map<const Eigen::VectorXd>(asked.data(), D);
  base::Random random(static_cast<std::uint64_t>(instance), base::Stream("true nuisances"));
  for (double& nuisance : truth.tail(num_nuisances)) {
    nuisance = std::clamp(0.5 + kNuisanceSd * random.Normal(), 0.05, 0.95);
  }
  return truth;
}

optimizer::Domain DomainOf(int num_nuisances) {
  optimizer::Domain domain{.num_parameters = D + num_nuisances};
  for (Eigen::Index n = D; n < domain.num_parameters; ++n) {
    domain.nuisances.push_back(n);
    domain.prior.Add(n, {.low = 0, .high = 1}, {.mean = 0.5, .sd = kNuisanceSd});
  }
  return domain;
}

struct Tally {
  int covered = 0;
  int solved = 0;
  double volume = 0;
  double distance = 0;
  double simulations = 0;
  int stopped = 0;  // by themselves
  double core_time = 0;
  double width_expected = 0;  // after half as many simulations again, over that before
  double width_then = 0;
  double settled =
      0;  // core time from which on the region was within kWithin of its final size [s]
};

// A powder that is not known, and the search for it.
struct Twin {
  Twin(const Options& chosen, int number)
      : options(chosen), instance(number), truth(Truth(number, chosen.nuisances)) {
    for (int test = 0; test < options.tests; ++test) {
      problems.push_back(MakeProblem("heap", MadeOf(test)));
      targets.push_back(
          Photographed(*problems.back(), Displaced(truth, MadeOf(test)), MadeOf(test)));
    }
    strategy.emplace(
        optimizer::PosteriorStrategyOptions{.scale_factors = options.factors,
                                            .target = options.target,
                                            .stop_share = options.stop_share,
                                            .seed = static_cast<std::uint64_t>(instance)},
        DomainOf(options.nuisances), targets);
  }

  // The instance of the problem that a test is.
  int MadeOf(int test) const { return instance + 5000 * test; }

  void SimulateOne() {
    while (static_cast<int>(begun.size()) < options.begun) {
      const std::vector<optimizer::Proposal> pending(begun.begin(), begun.end());
      begun.push_back(strategy->AskAt(1, pending).front());
    }
    EndOne();
  }

  void EndOne() {
    const optimizer::Proposal p = begun.front();
    begun.pop_front();
    const double cost = HeapCost(p.scale_factor);
    spent_at[p.scale_factor] += cost;
    spent += cost;
    const auto test = static_cast<std::size_t>(p.experiment);
    const auto run = static_cast<std::uint64_t>(1000 * instance + told++);
    const Image image = Heap(*problems[test], Displaced(p.point, MadeOf(p.experiment)),
                             p.scale_factor, run, options.useless);
    strategy->Tell({.point = p.point,
                    .experiment = p.experiment,
                    .scale_factor = p.scale_factor,
                    .cost = cost,
                    .value = targets[test].image.Value(image.px),
                    .field = image.px});
  }

  Options options;
  int instance = 1;
  Eigen::VectorXd truth;
  std::vector<std::unique_ptr<Problem>> problems{};
  std::vector<optimizer::ExperimentTarget> targets{};
  std::optional<optimizer::PosteriorStrategy> strategy{};
  std::deque<optimizer::Proposal> begun{};  // and not told
  double spent = 0;                         // [core s]
  int told = 0;
  std::map<double, double> spent_at{};  // core seconds, by scale factor
};

// Geometric mean of the asked ranges' widths.
double WidthOf(const optimizer::Answer& answer) {
  double log_width = 0;
  for (int k = 0; k < D; ++k) {
    const optimizer::Range& range = answer.credible[static_cast<std::size_t>(k)];
    log_width += std::log(range.high - range.low) / D;
  }
  return std::exp(log_width);
}

// The region as it was seen during a search.
struct Sight {
  double spent = 0;  // [core s]
  double volume = 1;
};

// From when on it was no larger than kWithin times its final size [core s].
double SettledAt(const std::vector<Sight>& sights, double final_volume) {
  double settled = 0;
  for (const Sight& sight : sights) {
    if (sight.volume > kWithin * final_volume) settled = sight.spent;
  }
  return settled;
}

void GoOn(Twin& twin, Tally& tally) {
  const double before = WidthOf(twin.strategy->Recommend());
  const auto outlook = twin.strategy->Shortfall();
  if (!outlook) return;
  double log_expected = 0;
  for (const double narrowing : outlook->narrowing) log_expected += std::log1p(-narrowing) / D;
  for (int i = 0; i < outlook->num_more; ++i) twin.SimulateOne();
  const double then = WidthOf(twin.strategy->Recommend()) / before;
  std::printf("     %d more: width times %.3f, expected %.3f\n", outlook->num_more, then,
              std::exp(log_expected));
  tally.width_expected += std::exp(log_expected);
  tally.width_then += then;
}

void Calibrate(const Options& options, int instance, Tally& tally) {
  Twin twin(options, instance);
  std::vector<Sight> sights;
  while (twin.spent < options.core_time) {
    if (options.look && twin.told % kLook == 0 && twin.strategy->CanModel()) {
      const optimizer::Answer seen = twin.strategy->Recommend();
      sights.push_back({.spent = twin.spent, .volume = seen.posterior->region_volume});
    }
    if (options.until_stop && twin.told > 0 && twin.strategy->WhyStop()) break;
    twin.SimulateOne();
  }
  while (!twin.begun.empty()) twin.EndOne();
  const optimizer::Answer answer = twin.strategy->Recommend();
  const auto standing = twin.strategy->Consider(twin.truth);
  const double distance = (answer.point - twin.truth).head(D).norm();
  std::printf(
      "%3d: level %.2f, volume %.4f, distance %.3f, branches %zu, temper %.2f, raw %.2f, "
      "implausibility %.2f, %d simulations",
      instance, standing->credible_level, answer.posterior->region_volume, distance,
      answer.posterior->branches.size(), answer.posterior->temper, answer.posterior->raw_coverage,
      answer.posterior->experiments[0].implausibility, twin.told);
  for (const auto& [factor, seconds] : twin.spent_at) {
    std::printf(", %.1f s at %g", seconds, factor);
  }
  if (options.look) {
    const double settled = SettledAt(sights, answer.posterior->region_volume);
    std::printf(", within %g of its size after %.1f s", kWithin, settled);
    tally.settled += settled;
  }
  std::printf("\n");
  tally.covered += standing->credible_level <= 0.9 ? 1 : 0;
  tally.solved += distance < kSolved ? 1 : 0;
  tally.volume += answer.posterior->region_volume;
  tally.distance += distance;
  tally.simulations += twin.told;
  tally.stopped += twin.spent < options.core_time ? 1 : 0;
  tally.core_time += twin.spent;
  if (options.again) GoOn(twin, tally);
  std::fflush(stdout);
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
      "mean core time %.1f s, %d ended by themselves, %.0f s of processor time\n",
      tally.covered, count, tally.solved, tally.volume / count, tally.distance / count,
      tally.simulations / count, tally.core_time / count, tally.stopped,
      static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  if (options.look) {
    std::printf("mean core time until within %g of the final size %.1f s\n", kWithin,
                tally.settled / count);
  }
  if (options.again) {
    std::printf("mean width after half as many again times %.3f, expected %.3f\n",
                tally.width_then / count, tally.width_expected / count);
  }
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) { return talus::bench::Main(argc, argv); }
