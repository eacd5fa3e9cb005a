// The images told so far, and the model that predicts them best.
//
// Hyper-parameters are fitted anew whenever the evaluations have grown by a seventh, on exactly the
// evaluations there were then: so what a strategy proposes does not depend on when it was asked.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/observation.h"
#include "optimizer/search/image_model.h"

namespace talus::optimizer {

class ImageHistory {
 public:
  ImageHistory(const FieldObjective& objective, std::uint64_t seed);

  void Add(const Observation& observation);
  bool has_metric() const { return static_cast<bool>(objective_.metric); }
  int size() const { return static_cast<int>(values_.size()); }

  // A model of all evaluations; none while there are too few, or where a process of the values
  // alone predicts them better, left out one by one: at all without noise, under noise where the
  // images' error is more than 1.5 times that of the values.
  std::optional<ImageModel> Model(bool deterministic);

  // Which model was chosen and how well each predicts, in words. After Model.
  const std::string& verdict() const { return verdict_; }
  // Leave-one-out error of the chosen model over the better half / their standard deviation.
  double left_out_share() const { return left_out_share_; }

 private:
  struct Coded {
    std::shared_ptr<const surrogate::FieldCode> code;
    std::vector<Eigen::VectorXd> vectors;
    std::vector<double> reconstruction_errors;
  };
  struct Choice {
    int num_fitted = 0;
    bool deterministic = false;
    const Coded* coded = nullptr;  // null: the values alone predict better
    std::optional<ImageState> state;
  };

  CodedImages First(const Coded& coded, int count) const;
  void Choose(int count, bool deterministic);
  double ErrorOfValues(const CodedImages& data, bool deterministic) const;

  FieldObjective objective_;
  std::uint64_t seed_;
  std::vector<Coded> codes_;
  std::vector<Eigen::VectorXd> points_;
  std::vector<double> values_;
  Choice choice_;
  std::string verdict_;
  double left_out_share_ = 0;
};

}  // namespace talus::optimizer
