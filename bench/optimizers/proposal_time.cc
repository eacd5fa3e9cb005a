// Prints the processor time of one proposal, and of one answer, after many noisy evaluations; after
// slashes that of the calling thread, and the time that passed.
//
//   OMP_WAIT_POLICY=passive OMP_NUM_THREADS=1 optimizer_proposal_time [200] [gp|auto]
//
// The evaluations are those of the problem `heap`, its images enlarged to 400 x 200 px; half of the
// points are spread over the cube, half lie near the optimum, as those of a search do.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/field.h"
#include "base/random.h"
#include "bench/optimizers/problems.h"
#include "bench/optimizers/scale_factor_heaps.h"
#include "bench/optimizers/stopwatch.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::bench {
namespace {

constexpr int kWidth = 400;
constexpr int kHeight = 200;

void Time(optimizer::StrategyKind kind, int num_trials) {
  const auto problem = MakeProblem("heap", 1);
  const optimizer::FieldObjective field{.width = kWidth,
                                        .height = kHeight,
                                        .target = Enlarged(problem->Target(), kWidth, kHeight).px,
                                        .sad_scale = 100.0 / (kWidth * kHeight),
                                        .metric = {}};
  const auto strategy =
      optimizer::MakeStrategy({.kind = kind, .stop_multiple = 0}, {.num_parameters = D}, &field, 1);
  Vec best;
  double lowest = 0;
  Optimum(*problem, best, lowest);
  base::Random random(1, base::Stream("proposal time"));
  std::vector<std::string> proposals;
  Vec point{};
  for (int i = 0; i < num_trials + 3; ++i) {
    if (i >= num_trials) {
      const Stopwatch watch;
      strategy->Ask(1, {});
      proposals.push_back(watch.Read());
    }
    for (std::size_t k = 0; k < point.size() && i != 1; ++k) {  // 1 repeats 0: it scatters
      point[k] =
          i % 2 == 0 ? random.Uniform() : std::clamp(best[k] + 0.05 * random.Normal(), 0.0, 1.0);
    }
    const Image image = problem->MakeImage(point, static_cast<std::uint64_t>(i), 1);
    const std::vector<float> pixels = Enlarged(image, kWidth, kHeight).px;
    strategy->Tell({.point = Eigen::Vector3d(point[0], point[1], point[2]),
                    .value = field.Value(pixels),
                    .field = pixels});
  }
  const Stopwatch watch;
  strategy->Recommend();
  // The first proposal fits everything, the next ones start from what it found.
  const std::string name(base::NameOf(kind));
  std::printf("%-9s after %d trials: proposals %s, %s, %s s, answer %s s\n", name.c_str(),
              num_trials, proposals[0].c_str(), proposals[1].c_str(), proposals[2].c_str(),
              watch.Read().c_str());
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  const int num_trials = argc > 1 ? std::atoi(argv[1]) : 200;
  const std::string only = argc > 2 ? argv[2] : "";
  using Kind = talus::optimizer::StrategyKind;
  if (!only.empty() && only != "gp" && only != "auto") {
    std::fprintf(stderr, "usage: optimizer_proposal_time [NUMBER OF TRIALS] [gp|auto]\n");
    return 2;
  }
  for (const Kind kind : {Kind::kGp, Kind::kAuto}) {
    if (only.empty() || only == talus::base::NameOf(kind)) talus::bench::Time(kind, num_trials);
  }
}
