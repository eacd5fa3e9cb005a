// Texts from outside, such as file names and the logs of other programs, made safe to show: a
// terminal obeys what follows an escape character.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace talus::base {

// Every control character but the line feed and the tab, and every byte that is not UTF-8, is
// written as "\x1b".
std::string Printable(std::string_view text);

// The character that a text starts with.
struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;   // in bytes; 0 where it is not UTF-8, or the text is empty
  bool is_control = false;  // a terminal may obey it; what turns the direction of writing, too
};
Character FirstCharacter(std::string_view text);
bool IsUtf8(std::string_view text);

// Whether a text holds a control character, the line feed and the tab among them.
bool HasControl(std::string_view text);

// Our own control sequence, past any filter: back to the start of the line, which becomes empty.
void EraseTerminalLine(int descriptor);

// While it lives, what is written to `stream` becomes printable on its way.
class PrintableStream {
 public:
  explicit PrintableStream(std::ostream& stream);
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;
  ~PrintableStream();

 private:
  class Filter : public std::streambuf {
   public:
    explicit Filter(std::streambuf* target) : target_(target) {}
    std::streambuf* target() const { return target_; }

   protected:
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int sync() override;

   private:
    bool Pass(bool all);

    std::streambuf* target_;
    std::string held_;  // the start of a character of several bytes
  };

  std::ostream& stream_;
  Filter filter_;
};

}  // namespace talus::base
