// The runs of a prediction as they end, and what they say so far.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/predict/measured_process.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/prediction_plan.h"
#include "experiments/analysis/predict/spread.h"
#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::analysis {

// Takes away what the case's rig does not measure: templates of another test leave other numbers.
// Throws base::Error where nothing is left, neither a number nor an image.
void KeepRigNumbers(const rigs::Case& rig_case, trials::TrialOutput& output);

class PredictionRuns {
 public:
  // What 90 % of single runs keep within is the largest of a few distances, at best, and the next
  // one of n runs is as near in n/(n + 1) of cases: of eight in 89 %. Few draws stand for few
  // of the sets besides.
  static constexpr int kFewestOfARange = 8;
  static constexpr int kFewestDrawsOfARange = 4;  // where there are several

  // `scale_factor`: of the runs that tell parameters and scatter apart, and have the pictures.
  PredictionRuns(std::vector<double> weights, std::vector<PlannedRun> plan, double scale_factor);

  std::size_t size() const { return runs_.size(); }
  const PlannedRun& planned(std::size_t run) const { return plan_[run]; }

  void Add(std::size_t run, trials::TrialOutput output);
  void AddFailure(std::size_t run, std::string why, double core_time);

  int num_ended() const { return num_ended_; }
  // Runs with the scale factor that have ended well.
  int NumEnded(double scale_factor) const;
  // Counts, and every number that has a value in some run with the prediction's scale factor, each
  // with its spread; none where no run gives it.
  std::vector<std::optional<Spread>> Summarise(Prediction& prediction) const;
  // Beside what was measured; the prediction must have been summarised.
  void Compare(const MeasuredProcess& measured, const std::vector<std::optional<Spread>>& spreads,
               Prediction& prediction) const;

  // Images of a draw's runs; none of runs without.
  std::vector<imaging::GrayImage> ImagesOf(std::size_t draw) const;
  const std::vector<double>& weights() const { return weights_; }

 private:
  struct Run {
    bool has_ended = false;
    std::optional<trials::TrialOutput> output;  // none where it failed
  };

  std::vector<std::string> Names(double scale_factor) const;
  // A number's values by draw, and why the last run without one has none.
  DrawValues ValuesOf(const std::string& name, double scale_factor, std::string& undefined) const;
  // By those runs that have ended well.
  std::vector<double> ByRun(const std::string& name) const;
  std::string UnitOf(const std::string& name) const;  // empty where no run has it
  int SeedsOfADraw() const;
  std::optional<MeasuredImage> CompareImage(const imaging::Profile& measured) const;

  std::vector<double> weights_;  // of the draws
  std::vector<PlannedRun> plan_;
  double scale_factor_ = 1;
  std::vector<Run> runs_;
  int num_ended_ = 0;
  int num_failed_ = 0;
  double failed_time_ = 0;  // core time of these [s]
  std::string failure_;
};

}  // namespace talus::analysis
