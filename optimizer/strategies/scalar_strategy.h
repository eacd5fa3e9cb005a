// The strategy for objectives that are numbers: a small design, one repeat, then a Gaussian process
// that says where the next evaluation is worth most.
//
//   design → repeat of the best point, which tells noisy from deterministic →
//   deterministic: steps by expected improvement, over the domain or in a region round the best
//                  point, and by a quadratic in such a region: the kind that has paid lately
//   noisy:         steps by noise-aware expected improvement
//
// Batches and pending points by the kriging believer: points under way are taken to give what the
// process predicts, hyper-parameters frozen.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimizer/models/feasibility.h"
#include "optimizer/models/history.h"
#include "optimizer/models/scalar_model.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategies/strategy.h"

namespace talus::optimizer {

struct ScalarOptions {
  int num_initial = 0;         // evaluations of the design; 0: 2 d + 3
  double stop_multiple = 0.7;  // ends when less than this × the scatter is left to gain; 0: never
  int max_replicates = 5;      // deliberate repeats beside the first, in all
  std::uint64_t seed = 1;
};

class ScalarStrategy : public Strategy {
 public:
  ScalarStrategy(Domain domain, const ScalarOptions& options);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override;
  std::optional<std::string> StopReason() override;
  Answer Recommend() override;

  // What a strategy with another model of the same evaluations shares with this one: the points
  // before any model (design and repeat), the rule for repeats, and what is known.
  using Points = std::vector<Eigen::VectorXd>;
  std::optional<Proposal> BeforeModel(const Points& asked) const;
  Proposal NotByAccident(const Eigen::VectorXd& point, const Points& asked) const;
  bool deterministic() const { return repeats_.deterministic; }
  bool knows_scatter() const { return repeats_.num_repeats > 0; }
  const History& history() const { return history_; }
  const Feasibility& feasibility() const { return feasibility_; }
  int size_of_design() const { return static_cast<int>(design_.size()); }

 private:
  // One more proposal, when those `asked` before are under way.
  Proposal Next(const Points& asked);
  std::optional<Eigen::VectorXd> NextOfDesign(const Points& asked) const;
  std::optional<Eigen::VectorXd> FirstRepeat(const Points& asked) const;
  Proposal ByModel(const Points& asked);
  // A step near the best point, where the next one is to be one; not a failing or evaluated point.
  std::optional<Eigen::VectorXd> NearBest(const Points& asked, std::uint64_t seed) const;
  bool HasFailed(const Eigen::VectorXd& point) const;
  bool WasEvaluated(const Eigen::VectorXd& point, const Points& asked) const;
  const ScalarFit& Fit();
  Eigen::VectorXd Best();

  Domain domain_;
  ScalarOptions options_;
  Points design_;
  std::vector<Observation> told_;
  History history_;
  Repeats repeats_;
  Feasibility feasibility_;
  ScalarFitter fitter_;
  std::optional<ScalarFit> fit_;
};

}  // namespace talus::optimizer
