// The posterior's search, over all experiments and scale factors: which set to simulate next, for
// which experiment, and with how coarse grains.
//
// First a design at the coarsest scale factor. Then the next set is a posterior draw where the
// outputs at the target are known worst, and the scale factor and experiment are what narrows the
// misfit there most a core second. The answer is the posterior's (posterior.h). Where the number of
// simulations is bounded beside their core time, both are used up.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "optimizer/moments.h"
#include "optimizer/outputs/experiment_target.h"
#include "optimizer/outputs/levels.h"
#include "optimizer/posterior/asked_density.h"
#include "optimizer/posterior/asked_gain.h"
#include "optimizer/posterior/expected_narrowing.h"
#include "optimizer/posterior/posterior.h"
#include "optimizer/posterior_summary.h"
#include "optimizer/search/stopping_rule.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategy/strategy.h"

namespace talus::optimizer {

// How a search over several scale factors works.
struct PosteriorStrategyOptions {
  std::vector<double> scale_factors = {1};  // distinct, >= 1, in any order
  double target = 0;    // the scale factor that the answer is for, <= all of them; 0: the least
  int num_initial = 0;  // evaluations of the design at the coarsest level; 0: PosteriorDesignSize
  double model_error = 1;  // sd of what no simulation can match, in run-to-run sds of the images
  bool learn_model_error = false;  // model_error is the scale of its prior (learn_model_errors.h)
  double stop_share = 0.1;  // stop when no number of evaluations would take this share of its width
                            // from the range of a parameter that is asked for; 0: never
  int simulations = 0;      // that may be run; 0: any number
  double core_time = 0;     // that these may take together [core s]; 0: any
  std::uint64_t seed = 1;
};

// What Recommend would say of other simulations; unit cube.
struct AnswerIfShifted {
  Eigen::VectorXd point{};
  std::vector<Range> credible{};  // 90 %, as Answer::credible
  double implausibility = 0;      // Posterior::Implausibility of the point, the largest [sd]
};

class PosteriorStrategy : public Strategy {
 public:
  PosteriorStrategy(const PosteriorStrategyOptions& options, const Domain& domain,
                    std::vector<ExperimentTarget> targets);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  std::vector<Proposal> AskAt(int count, std::span<const Proposal> pending) override;
  void Tell(const Observation& observation) override;
  std::optional<StopReason> WhyStop() override;
  std::optional<StopShortfall> Shortfall() override;
  Answer Recommend() override;

  // Whether enough was told for all below; the first three have nothing to say before.
  bool CanModel() const;
  // Where a set stands in the posterior.
  std::optional<Standing> Consider(const Eigen::VectorXd& point);
  // Its credible level alone, of many: one point a row. The nuisances' coordinates do not count.
  std::optional<Eigen::VectorXd> CredibleLevels(const Eigen::MatrixXd& points);
  // The objective of an experiment with an image by the model that Recommend answers with, at the
  // target scale factor: one point a row.
  std::optional<Moments> Predict(const Eigen::MatrixXd& points, int experiment);
  // Recommend's point and ranges had every simulation shown so much more, a shift for each
  // experiment: what a systematic error of the simulations does to the answer. Wants CanModel.
  AnswerIfShifted IfShifted(const std::vector<ShiftBySet>& shifts);
  // Model and sample of all that was told.
  const Posterior& Model();
  const PosteriorSample& Sample();
  // The same of the parameters asked for.
  const AskedDensity& Asked();
  const PosteriorSample& AskedSample();

 private:
  // What was told of one experiment; images in both codes until it shows which one serves.
  struct Told {
    std::vector<std::shared_ptr<const surrogate::FieldCode>> codes;
    std::vector<OutputData> by_code;  // one a code; one without code where there is no image
    std::vector<double> misses;       // objectives; of a test without image that of its numbers
    std::vector<std::size_t> place;   // of each, among all that were told
    double edge_error = 0;            // Σ |image - its column edges| / Σ image
    std::vector<double> cost;         // Σ over told evaluations [core s], one a level
    std::vector<int> count;           // of these
    std::optional<OutputState> state;
    int num_fitted = 0;
    std::size_t fitted_code = 0;

    std::size_t code() const;
    bool TellsBy(int number) const;
    OutputData FirstOf(int number) const;  // as they are modelled
    int size() const { return by_code.front().size(); }
  };

  static constexpr int kFewest = 6;  // evaluations of an experiment that a model can stand on

  Proposal Next(std::span<const Proposal> asked);
  // Whether the stopping rule has something to judge.
  bool HasDesign();
  // A number that too few evaluations have for a model; nothing where no number is to blame.
  std::optional<StopShortfall> UndefinedNumber() const;
  ExperimentModel::Setup SetupOf(std::size_t experiment) const;
  std::ptrdiff_t NumEarlier(const Told& told) const;
  std::vector<SurrogateAhead> SureSurrogates();
  // The surrogates after half as many evaluations again, if these do as well as the last third has.
  std::vector<SurrogateAhead> SurrogatesAhead(const Eigen::MatrixXd& draws);
  std::vector<double> NarrowingBy(const Eigen::MatrixXd& draws,
                                  const std::vector<SurrogateAhead>& ahead);
  Outlook OutlookBy(const Eigen::MatrixXd& draws);  // of any number of further evaluations
  const Outlook& OutlookNow();
  bool IsFarFromTheEnd();
  template <class Counted>
  int NumSets(std::span<const Proposal> asked, int most, const Counted& counted) const;
  bool IsUnderWay() const;
  std::optional<Proposal> FromDesign(std::span<const Proposal> asked) const;
  Proposal ByGain(std::span<const Proposal> asked);
  // Which of the points, for which experiment and how coarse, gains most for what it costs.
  Proposal MostPerCost(const AskedGain& gain, const Eigen::MatrixXd& sites, double price) const;
  // What a simulation costs beside its own core time [core s].
  double Price(std::span<const Proposal> asked) const;
  // A finer scale factor that has too few evaluations to tell its discrepancy.
  std::optional<Proposal> TooFewAt(const Eigen::VectorXd& point,
                                   std::span<const Proposal> asked) const;
  double CostOf(std::size_t experiment, int level) const;
  void CountSuccesses(std::size_t experiment, Posterior& posterior) const;
  Posterior MakePosterior();
  // `divisor`: of the usual size.
  PosteriorSample SampleOf(const Posterior& posterior, int divisor = 1) const;
  std::vector<double> UnlearntScaleFactors() const;
  int FewestAtFinest() const;
  Answer RecommendUnmodelled() const;
  Answer RecommendModelled();
  void Summarise(Answer& answer);
  std::vector<NuisanceWeight> NuisanceWeights(const Eigen::MatrixXd& draws) const;
  void AddPrior(PosteriorSummary& summary) const;

  PosteriorStrategyOptions options_;
  Domain domain_;
  Levels levels_;
  std::vector<ExperimentTarget> targets_;
  std::vector<Told> told_;
  std::vector<Observation> observations_;  // without their images
  Eigen::MatrixXd design_;                 // one point a row
  std::optional<Posterior> posterior_;     // of all that was told
  std::optional<PosteriorSample> sample_;  // of it
  std::optional<AskedDensity> asked_;
  std::optional<PosteriorSample> asked_sample_;
  std::optional<Outlook> outlook_;
  std::optional<Answer> answer_;
};

}  // namespace talus::optimizer
