// The strategy for evaluations that bring a whole image: the images' modes are modelled instead of
// the objective, and the objective is worked out on predicted images.
//
// While the images predict worse than the values alone, under noise 1.5 times worse
// (image_history.h), it steps by the values.
#pragma once

#include <cstddef>
#include <optional>

#include "optimizer/search/image_history.h"
#include "optimizer/search/model_step.h"
#include "optimizer/search/scalar_search.h"
#include "optimizer/strategy/surrogate_strategy.h"

namespace talus::optimizer {

class ImageStrategy : public SurrogateStrategy {
 public:
  ImageStrategy(const Domain& domain, const FieldObjective& objective,
                const SurrogateOptions& options);

  std::optional<StopReason> WhyStop() override;
  Answer Recommend() override;

 private:
  Proposal ByModel(const Points& asked) override;
  void RequireUsable(const Observation& observation) const override;
  void Update(const Observation& observation) override;

  const std::optional<ImageModel>& Model();
  ModelView ViewOf(const ImageModel& model, const Domain& domain, std::uint64_t seed) const;
  // A seed for the next search of the model, another one for each image.
  std::uint64_t ImageSeed(const Points& asked) const;
  Eigen::VectorXd Step(const ImageModel& model, const Points& asked) const;
  Eigen::VectorXd ByKnowledge(const ImageModel& model, const Points& asked) const;
  Eigen::VectorXd ByImprovement(const ImageModel& model, const Points& asked) const;
  double LowestOwnValue(const ImageModel& model) const;
  Eigen::VectorXd ByDraw(const ImageModel& model, const Points& asked) const;
  Eigen::VectorXd Best(const ImageModel& model, const Domain& domain) const;
  Eigen::VectorXd Recommended(const ImageModel& model) const;
  Answer RecommendByValues();

  ImageHistory fields_;
  ScalarSearch by_values_;
  bool has_exact_target_ = true;
  std::size_t num_pixels_ = 0;
  std::optional<ImageModel> model_;
  bool is_current_ = false;  // model_ knows all that was told
};

}  // namespace talus::optimizer
