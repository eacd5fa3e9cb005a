#include "optimizer/posterior/posterior.h"

#include <algorithm>
#include <cmath>

#include "base/not_known.h"
#include "optimizer/posterior/importance_sample.h"
#include "optimizer/space/point_rows.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

// Outputs that the likelihood is made of: none of an experiment that is held out.
int NumCounted(const ExperimentModel& model) {
  return model.weight() > 0 ? model.num_outputs() : 0;
}

// Residuals of all experiments side by side: a row for each set and scale factor, NaN where an
// experiment was not simulated there. Replicates go to rows of their own.
Eigen::MatrixXd StackResiduals(const std::vector<ExperimentModel>& models,
                               const std::vector<OutputData>& data) {
  Eigen::Index width = 0;
  for (const ExperimentModel& model : models) width += NumCounted(model);
  struct Place {
    Eigen::VectorXd point;
    int level;
    std::vector<bool> has;
  };
  std::vector<Place> places;
  Eigen::MatrixXd stacked(0, width);
  Eigen::Index left = 0;
  for (std::size_t e = 0; e < models.size(); ++e) {
    if (NumCounted(models[e]) == 0) continue;
    const Eigen::MatrixXd z = models[e].LeaveOneOut();
    for (int i = 0; i < data[e].size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      auto place = std::find_if(places.begin(), places.end(), [&](const Place& p) {
        return p.level == data[e].level[k] && !p.has[e] &&
               surrogate::SamePoint(p.point, data[e].points[k]);
      });
      if (place == places.end()) {
        places.push_back({data[e].points[k], data[e].level[k], std::vector<bool>(models.size())});
        place = places.end() - 1;
        stacked.conservativeResize(stacked.rows() + 1, Eigen::NoChange);
        stacked.bottomRows(1).setConstant(base::kNotKnown);
      }
      place->has[e] = true;
      stacked.row(place - places.begin()).segment(left, z.cols()) = z.row(i);
    }
    left += models[e].num_outputs();
  }
  return stacked;
}

// The experiment that each output is of, counted among those that count.
std::vector<int> TestOfOutputs(const std::vector<ExperimentModel>& models) {
  std::vector<int> test;
  int num_tests = 0;
  for (const ExperimentModel& model : models) {
    if (NumCounted(model) == 0) continue;
    test.insert(test.end(), static_cast<std::size_t>(NumCounted(model)), num_tests++);
  }
  return test;
}

}  // namespace

Posterior::Posterior(std::vector<ExperimentModel> models, const std::vector<OutputData>& data,
                     Prior prior)
    : models_(std::move(models)),
      misfit_(StackResiduals(models_, data), TestOfOutputs(models_)),
      prior_(std::move(prior)) {}

// An experiment that is held out has none.
std::vector<OutputMoments> Posterior::Outputs(const Eigen::MatrixXd& points) const {
  std::vector<OutputMoments> outputs;
  for (const ExperimentModel& model : models_) {
    outputs.push_back(NumCounted(model) == 0 ? OutputMoments{} : model.Outputs(points));
  }
  for (std::size_t e = 0; e < shifts_.size(); ++e) {
    if (NumCounted(models_[e]) > 0) outputs[e].mean += shifts_[e](points);
  }
  return outputs;
}

Eigen::VectorXd Posterior::LogDensity(const Eigen::MatrixXd& points, double softness) const {
  return LogDensity(Outputs(points), softness) + prior_.LogDensity(points) + LogSuccess(points);
}

void Posterior::CountSuccesses(std::size_t experiment, SuccessModel successes) {
  successes_.push_back({.weight = models_[experiment].weight(), .model = std::move(successes)});
}

Eigen::VectorXd Posterior::LogSuccess(const Eigen::MatrixXd& points) const {
  constexpr double kLeast = 1e-3;  // neighbours may be wrong
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
  for (const Successes& one : successes_) {
    sum.array() += one.weight * one.model.Probability(points).array().max(kLeast).log();
  }
  return sum;
}

Eigen::VectorXd Posterior::LogDensity(const std::vector<OutputMoments>& outputs,
                                      double softness) const {
  Eigen::Index num_points = 0;
  for (const OutputMoments& one : outputs) num_points = std::max(num_points, one.mean.rows());
  Eigen::MatrixXd residual(num_points, misfit_.num_outputs());
  Eigen::MatrixXd share(num_points, 0);
  Eigen::VectorXd log_sd = Eigen::VectorXd::Zero(num_points);
  Eigen::Index left = 0;
  for (std::size_t e = 0; e < models_.size(); ++e) {
    const ExperimentModel& model = models_[e];
    if (NumCounted(model) == 0) continue;
    const OutputMisfit misfit = model.MisfitOf(outputs[e]);
    const double weight = model.weight();
    residual.middleCols(left, misfit.residual.cols()) = std::sqrt(weight) * misfit.residual;
    log_sd += weight * misfit.log_sd;
    share.conservativeResize(Eigen::NoChange, share.cols() + 1);
    share.rightCols(1) = misfit.share;
    left += misfit.residual.cols();
  }
  return misfit_.LogDensity(misfit_.Squared(residual, share), log_sd, softness);
}

PosteriorSample Posterior::Sample(const Domain& domain, int num_start, double softness,
                                  std::uint64_t seed) const {
  const auto density = [&](const Eigen::MatrixXd& points) { return LogDensity(points, softness); };
  return SampleByImportance(density, {.domain = &domain, .prior = &prior_, .num_start = num_start},
                            seed);
}

double Posterior::Implausibility(std::size_t experiment, const Eigen::VectorXd& x) const {
  return models_[experiment].Misfit(x) / std::sqrt(temper());
}

Eigen::VectorXd Posterior::SquaredMisfit(std::size_t experiment,
                                         const Eigen::MatrixXd& points) const {
  return models_[experiment].SquaredMisfit(points) / temper();
}

std::vector<ExperimentStanding> Posterior::StandingsAt(const Eigen::VectorXd& x) const {
  std::vector<ExperimentStanding> standings;
  for (std::size_t e = 0; e < models_.size(); ++e) {
    standings.push_back(models_[e].StandingAt(x));
    standings.back().implausibility = Implausibility(e, x);
  }
  return standings;
}

}  // namespace talus::optimizer
