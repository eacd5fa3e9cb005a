#include "imaging/formats/spheres/text_cursor.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/trimmed.h"

namespace talus::imaging {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";

// As an error shows it.
std::string Quoted(std::string_view word) {
  constexpr std::size_t kMost = 40;
  return '"' + std::string(word.substr(0, kMost)) + (word.size() > kMost ? "…\"" : "\"");
}

// Whether a number out of the range of doubles is too small, not too large.
bool IsTiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return word.substr(exponent + 1).starts_with('-');
  const std::size_t digit = word.find_first_not_of("-0");  // 0.000…1 or 1000…
  return digit != std::string_view::npos && word[digit] == '.';
}

}  // namespace

std::string_view TextCursor::Line() {
  if (AtEnd()) Fail("the file ends too early; was it cut off while it was written?");
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = text_.substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::string_view TextCursor::Word() {
  position_ = std::min(text_.find_first_not_of(kSpace, position_), text_.size());
  const std::size_t end = std::min(text_.find_first_of(kSpace, position_), text_.size());
  const std::string_view word = text_.substr(position_, end - position_);
  position_ = end;
  return word;
}

double TextCursor::Number() {
  const std::string_view word = Word();
  double value = 0;
  if (word.empty()) Fail("the file ends too early; was it cut off while it was written?");
  if (!ParseNumber(word, value)) Fail(Quoted(word) + " is not a number");
  return value;
}

std::size_t TextCursor::Count() {
  const std::string_view word = Word();
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    Fail(Quoted(word) + " is not a count");
  }
  // Every value takes at least a byte, so a larger count is wrong, and must not become memory.
  if (value > text_.size()) {
    Fail("says that " + std::string(word) + " values follow, more than the file holds");
  }
  return value;
}

std::string_view TextCursor::Bytes(std::size_t count) {
  if (count > text_.size() - std::min(position_, text_.size())) {
    Fail("the file ends too early; was it cut off while it was written?");
  }
  const std::string_view bytes = text_.substr(position_, count);
  position_ += count;
  return bytes;
}

void TextCursor::Fail(const std::string& what) const {
  // A line that has just been read, with its end, is still the place.
  const std::size_t read = std::min(position_, text_.size());
  const std::string_view before = text_.substr(0, read == 0 ? 0 : read - 1);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw base::ConfigError(file_ + ":" + std::to_string(line) + ": " + what);
}

bool ParseNumber(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Both 1e-320 and 1e400 are out of range, and only the exponent's sign tells which: the one is
    // as good as zero, the other no length.
    if (!IsTiny(word)) return false;
    value = 0;
  }
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t start = line.find_first_not_of(kSpace);
  while (start != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kSpace, start), line.size());
    words.push_back(line.substr(start, end - start));
    start = line.find_first_not_of(kSpace, end);
  }
  return words;
}

std::string_view Trimmed(std::string_view text) { return base::Trimmed(text, kSpace); }

}  // namespace talus::imaging
