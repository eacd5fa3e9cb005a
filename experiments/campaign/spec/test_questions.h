// What is to be known of a bulk test before it can stand in a spec: of any rig, in the words that
// the bench knows it by.
#pragma once

#include <string>
#include <vector>

#include "base/units.h"
#include "experiments/rigs/options/rig_options.h"

namespace talus::campaign {

enum class TestPart {
  kName,    // in tables and messages
  kMass,    // filled in, where it is another one than the campaign's
  kOption,  // a size, speed or other choice of its rig
  kNumber   // what it has measured
};

struct TestQuestion {
  std::string key;    // "diameter", "taps.count", "tapped_density"
  std::string words;  // what it is
  TestPart part = TestPart::kOption;
  base::Dimension dimension = base::Dimension::kNone;
  std::string usual{};        // of the rig's own, with its unit; empty: left out of the spec
  std::string usual_error{};  // of a number, as the bench states it: "0.5 %", "1 deg"
  bool is_asked = false;      // on a terminal, where few questions are answered best
  bool is_list = false;       // several answers are a list
  std::string spec_key{};     // in the spec, where it is another than `key`
  std::string method{};       // of a number, in three words; empty where its name says it

  const std::string& KeyInSpec() const { return spec_key.empty() ? key : spec_key; }
};

// All of a rig's: name, filling and what it is made with, then what it measures. Where an option
// and a number have one name, as the height of a funnel and of its heap, they are rig_height and
// measured_height.
std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind);

// An answer with its unit, such as the bench has it.
std::string ExampleOf(const TestQuestion& question);

// What is said of an answer without a unit.
std::string NoUnitText(const std::string& answer, const std::string& example);

// What people type has its unit: a bare 10 for a plate is seldom ten metres. Throws ConfigError.
void RequireUnit(const std::string& answer, base::Dimension dimension, const std::string& example);

// A number and its standard error: as given after ±, or the usual one. A unit that only one of the
// two has is that of both: "0.64±0.01 g/mL", "55±2 %". Throws ConfigError where
// there is neither, where one of them is no number with a unit that fits, or for a share's error
// that tells nothing of it.
struct MeasuredText {
  std::string value;
  std::string error;
};
MeasuredText SplitNumber(const TestQuestion& question, const std::string& text);

// The answer without its error.
std::string MeanOf(const std::string& text);

// Whether an answer states its own error.
bool HasError(const std::string& text);

// Throws ConfigError that says what is wrong with an answer and what to write; an empty one is
// none.
void CheckAnswer(const TestQuestion& question, const std::string& answer);

}  // namespace talus::campaign
