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
                           "=cmd|'/c calc'!A1", "+1", "-x", "@sum", "\xff"}) {
    EXPECT_TRUE(IsRefused(name)) << name;
  }
  EXPECT_FALSE(IsRefused(std::string(100, 'n')));
  EXPECT_TRUE(IsRefused(std::string(101, 'n')));
}

TEST(Name, FromOutsideBecomesOneLine) {
  EXPECT_EQ(OneLine("μ a\nshell\x1b\xff!"), "μ a shell  !");
  EXPECT_EQ(OneLine(""), "");
}

}  // namespace name_test
}  // namespace talus::base
