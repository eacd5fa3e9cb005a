// The runs of a prediction as they end, and what they say so far.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/predict/measured_process.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/spread.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::analysis {

class PredictionRuns {
 public:
  PredictionRuns(std::vector<double> weights, int num_seeds);

  std::size_t size() const { return runs_.size(); }
  // Every draw once, then every draw again: the first few runs show the range already.
  std::size_t draw(std::size_t run) const { return run % weights_.size(); }
  std::size_t seed(std::size_t run) const { return run / weights_.size(); }

  void Add(std::size_t run, trials::TrialOutput output);
  void AddFailure(std::size_t run, std::string why);

  int num_ended() const { return num_ended_; }
  // Counts, and every number that has a value in some run.
  void Summarise(Prediction& prediction) const;
  // Beside what was measured; the prediction must have been summarised.
  void Compare(const MeasuredProcess& measured, Prediction& prediction) const;

  // Images of a draw's runs; none of runs without.
  std::vector<imaging::GrayImage> ImagesOf(std::size_t draw) const;
  const std::vector<double>& weights() const { return weights_; }

 private:
  struct Run {
    bool has_ended = false;
    std::optional<trials::TrialOutput> output;  // none where it failed
  };

  std::vector<std::string> Names() const;
  // A number's values by draw, and why the last run without one has none.
  DrawValues ValuesOf(const std::string& name, std::string& undefined) const;
  std::optional<MeasuredImage> CompareImage(const imaging::Profile& measured) const;

  std::vector<double> weights_;  // of the draws
  std::vector<Run> runs_;
  int num_ended_ = 0;
  int num_failed_ = 0;
  std::string failure_;
};

}  // namespace talus::analysis
