#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "base/field.h"
#include "base/json/json_changes.h"
#include "base/json/json_reader.h"
#include "base/json/json_schema.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/printable.h"
#include "tests/error_in.h"

namespace talus::base {

enum class Color { kRed, kBlue };
template <>
struct Names<Color> {
  static constexpr std::array kList{std::pair{"red", Color::kRed}, std::pair{"blue", Color::kBlue}};
};

enum class Ending { kDone, kTimeCap, kLostGrains };
constexpr Ending LastOf(Ending) { return Ending::kLostGrains; }

namespace json_test {

using ::testing::HasSubstr;
using ::testing::Not;

struct Inner {
  double diameter = 1e-3;
  int count = 2;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("diameter", self.diameter, {.dimension = Dimension::kLength, .doc = "of a grain, > 0"});
    visit("count", self.count);
  }
  void Validate(Problems& problems) const {
    problems.Require(diameter > 0, "diameter", diameter, "must be positive");
  }
};

struct Outer {
  Inner inner;
  std::vector<Inner> list;
  std::optional<double> mass;
  Vec3 position;
  Color color = Color::kRed;
  std::string name;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("inner", self.inner);
    visit("list", self.list);
    visit("mass", self.mass, {.dimension = Dimension::kMass});
    visit("position", self.position, {.dimension = Dimension::kLength});
    visit("color", self.color);
    visit("name", self.name, {.required = true});
  }
};

struct Record {
  std::string name{};
  double elapsed = 0;  // [s]
  Ending ending = Ending::kDone;
  std::optional<double> mass{};

  static constexpr FieldKey kKeys[] = {{"elapsed", "elapsed_s"}, {"mass", "mass_kg"}};
  TALUS_FIELDS(name, elapsed, ending, mass);
};

struct Measured {
  double value = 0;
  double sd = 0;
  std::vector<double> values;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("value", self.value, {.dimension = Dimension::kDensity});
    visit("sd", self.sd, {.dimension = Dimension::kDensity, .unit_of = "value"});
    visit("values", self.values, {.dimension = Dimension::kDensity, .unit_of = "values"});
  }
};

// The default breaks the rule, so that a value must be given.
struct Powder {
  double mass = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("mass", self.mass, {.dimension = Dimension::kMass, .required = true});
  }
  void Validate(Problems& problems) const {
    problems.Require(mass > 0, "mass", mass, "must be positive");
  }
};

Outer Load(std::string_view text) { return LoadOptions<Outer>(ParseJson(text, "spec.json")); }

std::string ErrorOf(std::string_view text) {
  return ErrorIn([&] { Load(text); });
}

TEST(FieldList, NamesTheKeysInTheOrderOfTheListAndReadsThemBack) {
  const Record record{.name = "a", .elapsed = 2.5, .ending = Ending::kLostGrains, .mass = 3e-3};
  const std::string text = JsonText(ToJson(record));
  EXPECT_EQ(text, R"({"name":"a","elapsed_s":2.5,"ending":"lost_grains","mass_kg":0.003})");
  const auto again = LoadOptions<Record>(ParseJson(text, "record.json"));
  EXPECT_EQ(JsonText(ToJson(again)), text);
}

TEST(EnumeratorNames, AreInSnakeCaseFromTheFirstToTheLast) {
  std::vector<std::string> names;
  for (const auto& [name, ending] : Names<Ending>::kList) names.emplace_back(name);
  EXPECT_THAT(names, testing::ElementsAre("done", "time_cap", "lost_grains"));
  EXPECT_EQ(NameOf(Ending::kTimeCap), "time_cap");
}

// "1.602 g", "1602 mg" and 0.001602: a campaign refused one for the other.
TEST(JsonChanges, OneQuantityInTwoUnitsIsNoChange) {
  const nlohmann::ordered_json grams{{"mass", 1.602 * 1e-3}}, kilograms{{"mass", 0.001602}};
  ASSERT_NE(grams, kilograms);
  EXPECT_TRUE(JsonChanges(grams, kilograms).empty());
  EXPECT_EQ(JsonChanges({{"mass", 0.001602}}, {{"mass", 0.001602001}}).size(), 1u);
  EXPECT_EQ(JsonChanges({{"mass", 0.0}}, {{"mass", 1e-300}}).size(), 1u);
}

TEST(JsonChanges, ShortensNoTextWithinACharacter) {
  const std::string text = std::string(35, 'x') + "µµµµµ";
  const auto changes = JsonChanges({{"name", text}}, {{"name", "y"}});
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_TRUE(IsUtf8(changes[0].before)) << changes[0].before;
}

TEST(JsonChanges, NamesWhatDiffersByItsPath) {
  const auto before = nlohmann::ordered_json::parse(
      R"({"a": {"b": 1, "c": [1, 2]}, "d": [1], "e": 0.0016020000000000001, "gone": true})");
  const auto after = nlohmann::ordered_json::parse(
      R"({"a": {"b": 1, "c": [1, 3]}, "d": [1, 2], "e": 0.0017, "new": "x"})");
  std::string text;
  for (const JsonChange& change : JsonChanges(before, after)) {
    text += change.path + ": " + change.before + " → " + change.after + "\n";
  }
  EXPECT_EQ(text,
            "a.c[1]: 2 → 3\n"
            "d: [1] → [1,2]\n"
            "e: 0.001602 → 0.0017\n"
            "gone: true → null\n"
            "new: null → \"x\"\n");
  EXPECT_TRUE(JsonChanges(before, before).empty());
}

TEST(Json, ReadsEveryKindOfFieldWithUnitsAndComments) {
  const Outer outer = Load(R"({
    // a comment
    "$schema": "x", "inner": {"diameter": "45 um"}, "list": [{"count": 7}], "mass": "1.5 g",
    "position": [0, "1 mm", 2e-3], "color": "blue", "name": "n"})");
  EXPECT_DOUBLE_EQ(outer.inner.diameter, 45e-6);
  ASSERT_EQ(outer.list.size(), 1u);
  EXPECT_EQ(outer.list[0].count, 7);
  EXPECT_DOUBLE_EQ(outer.mass.value(), 1.5e-3);
  EXPECT_DOUBLE_EQ(outer.position.y, 1e-3);
  EXPECT_EQ(outer.color, Color::kBlue);
}

TEST(Json, AWholeNumberMayHaveAnExponent) {
  EXPECT_EQ(Load(R"({"name": "n", "inner": {"count": 2e1}})").inner.count, 20);
  EXPECT_EQ(Load(R"({"name": "n", "inner": {"count": -3.0}})").inner.count, -3);
  for (const char* count : {"2.5", "1e10", "1e300", "\"3\""}) {
    EXPECT_THAT(ErrorOf(std::string(R"({"name": "n", "inner": {"count": )") + count + "}}"),
                HasSubstr("must be a whole number from -2147483648 to 2147483647"));
  }
}

struct Seeded {
  std::uint64_t seed = 1;
  std::int64_t steps = 1;

  TALUS_FIELDS(seed, steps);
};

TEST(Json, ARangeOfSixtyFourBitsIsNotSpeltOut) {
  const std::string error =
      ErrorIn([] { LoadOptions<Seeded>(ParseJson(R"({"seed": -1, "steps": 1.5})", "spec.json")); });
  EXPECT_THAT(error, HasSubstr("seed: must be a whole number, 0 or more"));
  EXPECT_THAT(error, HasSubstr("steps: must be a whole number"));
  EXPECT_THAT(error, Not(HasSubstr("9223372036854775808")));
}

TEST(Json, ReportsEveryProblemWithItsPathLineAndColumn) {
  const std::string error = ErrorOf(R"({
  "inner": {"diametr": 1, "count": 1.5},
  "list": [{}, {"diameter": -1}],
  "mass": "3 m",
  "color": "green"
})");
  EXPECT_THAT(error, HasSubstr("spec.json:2:24: inner.diametr: is not known here; did you mean "
                               "\"diameter\"?"));
  EXPECT_THAT(error, HasSubstr("inner.count: must be a whole number"));
  EXPECT_THAT(error, HasSubstr("spec.json:3:29: list[1].diameter: is -1, must be positive"));
  EXPECT_THAT(error, HasSubstr("spec.json:4:11: mass: \"3 m\" has the unit \"m\""));
  EXPECT_THAT(error, HasSubstr("spec.json:5:12: color: must be one of \"red\", \"blue\""));
  EXPECT_THAT(error, HasSubstr("name: is missing"));
}

TEST(Json, ValueThatBreaksARuleIsQuotedAsItIsWritten) {
  const std::string error =
      ErrorOf(R"({"inner": {"diameter": "-5 cm"}, "list": [{"diameter": -1}]})");
  EXPECT_THAT(error, HasSubstr("inner.diameter: is -0.05 (\"-5 cm\"), must be positive"));
  EXPECT_THAT(error, HasSubstr("list[0].diameter: is -1, must be positive"));
}

TEST(Json, MisspeltEnumValueIsMetWithTheNearest) {
  EXPECT_THAT(ErrorOf(R"({"color": "bleu"})"),
              HasSubstr("must be one of \"red\", \"blue\"; did you mean \"blue\"?"));
  EXPECT_THAT(ErrorOf(R"({"color": "x"})"), Not(HasSubstr("did you mean")));
}

TEST(NearestName, BeginsWithWhatIsWrittenRatherThanResemblesIt) {
  const std::vector<std::string> scales{"log", "linear"};
  EXPECT_EQ(Nearest("lin", scales), "linear");
  EXPECT_EQ(Nearest("lgo", scales), "log");
  EXPECT_EQ(Nearest("xy", std::vector<std::string>{"ab"}), "");  // no letter is right
}

TEST(Json, ValueThatCannotBeReadIsReportedOnce) {
  for (const char* text : {"{}", R"({"mass": "3 m"})", R"({"mass": true})"}) {
    try {
      LoadOptions<Powder>(ParseJson(text, "spec.json"));
      ADD_FAILURE() << text;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n"))) << text;
    }
  }
}

// A bare number is in SI: 640 ± 0.01 kg/m³ is hardly what was meant.
TEST(Json, ABareNumberBesideOneWithAUnitIsRefused) {
  const auto error = [](const char* text) {
    return ErrorIn([&] { LoadOptions<Measured>(ParseJson(text, "spec.json")); });
  };
  EXPECT_THAT(error(R"({"value": "0.64 g/mL", "sd": 0.01})"),
              HasSubstr("sd: is 0.01 without a unit beside one in g/mL; a bare number is in SI: "
                        "write \"0.01 g/mL\""));
  EXPECT_THAT(error(R"({"value": "0.64 g/mL", "sd": "0.01"})"), HasSubstr("write \"0.01 g/mL\""));
  EXPECT_THAT(error(R"({"values": [0.64, "0.65 g/mL"]})"),
              HasSubstr("values[0]: is 0.64 without a unit"));
  for (const char* good :
       {R"({"value": "0.64 g/mL", "sd": "10 g/L"})", R"({"value": 640, "sd": 10})",
        R"({"value": 640, "sd": "10 g/L"})", R"({"value": "640", "sd": 10})",
        R"({"value": "0.64 g/mL", "sd": 0})", R"({"values": [640, 650]})", R"({"sd": 10})"}) {
    EXPECT_EQ(error(good), "") << good;
  }
}

struct MeasuredShare {
  double value = 0;
  double sd = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("value", self.value);
    visit("sd", self.sd, {.unit_of = "value"});
  }
};

// 95 % ± 2 was an error of 200 %, by which the number counted for nothing.
TEST(Json, ABareNumberBesideOneInPercentIsRefused) {
  const auto error = [](const char* text) {
    return ErrorIn([&] { LoadOptions<MeasuredShare>(ParseJson(text, "spec.json")); });
  };
  EXPECT_THAT(error(R"({"value": "95 %", "sd": 2})"),
              HasSubstr("sd: is 2 without a % beside a number that has one; write \"2 %\""));
  EXPECT_THAT(error(R"({"value": "95%", "sd": "0.02"})"), HasSubstr("\"2 %\" for the share 0.02"));
  for (const char* good : {R"({"value": "95 %", "sd": "2 %"})", R"({"value": 0.95, "sd": "2 %"})",
                           R"({"value": 0.95, "sd": 0.02})", R"({"value": "95 %", "sd": 0})"}) {
    EXPECT_EQ(error(good), "") << good;
  }
}

TEST(Json, SyntaxErrorsAndDoubleKeysNameTheirPlace) {
  EXPECT_THAT(ErrorOf("{\n \"name\": }"), HasSubstr("spec.json:2:10: is not JSON"));
  EXPECT_THAT(ErrorOf("{\"name\": \"a\",\n \"name\": \"b\"}"), HasSubstr("name: is given twice"));
  EXPECT_THAT(ErrorOf("[]"), HasSubstr("must be an object"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("is not JSON"));
}

// The parser's own words are of tokens and grammar; a user is told what to type.
TEST(Json, SyntaxErrorsAreToldInAUsersWords) {
  const std::pair<const char*, const char*> kCases[] = {
      {R"({"name": "n",})", "1:14: is not JSON: a comma stands before the closing bracket"},
      {"{\"list\": [1, 2", "it ends too early: a bracket or a quote is not closed"},
      {R"({"name" "n"})", "a colon is missing"},
      {R"({"name": "n" "mass": 1})", "a comma or } is missing"},
      {R"({"list": [1 2]})", "a comma or ] is missing"},
      {R"({name: 1})", "texts and keys stand in double quotes"},
      {R"({"mass": NaN})", "texts and keys stand in double quotes"},
      {R"({"mass": 1.})", "a number is not complete"},
      {R"({"mass": 1,602})", "1:14: is not JSON: a number has a point before its decimals"},
      {R"({"mass": .342})", "1:10: is not JSON: a number begins with a digit"},
      {R"({"mass": [+3]})", "1:11: is not JSON: a number begins with a digit"},
      {R"({"mass": 010})", "1:12: is not JSON: a number of several digits does not begin with 0"},
      {R"({"mass": 1e400})", "a number is too large"},
      {"{\"name\": \"a\nb\"}", "is its closing quote missing?"},
      {"{\"name\": \"\xff\"}", "is not UTF-8"},
      {R"({"name": "C:\dir"})", "a backslash in a text must be doubled"},
      {R"({"name": "n"} 1)", "is a bracket too many?"},
      {"{} /* open", "a comment is //"},
      {" \n", "it is empty"}};
  for (const auto& [text, expected] : kCases) {
    EXPECT_THAT(ErrorOf(text), HasSubstr(expected)) << text;
    EXPECT_THAT(ErrorOf(text), Not(HasSubstr("json.exception"))) << text;
    EXPECT_THAT(ErrorOf(text), Not(HasSubstr("while parsing"))) << text;
  }
}

TEST(Json, DeepNestingIsAnError) {
  EXPECT_NO_THROW(ParseJson(std::string(100, '[') + std::string(100, ']'), "deep.json"));
  EXPECT_THROW(ParseJson(std::string(101, '[') + std::string(101, ']'), "deep.json"), ConfigError);
  EXPECT_THAT(ErrorOf(std::string(1000000, '[')),
              HasSubstr("1:101: lists and objects lie in each"));
}

// Each place was found by counting the lines before it: a list took time by its length squared, and
// this one more than an hour.
TEST(Json, ManyBadValuesAreReadAndCounted) {
  std::string text = "{\"name\": \"n\", \"list\": [\n";
  for (int i = 0; i < 100000; ++i) text += "{\"diameter\": -1},\n";
  text += "{}]}";
  const std::string error = ErrorOf(text);
  EXPECT_THAT(error, HasSubstr("spec.json:2:14: list[0].diameter: is -1"));
  EXPECT_THAT(error, HasSubstr("spec.json:101:14: list[99].diameter: is -1"));
  EXPECT_THAT(error, HasSubstr("and 99900 more problems"));
}

TEST(Json, PlacesAreFoundInKeysWithDotsAndAfterComments) {
  const JsonFile file = ParseJson("{ /* 1\n2 */ \"a.b\": [0,\n 12], \"a\": {\"b\": true}}", "f");
  const std::vector<std::string> paths{"a.b[1]", "a.b.c", "", "x"};
  const auto places = file.places(paths);
  EXPECT_EQ(places[0].line, 3);
  EXPECT_EQ(places[0].column, 2);
  EXPECT_EQ(places[1].line, 3);  // of both that "a.b" may mean, the last
  EXPECT_EQ(places[2].column, 1);
  EXPECT_EQ(places[3].line, 1);  // no such key: the object that should hold it
}

TEST(Json, WriterIsReadBack) {
  Outer outer = Load(R"({"name": "n", "list": [{"diameter": 0.1}], "color": "blue"})");
  const Outer again = Load(ToJson(outer).dump());
  EXPECT_EQ(again.list.at(0).diameter, 0.1);  // exact: the writer gives all digits
  EXPECT_EQ(again.color, Color::kBlue);
  outer.name = "a\"\\\n\x01 ü";
  EXPECT_EQ(JsonTextWriter::TextOf(outer), ToJson(outer).dump(2) + "\n");
  EXPECT_EQ(JsonTextWriter::TextOf(Outer()), ToJson(Outer()).dump(2) + "\n");
  EXPECT_FALSE(again.mass.has_value());
}

TEST(Json, TextsOfOthersStayJsonThatNoTerminalObeys) {
  const nlohmann::json log{{"log", "a\x1b[2J\x7f\xc2\x9b \xe2\x80\xae µ"}};
  EXPECT_EQ(JsonText(log), "{\"log\":\"a\\u001b[2J\\u007f\\u009b \\u202e µ\"}");
  EXPECT_EQ(nlohmann::json::parse(JsonText(log)), log);
  EXPECT_EQ(JsonText(nlohmann::json{"l\xe4"}), "[\"l\xef\xbf\xbd\"]");  // U+FFFD
  EXPECT_EQ(JsonText(nlohmann::ordered_json{{"b", 1}, {"a", 2}}, 1), "{\n \"b\": 1,\n \"a\": 2\n}");
}

TEST(Json, SchemaHasTypesDefaultsUnitsAndRequiredKeys) {
  const auto schema = FileSchema<Outer>("outer");
  EXPECT_EQ(schema["required"], nlohmann::ordered_json::array({"name"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  const auto& diameter = schema["properties"]["inner"]["properties"]["diameter"];
  EXPECT_EQ(diameter["default"], 1e-3);
  EXPECT_EQ(diameter["description"], "of a grain, > 0 [m]");
  EXPECT_EQ(schema["properties"]["list"]["items"]["type"], "object");
}

}  // namespace json_test
}  // namespace talus::base
