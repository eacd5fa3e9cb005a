// A further bulk test for the first spec: any rig, in the words that the bench knows it by.
#pragma once

#include <string>
#include <vector>

#include "base/units.h"
#include "experiments/rigs/options/rig_options.h"

namespace talus::campaign {

enum class TestPart {
  kMass,    // filled in, where it is another one than the campaign's
  kOption,  // a size or speed of its rig
  kNumber   // what it has measured
};

// What is to be known of a test.
struct TestQuestion {
  std::string key;    // in the spec: "diameter", "tapped_density"
  std::string words;  // what it is
  TestPart part = TestPart::kOption;
  base::Dimension dimension = base::Dimension::kNone;
  std::string usual{};        // of the rig's own, with its unit
  std::string usual_error{};  // of a number, as the bench states it: "0.5 %", "1 deg"
};

// All of a rig's: its filling and what it is made with, then what it usually measures.
std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind);

// Throws ConfigError that says what is wrong with an answer and what to write; an empty one is
// none.
void CheckAnswer(const TestQuestion& question, const std::string& answer);

struct DraftTest {
  rigs::RigKind kind = rigs::RigKind::kTappedDensity;
  std::vector<std::pair<std::string, std::string>> answers{};  // by key; with their units
};

// "tapped_density:diameter=12mm,tapped_density=1480kg/m^3". Throws ConfigError that names the rigs,
// or the keys of this one.
DraftTest ParseDraftTest(const std::string& text);

// The same text again, as the program is given it.
std::string FlagText(const DraftTest& test);

// The rigs by name, with commas.
std::string TestNames();

// Its entry of a spec's `experiments`. Throws ConfigError where no number is given.
std::string DraftTestText(const DraftTest& test);

}  // namespace talus::campaign
