#include "experiments/campaign/spec/draft_test.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/nearest.h"
#include "base/text/joined.h"
#include "base/trimmed.h"

namespace talus::campaign {
namespace {

// "…, angle_of_repose_1 (height over foot), …"
std::string Listed(const std::vector<TestQuestion>& questions) {
  return base::Joined(questions, ", ", [](const TestQuestion& question) {
    return question.key + (question.method.empty() ? "" : " (" + question.method + ")");
  });
}

std::string FlagOf(const DraftTest& test) {
  return "--test " + std::string(base::NameOf(test.kind));
}

std::string InQuotes(const std::string& text) { return base::JsonText(nlohmann::json(text)); }

// Numbers, true and false as they are, all else as a text.
std::string JsonValue(const std::string& text) {
  const auto value = nlohmann::json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() ? text : InQuotes(text);
}

// Every answer to a question that says something.
std::vector<std::string> AnswersTo(const TestQuestion& question, const DraftTest& test) {
  std::vector<std::string> found;
  for (const auto& [key, answer] : test.answers) {
    if (key == question.key && !answer.empty()) found.push_back(answer);
  }
  return found;
}

// "taps" of "taps.count".
std::string GroupOf(const std::string& key) {
  const std::size_t dot = key.find('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

bool HasGroup(const DraftTest& test, const std::string& group) {
  return std::ranges::any_of(test.answers, [&](const auto& answer) {
    return GroupOf(answer.first) == group && !answer.second.empty();
  });
}

// The value of an option, "" where the rig's own holds without being named.
std::string OptionValue(const TestQuestion& question, const DraftTest& test) {
  const std::vector<std::string> given = AnswersTo(question, test);
  if (question.is_list && !given.empty()) return "[" + base::Joined(given, ", ", JsonValue) + "]";
  if (!given.empty()) return JsonValue(given.front());
  const std::string group = GroupOf(question.key);
  const bool is_open = group.empty() || HasGroup(test, group);
  return is_open && !question.usual.empty() ? JsonValue(question.usual) : "";
}

// The rig's options with commas, those of an object within it, such as its taps, in braces.
std::string OptionsText(const DraftTest& test, const std::vector<TestQuestion>& questions) {
  std::vector<std::string> options;
  std::string open;  // group
  for (const TestQuestion& question : questions) {
    if (question.part != TestPart::kOption) continue;
    const std::string value = OptionValue(question, test);
    if (value.empty()) continue;
    const std::string group = GroupOf(question.key);
    const std::string key =
        group.empty() ? question.KeyInSpec() : question.key.substr(group.size() + 1);
    const std::string entry = InQuotes(key) + ": " + value;
    if (group.empty()) {
      options.push_back(entry);
    } else if (group == open) {
      options.back().insert(options.back().size() - 1, ", " + entry);
    } else {
      options.push_back(InQuotes(group) + ": {" + entry + "}");
    }
    open = group;
  }
  return base::Joined(options, ", ");
}

// One value with its error, or every value that was measured.
std::string NumberText(const TestQuestion& question, const std::vector<std::string>& given) {
  if (given.size() == 1) {
    const MeasuredText measured = SplitNumber(question, given.front());
    return InQuotes(question.KeyInSpec()) + ": {\"value\": " + InQuotes(measured.value) +
           ", \"sd\": " + InQuotes(measured.error) + "}";
  }
  for (const std::string& one : given) {
    if (HasError(one)) {
      throw base::ConfigError(question.key + ": \"" + one +
                              "\" stands beside other values, whose scatter gives the error; leave "
                              "the error away, or give the mean alone with its own");
    }
    base::ParseQuantity(one, question.dimension);
  }
  return InQuotes(question.KeyInSpec()) + ": {\"values\": [" + base::Joined(given, ", ", InQuotes) +
         "]}";
}

// Lines after a test's keys; each comma stands before its line's comment.
std::string NumberLines(const DraftTest& test, const std::vector<TestQuestion>& questions) {
  std::vector<std::string> lines;
  std::vector<bool> are_several;
  for (const TestQuestion& question : questions) {
    if (question.part != TestPart::kNumber) continue;
    const std::vector<std::string> given = AnswersTo(question, test);
    if (given.empty()) continue;
    try {
      lines.push_back(NumberText(question, given));
    } catch (const base::ConfigError& error) {
      throw base::ConfigError(FlagOf(test) + ": " + error.what());
    }
    are_several.push_back(given.size() > 1);
  }
  std::string text = ",";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += "\n      " + lines[i] + (i + 1 < lines.size() ? "," : "") +
            (are_several[i] ? " // their mean and its standard error count"
                            : " // standard error of the mean");
  }
  return text;
}

// Only what a rig asks for where the campaign's filling does not serve it: a closed drum is not
// poured into.
std::string FillingText(rigs::RigKind kind, bool pours) {
  const bool must_pour =
      kind == rigs::RigKind::kTappedDensity || kind == rigs::RigKind::kFunnelHeap;
  if (must_pour) return ",\n      \"filling\": {\"kind\": \"pour\"}";
  if (kind == rigs::RigKind::kDrum && pours) {
    return ",\n      \"filling\": {\"kind\": \"dense\"}";
  }
  return "";
}

// What stands there in place of "diameter=12 mm". Throws ConfigError that says so.
[[noreturn]] void RefuseKey(const std::string& part, const std::string& key, const DraftTest& test,
                            const std::vector<TestQuestion>& questions) {
  std::vector<std::string> keys;
  std::string both;
  for (const TestQuestion& question : questions) {
    keys.push_back(question.key);
    if (question.spec_key != key) continue;
    both += (both.empty() ? "" : " or ") + question.key + "=… (" + question.words + ")";
  }
  if (!both.empty())
    throw base::ConfigError(FlagOf(test) + ": " + key + " is of two things: write " + both);
  throw base::ConfigError("--test: \"" + std::string(base::Trimmed(part)) +
                          "\" is no KEY=VALUE of " + std::string(base::NameOf(test.kind)) +
                          base::DidYouMean(key, keys) + "; its keys are " + Listed(questions));
}

// That a flag's answer is a quantity. Options have their unit, as on a terminal: 5 for a drum is
// seldom 5 rad/s. Numbers beyond what can be are found out once all is read.
void CheckQuantity(const TestQuestion& question, const std::string& answer) {
  const bool is_number = question.part == TestPart::kNumber;
  const bool has_quantity = is_number || question.dimension != base::Dimension::kNone;
  if (!has_quantity) return;
  const double value = base::ParseQuantity(MeanOf(answer), question.dimension);
  if (!is_number && value != 0) RequireUnit(answer, question.dimension, ExampleOf(question));
}

// "diameter=12 mm" of a test, its key being one of the rig's and given once.
std::pair<std::string, std::string> ParseAnswer(const std::string& part, const DraftTest& test,
                                                const std::vector<TestQuestion>& questions) {
  const std::size_t equals = part.find('=');
  const std::string key(base::Trimmed(part.substr(0, equals)));
  const auto question = std::ranges::find(questions, key, &TestQuestion::key);
  if (equals == std::string::npos && !key.empty() && key.front() >= '0' && key.front() <= '9') {
    throw base::ConfigError("--test: \"" + key +
                            "\" stands after a comma, which parts the answers; write a decimal "
                            "with a point, and a key before each number");
  }
  if (equals == std::string::npos || question == questions.end()) {
    RefuseKey(part, key, test, questions);
  }
  if (!question->is_list && !test.Answer(key).empty()) {
    throw base::ConfigError(FlagOf(test) + ": " + key +
                            " stands there twice; give it once, or --test once more for a further "
                            "test");
  }
  const std::string answer(base::Trimmed(part.substr(equals + 1)));
  try {
    CheckQuantity(*question, answer);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(FlagOf(test) + ": " + key + ": " + error.what());
  }
  return {key, answer};
}

}  // namespace

std::string DraftTest::Answer(const std::string& key) const {
  const auto found = std::ranges::find(answers, key, &std::pair<std::string, std::string>::first);
  return found == answers.end() ? "" : found->second;
}

std::string TestNames() { return base::Joined(base::NamesOf<rigs::RigKind>(), ", "); }

DraftTest ParseDraftTest(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name(base::Trimmed(text.substr(0, colon)));
  const auto kind = base::EnumNamed<rigs::RigKind>(name);
  if (!kind) {
    throw base::ConfigError("--test: \"" + name + "\" is no test that can be added; write one of " +
                            TestNames());
  }
  DraftTest test{.kind = *kind};
  const std::vector<TestQuestion> questions = QuestionsOf(*kind);
  std::size_t at = colon;
  while (at != std::string::npos) {
    const std::size_t next = text.find(',', at + 1);
    const std::size_t length = next == std::string::npos ? next : next - at - 1;
    test.answers.push_back(ParseAnswer(text.substr(at + 1, length), test, questions));
    at = next;
  }
  return test;
}

std::string FlagText(const DraftTest& test) {
  std::string text(base::NameOf(test.kind));
  char separator = ':';
  for (const auto& [key, answer] : test.answers) {
    if (answer.empty()) continue;
    text += separator + key + "=" + answer;
    separator = ',';
  }
  return text;
}

void RequireNumber(const DraftTest& test) {
  std::vector<TestQuestion> numbers = QuestionsOf(test.kind);
  std::erase_if(numbers, [](const TestQuestion& q) { return q.part != TestPart::kNumber; });
  const bool has_one = std::ranges::any_of(
      numbers, [&](const TestQuestion& number) { return !AnswersTo(number, test).empty(); });
  if (has_one) return;
  throw base::ConfigError(FlagOf(test) +
                          ": needs a number that it has measured: " + Listed(numbers));
}

std::string DraftTestText(const DraftTest& test, const DraftSurroundings& around) {
  RequireNumber(test);
  const bool is_tube = test.kind == rigs::RigKind::kLiftedTube;
  const std::string kind = InQuotes(std::string(base::NameOf(test.kind)));
  const std::string options = OptionsText(test, around.questions);
  const std::string mass = test.Answer("mass");
  return "    {\"name\": " + InQuotes(around.name) +
         ", // docs/rigs.md has every key\n      \"rig\": {\"kind\": " + kind +
         (is_tube ? "},\n      \"device\": {" : ", ") + options + "}" +
         (mass.empty() ? "" : ",\n      \"mass\": " + InQuotes(mass)) +
         FillingText(test.kind, around.pours) + NumberLines(test, around.questions) + "\n    }";
}

}  // namespace talus::campaign
