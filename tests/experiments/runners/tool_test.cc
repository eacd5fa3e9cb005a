#include "experiments/runners/tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

namespace talus::runners {
namespace tool_test {

using ::testing::HasSubstr;

TEST(Tool, GivesOutputStatusAndAnEndToWhatHangs) {
  const ToolResult good = RunTool({"sh", "-c", "echo out; echo err >&2; exit 4"});
  EXPECT_EQ(good.status, 4);
  EXPECT_EQ(good.output, "out\n");
  EXPECT_EQ(good.errors, "err\n");
  EXPECT_EQ(RunTool({"talus-no-such-program"}).status, 127);
  const ToolResult endless =
      RunTool({"yes"},
              {.time_cap = 60, .output_file = {}, .input = {}, .mark = {}, .most_output = 1 << 20});
  EXPECT_FALSE(endless.ok());
  EXPECT_THAT(endless.errors, HasSubstr("printed more than 1 MiB"));
  const ToolResult hung =
      RunTool({"sleep", "100"}, {.time_cap = 0.1, .output_file = std::filesystem::path()});
  EXPECT_FALSE(hung.ok());
  EXPECT_THAT(hung.errors, HasSubstr("gave no answer in time"));
}

// What a command leaves in the background keeps its pipes open; what closes them may hang all the
// same.
TEST(Tool, WaitsForTheCommandAndForNothingElse) {
  const auto seconds = [](const std::string& script, const ToolOptions& options,
                          ToolResult& result) {
    const auto start = std::chrono::steady_clock::now();
    result = RunTool({"sh", "-c", script}, options);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  ToolResult result;
  EXPECT_LT(seconds("sleep 100 & echo out", {.time_cap = 60}, result), 50);
  EXPECT_EQ(result.output, "out\n");
  EXPECT_TRUE(result.ok());
  EXPECT_LT(seconds("exec >&- 2>&-; sleep 100", {.time_cap = 0.2}, result), 50);
  EXPECT_FALSE(result.ok());
  int asked = 0;
  const ToolOptions stopped{.time_cap = 60, .is_stopped = [&] { return ++asked > 3; }};
  EXPECT_LT(seconds("sleep 100", stopped, result), 50);
  EXPECT_FALSE(result.ok());
  EXPECT_THAT(result.errors, HasSubstr("was stopped"));
}

}  // namespace tool_test
}  // namespace talus::runners
