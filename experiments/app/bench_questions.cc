#include "experiments/app/bench_questions.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/problems.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "base/units.h"
#include "experiments/rigs/case/plausible_quantity.h"

namespace talus::app {
namespace {

using campaign::SpecAnswers;
using rigs::BenchQuantity;

enum class Asked {
  kAlways,
  kOfHeap,    // with photographs only
  kMayBeOpen  // without an answer the spec searches it
};

struct Question {
  const char* flag;
  const char* key;      // in the spec
  const char* words;    // of the question and the help
  const char* example;  // with its unit
  base::Dimension dimension;
  std::string SpecAnswers::*answer;
  Asked asked = Asked::kAlways;
  std::optional<BenchQuantity> quantity{};  // that it must be plausible as
};
using enum base::Dimension;
constexpr Question kQuestions[] = {
    {"--plate-diameter", "device.plate_diameter", "diameter of the plate", "10 mm", kLength,
     &SpecAnswers::plate_diameter, Asked::kOfHeap, BenchQuantity::kPlateDiameter},
    {"--tube-diameter", "device.tube_inner_diameter", "inner diameter of the tube", "10 mm",
     kLength, &SpecAnswers::tube_diameter, Asked::kOfHeap, BenchQuantity::kTubeDiameter},
    {"--lift-velocity", "device.lift_velocity", "speed at which the tube is lifted", "10 mm/s",
     kVelocity, &SpecAnswers::lift_velocity, Asked::kOfHeap, BenchQuantity::kLiftVelocity},
    {"--mass", "powder.mass", "mass filled in", "1.5 g", kMass, &SpecAnswers::mass, Asked::kAlways,
     BenchQuantity::kMass},
    {"--density", "powder.material.density", "density of the grains", "4400 kg/m^3", kDensity,
     &SpecAnswers::density, Asked::kAlways, BenchQuantity::kGrainDensity},
    {"--grain-diameter", "powder.sizes.diameter", "median diameter of the grains", "80 um", kLength,
     &SpecAnswers::grain_diameter, Asked::kAlways, BenchQuantity::kGrainDiameter},
    {"--restitution", "powder.material.restitution", "coefficient of restitution of the grains",
     "0.8", kNone, &SpecAnswers::restitution, Asked::kMayBeOpen},
    {"--rolling-damping", "powder.material.rolling_damping", "rolling damping of the EPSD law",
     "0.3", kNone, &SpecAnswers::rolling_damping, Asked::kMayBeOpen},
};

bool IsAsked(const Question& question, const SpecAnswers& answers) {
  return question.asked != Asked::kOfHeap || answers.HasPhotographs();
}

// Throws ConfigError that says what is wrong with it.
void Check(const Question& question, const std::string& answer) {
  const double value = base::ParseQuantity(answer, question.dimension);
  campaign::RequireUnit(answer, question.dimension, question.example);
  const std::string is = "\"" + answer + "\" is " + base::ShortNumber(value, 6) + ", ";
  if (!(value > 0)) throw base::ConfigError(is + "must be positive");
  if (question.flag == std::string_view("--restitution") && value > 1) {
    throw base::ConfigError(is + "must be in (0, 1]");
  }
  if (!question.quantity) return;
  const std::string text = rigs::ImplausibleText(*question.quantity, value);
  if (!text.empty()) throw base::ConfigError(is + text);
}

// A flag's answer has its unit, too: of 10 kg for 10 g a length would be said to be wrong, as the
// grains are made so large. What is no number is said with the rest.
void CheckUnit(const Question& question, const std::string& answer, base::Problems& problems) {
  if (question.dimension == kNone || !base::IsBareNumber(answer)) return;
  problems.Add(question.flag, campaign::NoUnitText(answer, question.example));
}

// Until `check` lets the answer pass; `kept` where Enter is typed and may be.
template <class Checker>
std::string AskUntil(const std::string& words, const std::string& kept, bool may_be_empty,
                     Checker&& check) {
  while (std::cin) {
    const std::string answer = AskLine(words);
    if (answer.empty() && (!kept.empty() || may_be_empty)) return kept;
    if (answer.empty()) continue;
    try {
      check(answer);
      return answer;
    } catch (const base::ConfigError& error) {
      std::cerr << error.what() << '\n';
    }
  }
  return kept;
}

std::string Ask(const Question& question, const std::string& kept) {
  std::string words = std::string(question.words) + " (such as " + question.example;
  if (!kept.empty()) {
    words += "; Enter: " + kept;
  } else if (question.asked == Asked::kMayBeOpen) {
    words += "; Enter when nobody has measured it";
  }
  return AskUntil(words + ")", kept, question.asked == Asked::kMayBeOpen,
                  [&](const std::string& answer) { Check(question, answer); });
}

std::string WordsOf(const campaign::TestQuestion& question) {
  const std::string words = "  " + question.key + ", " + question.words;
  switch (question.part) {
    case campaign::TestPart::kName:
    case campaign::TestPart::kMass:
      return words + " (Enter: the same)";
    case campaign::TestPart::kOption:
      return words + " (Enter: " + question.usual + ")";
    case campaign::TestPart::kNumber:
      break;
  }
  return words + " (\"value ± error\"" +
         (question.usual_error.empty() ? "" : "; without an error ± " + question.usual_error) +
         "; Enter: not measured)";
}

std::string AskOf(const campaign::TestQuestion& question) {
  return AskUntil(WordsOf(question), "", true, [&](const std::string& answer) {
    campaign::CheckAnswer(question, answer);
    const bool is_number = question.part == campaign::TestPart::kNumber;
    campaign::RequireUnit(is_number ? campaign::SplitNumber(question, answer).value : answer,
                          question.dimension, campaign::ExampleOf(question));
  });
}

// The tests that were made of the powder, one after the other, until there are no more.
void AskTests(SpecAnswers& answers) {
  const std::string of_heap = "a further test of the same powder, if one was made (";
  while (std::cin) {
    const bool is_first = !answers.HasPhotographs() && answers.tests.empty();
    const std::string name = AskLine((is_first ? "a test that was made (" : of_heap) +
                                     campaign::TestNames() + "; Enter: none)");
    if (name.empty()) return;
    try {
      campaign::DraftTest test = campaign::ParseDraftTest(name);
      for (const campaign::TestQuestion& question : campaign::QuestionsOf(test.kind, answers)) {
        if (!question.is_asked || !test.Answer(question.key).empty()) continue;
        test.answers.emplace_back(question.key, AskOf(question));
      }
      campaign::RequireNumber(test);
      answers.tests.push_back(std::move(test));
    } catch (const base::ConfigError& error) {
      std::cerr << error.what() << '\n';
    }
  }
}

// "--test drum: angle.value: …" of "experiments[1].angle.value: …", after a photographed heap.
std::string WithTest(const std::string& line, const SpecAnswers& answers) {
  const std::size_t num_heaps = answers.HasPhotographs() ? 1 : 0;
  for (std::size_t i = 0; i < answers.tests.size(); ++i) {
    const std::string place = "experiments[" + std::to_string(i + num_heaps) + "].";
    if (!line.starts_with(place)) continue;
    std::string_view key = std::string_view(line).substr(place.size());
    for (const std::string_view section : {"rig.", "device."}) {
      if (key.starts_with(section)) key.remove_prefix(section.size());
    }
    return "--test " + std::string(base::NameOf(answers.tests[i].kind)) + ": " + std::string(key);
  }
  return line;
}

}  // namespace

void AddQuestionFlags(CLI::App& verb, SpecAnswers& answers) {
  for (const Question& question : kQuestions) {
    verb.add_option(
        question.flag, answers.*question.answer,
        std::string(question.words) +
            (question.asked == Asked::kMayBeOpen
                 ? "; without it the spec searches it, as a nuisance"
                 : " with its unit, such as \"" + std::string(question.example) + "\""));
  }
}

bool AsksOnTerminal() { return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1; }

std::string AskLine(const std::string& words) {
  std::string answer;
  std::cerr << words << ": " << std::flush;
  std::getline(std::cin, answer);
  return answer;
}

void Complete(SpecAnswers& answers) {
  const bool asks = AsksOnTerminal();
  base::Problems problems;
  for (const Question& question : kQuestions) {
    if (!IsAsked(question, answers)) continue;
    std::string& answer = answers.*question.answer;
    if (asks && answer.empty()) answer = Ask(question, "");
    CheckUnit(question, answer, problems);
    if (answer.empty() && question.asked != Asked::kMayBeOpen) {
      problems.Add(question.flag, std::string("is missing; give the ") + question.words + ": \"" +
                                      question.example + "\"");
    }
  }
  if (asks && problems.empty() && answers.tests.empty()) AskTests(answers);
  campaign::RequireRead(answers, problems);
  problems.ThrowIfAny();
}

bool AskAgain(SpecAnswers& answers) {
  for (const Question& question : kQuestions) {
    if (!IsAsked(question, answers)) continue;
    answers.*question.answer = Ask(question, answers.*question.answer);
  }
  while (!answers.tests.empty()) {
    const std::string answer = AskLine("the further tests (Enter: as they are; no: ask again)");
    if (answer.empty()) break;
    if (answer != "no" && answer != "n") continue;
    answers.tests.clear();
    AskTests(answers);
    break;
  }
  return static_cast<bool>(std::cin);
}

std::string ProblemsByFlag(const std::string& problems, const SpecAnswers& answers,
                           const std::string& out) {
  std::istringstream lines(problems);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(out + ":")) line.erase(0, line.find(' ', out.size()) + 1);
    for (const Question& question : kQuestions) {
      const std::string key = std::string(question.key) + ":";
      if (line.starts_with(key)) line.replace(0, key.size(), std::string(question.flag) + ":");
    }
    text += (text.empty() ? "" : "\n") + WithTest(line, answers);
  }
  return text;
}

std::string AnswerFlags(const SpecAnswers& answers) {
  std::string flags;
  for (const Question& question : kQuestions) {
    const std::string& answer = answers.*question.answer;
    if (!answer.empty()) flags += std::string(" ") + question.flag + "=" + base::ShellWord(answer);
  }
  if (answers.cohesive) flags += " --cohesive";
  for (const campaign::DraftTest& test : answers.tests) {
    flags += " --test " + base::ShellWord(campaign::FlagText(test));
  }
  return flags;
}

}  // namespace talus::app
