// What a campaign predicts of another test or process: the content of DIR/predict/NAME/
// prediction.json. Terminal and report read it.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"

namespace talus::analysis {

// What was simulated.
enum class PredictedBy {
  kPosterior,    // draws of it
  kRecommended,  // the recommended set
  kSet           // one that the user gave
};

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A number that was measured on the real process, beside the prediction of it.
struct MeasuredThere {
  double value = kUnknown;
  double standard_error = kUnknown;
  double low = kUnknown;  // 90 % of what one such measurement would give, its error counted
  double high = kUnknown;
  bool is_inside = false;
  int nearest_draw = 0;            // by its place from 0
  bool nearest_is_inside = false;  // of the 90 % that this draw alone predicts

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("value", self.value);
    visit("standard_error", self.standard_error);
    visit("low_90", self.low);
    visit("high_90", self.high);
    visit("is_inside", self.is_inside);
    visit("nearest_draw", self.nearest_draw);
    visit("nearest_is_inside", self.nearest_is_inside);
  }
};

// A surrogate over the draws (number_surrogate.h) beside the draws themselves.
struct PredictedSurrogate {
  double scale_factor = 1;           // that it tells the number at
  double left_out_error = kUnknown;  // by which it misses a draw that it was not told
  double draws_error = kUnknown;     // by which the other draws' mean misses it
  bool is_used = false;              // the number is by it
  double sd = kUnknown;              // of what it gives for a set

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor);
    visit("left_out_error", self.left_out_error);
    visit("draws_error", self.draws_error);
    visit("is_used", self.is_used);
    visit("sd", self.sd);
  }
};

struct PredictedNumber {
  std::string name{};       // with its unit: "angle_deg"
  bool is_usual = false;    // what the rig is made to measure
  int num_defined = 0;      // runs that have it
  std::string undefined{};  // why another has none
  double mean = kUnknown;
  double low = kUnknown;  // 90 % of single runs, whatever the set
  double high = kUnknown;
  double parameters_sd = kUnknown;     // of what the sets give on average
  double run_sd = kUnknown;            // of a single run; null where no set was run twice
  double parameters_share = kUnknown;  // of the variance of a single run
  std::vector<double> by_draw{};       // mean of each draw; null where it is not defined
  std::vector<double> by_run{};        // as in Prediction::runs; null where it is not defined
  std::optional<PredictedSurrogate> surrogate{};  // none: too few draws to stand on
  std::optional<MeasuredThere> measured{};

  // Of a single run, as far as it is known where it comes from.
  double Variance() const {
    const double by_surrogate = surrogate && surrogate->is_used ? surrogate->sd : 0;
    return parameters_sd * parameters_sd + by_surrogate * by_surrogate + run_sd * run_sd;
  }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("is_usual", self.is_usual);
    visit("num_defined", self.num_defined);
    visit("undefined", self.undefined);
    visit("mean", self.mean);
    visit("low_90", self.low);
    visit("high_90", self.high);
    visit("parameters_sd", self.parameters_sd);
    visit("run_sd", self.run_sd);
    visit("parameters_share", self.parameters_share);
    visit("by_draw", self.by_draw);
    visit("by_run", self.by_run);
    visit("surrogate", self.surrogate);
    visit("measured", self.measured);
  }
};

// A measured profile beside the simulated ones. Distances are areas between silhouettes.
struct MeasuredImage {
  double sad_mm2 = kUnknown;     // measured from the predicted mean
  double sad_90_mm2 = kUnknown;  // 90 % of single runs are as near to the mean of the others
  bool is_inside = false;
  int nearest_draw = 0;  // whose mean is nearest to what was measured
  double nearest_sad_mm2 = kUnknown;
  bool nearest_is_inside = false;  // nearer than 90 % of single runs are to their draw's mean

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("sad_mm2", self.sad_mm2);
    visit("sad_90_mm2", self.sad_90_mm2);
    visit("is_inside", self.is_inside);
    visit("nearest_draw", self.nearest_draw);
    visit("nearest_sad_mm2", self.nearest_sad_mm2);
    visit("nearest_is_inside", self.nearest_is_inside);
  }
};

struct PredictedDraw {
  double weight = 0;
  std::vector<double> values{};  // of the searched parameters, SI

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("weight", self.weight);
    visit("values", self.values);
  }
};

struct PredictedRun {
  int draw = 0;  // by its place from 0
  double scale_factor = 1;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("draw", self.draw);
    visit("scale_factor", self.scale_factor);
  }
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

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("is_process", self.is_process);
    visit("inertial_number", self.inertial_number);
    visit("pressure_Pa", self.pressure);
    visit("shear_rate_per_s", self.shear_rate);
    visit("contact_duration", self.contact_duration);
    visit("bond_number", self.bond_number);
  }
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

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("test", self.test);
    visit("by", self.by);
    visit("scale_factor", self.scale_factor);
    visit("target_scale_factor", self.target);
    visit("after_trial", self.last_trial);
    visit("num_runs", self.num_runs);
    visit("num_ended", self.num_ended);
    visit("num_failed", self.num_failed);
    visit("failure", self.failure);
    visit("core_time_s", self.core_time);
    visit("notes", self.notes);
    visit("draws", self.draws);
    visit("runs", self.runs);
    visit("numbers", self.numbers);
    visit("image", self.image);
    visit("regimes", self.regimes);
    visit("mean_profile", self.mean_profile);
    visit("most_different", self.most_different);
    visit("most_different_draws", self.different);
  }
};

}  // namespace talus::analysis

template <>
struct talus::base::Names<talus::analysis::PredictedBy> {
  using P = talus::analysis::PredictedBy;
  static constexpr std::array kList{std::pair{"posterior", P::kPosterior},
                                    std::pair{"recommended", P::kRecommended},
                                    std::pair{"set", P::kSet}};
};
