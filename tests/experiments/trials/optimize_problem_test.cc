#include "experiments/trials/optimize/optimize_problem.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/json/json_schema.h"

namespace talus::trials {
namespace optimize_problem_test {

TEST(OptimizeProblem, ShippedSchemaIsThatOfTheParser) {
  const std::string path = TALUS_SOURCE_DIR "/docs/optimize.schema.json";
  const std::string schema =
      base::FileSchema<OptimizeProblem>("talus optimize problem").dump(2) + "\n";
  if (std::getenv("TALUS_UPDATE_SCHEMAS") != nullptr) base::WriteFileAtomically(path, schema);
  EXPECT_TRUE(base::ReadFile(path) == schema) << path << ": TALUS_UPDATE_SCHEMAS=1 makes it anew";
}

TEST(OptimizeProblem, ExampleIsRead) {
  const auto problem = base::LoadOptions<OptimizeProblem>(
      base::ReadJsonFile(TALUS_SOURCE_DIR "/examples/optimize/bowl.json"));
  EXPECT_EQ(problem.space.Free().size(), 2u);
  EXPECT_EQ(problem.evaluations, 40);
}

}  // namespace optimize_problem_test
}  // namespace talus::trials
