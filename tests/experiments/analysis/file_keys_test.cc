// Every key of the files that `talus sensitivity` and `talus predict` leave stands in the docs.
#include <gtest/gtest.h>

#include "base/files/file.h"
#include "base/json/json_writer.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/sensitivity/sensitivity_table.h"
#include "tests/experiments/documented_keys.h"

namespace talus::analysis {
namespace file_keys_test {

TEST(FileKeys, OfSensitivityStandInTheDocs) {
  SensitivityTable table;
  table.parameters.resize(1);
  FixedMove& move = table.moves.emplace_back();
  move.outputs.resize(1);
  move.answer.resize(1);
  const auto json = base::ToJson(table);
  ASSERT_TRUE(json["moves"][0]["answer"][0].contains("shift_in_half_ranges"));
  ExpectKeysIn(base::ReadFile(TALUS_SOURCE_DIR "/docs/sensitivity.md"), json);
}

TEST(FileKeys, OfAPredictionStandInTheDocs) {
  Prediction prediction;
  prediction.draws.resize(1);
  prediction.runs.resize(1);
  prediction.regimes.resize(1);
  prediction.image.emplace();
  PredictedNumber& number = prediction.numbers.emplace_back();
  number.surrogate.emplace();
  number.measured.emplace();
  const auto json = base::ToJson(prediction);
  ASSERT_TRUE(json["numbers"][0]["measured"].contains("nearest_is_inside"));
  ExpectKeysIn(base::ReadFile(TALUS_SOURCE_DIR "/docs/predict.md"), json);
}

}  // namespace file_keys_test
}  // namespace talus::analysis
