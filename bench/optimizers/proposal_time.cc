// Prints the processor time of one proposal, and of one answer, after many noisy evaluations.
//
//   optimizer_proposal_time [200]
//
// The evaluations are those of the problem `heap`, its images enlarged to 400 x 200 px; half of the
// points are spread over the cube, half lie near the optimum, as those of a search do.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "base/random.h"
#include "bench/optimizers/problems.h"
#include "optimizer/strategies/make_strategy.h"

namespace talus::bench {
namespace {

constexpr int kWidth = 400;
constexpr int kHeight = 200;

std::vector<float> Enlarged(const Image& image) {
  std::vector<float> pixels;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int place = y * image.h / kHeight * image.w + x * image.w / kWidth;
      pixels.push_back(image.px[static_cast<std::size_t>(place)]);
    }
  }
  return pixels;
}

double Seconds(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void Time(optimizer::StrategyKind kind, const char* name, int num_trials) {
  const auto problem = MakeProblem("heap", 1);
  const optimizer::FieldObjective field{.width = kWidth,
                                        .height = kHeight,
                                        .target = Enlarged(problem->Target()),
                                        .sad_scale = 100.0 / (kWidth * kHeight),
                                        .metric = {}};
  const auto strategy =
      optimizer::MakeStrategy({.kind = kind, .stop_multiple = 0}, {.num_parameters = D}, &field, 1);
  Vec best;
  double lowest = 0;
  Optimum(*problem, best, lowest);
  base::Random random(1, base::Stream("proposal time"));
  std::vector<double> proposals;
  Vec point{};
  for (int i = 0; i < num_trials + 3; ++i) {
    if (i >= num_trials) {
      const std::clock_t start = std::clock();
      strategy->Ask(1, {});
      proposals.push_back(Seconds(start));
    }
    for (std::size_t k = 0; k < point.size() && i != 1; ++k) {  // 1 repeats 0: it scatters
      point[k] =
          i % 2 == 0 ? random.Uniform() : std::clamp(best[k] + 0.05 * random.Normal(), 0.0, 1.0);
    }
    const Image image = problem->MakeImage(point, static_cast<std::uint64_t>(i), 1);
    const std::vector<float> pixels = Enlarged(image);
    strategy->Tell({.point = Eigen::Vector3d(point[0], point[1], point[2]),
                    .value = field.Value(pixels),
                    .field = pixels});
  }
  const std::clock_t start = std::clock();
  strategy->Recommend();
  // The first proposal fits everything, the next ones start from what it found.
  std::printf("%-6s after %d trials: proposals %.2f, %.2f, %.2f s, answer %.2f s\n", name,
              num_trials, proposals[0], proposals[1], proposals[2], Seconds(start));
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  const int num_trials = argc > 1 ? std::atoi(argv[1]) : 200;
  talus::bench::Time(talus::optimizer::StrategyKind::kGp, "gp", num_trials);
  talus::bench::Time(talus::optimizer::StrategyKind::kField, "field", num_trials);
}
