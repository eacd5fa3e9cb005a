// Numbers and tables as text.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/median.h"
#include "base/prime.h"
#include "base/replaced.h"
#include "base/text/base64.h"
#include "base/text/csv.h"
#include "base/text/joined.h"
#include "base/text/lower.h"
#include "base/text/markup.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"

namespace talus::base {
namespace text_test {

TEST(Lists, AreReadAsSentences) {
  EXPECT_EQ(Listed({}), "");
  EXPECT_EQ(Listed({"a"}), "a");
  EXPECT_EQ(Listed({"a", "b"}), "a and b");
  EXPECT_EQ(Listed({"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(LowerFirst("Mass fallen"), "mass fallen");
  EXPECT_EQ(LowerFirst("AOR 1"), "AOR 1");
}

TEST(Numbers, MediansAndPrimes) {
  EXPECT_EQ(Median(std::vector{3.0, 1.0, 2.0}), 2);
  EXPECT_EQ(Median(std::vector{4.0, 1.0, 3.0, 2.0}), 3);  // of an even number the upper one
  EXPECT_EQ(PrimeFrom(0), 2U);
  EXPECT_EQ(PrimeFrom(24), 29U);
  EXPECT_EQ(PrimeFrom(29), 29U);
  EXPECT_EQ(PrimeFrom(48), 53U);  // 49 is a square
}

TEST(NumberText, ShortRoundsAndExactReadsBack) {
  EXPECT_EQ(ShortNumber(0.123456), "0.1235");
  EXPECT_EQ(ShortNumber(1234567, 3), "1.23e+06");
  EXPECT_EQ(ShortNumber(-std::numeric_limits<double>::max(), 17).size(), 24U);
  for (const double x : {0.1, 1.0 / 3, 1e300, 5e-324, -0.0}) {
    EXPECT_EQ(std::strtod(ExactNumber(x).c_str(), nullptr), x) << x;
  }
  EXPECT_EQ(ExactNumber(0.1F), "0.1");
}

// A region of all that is searched was one of "1e+02 %", and a small one "about 0 %".
TEST(NumberText, WhatPeopleReadHasNoPowersOfTen) {
  EXPECT_EQ(PlainNumber(0.126, 2), "0.13");
  EXPECT_EQ(PlainNumber(99.4, 2), "99");
  EXPECT_EQ(PlainNumber(99.6, 2), "100");
  EXPECT_EQ(PlainNumber(-1234.4, 2), "-1234");
  EXPECT_EQ(InPercent(1), "100");
  EXPECT_EQ(InPercent(0.996), "100");
  EXPECT_EQ(InPercent(0.0034), "0.34");
  EXPECT_EQ(InPercent(3e-7), "less than 0.01");
  EXPECT_EQ(InPercent(0), "0");
}

TEST(NumberText, FileNumbersSortUpToTenThousand) {
  EXPECT_EQ(FileNumber(7), "0007");
  EXPECT_EQ(FileNumber(12345), "12345");
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe\xfd"), "//79");
}

TEST(Replaced, EverywhereAndWhatIsPutInIsLeftAlone) {
  EXPECT_EQ(Replaced("m2/m2", "m2", "m^2m2"), "m^2m2/m^2m2");
  EXPECT_EQ(Replaced("a\n\nb\n", "\n", "\\x0a"), "a\\x0a\\x0ab\\x0a");
  EXPECT_EQ(Replaced("", "x", "y"), "");
  EXPECT_EQ(Replaced("x", "x", ""), "");
}

TEST(Csv, QuotesWhatTheFormatNeedsAndLeavesWhatIsNotFinite) {
  base::Csv csv;
  csv.Cell("plain").Cell("a,b").Cell("say \"so\"").Cell("two\nlines").EndRow();
  csv.Cell(3).Cell(0.1).Cell(NAN).Cells({1, 2.5}).EndRow();
  EXPECT_EQ(csv.Take(), "plain,\"a,b\",\"say \"\"so\"\"\",\"two\nlines\"\n3,0.1,,1,2.5\n");
}

// A table is looked at with `cat`, too.
TEST(Csv, TextsOfOthersBecomePrintable) {
  base::Csv csv;
  csv.Cell("a\x1b[2J\r").Cell("l\xe4,b").EndRow();
  EXPECT_EQ(csv.Take(), "a\\x1b[2J\\x0d,\"l\\xe4,b\"\n");
}

TEST(Markup, TextsOfOthersStayTexts) {
  EXPECT_EQ(MarkupText("a < b & \"c\" > µ"), "a &lt; b &amp; &quot;c&quot; &gt; µ");
  EXPECT_EQ(MarkupText("</script>\x1b[2J"), "&lt;/script&gt;\\x1b[2J");
}

}  // namespace text_test
}  // namespace talus::base
