// The strategy for evaluations that bring a whole image: the images' modes are modelled instead of
// the objective, and the objective is worked out on predicted images.
//
// While the images predict worse than the values alone (field_history.h) it steps by the values.
#pragma once

#include <optional>
#include <string>

#include "optimizer/acquisition/model_step.h"
#include "optimizer/models/field_history.h"
#include "optimizer/strategies/scalar_search.h"
#include "optimizer/strategies/surrogate_strategy.h"

namespace talus::optimizer {

class FieldStrategy : public SurrogateStrategy {
 public:
  // `always`: never fall back to the values.
  FieldStrategy(const Domain& domain, const FieldObjective& objective, bool always,
                const SurrogateOptions& options);

  std::optional<std::string> StopReason() override;
  Answer Recommend() override;
  std::optional<Moments> Predict(const Eigen::MatrixXd& points, int experiment) override;

 private:
  Proposal ByModel(const Points& asked) override;
  void Update(const Observation& observation) override;

  const std::optional<FieldModel>& Model();
  ModelView ViewOf(const FieldModel& model, const Domain& domain, std::uint64_t seed) const;
  // A seed for the next search of the model, another one for each image.
  std::uint64_t ImageSeed(const Points& asked) const;
  Eigen::VectorXd Step(const FieldModel& model, const Points& asked) const;
  Eigen::VectorXd ByKnowledge(const FieldModel& model, const Points& asked) const;
  Eigen::VectorXd ByImprovement(const FieldModel& model, const Points& asked) const;
  double LowestOwnValue(const FieldModel& model) const;
  Eigen::VectorXd ByDraw(const FieldModel& model, const Points& asked) const;
  Eigen::VectorXd Best(const FieldModel& model, const Domain& domain) const;
  Answer RecommendByValues();

  FieldHistory fields_;
  ScalarSearch by_values_;
  bool has_exact_target_ = true;
  std::optional<FieldModel> model_;
  bool is_current_ = false;  // model_ knows all that was told
};

}  // namespace talus::optimizer
