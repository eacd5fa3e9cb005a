#include "base/text/printable.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace talus::base {
namespace {

unsigned char Byte(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

// Bytes of the character that begins with `first`; 0 when none of UTF-8 does.
std::size_t LengthOf(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

bool IsControl(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) ||                            // C0, DEL, C1
         (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);  // direction
}

bool IsBlank(char c) { return c == '\n' || c == '\t'; }

}  // namespace

Character FirstCharacter(std::string_view text) {
  const unsigned char first = Byte(text, 0);
  const std::size_t length = LengthOf(first);
  if (length == 0 || length > text.size()) return {};
  std::uint32_t code = length == 1 ? first : first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((Byte(text, i) & 0xc0) != 0x80) return {};
    code = code << 6 | (Byte(text, i) & 0x3fu);
  }
  // Too long forms, and surrogates.
  if ((length == 3 && code < 0x800) || (length == 4 && code < 0x10000) || code > 0x10ffff)
    return {};
  if (code >= 0xd800 && code < 0xe000) return {};
  return {.code = code, .length = length, .is_control = IsControl(code)};
}

bool IsUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = FirstCharacter(text).length;
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string Printable(std::string_view text) {
  std::string printable;
  printable.reserve(text.size());
  while (!text.empty()) {
    const Character next = FirstCharacter(text);
    std::size_t length = next.length;
    if (length > 0 && (!next.is_control || IsBlank(text[0]))) {
      printable += text.substr(0, length);
    } else {
      char code[5];
      std::snprintf(code, sizeof code, "\\x%02x", Byte(text, 0));
      printable += code;
      length = 1;
    }
    text.remove_prefix(length);
  }
  return printable;
}

bool HasControl(std::string_view text) {
  while (!text.empty()) {
    const Character next = FirstCharacter(text);
    if (next.is_control) return true;
    text.remove_prefix(std::max<std::size_t>(next.length, 1));
  }
  return false;
}

void EraseTerminalLine(int descriptor) {
  constexpr char kErase[] = "\r\033[K";
  (void)!::write(descriptor, kErase, sizeof kErase - 1);
}

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), filter_(stream.rdbuf()) {
  stream_.rdbuf(&filter_);
}

PrintableStream::~PrintableStream() {
  stream_.flush();
  stream_.rdbuf(filter_.target());
}

// Sends on what is held, but not a character whose end may still come, unless `all`.
bool PrintableStream::Filter::Pass(bool all) {
  std::size_t whole = held_.size();
  for (std::size_t back = 1; !all && back <= std::min<std::size_t>(3, held_.size()); ++back) {
    const std::size_t at = held_.size() - back;
    const unsigned char byte = Byte(held_, at);
    if (byte < 0xc0) continue;
    if (LengthOf(byte) > back) whole = at;
    break;
  }
  const std::string text = Printable(std::string_view(held_).substr(0, whole));
  held_.erase(0, whole);
  const auto count = static_cast<std::streamsize>(text.size());
  return target_->sputn(text.data(), count) == count;
}

PrintableStream::Filter::int_type PrintableStream::Filter::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof()))
    return traits_type::not_eof(character);
  held_ += traits_type::to_char_type(character);
  return Pass(false) ? character : traits_type::eof();
}

std::streamsize PrintableStream::Filter::xsputn(const char* text, std::streamsize count) {
  held_.append(text, static_cast<std::size_t>(count));
  return Pass(false) ? count : 0;
}

int PrintableStream::Filter::sync() { return Pass(true) ? target_->pubsync() : -1; }

}  // namespace talus::base
