// How often the stated ranges hold the truth: twin calibrations on synthetic heaps, whose target is
// the mean of a few heaps made with known parameters. RECORD.md has the table.
//
//   range_coverage [--first 1] [--last 24] [--budget 40] [--heaps 5] [--proposals PREFIX]
//
// PREFIX names files that keep the proposals of each calibration: where they exist, they are told
// again, so that a change of the answer alone is judged in a tenth of the time.
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

#include "bench/optimizers/arguments.h"
#include "bench/optimizers/problems.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::bench {
namespace {

constexpr int kNoiseLevel = 1;

struct Options {
  int first = 1;  // instance: each has another truth and other seeds
  int last = 24;
  int budget = 40;  // evaluations of a calibration
  int heaps = 5;    // the target is the mean of
  std::string proposals;
};

struct Tally {
  int inside = 0;
  double width = 0;
  double square_error = 0;
};

Options Parse(int argc, char** argv) {
  Options options;
  Arguments arguments(argc, argv);
  arguments.Take("--first", options.first);
  arguments.Take("--last", options.last);
  arguments.Take("--budget", options.budget);
  arguments.Take("--heaps", options.heaps);
  arguments.Take("--proposals", options.proposals);
  arguments.End();
  return options;
}

optimizer::FieldObjective Objective(const Problem& problem, const Vec& truth, int heaps,
                                    std::uint64_t seed) {
  optimizer::FieldObjective field;
  for (int heap = 0; heap < heaps; ++heap) {
    const std::uint64_t run = 900'000 + 1000 * seed + static_cast<std::uint64_t>(heap);
    const Image image = problem.MakeImage(truth, run, kNoiseLevel);
    field.width = image.w;
    field.height = image.h;
    field.target.resize(image.px.size());
    for (std::size_t i = 0; i < image.px.size(); ++i) {
      field.target[i] += image.px[i] / static_cast<float>(heaps);
    }
  }
  field.sad_scale = 100.0 / (field.width * field.height);
  field.num_target_heaps = heaps;
  return field;
}

optimizer::Answer Calibrate(const Options& options, const Problem& problem, const Vec& truth,
                            std::uint64_t seed) {
  const optimizer::FieldObjective field = Objective(problem, truth, options.heaps, seed);
  const auto strategy =
      optimizer::MakeStrategy({.stop_multiple = 0}, {.num_parameters = D}, &field, seed);
  const std::string file = options.proposals + std::to_string(seed);
  std::ifstream kept(options.proposals.empty() ? "" : file);
  const bool retell = kept.good();
  std::ofstream keep;
  if (!retell && !options.proposals.empty()) keep.open(file);
  keep.precision(17);
  for (int told = 0; told < options.budget; ++told) {
    Eigen::VectorXd point(D);
    if (retell) {
      if (!(kept >> point[0] >> point[1] >> point[2])) {
        Arguments::Fail(file + " has fewer proposals than the budget: remove it");
      }
    } else {
      point = strategy->Ask(1, {}).front().point;
      keep << point.transpose() << '\n';
    }
    const Image image =
        problem.MakeImage({point[0], point[1], point[2]},
                          1000 * seed + static_cast<std::uint64_t>(told), kNoiseLevel);
    strategy->Tell({.point = point, .value = field.Value(image.px), .field = image.px});
  }
  return strategy->Recommend();
}

// Whether all parameters are inside.
bool Count(const optimizer::Answer& answer, const Vec& truth, std::array<Tally, D>& tally) {
  bool all = true;
  for (std::size_t k = 0; k < D; ++k) {
    const auto [low, high] = answer.credible[k];
    const double found = answer.point[static_cast<Eigen::Index>(k)];
    const bool inside = low <= truth[k] && truth[k] <= high;
    std::printf("  %.3f: %.3f in %.3f … %.3f%c", truth[k], found, low, high, inside ? ' ' : '!');
    tally[k].inside += inside ? 1 : 0;
    tally[k].width += high - low;
    tally[k].square_error += (found - truth[k]) * (found - truth[k]);
    all = all && inside;
  }
  std::printf("  tied %.4f\n", answer.tied_volume);
  std::fflush(stdout);
  return all;
}

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  const std::clock_t start = std::clock();
  std::array<Tally, D> tally;
  int num_all = 0;
  for (int instance = options.first; instance <= options.last; ++instance) {
    const auto problem = MakeProblem("heap", instance);
    const Vec truth = TwinTruth(instance);
    const auto answer = Calibrate(options, *problem, truth, static_cast<std::uint64_t>(instance));
    std::printf("%3d", instance);
    num_all += Count(answer, truth, tally) ? 1 : 0;
  }
  const double count = options.last - options.first + 1;
  for (std::size_t k = 0; k < D; ++k) {
    std::printf("parameter %zu: inside %.0f %%, mean width %.3f, rms error %.3f\n", k + 1,
                100 * tally[k].inside / count, tally[k].width / count,
                std::sqrt(tally[k].square_error / count));
  }
  std::printf("all inside %.0f %%, %.1f s of processor time\n", 100 * num_all / count,
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) { return talus::bench::Main(argc, argv); }
