// What a campaign predicts of another test or process: the content of DIR/predict/NAME/
// prediction.json. Terminal and report read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"

namespace talus::analysis {

// What was simulated.
enum class PredictedBy {
  kPosterior,    // draws of it
  kRecommended,  // the recommended set
  kSet           // one that the user gave
};
constexpr PredictedBy LastOf(PredictedBy) { return PredictedBy::kSet; }

inline constexpr const char* kSceneTest = "scene";  // in place of a rig's kind

// A number that was measured on the real process, beside the prediction of it.
struct MeasuredThere {
  double value = base::kNotKnown;
  double standard_error = base::kNotKnown;
  double low = base::kNotKnown;  // 90 % of what one such measurement would give, its error counted
  double high = base::kNotKnown;
  bool is_inside = false;
  int nearest_draw = 0;            // by its place from 0
  bool nearest_is_inside = false;  // of the 90 % that this draw alone predicts

  static constexpr base::FieldKey kKeys[] = {{"low", "low_90"}, {"high", "high_90"}};
  TALUS_FIELDS(value, standard_error, low, high, is_inside, nearest_draw, nearest_is_inside);
};

// A surrogate over the draws (number_surrogate.h) beside the draws themselves.
struct PredictedSurrogate {
  double scale_factor = 1;                  // that it tells the number at
  double left_out_error = base::kNotKnown;  // by which it misses a draw that it was not told
  double draws_error = base::kNotKnown;     // by which the other draws' mean misses it
  bool is_used = false;                     // the number is by it
  double sd = base::kNotKnown;              // of what it gives for a set

  TALUS_FIELDS(scale_factor, left_out_error, draws_error, is_used, sd);
};

struct PredictedNumber {
  std::string name{};       // with its unit: "angle_deg"
  std::string unit{};       // "deg"; empty of a pure number
  bool is_usual = false;    // what the rig is made to measure
  int num_defined = 0;      // runs that have it
  std::string undefined{};  // why another has none
  double mean = base::kNotKnown;
  double low = base::kNotKnown;  // 90 % of single runs, whatever the set
  double high = base::kNotKnown;
  double parameters_sd = base::kNotKnown;  // of what the sets give on average
  double run_sd = base::kNotKnown;         // of a single run; null where no set was run twice
  double repeats_sd =
      base::kNotKnown;  // of runs of one draw; no key: run_sd may be the surrogate's
  double parameters_share = base::kNotKnown;  // of the variance of a single run
  std::vector<double> by_draw{};              // mean of each draw; null where it is not defined
  std::vector<double> by_run{};  // as in Prediction::runs; null where it is not defined
  std::optional<PredictedSurrogate> surrogate{};  // none: too few draws to stand on
  std::optional<MeasuredThere> measured{};

  // The variance of a single run, as far as it is known where it comes from.
  double Variance() const {
    const double by_surrogate = surrogate && surrogate->is_used ? surrogate->sd : 0;
    return parameters_sd * parameters_sd + by_surrogate * by_surrogate + run_sd * run_sd;
  }

  static constexpr base::FieldKey kKeys[] = {{"low", "low_90"}, {"high", "high_90"}};
  TALUS_FIELDS(name, unit, is_usual, num_defined, undefined, mean, low, high, parameters_sd, run_sd,
               parameters_share, by_draw, by_run, surrogate, measured);
};

// A measured profile beside the simulated ones. Distances are areas between silhouettes; what 90 %
// of single runs keep within is not known of a few runs, and nothing is then inside or outside.
struct MeasuredImage {
  double sad_mm2 = base::kNotKnown;     // measured from the predicted mean
  double sad_90_mm2 = base::kNotKnown;  // 90 % of single runs are as near to the mean
  std::optional<bool> is_inside{};
  int nearest_draw = 0;  // whose mean is nearest to what was measured
  double nearest_sad_mm2 = base::kNotKnown;
  double nearest_sad_90_mm2 =
      base::kNotKnown;  // 90 % of single runs are as near to their draw's mean
  std::optional<bool> nearest_is_inside{};

  TALUS_FIELDS(sad_mm2, sad_90_mm2, is_inside, nearest_draw, nearest_sad_mm2, nearest_sad_90_mm2,
               nearest_is_inside);
};

struct PredictedDraw {
  double weight = 0;
  std::vector<double> values{};  // of the searched parameters, SI

  TALUS_FIELDS(weight, values);
};

struct PredictedRun {
  int draw = 0;  // by its place from 0
  double scale_factor = 1;

  TALUS_FIELDS(draw, scale_factor);
};

// How a test or process shears its powder (regimes.h): 5, 50 and 95 % of the work of shearing is
// done below these.
struct FlowRegime {
  std::string name{};
  bool is_process = false;                 // what is predicted; else a test of the campaign
  std::vector<double> inertial_number{};   // I [-], of grains of the powder's own size
  std::vector<double> pressure{};          // P [Pa]
  std::vector<double> shear_rate{};        // γ̇ [1/s]
  std::vector<double> contact_duration{};  // of a collision at γ̇ d, over 1/γ̇ [-]
  double bond_number = 0;                  // pull-off force over weight [-]

  static constexpr base::FieldKey kKeys[] = {{"pressure", "pressure_Pa"},
                                             {"shear_rate", "shear_rate_per_s"}};
  TALUS_FIELDS(name, is_process, inertial_number, pressure, shear_rate, contact_duration,
               bond_number);
};

struct Prediction {
  std::string name{};
  std::string test{};  // the rig, or "scene"
  PredictedBy by = PredictedBy::kPosterior;
  double scale_factor = 1;      // of the runs that every draw has, with several seeds
  double target = 1;            // scale factor that surrogates tell
  std::int64_t last_trial = 0;  // of the campaign when the draws were taken
  int num_runs = 0;
  int num_ended = 0;
  int num_failed = 0;
  std::string failure{};  // why the last of these failed
  double core_time = 0;   // [s]
  std::vector<std::string> notes{};
  std::vector<PredictedDraw> draws{};
  std::vector<PredictedRun> runs{};  // those that have ended well
  std::vector<PredictedNumber> numbers{};
  std::optional<MeasuredImage> image{};
  std::vector<FlowRegime> regimes{};  // of the process and of each test; none where not known
  std::string mean_profile{};         // file beside this one; empty without images
  std::string most_different{};
  std::vector<int> different{};  // the two draws in it, by place from 0

  static constexpr base::FieldKey kKeys[] = {{"target", "target_scale_factor"},
                                             {"last_trial", "after_trial"},
                                             {"core_time", "core_time_s"},
                                             {"different", "most_different_draws"}};
  TALUS_FIELDS(name, test, by, scale_factor, target, last_trial, num_runs, num_ended, num_failed,
               failure, core_time, notes, draws, runs, numbers, image, regimes, mean_profile,
               most_different, different);
};

}  // namespace talus::analysis
