// Prints the time of a proposal, and of the answer, and the memory of a campaign of two experiments
// at three scale factors after many trials.
//
//   OMP_WAIT_POLICY=passive OMP_NUM_THREADS=1 posterior_time [300] [400x200]
//
// After the initial design half of the trials are spread over the cube, half lie near the truth, as
// those of a search do; scale factors and experiments take turns. The second experiment's heap has
// the parameters in another order. Images are those of the problem `heap`, enlarged.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "bench/optimizers/scale_factor_heaps.h"
#include "bench/optimizers/stopwatch.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::bench {
namespace {

constexpr std::array kFactors{2.0, 1.5, 1.0};
constexpr int kExperiments = 2;

struct Size {
  int width = 400;   // [px]
  int height = 200;  // [px]
};

class Campaign {
 public:
  explicit Campaign(const Size& size) : problem_(MakeProblem("heap", 1)), size_(size) {
    std::vector<optimizer::ExperimentTarget> targets;
    for (int experiment = 0; experiment < kExperiments; ++experiment) {
      std::vector<Image> heaps;
      for (int heap = 0; heap < kHeaps; ++heap) {
        heaps.push_back(Simulate(truth_, experiment, 1, 900'000 + heap));
      }
      targets.push_back(TargetOf(heaps));
    }
    strategy_ = std::make_unique<optimizer::PosteriorStrategy>(
        optimizer::PosteriorStrategyOptions{.scale_factors = {2, 1.5, 1}, .seed = 1},
        optimizer::Domain{.num_parameters = D}, std::move(targets));
  }

  // The trials of the initial design.
  int TellDesign() {
    int trial = 0;
    for (auto p = strategy_->AskAt(1, {}).front(); p.origin == optimizer::Origin::kDesign;
         p = strategy_->AskAt(1, {}).front()) {
      Tell({p.point[0], p.point[1], p.point[2]}, p.experiment, p.scale_factor, trial++);
    }
    return trial;
  }

  void Tell(const Vec& x, int trial) {
    const double factor = kFactors[static_cast<std::size_t>(trial / kExperiments) % 3];
    Tell(x, trial % kExperiments, factor, trial);
  }

  const Vec& truth() const { return truth_; }
  optimizer::Strategy& strategy() { return *strategy_; }

 private:
  void Tell(const Vec& x, int experiment, double factor, int trial) {
    strategy_->Tell({.point = Eigen::Vector3d(x[0], x[1], x[2]),
                     .experiment = experiment,
                     .scale_factor = factor,
                     .cost = HeapCost(factor),
                     .field = Simulate(x, experiment, factor, trial).px});
  }

  Image Simulate(const Vec& x, int experiment, double factor, int run) const {
    const Vec order = experiment == 0 ? x : Vec{x[1], x[2], x[0]};
    return Enlarged(HeapAt(*problem_, order, factor, static_cast<std::uint64_t>(run)), size_.width,
                    size_.height);
  }

  std::unique_ptr<Problem> problem_;
  Size size_;
  Vec truth_ = TwinTruth(1);
  std::unique_ptr<optimizer::PosteriorStrategy> strategy_;
};

double MemoryMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void Time(int num_trials, const Size& size) {
  Campaign campaign(size);
  base::Random random(1, base::Stream("fidelity time"));
  std::string proposals;
  for (int trial = campaign.TellDesign(); trial < num_trials + 3; ++trial) {
    if (trial >= num_trials) {
      const Stopwatch watch;
      campaign.strategy().AskAt(1, {});
      proposals += " " + watch.Read();
    }
    Vec x = campaign.truth();
    for (double& coordinate : x) {
      coordinate = trial % 2 == 0 ? random.Uniform()
                                  : std::clamp(coordinate + 0.05 * random.Normal(), 0.0, 1.0);
    }
    campaign.Tell(x, trial);
  }
  const double before_answer = MemoryMegabytes();
  const Stopwatch watch;
  campaign.strategy().Recommend();
  // The first proposal fits everything, the next ones start from what it found.
  std::printf("%d x %d px after %d trials: proposals%s s, answer %s s, memory %.0f, then %.0f MB\n",
              size.width, size.height, num_trials, proposals.c_str(), watch.Read().c_str(),
              before_answer, MemoryMegabytes());
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  talus::bench::Size size;
  if (argc > 2) std::sscanf(argv[2], "%dx%d", &size.width, &size.height);
  talus::bench::Time(argc > 1 ? std::atoi(argv[1]) : 300, size);
}
