// The flags of plate and tube: of the photographed heap, or else of a lifted tube among the tests.
#include <algorithm>

#include "base/problems.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/spec/spec_draft.h"

namespace talus::campaign {
namespace {

// A flag of plate and tube, and the lifted tube's option that it is.
struct DeviceFlag {
  const char* flag;
  const char* option;
  std::string SpecAnswers::*answer;
};
constexpr DeviceFlag kDeviceFlags[] = {
    {"--plate-diameter", "plate_diameter", &SpecAnswers::plate_diameter},
    {"--tube-diameter", "tube_inner_diameter", &SpecAnswers::tube_diameter},
    {"--lift-velocity", "lift_velocity", &SpecAnswers::lift_velocity}};

// "; the plate of funnel_heap is --test funnel_heap:plate_diameter=20mm", of the first test that
// has an option of this name itself.
std::string OwnOption(const DeviceFlag& flag, const SpecAnswers& answers) {
  for (const DraftTest& test : answers.tests) {
    const std::vector<TestQuestion> questions = QuestionsOf(test.kind);
    if (std::ranges::find(questions, flag.option, &TestQuestion::key) == questions.end()) continue;
    const std::string kind(base::NameOf(test.kind));
    return "; that of " + kind + " is given by --test " + kind + ":" + flag.option + "=" +
           base::ShellWord(answers.*flag.answer);
  }
  return "";
}

}  // namespace

std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind, const SpecAnswers& answers) {
  std::vector<TestQuestion> questions = QuestionsOf(kind);
  if (kind != rigs::RigKind::kLiftedTube) return questions;
  for (const DeviceFlag& flag : kDeviceFlags) {
    if ((answers.*flag.answer).empty()) continue;
    std::ranges::find(questions, flag.option, &TestQuestion::key)->usual = answers.*flag.answer;
  }
  return questions;
}

void RequireRead(const SpecAnswers& answers, base::Problems& problems) {
  if (answers.HasPhotographs()) return;
  problems.Require(answers.scale.empty(), "--scale",
                   "is of photographs, and there are none; leave it out, or give PHOTOS");
  problems.Require(answers.pattern.empty(), "--pattern",
                   "is of photographs' names, and there are none; leave it out, or give PHOTOS");
  const bool has_tube = std::ranges::find(answers.tests, rigs::RigKind::kLiftedTube,
                                          &DraftTest::kind) != answers.tests.end();
  for (const DeviceFlag& flag : kDeviceFlags) {
    problems.Require(has_tube || (answers.*flag.answer).empty(), flag.flag,
                     "is of a lifted tube, which nothing here is: there are neither photographs of "
                     "a heap nor --test lifted_tube; leave it out" +
                         OwnOption(flag, answers));
  }
}

}  // namespace talus::campaign
