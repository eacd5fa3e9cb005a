#include "experiments/campaign/spec/draft_test.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/rigs/case/device_text.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

// What has a dimension among a rig's options: sizes, speeds, angles.
struct OptionCollector {
  std::vector<TestQuestion> questions{};

  void operator()(std::string_view key, double value, const base::FieldInfo& info = {}) {
    if (info.dimension == base::Dimension::kNone) return;
    questions.push_back({.key = std::string(key),
                         .words = info.doc,
                         .dimension = info.dimension,
                         .usual = rigs::QuantityText(value, info.dimension)});
  }
  template <class Other>
  void operator()(std::string_view, const Other&, const base::FieldInfo& = {}) {}
};

rigs::Case CaseOfKind(rigs::RigKind kind) {
  rigs::Case rig_case;
  rig_case.rig.kind = kind;
  return rig_case;
}

std::string UsualError(const rigs::ObservableInfo& info) {
  if (info.usual_error.relative > 0)
    return base::ShortNumber(100 * info.usual_error.relative) + " %";
  if (info.usual_error.absolute > 0) {
    const std::string unit = info.dimension == base::Dimension::kAngle ? " deg" : "";
    return base::ShortNumber(info.usual_error.absolute) + unit;
  }
  return "";
}

// The lifted tube's own keys stand under `device`.
void CollectOptions(const rigs::Case& rig_case, OptionCollector& collector) {
  if (rig_case.rig.kind == rigs::RigKind::kLiftedTube) {
    rigs::LiftedTubeOptions::Visit(rig_case.rig.lifted_tube, collector);
    std::erase_if(collector.questions,
                  [](const TestQuestion& question) { return question.key == "plate_height"; });
  } else {
    rigs::RigOptions::Visit(rig_case.rig, collector);
  }
}

// A heap without photographs has its angle by hand.
bool IsAsked(rigs::RigKind kind, const rigs::RigObservable& measured) {
  return measured.usual || (kind == rigs::RigKind::kLiftedTube &&
                            measured.observable == rigs::Observable::kReposeTriangle);
}

std::string Listed(const std::vector<TestQuestion>& questions) {
  return base::Joined(questions, ", ", &TestQuestion::key);
}

// The standard error of a value: as given after ±, or the usual one of it.
struct MeasuredText {
  std::string value;
  std::string error;
};

MeasuredText SplitNumber(const TestQuestion& question, const std::string& text) {
  for (const std::string_view sign : {"±", "+-"}) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos) continue;
    return {text.substr(0, at), text.substr(at + sign.size())};
  }
  if (question.usual_error.empty()) {
    throw base::ConfigError(question.key + ": give its standard error, too: \"" + text + " ± …\"");
  }
  if (!question.usual_error.ends_with('%')) return {text, question.usual_error};
  // A share of the value, in the value's own unit.
  const std::size_t number_end = text.find_first_not_of("0123456789.eE+-");
  const double value = base::ParseQuantity(text.substr(0, number_end), base::Dimension::kNone);
  const double share = base::ParseQuantity(question.usual_error, base::Dimension::kNone);
  return {text, base::ShortNumber(share * value) +
                    (number_end == std::string::npos ? "" : text.substr(number_end))};
}

std::string InQuotes(const std::string& text) { return base::JsonText(nlohmann::json(text)); }

// Lines after a test's keys; each comma stands before its line's comment.
std::string NumberLines(const std::vector<std::string>& numbers) {
  std::string lines = ",";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    lines += "\n      " + numbers[i] + (i + 1 < numbers.size() ? "," : "") +
             " // standard error of the mean";
  }
  return lines;
}

std::string Spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace

std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind) {
  const rigs::Case rig_case = CaseOfKind(kind);
  OptionCollector collector{.questions = {{.key = "mass",
                                           .words = "filled in, where it is another one",
                                           .part = TestPart::kMass,
                                           .dimension = base::Dimension::kMass}}};
  CollectOptions(rig_case, collector);
  for (const rigs::RigObservable& measured : rigs::EntryOf(rig_case).observables) {
    if (!IsAsked(kind, measured)) continue;
    const rigs::ObservableInfo& info = rigs::InfoOf(measured.observable);
    collector.questions.push_back({.key = info.key,
                                   .words = std::string(info.title) + ", " + info.doc,
                                   .part = TestPart::kNumber,
                                   .dimension = info.dimension,
                                   .usual_error = UsualError(info)});
  }
  return collector.questions;
}

std::string TestNames() { return base::Joined(base::NamesOf<rigs::RigKind>(), ", "); }

DraftTest ParseDraftTest(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
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
    const std::string part = text.substr(at + 1, next == std::string::npos ? next : next - at - 1);
    const std::size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    if (equals == std::string::npos ||
        std::ranges::find(questions, key, &TestQuestion::key) == questions.end()) {
      throw base::ConfigError("--test: \"" + part + "\" is no KEY=VALUE of " + name +
                              "; its keys are " + Listed(questions));
    }
    test.answers.emplace_back(key, part.substr(equals + 1));
    at = next;
  }
  return test;
}

void CheckAnswer(const TestQuestion& question, const std::string& answer) {
  if (answer.empty()) return;
  if (question.part != TestPart::kNumber) {
    base::ParseQuantity(answer, question.dimension);
    return;
  }
  const MeasuredText measured = SplitNumber(question, answer);
  base::ParseQuantity(measured.value, question.dimension);
  base::ParseQuantity(measured.error, question.dimension);
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

std::string DraftTestText(const DraftTest& test) {
  const std::string kind(base::NameOf(test.kind));
  std::string options;
  std::string mass;
  std::vector<std::string> numbers;
  for (const TestQuestion& question : QuestionsOf(test.kind)) {
    const auto given =
        std::ranges::find(test.answers, question.key, &std::pair<std::string, std::string>::first);
    const bool is_given = given != test.answers.end() && !given->second.empty();
    if (question.part == TestPart::kOption) {
      options += ", " + InQuotes(question.key) + ": " +
                 InQuotes(is_given ? given->second : question.usual);
    } else if (is_given && question.part == TestPart::kMass) {
      mass = ",\n      \"mass\": " + InQuotes(given->second);
    } else if (is_given) {
      const MeasuredText measured = SplitNumber(question, given->second);
      numbers.push_back(InQuotes(question.key) + ": {\"value\": " + InQuotes(measured.value) +
                        ", \"sd\": " + InQuotes(measured.error) + "}");
    }
  }
  if (numbers.empty()) {
    std::vector<TestQuestion> asked = QuestionsOf(test.kind);
    std::erase_if(asked, [](const TestQuestion& q) { return q.part != TestPart::kNumber; });
    throw base::ConfigError("--test " + kind +
                            ": needs a number that it has measured: " + Listed(asked));
  }
  const bool is_tube = test.kind == rigs::RigKind::kLiftedTube;
  const std::string device =
      is_tube ? "},\n      \"device\": {\"plate\": \"disc\"" + options + "}" : options + "}";
  const bool pours =
      test.kind == rigs::RigKind::kTappedDensity || test.kind == rigs::RigKind::kFunnelHeap;
  return "    {\"name\": " + InQuotes(Spaced(kind)) +
         ", // docs/rigs.md has every key\n      \"rig\": {\"kind\": " + InQuotes(kind) + device +
         mass + (pours ? ",\n      \"filling\": {\"kind\": \"pour\"}" : "") + NumberLines(numbers) +
         "\n    }";
}

}  // namespace talus::campaign
