#include "base/text/name.h"

#include <gtest/gtest.h>

namespace talus::base {
namespace name_test {

bool IsRefused(const std::string& name) {
  Problems problems;
  RequireName(problems, "name", name);
  return !problems.empty();
}

TEST(Name, IsAnyLineThatNoFormatTakesForMore) {
  for (const char* name : {"plate", "wide plate 2", "μ_r", "d50-d90", "a=b", "粉体", "1"}) {
    EXPECT_FALSE(IsRefused(name)) << name;
  }
}

TEST(Name, HasNoLineBreakSlashOrFormula) {
  for (const char* name : {"", "a\nshell rm", "a\tb", "\x1b[2J", "d50/d90", "..\\x",
                           "=cmd|'/c calc'!A1", "+1", "-x", "@sum", "\xff",
                           "\xc2\x9b"
                           "2J",
                           "a\u202e"
                           "b"}) {
    EXPECT_TRUE(IsRefused(name)) << name;
  }
  EXPECT_FALSE(IsRefused(std::string(100, 'n')));
  EXPECT_TRUE(IsRefused(std::string(101, 'n')));
}

TEST(Name, FromOutsideBecomesOneLine) {
  EXPECT_EQ(OneLine("μ a\nshell\x1b\xff!"), "μ a shell  !");
  EXPECT_EQ(OneLine(""), "");
}

// "müll" and "möll" were one folder, "ящик" and "中" another.
TEST(Name, AsAFilesKeepsLettersOfAnyScript) {
  EXPECT_EQ(FileWord("müll 2"), "müll-2");
  EXPECT_EQ(FileWord("ящик.中"), "ящик-中");
  EXPECT_EQ(FileWord("a/../b\x1b[2J\xff\u2028c\u00a0d"), "a-b-2J-c-d");
  EXPECT_EQ(FileWord("//"), "test");
}

}  // namespace name_test
}  // namespace talus::base
