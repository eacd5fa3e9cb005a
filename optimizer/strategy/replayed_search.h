// A search that calls the objective itself (NLopt's do), turned inside out into ask–tell.
//
// Each Ask runs the search anew from its beginning and answers its calls from what was told, until
// it calls for a point nobody has told: that is the proposal. So there is no thread, and no state
// but the observations. Told are some hundreds of points, so the replay costs nothing beside a
// simulation.
#pragma once

#include <optional>

#include "optimizer/designs/design.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategy/strategy.h"
#include "surrogate/nlopt_minimize.h"

namespace talus::optimizer {

struct ReplayOptions {
  surrogate::SearchAlgorithm algorithm = surrogate::SearchAlgorithm::kDirectL;
  std::string name;    // for people: "DIRECT-L"
  bool local = false;  // starts again from another point whenever it has converged
};

class ReplayedSearch : public Strategy {
 public:
  ReplayedSearch(const Domain& domain, ReplayOptions options, std::uint64_t seed);

  // A batch goes on as if each pending point had the value of its nearest neighbour.
  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override { told_.push_back(WithoutImage(observation)); }
  std::optional<StopReason> WhyStop() override;
  Answer Recommend() override;

 private:
  // The first point the search calls for that is neither told nor pending; none when it has ended.
  std::optional<Eigen::VectorXd> Replay(std::span<const Eigen::VectorXd> pending);
  Eigen::VectorXd Start(int run);

  const Domain domain_;
  const ReplayOptions options_;
  const std::uint64_t seed_;
  std::vector<Observation> told_;
  Points starts_;         // within a small domain, made when they are needed
  bool is_lost_ = false;  // the last replay hardly came to the domain
};

}  // namespace talus::optimizer
