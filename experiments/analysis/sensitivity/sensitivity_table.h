// What the answer owes to what was held fixed: the content of DIR/sensitivity.json.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"

namespace talus::analysis {

inline constexpr double kSure = 2;  // standard errors that are not chance

// How far a move shifts what an experiment shows.
struct OutputShift {
  std::string experiment{};
  std::string output{};  // "image", or the number's name
  // [sd of one simulation at the target scale factor]; of an image the root mean square over its
  // modes, of a number with its sign
  double shift = base::kNotKnown;
  double noise = base::kNotKnown;  // sd that chance gives it; of an image its root mean square
  int num_modes = 0;               // that these are root mean squares over, 1 of a number
  // Both NaN where no simulation, with the move or without, has the number.

  static constexpr base::FieldKey kKeys[] = {{"shift", "shift_in_noise_sd"},
                                             {"noise", "by_chance"}};
  TALUS_FIELDS(experiment, output, shift, noise, num_modes);
};

// What the answer would be with the moved value, SI.
struct AnswerShift {
  std::string parameter{};
  double from = 0;
  double to = 0;
  double standard_error = 0;  // of `to`, by chance in the shift
  double low = 0;             // the 90 % range would be
  double high = 0;
  double half_ranges = 0;  // the shift over half of the stated range [-], on the searched scale
  double half_ranges_error = 0;

  static constexpr base::FieldKey kKeys[] = {{"half_ranges", "shift_in_half_ranges"},
                                             {"half_ranges_error", "shift_error_in_half_ranges"},
                                             {"low", "credible_90_low"},
                                             {"high", "credible_90_high"}};
  TALUS_FIELDS(parameter, from, to, standard_error, low, high, half_ranges, half_ranges_error);
  // Beyond half of the range, and not by chance.
  bool Exceeds() const;
  bool IsWithin() const;  // half of the range, and not by chance
};

struct FixedMove {
  std::string name{};
  std::string from{};
  std::string to{};
  int replicates = 0;              // simulations of each experiment
  int num_failed = 0;              // of these
  int num_followed = 0;            // how often the shift was simulated anew at the answer foretold
  bool moves_still = false;        // the answer, after the last of these
  std::string why_not{};           // why nothing is known; else empty
  std::string why_not_followed{};  // why the answer is not simulated where it was foretold last
  std::vector<OutputShift> outputs{};
  std::vector<AnswerShift> answer{};
  double implausibility = base::kNotKnown;  // of that answer, the largest of the experiments' [sd]

  static constexpr base::FieldKey kKeys[] = {{"implausibility", "implausibility_sd"}};
  TALUS_FIELDS(name, from, to, replicates, num_failed, num_followed, moves_still, why_not,
               why_not_followed, outputs, answer, implausibility);
  // Whether no output shifts by more than chance makes once in a thousand times (IsByChance in
  // shift.h). Where the region is wide, the answer may then jump within it, and the move is not to
  // blame.
  bool IsByChance() const;
  bool Exceeds(const AnswerShift& shift) const;  // … of this move, and the move's own doing
  bool Exceeds() const;                          // any parameter
  // Whether more simulations would not change what Exceeds says.
  bool IsTold(const AnswerShift& shift) const;
  bool IsTold() const;
  double MostHalfRanges() const;
  bool FitsNoSet() const;  // as `implausible` alarms count it
};

struct SensitivityParameter {
  std::string name{};
  std::string unit{};
  double value = 0;  // recommended
  double low = 0;    // stated range
  double high = 0;

  static constexpr base::FieldKey kKeys[] = {{"low", "credible_90_low"},
                                             {"high", "credible_90_high"}};
  TALUS_FIELDS(name, unit, value, low, high);
};

struct SensitivityTable {
  double scale_factor = 1;      // of its simulations
  std::int64_t last_trial = 0;  // the latest of the campaign that had ended, by id; 0: none
  int num_simulations = 0;
  double core_time = 0;  // of these [s]; 0 where the engine does not tell
  std::vector<SensitivityParameter> parameters{};
  double implausibility = 0;  // of the answer as it stands, the largest of the experiments' [sd]
  std::vector<FixedMove> moves{};  // the largest shift of the answer first

  static constexpr base::FieldKey kKeys[] = {{"last_trial", "after_trial"},
                                             {"core_time", "core_time_s"},
                                             {"implausibility", "implausibility_sd"}};
  TALUS_FIELDS(scale_factor, last_trial, num_simulations, core_time, parameters, implausibility,
               moves);
  bool FitsNoSet() const;  // as it stands
};

}  // namespace talus::analysis
