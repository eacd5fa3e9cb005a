#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "experiments/analysis/search/search_folder.h"
#include "experiments/analysis/search/search_page.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::analysis {
namespace search_report_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kProblem = R"({"problem": {"parameters": [
  {"name": "mu", "low": 0, "high": 1, "scale": "linear", "levels": []},
  {"name": "rpm", "low": null, "high": null, "scale": "linear", "levels": [10, 40]},
  {"name": "density", "scale": "linear", "fixed": 2500, "levels": []}],
  "evaluations": 4}, "command": ["x"]})";

// The second is made twice, the last is being written.
constexpr const char* kLog = R"({"evaluation":1,"parameters":{"mu":0.5,"rpm":10},"value":3.25}
{"evaluation":2,"parameters":{"mu":0.25,"rpm":40},"failed":"first"}
{"evaluation":3,"parameters":{"mu":0.75,"rpm":40},"value":1.5}
{"evaluation":2,"parameters":{"mu":0.25,"rpm":40},"failed":"<b>crash</b>"}
{"evaluation":4,"parameters":{"mu":0.)";

constexpr const char* kResult = R"({"recommended": {"mu": 0.625, "rpm": 40, "density": 2500},
  "predicted_value": 1.75, "predicted_sd": 0.125, "noise_sd": 0.5, "ranges_90": {
  "mu": {"low": 0.375, "high": 0.875, "sobol_first": 0.75, "sobol_total": 0.8125},
  "rpm": {"low": 10, "high": 40, "sobol_first": 0.1, "sobol_total": 0.2}},
  "tied_volume": 0.0625, "stopped": "all evaluations are used", "model": "a model",
  "warnings": ["mu is at its bound"]})";

// Each whole line with its checksum, as the program writes it.
std::string Sealed(const std::string& lines) {
  std::istringstream in(lines);
  std::string sealed;
  for (std::string line; std::getline(in, line);) {
    sealed += in.eof() ? line : base::WithChecksum(line + "\n");
  }
  return sealed;
}

class SearchReport : public testing::Test {
 protected:
  void SetUp() override {
    Write("problem.json", kProblem);
    Write("evaluations.jsonl", Sealed(kLog));
  }
  void Write(const std::string& name, const std::string& text) {
    base::WriteFileAtomically(scratch_.path() / name, text);
  }
  SearchFolder Read() { return ReadSearchFolder(scratch_.path()); }

  ScratchFolder scratch_;
};

TEST_F(SearchReport, ReadsWhatIsSearchedAndEachEvaluationOnce) {
  const SearchFolder search = Read();
  ASSERT_EQ(search.parameters.size(), 2u);
  EXPECT_EQ(search.parameters[1].name, "rpm");
  EXPECT_EQ(search.parameters[1].low, 10);
  EXPECT_EQ(search.parameters[1].high, 40);
  ASSERT_EQ(search.evaluations.size(), 3u);
  EXPECT_THAT(search.evaluations[0].values, ElementsAre(0.5, 10));
  EXPECT_EQ(search.evaluations[1].failure, "<b>crash</b>");
  EXPECT_EQ(search.evaluations[2].value, 1.5);
}

// `evaluations` was lowered, and the page counted and showed all that the log has.
TEST_F(SearchReport, EvaluationsThatTheResultIsNotMadeOfAreLeftOut) {
  std::string result = kResult;
  result.insert(1, R"("evaluations": 1, )");
  Write("result.json", base::WithChecksum(result + "\n"));
  EXPECT_EQ(Read().evaluations.size(), 1u);
}

TEST_F(SearchReport, ShowsASearchThatHasNotEnded) {
  const std::string page = SearchPage(Read());
  EXPECT_THAT(page, HasSubstr("3 of at most 4 evaluations, 1 failed"));
  EXPECT_THAT(page, HasSubstr("has not ended"));
  EXPECT_THAT(page, HasSubstr("<code>talus optimize</code>"));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

// "The search has not ended" was said of a command that had failed eight times.
TEST(SearchPage, OfACommandThatNeverSucceededSaysWhy) {
  SearchFolder search{.name = "x", .most_evaluations = 24};
  search.parameters = {{.name = "a", .low = 0, .high = 1}};
  for (int i = 1; i <= 8; ++i) {
    search.evaluations.push_back({.number = i, .values = {0.5}, .failure = "exit status 3: oops"});
  }
  EXPECT_THAT(SearchPage(search), HasSubstr("All have failed, the last: exit status 3: oops."));
  EXPECT_THAT(SearchPage(search), HasSubstr("mend the command"));
  SearchFolder few = search;  // a budget below eight
  few.evaluations.resize(5);
  EXPECT_THAT(SearchPage(few), HasSubstr("has not ended"));
  few.most_evaluations = 5;
  EXPECT_THAT(SearchPage(few), HasSubstr("All have failed"));
  // Values that differ in the seventh digit are shown with it.
  search.evaluations.push_back({.number = 9, .values = {0.5}, .value = 1234567});
  search.evaluations.push_back({.number = 10, .values = {0.6}, .value = 1234568});
  EXPECT_THAT(SearchPage(search), HasSubstr("1234568"));
}

TEST_F(SearchReport, ShowsTheAnswerWithItsRangesAndWarnings) {
  Write("result.json", base::WithChecksum(std::string(kResult) + "\n"));
  const std::string page = SearchPage(Read());
  EXPECT_THAT(page, HasSubstr("<tr><td>mu</td><td>0.625</td><td>0.375</td><td>0.875</td>"
                              "<td>0.75</td><td>0.8125</td><td>0.75</td></tr>"));
  EXPECT_THAT(page, HasSubstr("1.75 ± 0.125"));
  EXPECT_THAT(page, HasSubstr("Lowest value seen: 1.5, by evaluation 3"));
  EXPECT_THAT(page, HasSubstr("mu is at its bound"));
}

// The page of a search that ended before there was a model.
TEST_F(SearchReport, ShowsAnAnswerWithoutRanges) {
  Write("result.json",
        Sealed("{\"recommended\": {\"mu\": 0.625, \"rpm\": 40}, \"stopped\": \"interrupted\"}\n"));
  EXPECT_THAT(SearchPage(Read()), HasSubstr("<tr><td>mu</td><td>0.625</td><td>–</td><td>–</td>"));
}

TEST_F(SearchReport, LoadsNothingAndTakesNoWordForMarkup) {
  const std::string page = SearchPage(Read());
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;crash"));
  EXPECT_THAT(page, Not(HasSubstr("<b>crash")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
}

TEST_F(SearchReport, PutsFiguresAndTheTableBesideThePage) {
  const auto out = scratch_.path() / "report";
  WriteSearchReport(Read(), out);
  EXPECT_TRUE(std::filesystem::exists(out / "report.html"));
  EXPECT_TRUE(std::filesystem::exists(out / "figures" / "along_rpm.svg"));
  EXPECT_THAT(base::ReadFile(out / "tables" / "evaluations.csv"),
              HasSubstr("evaluation,mu,rpm,value,failed\n1,0.5,10,3.25,\n"));
}

TEST_F(SearchReport, NamesTheFileAndLineOfWhatIsDamaged) {
  const auto read = [this] { Read(); };
  Write("evaluations.jsonl", Sealed("{\"evaluation\":1,\"parameters\":{\"mu\":0.5}}\n"));
  EXPECT_THAT(read, testing::ThrowsMessage<base::ConfigError>(HasSubstr("evaluations.jsonl:1")));
  Write("evaluations.jsonl", "");
  Write("result.json", "{}");
  EXPECT_THAT(read, testing::ThrowsMessage<base::ConfigError>(HasSubstr("result.json")));
  Write("problem.json", "[]");
  EXPECT_THAT(read, testing::ThrowsMessage<base::ConfigError>(HasSubstr("problem.json")));
}

// A digit turned over in a log or a result was another number on the page.
TEST_F(SearchReport, RefusesWhatDoesNotMatchItsChecksum) {
  const auto read = [this] { Read(); };
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const auto refused = [](const char* name) {
    return testing::ThrowsMessage<base::Error>(AllOf(HasSubstr(name), HasSubstr("is damaged")));
  };
  Write("evaluations.jsonl", changed(Sealed(kLog), "1.5", "7.5"));
  EXPECT_THAT(read, refused("evaluations.jsonl:3"));
  Write("evaluations.jsonl", Sealed(kLog));
  const std::string result = base::WithChecksum(std::string(kResult) + "\n");
  Write("result.json", changed(result, "0.625", "0.725"));
  EXPECT_THAT(read, refused("result.json"));
  Write("result.json", result);
  const std::string problem = base::WithChecksum(std::string(kProblem) + "\n");
  Write("problem.json", changed(problem, "\"high\": 1", "\"high\": 3"));
  EXPECT_THAT(read, refused("problem.json"));
  Write("problem.json", problem);
  EXPECT_NO_THROW(read());
}

}  // namespace search_report_test
}  // namespace talus::analysis
