// What the observations say of the parameters, as plain data: the answer that a posterior gives.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"

namespace talus::optimizer {

// A connected part of the joint 90 % region.
struct PosteriorBranch {
  double share = 0;           // of the posterior draws in the region, in (0, 1]
  Eigen::VectorXd point;      // a draw in the middle of the branch, unit cube
  Eigen::VectorXd low, high;  // the branch's bounding box, unit cube
};

// A number of an experiment, as the model expects it at a point and the target scale factor.
struct NumberStanding {
  double predicted = 0;     // median over seeds, in the number's own unit
  double predicted_sd = 0;  // of that median

  TALUS_FIELDS(predicted, predicted_sd);
};

// How an experiment stands at a point.
struct ExperimentStanding {
  std::string name{};
  // Objective of the mean image at the target scale factor; NaN without images.
  double predicted = base::kNotKnown;
  double predicted_sd = base::kNotKnown;
  double implausibility = 0;              // Posterior::Implausibility [standard deviations]
  double caution = 1;                     // times the predictions' sds in that [-], >= 1
  double model_error = 1;                 // that the posterior counts with, in run-to-run sds [-]
  double model_error_told = 0;            // ModelError::told [-], in [0, 1]; 0: stated
  std::vector<NumberStanding> numbers{};  // in the order of the target's

  static constexpr base::FieldKey kKeys[] = {{"predicted", "predicted_objective"},
                                             {"predicted_sd", "predicted_objective_sd"}};
  TALUS_FIELDS(name, predicted, predicted_sd, implausibility, caution, model_error,
               model_error_told, numbers);
};

// Where a given set stands in the posterior.
struct Standing {
  double credible_level = 1;  // of the smallest joint region that holds it, in [0, 1]
  std::vector<ExperimentStanding> experiments;
};

// What knowing a nuisance would change.
struct NuisanceWeight {
  Eigen::Index coordinate = 0;
  // Share of the asked parameter's range that it would narrow most: sample_statistics.h.
  double narrowing = 0;
  Eigen::Index other = 0;  // the coordinate of that parameter
};

// Regions are of the parameters asked for, nuisances integrated out.
struct PosteriorSummary {
  Eigen::MatrixXd draws;     // unit cube, one draw a row, equally likely, nuisances too
  double region_volume = 1;  // of the joint 90 % region, share of the searched box
  std::vector<PosteriorBranch> branches;  // of the joint 90 % region, the likeliest first
  double temper = 1;        // misfits are divided by this for leave-one-out coverage, >= 1
  double raw_coverage = 0;  // leave-one-out, of nominal 90 % regions of the outputs, without it
  double tempered_coverage = 0;  // … with it
  int num_left_out = 0;          // evaluations that the two are made of
  double target_scale_factor = 1;
  bool is_extrapolated = false;  // no simulation at the target scale factor
  std::vector<double>
      unlearnt_scale_factors;  // scale factors whose discrepancy from the target is not known
  int fewest_at_finest = 0;  // evaluations at the smallest scale factor, of the experiment with the
                             // fewest
  std::vector<ExperimentStanding> experiments;  // at the recommended set
  // The largest share of its width that a surrogate which is sure would take from a range [-].
  double surrogate_narrowing = 0;
  std::vector<NuisanceWeight> nuisances{};
  Eigen::MatrixXd prior_draws{};   // as `draws`; no rows where the prior is uniform
  Eigen::VectorXd prior_offset{};  // of the draws' mean (Prior::Offset); NaN where it is uniform
};

}  // namespace talus::optimizer
