#include "experiments/trials/engines/talus_engine.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "base/files/checked_text.h"
#include "base/files/file.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

// A result.json that a flipped bit had changed was another answer, where the journal did not have
// the trial yet.
TEST(TalusEngine, ATrialWithADamagedResultIsNotComplete) {
  const fs::path folder =
      fs::temp_directory_path() / ("talus_engine_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fs::path file = folder / "result.json";
  TalusEngine engine("talus");
  EXPECT_FALSE(engine.IsComplete(folder));
  const std::string whole = base::WithChecksum("{\n  \"status\": \"ok\",\n  \"num_steps\": 7\n}\n");
  base::WriteFileAtomically(file, whole, base::Outlives::kProgram);
  EXPECT_TRUE(engine.IsComplete(folder));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    base::WriteFileAtomically(file, damaged, base::Outlives::kProgram);
    EXPECT_FALSE(engine.IsComplete(folder)) << "byte " << i;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace talus::trials
