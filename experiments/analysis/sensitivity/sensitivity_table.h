// What the answer owes to what was held fixed: the content of DIR/sensitivity.json.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/field.h"

namespace talus::analysis {

// How far a move shifts what an experiment shows.
struct OutputShift {
  std::string experiment{};
  std::string output{};  // "image", or the number's name
  double shift = 0;      // [sd of one simulation at the target scale factor]; of an image the root
                         // mean square over its modes, of a number with its sign
  double noise = 0;      // sd that chance gives the shift; of an image its root mean square

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("experiment", self.experiment);
    visit("output", self.output);
    visit("shift_in_noise_sd", self.shift);
    visit("by_chance", self.noise);
  }
};

// What the answer would be with the moved value, SI.
struct AnswerShift {
  std::string parameter{};
  double from = 0;
  double to = 0;
  double standard_error = 0;  // of `to`
  double half_ranges = 0;     // the shift over half of the stated range [-], on the searched scale
  double half_ranges_error = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("parameter", self.parameter);
    visit("from", self.from);
    visit("to", self.to);
    visit("standard_error", self.standard_error);
    visit("shift_in_half_ranges", self.half_ranges);
    visit("shift_error_in_half_ranges", self.half_ranges_error);
  }
  // Beyond half of the range, and not by chance.
  bool Exceeds() const;
  // Whether more simulations would not change what Exceeds says.
  bool IsTold() const;
};

struct FixedMove {
  std::string name{};
  std::string from{};
  std::string to{};
  int replicates = 0;     // simulations of each experiment
  int num_failed = 0;     // of these
  std::string why_not{};  // why nothing is known; else empty
  std::vector<OutputShift> outputs{};
  std::vector<AnswerShift> answer{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("from", self.from);
    visit("to", self.to);
    visit("replicates", self.replicates);
    visit("num_failed", self.num_failed);
    visit("why_not", self.why_not);
    visit("outputs", self.outputs);
    visit("answer", self.answer);
  }
  bool Exceeds() const;  // any parameter
  bool IsTold() const;   // all parameters
  double MostHalfRanges() const;
};

struct SensitivityParameter {
  std::string name{};
  std::string unit{};
  double value = 0;  // recommended
  double low = 0;    // stated range
  double high = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("unit", self.unit);
    visit("value", self.value);
    visit("credible_90_low", self.low);
    visit("credible_90_high", self.high);
  }
};

struct SensitivityTable {
  double scale_factor = 1;      // of its simulations
  std::int64_t last_trial = 0;  // the latest of the campaign that had ended, by id; 0: none
  int num_simulations = 0;
  double core_time = 0;  // of these [s]; 0 where the engine does not tell
  std::vector<SensitivityParameter> parameters{};
  std::vector<FixedMove> moves{};  // the largest shift of the answer first

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor);
    visit("after_trial", self.last_trial);
    visit("num_simulations", self.num_simulations);
    visit("core_time_s", self.core_time);
    visit("parameters", self.parameters);
    visit("moves", self.moves);
  }
};

}  // namespace talus::analysis
