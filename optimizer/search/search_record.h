// What a model-based strategy was told, and the rules that hold whatever the model is.
//
//   initial design      the domain's guesses, then a Latin hypercube of 2 d + 3 points,
//                       d + 3 of an exact list
//   first repeat        the best point once more: the same value twice means deterministic
//   replicate or        under noise, a proposal next to an evaluated point becomes a replicate of
//   perturb             it; otherwise no point is evaluated twice
//   feasibility         where evaluations fail (feasibility.h)
//   end                 when what is left to gain is small (ReasonToStop)
//
// State = the observations told so far, in order.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "optimizer/designs/design_queue.h"
#include "optimizer/observation.h"
#include "optimizer/search/feasibility.h"
#include "optimizer/search/history.h"
#include "optimizer/space/domain.h"
#include "optimizer/stop_reason.h"

namespace talus::optimizer {

// Options of every strategy with a model.
struct SurrogateOptions {
  int num_initial = 0;         // evaluations of the design; 0: as above
  double stop_multiple = 0.7;  // stop when the most left to gain is below this × noise sd
  int max_replicates = 5;      // deliberate replicates beside the first repeat, in all; of a list
                               // of candidates, how often each may be evaluated
  bool exact = false;          // the same point always gives the same value: nothing is repeated
  std::uint64_t seed = 1;
};

class SearchRecord {
 public:
  SearchRecord(Domain domain, const SurrogateOptions& options);

  void Tell(const Observation& observation);

  // The next point of the design or the first repeat; nothing when both are done. `asked` are the
  // points that are being evaluated.
  std::optional<Proposal> BeforeModel(std::span<const Eigen::VectorXd> asked) const;

  // Where the next evaluation may be: the domain, less the candidates that are used up.
  Domain OpenDomain(std::span<const Eigen::VectorXd> asked) const;

  // Where an evaluation most probably works: all there is to go by while hardly any has.
  Eigen::VectorXd MostFeasible(std::span<const Eigen::VectorXd> asked) const;

  // The proposal that a model's choice of `point` becomes.
  Proposal ReplicateOrPerturb(const Eigen::VectorXd& point,
                              std::span<const Eigen::VectorXd> asked) const;

  bool WasEvaluated(const Eigen::VectorXd& point, std::span<const Eigen::VectorXd> asked) const;

  // By the rule of stopping_rule.h, when `gain`, what going on would improve by at most, is small.
  std::optional<StopReason> ReasonToStop(double gain, double noise) const;
  // A search never stops before `num_evaluations` is twice the design and the noise is known.
  bool MayStop(int num_evaluations) const;

  // A seed for the next search of a model, another one for each evaluation.
  std::uint64_t StepSeed(std::span<const Eigen::VectorXd> asked) const;

  const Domain& domain() const { return domain_; }
  const SurrogateOptions& options() const { return options_; }
  const std::vector<Observation>& told() const { return told_; }
  const History& history() const { return history_; }
  // Fitted when it is first asked for, since a resumed search is told hundreds of observations at
  // once; so ask before threads do.
  const Feasibility& feasibility() const {
    return feasibility_ ? *feasibility_ : feasibility_.emplace(history_);
  }
  bool deterministic() const { return options_.exact || repeats_.deterministic(); }
  // Whether a model may go through every value. Rows of a table are results of single simulations:
  // each may be exact and yet rough, other seeds beside each other.
  bool noise_free() const { return deterministic() && !domain_.IsList(); }
  // Whether a point's own value is wanted, chance included: it will not be evaluated again.
  bool wants_own_values() const { return deterministic() && domain_.IsList(); }
  int design_size() const { return design_.size(); }

 private:
  std::optional<Eigen::VectorXd> FirstRepeat(std::span<const Eigen::VectorXd> asked) const;
  bool HasFailed(const Eigen::VectorXd& point) const;
  // Some point of a domain that is no list; base::ConfigError where there is none.
  Eigen::VectorXd Unevaluated(std::span<const Eigen::VectorXd> asked) const;

  Domain domain_;
  SurrogateOptions options_;
  DesignQueue design_;
  std::vector<Observation> told_;
  History history_;
  Repeats repeats_;
  mutable std::optional<Feasibility> feasibility_;
};

}  // namespace talus::optimizer
