// Steps by a Gaussian process of the objective's values, and what it says of the minimum.
//
//   deterministic: expected improvement over the domain or in a region round the best point, or a
//                  quadratic in such a region: the kind that has paid lately (step_choice.h)
//   noisy:         noise-aware expected improvement, from 20 evaluations on in turn with the
//                  knowledge gradient
//
// Batches and pending points by the kriging believer: points under way are fantasised at their
// predicted mean, hyper-parameters frozen.
#pragma once

#include <optional>
#include <span>

#include "optimizer/answer.h"
#include "optimizer/search/scalar_model.h"
#include "optimizer/search/search_record.h"

namespace talus::optimizer {

class ScalarSearch {
 public:
  explicit ScalarSearch(std::uint64_t seed) : fitter_(seed) {}

  // The record has grown: the process is out of date.
  void Update() { fit_.reset(); }

  // At least two evaluations succeeded.
  Proposal Next(const SearchRecord& record, std::span<const Eigen::VectorXd> asked);
  std::optional<StopReason> WhyStop(const SearchRecord& record);
  Answer Recommend(const SearchRecord& record);

 private:
  const ScalarFit& Fit(const SearchRecord& record);
  Eigen::VectorXd Best(const SearchRecord& record);

  ScalarFitter fitter_;
  std::optional<ScalarFit> fit_;
};

}  // namespace talus::optimizer
