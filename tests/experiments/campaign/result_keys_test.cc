// Every key that result.json may have stands in docs/results.md.
#include <gtest/gtest.h>

#include "base/files/file.h"
#include "experiments/campaign/answer/answer.h"
#include "tests/experiments/documented_keys.h"

namespace talus::campaign {
namespace result_keys_test {

// With one of everything.
Answer FullAnswer() {
  Answer answer;
  answer.stop.rule.emplace();
  answer.unsettled.emplace().narrowing.resize(1);
  answer.verdict.emplace();
  ResultParameter& parameter = answer.parameters.emplace_back();
  parameter.prior.emplace();
  parameter.nuisance.emplace();
  ResultExperiment& experiment = answer.experiments.emplace_back();
  experiment.powder_area = experiment.noise_floor = experiment.noise_sd = 1;
  experiment.replicates_sd = 1;
  experiment.numbers.resize(1);
  ResultConfirmed& confirmed = answer.confirmed.emplace_back().experiments.emplace_back();
  confirmed.sad_mm2 = confirmed.sad_standard_error = confirmed.profile_sad_mm2 = 1;
  confirmed.over_floor = confirmed.spread_mm2 = 1;
  confirmed.scalars.emplace_back().undefined = "none";
  answer.remains.emplace_back().share = 1;
  ResultPosterior& posterior = answer.posterior.emplace();
  posterior.branches.resize(1);
  posterior.alone.resize(1);
  posterior.experiments.emplace_back().numbers.resize(1);
  answer.held_out.emplace().numbers.resize(1);
  answer.conditions.devices.resize(1);
  answer.reused.resize(1);
  return answer;
}

TEST(ResultKeys, StandInTheDocs) {
  const auto json = nlohmann::ordered_json::parse(AnswerJson(FullAnswer()), nullptr, false);
  ASSERT_TRUE(json.contains("held_out"));
  ASSERT_TRUE(json["confirmed"][0]["experiments"][0]["scalars"][0].contains("undefined"));
  // What a strategy's rule holds is its own.
  ExpectKeysIn(base::ReadFile(TALUS_SOURCE_DIR "/docs/results.md"), json, "rule");
}

}  // namespace result_keys_test
}  // namespace talus::campaign
