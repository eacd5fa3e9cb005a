// The strategy for evaluations that bring a whole image: the images' modes are modelled instead of
// the objective, and the objective is worked out on predicted images.
//
// Design, the repeat that tells noisy from deterministic, and everything while the images predict
// worse than the values alone (field_history.h), are the scalar strategy's.
#pragma once

#include "optimizer/models/field_history.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategies/scalar_strategy.h"
#include "optimizer/strategies/strategy.h"

namespace talus::optimizer {

class FieldStrategy : public Strategy {
 public:
  // `always`: never fall back to the values.
  FieldStrategy(const Domain& domain, const FieldObjective& objective, bool always,
                const ScalarOptions& options);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override;
  std::optional<std::string> StopReason() override;
  Answer Recommend() override;

 private:
  using Points = std::vector<Eigen::VectorXd>;

  const std::optional<FieldModel>& Model();
  Proposal Next(const Points& asked);
  Eigen::VectorXd NextByModel(const FieldModel& model, const Points& asked) const;
  Eigen::VectorXd ByImprovement(const FieldModel& model, const Points& asked) const;
  Eigen::VectorXd ByDraw(const FieldModel& model, const Points& asked) const;
  Eigen::VectorXd LowestMean(const FieldModel& model) const;
  Answer RecommendByValues();

  Domain domain_;
  ScalarOptions options_;
  ScalarStrategy scalar_;
  FieldHistory fields_;
  bool has_exact_target_ = true;
  std::optional<FieldModel> model_;
  bool is_current_ = false;  // model_ knows all that was told
};

}  // namespace talus::optimizer
