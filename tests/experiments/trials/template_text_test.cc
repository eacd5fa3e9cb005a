#include "experiments/trials/engines/template_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/text/number_text.h"
#include "tests/error_in.h"

namespace talus::trials {
namespace template_text_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const TemplateValues kValues{
    .scalars = {{"seed", "7"}, {"sliding_friction", "0.5"}},
    .tables = {{"grains", {.columns = {"x", "y"}, .rows = {{"1", "2"}, {"3", "4"}}}}}};

std::string Fill(std::string_view text) { return TextTemplate(text, "deck").Fill(kValues); }

std::string ErrorOf(std::string_view text) {
  return ErrorIn([&] {
    base::Problems problems("spec.json", {});
    TextTemplate(text, "deck").Check(kValues, problems);
    problems.ThrowIfAny();
  });
}

TEST(TextTemplate, ValuesReplaceTheirPlaceholders) {
  EXPECT_EQ(Fill("mu {{ sliding_friction }} ${v} {{seed}}\n"), "mu 0.5 ${v} 7\n");
  EXPECT_EQ(Fill("{{seed}}{{ seed }}"), "77");
  EXPECT_EQ(Fill("{ {seed} } { }}\n"), "{ {seed} } { }}\n");
  EXPECT_EQ(Fill(""), "");
}

// A Python deck's f"{{x}}" was refused, and nothing said how to write it.
TEST(TextTemplate, BracesOfTheFilesOwnAreQuoted) {
  EXPECT_EQ(Fill("f'{{ \"{{\" }}a}} {{ seed }}'\n"), "f'{{a}} 7'\n");
  EXPECT_EQ(Fill("{{# grains }}{{\"{{\"}}{{ x }}{{/ grains }}"), "{{1{{3");
  EXPECT_EQ(ErrorOf("{{ \"{{\" }}"), "");
  EXPECT_THAT(TextTemplate("{{ \"{{\" }}", "deck").Names(), ElementsAre());
  EXPECT_THAT(ErrorOf("{{ a.b }}"), HasSubstr("are written {{ \"{{\" }}"));
}

TEST(TextTemplate, SectionIsRepeatedForEachRow) {
  EXPECT_EQ(Fill("a\n{{# grains }}\n{{ x }} {{ y }} s{{ seed }}\n{{/ grains }}\nb\n"),
            "a\n1 2 s7\n3 4 s7\nb\n");
  EXPECT_EQ(Fill("[{{#grains}}({{x}}){{/grains}}]"), "[(1)(3)]");
}

// The second section's rows began with an empty line, which no reader of data expects.
TEST(TextTemplate, SectionsMayFollowOneAnother) {
  EXPECT_EQ(
      Fill("{{# grains }}\na {{ x }}\n{{/ grains }}\n{{# grains }}\nb {{ x }}\n{{/ grains }}\n"),
      "a 1\na 3\nb 1\nb 3\n");
}

TEST(TextTemplate, UsedNamesAreListed) {
  EXPECT_THAT(TextTemplate("{{ b }} {{# t }}{{ a }}{{/ t }} {{ b }}", "deck").Names(),
              ElementsAre("a", "b", "t"));
}

TEST(TextTemplate, ErrorsNameFileLineAndTheNearestName) {
  EXPECT_THAT(ErrorOf("a\n{{ sliding_frction }}"),
              HasSubstr("deck:2: the placeholder \"sliding_frction\" is not known; did you mean "
                        "\"sliding_friction\"?"));
  EXPECT_THAT(ErrorOf("{{ x }}"), HasSubstr("\"x\" is not known"));  // only inside grains
  EXPECT_THAT(ErrorOf("{{# walls }}{{/ walls }}"), HasSubstr("\"walls\" is not known"));
  EXPECT_THAT(ErrorOf("a\n\n{{ seed"), HasSubstr("deck:3: \"{{\" has no \"}}\""));
  EXPECT_THAT(ErrorOf("{{ 2 * seed }}"), HasSubstr("must hold a name"));
  EXPECT_THAT(ErrorOf("{{# grains }}"), HasSubstr("is not closed"));
  EXPECT_THAT(ErrorOf("{{/ grains }}"), HasSubstr("closes nothing"));
  EXPECT_THAT(ErrorOf("{{# grains }}{{# grains }}{{/ grains }}"), HasSubstr("inside another"));
}

TEST(TextTemplate, NumbersAreReadBackAsTheSame) {
  base::Random random(1, base::Stream("numbers"));
  for (int i = 0; i < 1000; ++i) {
    const double value = std::exp(random.Uniform(-40, 40));
    EXPECT_EQ(std::stod(base::ExactNumber(value)), value);
  }
  EXPECT_EQ(base::ExactNumber(0.25), "0.25");
}

}  // namespace template_text_test
}  // namespace talus::trials
