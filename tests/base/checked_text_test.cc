#include "base/files/checked_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace talus::base {
namespace checked_text_test {

using ::testing::HasSubstr;

class CheckedTextShapes : public ::testing::TestWithParam<const char*> {};

TEST_P(CheckedTextShapes, IsGivenBackAsItWas) {
  const std::string text = GetParam();
  const std::string checked = WithChecksum(text);
  EXPECT_THAT(checked, HasSubstr("\"checksum_xxh3\": \""));
  EXPECT_EQ(CheckedText(checked, "file"), text);
  EXPECT_EQ(IfWhole(checked), text);
  EXPECT_EQ(IfWhole(text), std::nullopt);
  EXPECT_EQ(CheckedText(text, "file"), std::nullopt);
}

TEST_P(CheckedTextShapes, IsNotWholeWithAnyBitFlippedOrAnyEndCutOff) {
  const std::string checked = WithChecksum(GetParam());
  for (std::size_t bit = 0; bit < 8 * checked.size(); ++bit) {
    std::string flipped = checked;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    EXPECT_EQ(IfWhole(flipped), std::nullopt) << "bit " << bit;
  }
  for (std::size_t size = 0; size < checked.size(); ++size) {
    EXPECT_EQ(IfWhole(checked.substr(0, size)), std::nullopt) << "cut at " << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CheckedTextShapes,
                         ::testing::Values("{\"a\": 1}\n", "{\n  \"a\": 1,\n  \"b\": 2\n}\n"));

TEST(CheckedText, NamesWhatIsDamaged) {
  std::string checked = WithChecksum("{\"a\": 1}\n");
  checked[6] = '2';
  try {
    CheckedText(checked, "trial.json");
    FAIL() << "another answer was read";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trial.json: is damaged"));
  }
}

}  // namespace checked_text_test
}  // namespace talus::base
