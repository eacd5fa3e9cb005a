#include "experiments/campaign/spec/test_questions.h"

#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/field.h"
#include "base/text/number_text.h"
#include "base/trimmed.h"
#include "experiments/rigs/case/device_text.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

// Walks the options of a rig; those of an object within are "taps.count".
struct OptionCollector {
  std::vector<TestQuestion>& questions;
  std::string prefix{};

  void operator()(std::string_view key, double value, const base::FieldInfo& info = {}) {
    TestQuestion& question = Add(key, info);
    question.is_asked = prefix.empty() && info.dimension != base::Dimension::kNone;
    if (question.is_asked || info.required) {
      question.usual = rigs::QuantityText(value, info.dimension);
    }
  }
  void operator()(std::string_view key, int value, const base::FieldInfo& info = {}) {
    TestQuestion& question = Add(key, info);
    if (info.required) question.usual = std::to_string(value);
  }
  void operator()(std::string_view key, bool, const base::FieldInfo& info = {}) { Add(key, info); }
  void operator()(std::string_view key, const std::vector<double>&,
                  const base::FieldInfo& info = {}) {
    Add(key, info).is_list = true;
  }
  template <base::NamedEnum T>
  void operator()(std::string_view key, T, const base::FieldInfo& info = {}) {
    if (key != "kind") Add(key, info);  // it stands before the colon
  }
  template <base::Visitable T>
  void operator()(std::string_view key, const T& part, const base::FieldInfo& = {}) {
    T::Visit(part, OptionCollector{questions, prefix + std::string(key) + "."});
  }
  // What may be left out is.
  template <class T>
  void operator()(std::string_view key, const std::optional<T>& value,
                  const base::FieldInfo& info = {}) {
    const std::size_t first = questions.size();
    (*this)(key, value.value_or(T{}), info);
    for (std::size_t i = first; i < questions.size(); ++i) {
      questions[i].usual.clear();
      questions[i].is_asked = false;
    }
  }

 private:
  TestQuestion& Add(std::string_view key, const base::FieldInfo& info) {
    return questions.emplace_back(TestQuestion{
        .key = prefix + std::string(key), .words = info.doc, .dimension = info.dimension});
  }
};

rigs::Case CaseOfKind(rigs::RigKind kind) {
  rigs::Case rig_case;
  rig_case.rig.kind = kind;
  return rig_case;
}

// The lifted tube's own keys stand under `device`. Its heap stands on a disc: no height is asked.
void CollectOptions(const rigs::Case& rig_case, std::vector<TestQuestion>& questions) {
  OptionCollector collector{questions};
  if (rig_case.rig.kind != rigs::RigKind::kLiftedTube) {
    return rigs::RigOptions::Visit(rig_case.rig, collector);
  }
  rigs::LiftedTubeOptions::Visit(rig_case.rig.lifted_tube, collector);
  for (TestQuestion& question : questions) {
    if (question.key == "plate") question.usual = base::NameOf(rigs::PlateKind::kDisc);
    if (question.key != "plate_height") continue;
    question.usual.clear();
    question.is_asked = false;
  }
}

// A rig without a camera, whose powder is at rest, has no question of one.
void DropCamera(rigs::RigKind kind, std::vector<TestQuestion>& questions) {
  if (rigs::IsFilmed(kind)) return;
  std::erase_if(questions, [](const TestQuestion& q) { return q.key.starts_with("camera."); });
}

std::string UsualError(const rigs::ObservableInfo& info) {
  if (info.usual_error.relative > 0)
    return base::ShortNumber(100 * info.usual_error.relative) + " %";
  if (info.usual_error.absolute > 0) {
    const bool is_angle = info.dimension == base::Dimension::kAngle;
    const std::string unit(is_angle ? "deg" : base::SiUnit(info.dimension));
    return base::WithUnit(info.usual_error.absolute, unit);
  }
  return "";
}

// A heap without photographs has its angle by hand.
bool IsAsked(rigs::RigKind kind, const rigs::RigObservable& measured) {
  return measured.usual || (kind == rigs::RigKind::kLiftedTube &&
                            measured.observable == rigs::Observable::kReposeTriangle);
}

// A spec has them at two places; a flag has one list of keys.
void TellApart(std::vector<TestQuestion>& options, TestQuestion& number) {
  const auto option = std::ranges::find(options, number.key, &TestQuestion::key);
  if (option == options.end()) return;
  option->spec_key = number.spec_key = number.key;
  option->key = "rig_" + number.key;
  number.key = "measured_" + number.key;
}

bool IsShare(const TestQuestion& question) {
  return question.part == TestPart::kNumber && question.dimension == base::Dimension::kNone &&
         rigs::BoundsOf(question.KeyInSpec()).high <= 1;  // without a unit key and metric are one
}

// "55±2%" is of percents throughout; 0.55±2% and a ratio of 1.25±2% need none at the value.
bool LacksPercent(const TestQuestion& question, const std::string& value) {
  return IsShare(question) && base::IsBareNumber(value) &&
         base::ParseQuantity(value, base::Dimension::kNone) > 1;
}

// "0.64±0.01 g/mL" and "0.64 g/mL±0.01": nobody means an error in another unit.
void ShareUnit(const TestQuestion& question, MeasuredText& measured) {
  const std::string of_value(base::UnitIn(measured.value));
  const std::string of_error(base::UnitIn(measured.error));
  if (of_error.empty() && !of_value.empty()) measured.error += " " + of_value;
  if (of_error.empty() || !of_value.empty()) return;
  const bool is_its_unit = question.dimension != base::Dimension::kNone;
  if (is_its_unit || LacksPercent(question, measured.value)) measured.value += " " + of_error;
}

// Beyond a half it tells nothing of a share; most often it is in percent.
void RequireErrorOfShare(const TestQuestion& question, const std::string& error) {
  constexpr double kMost = 0.5;
  if (!IsShare(question) || base::ParseQuantity(error, question.dimension) <= kMost) return;
  throw base::ConfigError(
      question.key + ": \"" + error + "\" as the error of a share must be at most 0.5" +
      (base::IsBareNumber(error) ? "; write \"" + error + " %\" for percent" : ""));
}

// The usual error, where it is no share of the value, beside a value that may be in percent.
std::string UsualErrorBeside(const TestQuestion& question, const std::string& value) {
  if (base::UnitIn(value) != "%") return question.usual_error;
  const double error = base::ParseQuantity(question.usual_error, question.dimension);
  return base::WithUnit(100 * error, "%");
}

constexpr std::string_view kErrorSigns[] = {"±", "+-"};

}  // namespace

std::vector<TestQuestion> QuestionsOf(rigs::RigKind kind) {
  const rigs::Case rig_case = CaseOfKind(kind);
  std::vector<TestQuestion> questions{
      {.key = "name", .words = "what tables and messages call it", .part = TestPart::kName},
      {.key = "mass",
       .words = "filled in, where it is another one",
       .part = TestPart::kMass,
       .dimension = base::Dimension::kMass,
       .is_asked = true}};
  CollectOptions(rig_case, questions);
  DropCamera(kind, questions);
  for (const rigs::RigObservable& measured : rigs::EntryOf(rig_case).observables) {
    const rigs::ObservableInfo& info = rigs::InfoOf(measured.observable);
    TestQuestion number{.key = info.key,
                        .words = std::string(info.title) + ", " + info.doc,
                        .part = TestPart::kNumber,
                        .dimension = info.dimension,
                        .usual_error = UsualError(info),
                        .is_asked = IsAsked(kind, measured),
                        .is_list = true,
                        .method = info.method};
    TellApart(questions, number);
    questions.push_back(std::move(number));
  }
  return questions;
}

// Not in the SI's units: nobody reads 28 rad.
std::string ExampleOf(const TestQuestion& question) {
  if (!question.usual.empty()) return question.usual;
  switch (question.dimension) {
    case base::Dimension::kAngle:
      return "28 deg";
    case base::Dimension::kMass:
      return "1.5 g";
    case base::Dimension::kLength:
      return "12 mm";
    case base::Dimension::kMassRate:
      return "3 g/s";
    case base::Dimension::kDensity:
      return "1480 kg/m^3";
    case base::Dimension::kPressure:
      return "1 kPa";
    case base::Dimension::kAngularVelocity:
      return "10 rpm";
    default:
      return "1 " + std::string(base::SiUnit(question.dimension));
  }
}

std::string NoUnitText(const std::string& answer, const std::string& example) {
  return "\"" + answer + "\" has no unit; write one, such as \"" + example + "\"";
}

void RequireUnit(const std::string& answer, base::Dimension dimension, const std::string& example) {
  if (dimension == base::Dimension::kNone || !base::UnitIn(answer).empty()) return;
  throw base::ConfigError(NoUnitText(answer, example));
}

std::string MeanOf(const std::string& text) {
  for (const std::string_view sign : kErrorSigns) {
    if (const std::size_t at = text.find(sign); at != std::string::npos) {
      return std::string(base::Trimmed(text.substr(0, at)));
    }
  }
  return text;
}

bool HasError(const std::string& text) { return MeanOf(text) != text; }

MeasuredText SplitNumber(const TestQuestion& question, const std::string& text) {
  for (const std::string_view sign : kErrorSigns) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos) continue;
    MeasuredText measured{std::string(base::Trimmed(text.substr(0, at))),
                          std::string(base::Trimmed(text.substr(at + sign.size())))};
    ShareUnit(question, measured);
    for (const std::string& part : {measured.value, measured.error}) {
      try {
        base::ParseQuantity(part, question.dimension);
      } catch (const base::ConfigError& error) {
        throw base::ConfigError(question.key + ": " + error.what());
      }
    }
    RequireErrorOfShare(question, measured.error);
    return measured;
  }
  base::ParseQuantity(text, question.dimension);
  if (question.usual_error.empty()) {
    throw base::ConfigError(question.key + ": give its standard error, too: \"" + text +
                            " ± …\", or every measurement: " + question.key + "=…," + question.key +
                            "=…");
  }
  if (!question.usual_error.ends_with('%')) return {text, UsualErrorBeside(question, text)};
  // A share of the value, in the value's own unit.
  const std::size_t number_end = text.find_first_not_of("0123456789.eE+-");
  const double value = base::ParseQuantity(text.substr(0, number_end), base::Dimension::kNone);
  const double share = base::ParseQuantity(question.usual_error, base::Dimension::kNone);
  return {text, base::ShortNumber(share * value) +
                    (number_end == std::string::npos ? "" : text.substr(number_end))};
}

void CheckAnswer(const TestQuestion& question, const std::string& answer) {
  if (answer.empty()) return;
  if (question.part == TestPart::kNumber) {
    SplitNumber(question, answer);
  } else {
    base::ParseQuantity(answer, question.dimension);
  }
}

}  // namespace talus::campaign
