#include "base/text/printable.h"

#include <gtest/gtest.h>

#include <sstream>

namespace talus::base {
namespace printable_test {

TEST(Printable, KeepsTextsAsTheyAre) {
  for (const char* text : {"", "trial 3: 4.1 mm²", "a\tb\nc", "Größe 粉体 😀"}) {
    EXPECT_EQ(Printable(text), text);
  }
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(Printable("\x1b]0;title\x07"), "\\x1b]0;title\\x07");
  EXPECT_EQ(Printable("a\rb\x7f"), "a\\x0db\\x7f");
  EXPECT_EQ(Printable("\xc2\x9b"
                      "2J"),
            "\\xc2\\x9b"
            "2J");  // CSI as one character of C1
  EXPECT_EQ(Printable("\x9b"
                      "2J"),
            "\\x9b"
            "2J");                                                // and as one byte
  EXPECT_EQ(Printable("\xe2\x80\xaegnp"), "\\xe2\\x80\\xaegnp");  // writes from right to left
  EXPECT_EQ(Printable("\xc0\x9b \xed\xa0\x80"), "\\xc0\\x9b \\xed\\xa0\\x80");  // not UTF-8
}

TEST(Printable, StreamFiltersWhateverThePiecesAre) {
  std::ostringstream target;
  {
    const PrintableStream filter(target);
    target << "a\x1b[2J" << 12 << "\xe7"
           << "\xb2"
           << "\x89";                                 // 粉 in three pieces
    target << '\x07' << "\xe7" << std::flush << "b";  // one that never ends
  }
  EXPECT_EQ(target.str(), "a\\x1b[2J12粉\\x07\\xe7b");
  target << "\x1b";  // its own again
  EXPECT_EQ(target.str().back(), '\x1b');
}

TEST(Printable, KnowsWhatIsUtf8) {
  for (const char* text : {"", "plain", "Größe 粉体 😀", "\x1b\x7f"}) EXPECT_TRUE(IsUtf8(text));
  for (const char* text : {"l\xe4", "\xc0\x9b", "\xed\xa0\x80", "\xe7\xb2"})
    EXPECT_FALSE(IsUtf8(text));
}

TEST(Printable, ControlsAreFound) {
  EXPECT_FALSE(HasControl("a b ü"));
  EXPECT_FALSE(HasControl("l\xe4nge"));  // not UTF-8, but obeyed by nobody
  for (const char* text : {"\n", "a\tb", "\x1b", "\x7f",
                           "\xc2\x9b"
                           "2J",
                           "a\u202e"
                           "b"}) {
    EXPECT_TRUE(HasControl(text)) << text;
  }
}

}  // namespace printable_test
}  // namespace talus::base
