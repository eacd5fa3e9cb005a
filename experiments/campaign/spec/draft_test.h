// A bulk test for the first spec, as a flag has it: KIND:KEY=VALUE,…
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/campaign/spec/test_questions.h"
#include "experiments/rigs/options/filling_rule.h"
#include "experiments/rigs/options/rig_options.h"

namespace talus::campaign {

struct DraftTest {
  rigs::RigKind kind = rigs::RigKind::kTappedDensity;
  // By key, with their units, in the order given; what is a list may stand there several times.
  std::vector<std::pair<std::string, std::string>> answers{};

  // The first answer; "" where there is none.
  std::string Answer(const std::string& key) const;
};

// "tapped_density:diameter=12mm,tapped_density=1480kg/m^3". Throws ConfigError that names the rigs,
// or the keys of this one.
DraftTest ParseDraftTest(const std::string& text);

// The same text again, as the program is given it.
std::string FlagText(const DraftTest& test);

// The rigs by name, with commas.
std::string TestNames();

// Throws ConfigError where no number is given.
void RequireNumber(const DraftTest& test);

// What the spec around a test says of it.
struct DraftSurroundings {
  std::string name;                     // of the experiment
  std::vector<TestQuestion> questions;  // of its rig, whose usual answers count where none is given
  bool pours = false;                   // the campaign's filling
};

// Its entry of a spec's `experiments`. Throws ConfigError where no number is given.
std::string DraftTestText(const DraftTest& test, const DraftSurroundings& around);

}  // namespace talus::campaign
