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
  std::string key;    // in the spec: "diameter", "taps.count", "tapped_density"
  std::string words;  // what it is
  TestPart part = TestPart::kOption;
  base::Dimension dimension = base::Dimension::kNone;
  std::string usual{};        // of the rig's own, with its unit; empty: left out of the spec
  std::string usual_error{};  // of a number, as the bench states it: "0.5 %", "1 deg"
  bool is_asked = false;      // on a terminal, where few questions are answered best
  bool is_list = false;       // several answers are a list
};

// All of a rig's: name, filling and what it is made with, then what it measures.
std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind);

// A number and its standard error: as given after ±, or the usual one. Throws ConfigError where
// there is neither, or where one of them is no number with a unit that fits.
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
