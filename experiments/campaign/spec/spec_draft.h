// A spec to start from: what a bench knows, the rest filled in and explained in comments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/problems.h"
#include "experiments/campaign/spec/draft_test.h"
#include "imaging/photos/experiment.h"

namespace talus::campaign {

// Quantities as the user wrote them, with their units. Without photographs the tests alone are what
// is calibrated on, and the keys of plate and tube are of a lifted tube among them.
struct SpecAnswers {
  std::string name;
  std::filesystem::path folder;         // of the photographs, or
  std::string pattern;                  // … of their names in it
  std::vector<imaging::PhotoRun> runs;  // or these, heap by heap
  std::string missing{};                // views that some heaps lack, in words
  std::string plate_diameter;
  std::string scale;  // of a heap on a table; empty with a plate
  std::string tube_diameter;
  std::string lift_velocity;
  std::string mass;
  std::string density;
  std::string grain_diameter;
  std::string restitution;         // empty: nobody has measured it
  std::string rolling_damping;     // … the same, of the EPSD law that the spec names
  bool cohesive = false;           // search the surface energy, too
  std::vector<DraftTest> tests{};  // made of the same powder beside the heap

  bool HasPhotographs() const { return !folder.empty() || !runs.empty(); }
};

// The questions of a test, a lifted tube's with the flags of plate and tube as usual answers.
std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind, const SpecAnswers& answers);

// Adds a problem for each flag that nothing of this spec would read.
void RequireRead(const SpecAnswers& answers, base::Problems& problems);

// The text of a spec that `talus validate` accepts: comments say what each part is for and what to
// change. Throws ConfigError with every answer that cannot be.
std::string DraftSpec(const SpecAnswers& answers);

}  // namespace talus::campaign
